"""Which arrays are taken, without a copy where their memory allows, and which are refused."""

import tracemalloc
from typing import Any

import numpy as np
import pytest

import pierce
from meshes import random_segments, sphere, tetrahedron


@pytest.fixture
def mesh(scalar: Any) -> pierce.CollisionMesh:
    vertices, faces = sphere()
    return pierce.CollisionMesh(vertices.astype(scalar), faces)


def layouts(points: Any) -> dict[str, Any]:
    """The same points in other memory."""
    wide = np.full((len(points), 5), np.nan, points.dtype)
    wide[:, 1:4] = points
    packed = np.zeros(len(points), [("gap", "u1"), ("point", points.dtype, (3,))])
    packed["point"] = points
    every_other = np.repeat(points, 2, axis=0)
    read_only = points.copy()
    read_only.flags.writeable = False
    return {"columns of a table": wide[:, 1:4], "packed records": packed["point"], "every other": every_other[::2],
            "backwards": points[::-1].copy()[::-1], "Fortran": np.asfortranarray(points), "read only": read_only,
            "other byte order": points.astype(points.dtype.newbyteorder()), "mirrored": points[:, ::-1].copy()[:, ::-1]}


def test_layouts(mesh: pierce.CollisionMesh) -> None:
    starts, ends = (points.astype(mesh.dtype) for points in random_segments(5000))
    expected = mesh.first_hits(starts, ends)
    inside = mesh.contains(starts)
    for name, points in layouts(starts).items():
        hits = mesh.first_hits(points, ends)
        for column, values in expected.columns().items():
            assert values.tobytes() == hits.columns()[column].tobytes(), (name, column)
        assert (mesh.contains(points) == inside).all(), name


def test_copies_nothing(mesh: pierce.CollisionMesh) -> None:
    points = random_segments(100_000)[0].astype(mesh.dtype)
    for name, some in layouts(points).items():
        tracemalloc.start()
        mesh.contains(some)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        copied = name in ("Fortran", "other byte order", "mirrored")
        assert (peak > points.nbytes) == copied, name


def test_one_point_for_all(mesh: pierce.CollisionMesh) -> None:
    starts, _ = (points.astype(mesh.dtype) for points in random_segments(1000))
    one = np.zeros(3, mesh.dtype)
    repeated = np.repeat(one[None], 1000, axis=0)
    faces, expected = (mesh.first_hits(some, starts, sides="both").face for some in (one, repeated))
    assert (faces == expected).all() and (faces != pierce.NO_FACE).any()
    assert (mesh.any_hits(starts, one) == mesh.any_hits(starts, repeated)).all()
    assert mesh.contains(one).tolist() == [True]
    assert mesh.first_hits(starts[:1], starts[0]).hit.shape == (1,)


def test_nothing(mesh: pierce.CollisionMesh) -> None:
    none = np.empty((0, 3), mesh.dtype)
    assert len(mesh.first_hits(none, none)) == len(mesh.contains([])) == len(mesh.any_hits([], [])) == 0
    offsets, hits = mesh.all_hits(none, none)
    assert offsets.tolist() == [0] and hits.point.shape == (0, 3)
    assert len(pierce.CollisionMesh([], [])) == 0
    assert not pierce.CollisionMesh(np.empty((0, 3), np.float32), []).contains([[0, 0, 0]]).any()


def test_dtype_of_the_mesh() -> None:
    vertices, faces = tetrahedron()
    for given, expected in [(vertices, np.float64), (vertices.astype(np.float32), np.float32),
                            (vertices.astype(np.float16), np.float32), (vertices.astype(np.int32), np.float64),
                            (vertices.astype(np.uint8), np.float64), (vertices.astype(int).tolist(), np.float64)]:
        mesh = pierce.CollisionMesh(given, faces)
        assert mesh.dtype == expected
        assert mesh.contains([[1, 1, 1], [2, 2, 2]]).tolist() == [True, False]
        assert mesh.first_hits([1, 1, 9], [[1, 1, -1]]).position.dtype == expected


@pytest.mark.parametrize("dtype", ["u1", "i1", "u2", "i2", "u4", "i4", "u8", "i8", ">u4", ">i4"])
def test_dtype_of_faces(dtype: str) -> None:
    vertices, faces = tetrahedron()
    wide = np.zeros((len(faces), 4), dtype)
    wide[:, :3] = faces
    for some in (faces.astype(dtype), wide[:, :3], np.asfortranarray(faces.astype(dtype))):
        assert pierce.CollisionMesh(vertices, some).contains([[1, 1, 1], [2, 2, 2]]).tolist() == [True, False]


def test_floats_go_up_and_never_down() -> None:
    vertices, faces = sphere()
    points = random_segments(1000)[0]
    floats = points.astype(np.float32)
    in_double = pierce.CollisionMesh(vertices, faces)
    in_float = pierce.CollisionMesh(vertices.astype(np.float32), faces)
    assert (in_double.contains(floats) == in_double.contains(floats.astype(np.float64))).all()
    with pytest.raises(TypeError, match=r"points: dtype float64 on a float32 mesh.*points\.astype\(numpy\.float32\)"):
        in_float.contains(points)
    with pytest.raises(TypeError, match=r"ends: dtype float64"):
        in_float.first_hits(floats, points)
    with pytest.raises(TypeError, match="limit: dtype float64"):
        in_float.any_hits_of_rays(floats, floats, np.ones(1000))
    with pytest.raises(TypeError, match="end: 0.1.* is no float32 number"):
        in_float.sweep(floats, floats, pierce.Translation([0, 0, 0], [0.1, 0, 0]))
    in_float.sweep(floats, floats, pierce.Translation([0, 0, 0], [np.float32(0.1), 0, 0]))
    with pytest.raises(TypeError, match="end: 1e-10 is no float32 number"):
        in_float.sweep(floats, floats, pierce.Translation([0, 0, 0], [1e-10, 0, 0]))
    with pytest.raises(ValueError, match=r"start: shape \(2,\), where \(3,\) is needed"):
        in_float.sweep(floats, floats, pierce.Translation([0, 0], [0, 0, 0]))
    with pytest.raises(OverflowError):
        in_float.first_hits_of_rays(floats, floats, 10**400)


def test_integers_that_are_not_exact() -> None:
    vertices, faces = tetrahedron()
    mesh = pierce.CollisionMesh(vertices, faces)
    in_float = pierce.CollisionMesh(vertices.astype(np.float32), faces)
    assert not mesh.contains([[2**53, -2**53, 0]])[0] and not in_float.contains([[2**24, 0, 0]])[0]
    for ask, large in [(mesh, 2**53 + 1), (mesh, -2**53 - 1), (mesh, 2**64 - 1), (in_float, 2**24 + 1)]:
        with pytest.raises(ValueError, match="points: integers from .* are not all exact"):
            ask.contains(np.array([[large, 0, 0]], np.uint64 if large > 2**63 else np.int64))


@pytest.mark.parametrize("points, error", [
    (np.zeros((4, 2)), "shape \\(4, 2\\), where \\(n, 3\\)"), (np.zeros(4), "shape"), (np.zeros((1, 3, 3)), "shape"),
    (np.zeros((2, 3), complex), "dtype complex128"), (np.zeros((2, 3), bool), "dtype bool"), ("word", "dtype"),
    ([[None, 1, 2]], "dtype object"), (np.zeros((2, 3), np.longdouble), "dtype float128"), (7, "shape \\(\\)")])
def test_points_that_are_none(points: Any, error: str) -> None:
    mesh = pierce.CollisionMesh(*tetrahedron())
    with pytest.raises((ValueError, TypeError), match="points: " + error):
        mesh.contains(points)


def test_meshes_that_are_none() -> None:
    vertices, faces = tetrahedron()
    for wrong, error in [([[0, 1, 4]], "face 0: vertex index 4"), ([[0, 1, 2], [0, 1, -2]], "faces: -2 in row 1"),
                         ([[0, 1, 2**40]], "faces: 1099511627776 in row 0"), ([[0, 1, 2**32]], "faces: 4294967296")]:
        with pytest.raises(pierce.MeshError, match=error):
            pierce.CollisionMesh(vertices, wrong)
    with pytest.raises(pierce.MeshError, match="vertex 2: its y coordinate is not finite"):
        pierce.CollisionMesh([[0, 0, 0], [1, 0, 0], [0, np.inf, 0]], [[0, 1, 2]])
    with pytest.raises(pierce.MeshError, match="2 faces"):
        pierce.CollisionMesh(vertices, faces, face_numbers=[1, 2])
    with pytest.raises(TypeError, match="faces: dtype float64"):
        pierce.CollisionMesh(vertices, faces.astype(float))
    with pytest.raises(ValueError, match="faces: shape"):
        pierce.CollisionMesh(vertices, faces.ravel())
    for options in ({"broadphase": "oct"}, {"backend": "abacus"}, {"cell_size": -1.0, "broadphase": "grid"},
                    {"threads": -1}):
        with pytest.raises(ValueError):
            pierce.CollisionMesh(vertices, faces, **options)
    assert issubclass(pierce.MeshError, ValueError)


def test_lengths_that_differ(mesh: pierce.CollisionMesh) -> None:
    three, two = np.zeros((3, 3), mesh.dtype), np.zeros((2, 3), mesh.dtype)
    for call, error in [(mesh.first_hits, "first_hits: 3 starts and 2 ends"), (mesh.any_hits, "any_hits: 3 starts"),
                        (mesh.first_hits_of_rays, "first_hits: 3 origins and 2 directions"),
                        (mesh.crossings, "crossings: 3"), (mesh.all_hits, "all_hits: 3")]:
        with pytest.raises(ValueError, match=error):
            call(three, two)
    with pytest.raises(ValueError, match="limit: shape"):
        mesh.first_hits_of_rays(three, three, np.ones(2, mesh.dtype))
