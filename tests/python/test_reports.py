"""Files, reports, answers as objects, and the numbers of enumerators."""

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pierce
from meshes import lattice_segments, lattice_soup, sphere, tetrahedron


def test_files(scalar: Any, tmp_path: Path) -> None:
    path = tmp_path / "house.obj"
    path.write_text("o house\nusemtl brick\nv 0 0 0\nv 1 0 0\nv 1 1.1 0\nv 0 1 0\nf 1 2 3 4\nusemtl tile\nf 1 2 3\n")
    for name in (path, str(path)):
        soup = pierce.read_mesh(name, scalar, materials=True, groups=True)
        assert soup.vertices.dtype == scalar and soup.vertices[2, 1] == scalar(1.1)
        assert soup.faces.shape == (3, 3) and soup.face_numbers is not None
        assert soup.face_numbers.tolist() == [0, 0, 1]
        assert soup.materials == ["brick", "tile"] and soup.groups == ["house"]
        assert soup.material_of_face is not None and soup.material_of_face.tolist() == [0, 1]
    assert pierce.read_mesh(path).materials == [] and pierce.read_mesh(path).material_of_face is None
    mesh = pierce.CollisionMesh.of(soup)
    assert len(mesh) == 3 and mesh.dtype == scalar and mesh.statistics()["faces"] == 2
    ends = np.array([[0.25, 0.5, 1], [0.25, 0.5, -1]], scalar)
    assert mesh.first_hits(ends[0], ends[1]).face.tolist() == [0]
    path.write_text("v 0 0 zero\n")
    with pytest.raises(pierce.MeshError, match="house.obj:1: "):
        pierce.read_mesh(path)
    with pytest.raises(pierce.MeshError, match="none.stl"):
        pierce.read_mesh(tmp_path / "none.stl")
    with pytest.raises(TypeError, match="int32"):
        pierce.read_mesh(path, np.int32)


def test_the_memory_of_a_file_outlives_it(tmp_path: Path) -> None:
    path = tmp_path / "one.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    vertices = pierce.read_mesh(path).vertices
    rubbish = [np.full((3, 3), 7.0) for _ in range(100)]
    assert vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]] and len(rubbish) == 100
    vertices[0, 0] = 5  # the caller's own


def test_objects_that_are_no_meshes() -> None:
    with pytest.raises(TypeError):
        pierce.CollisionMesh.of(3)


def test_explain_agrees_with_first_hits() -> None:
    vertices, faces = lattice_soup()
    mesh = pierce.CollisionMesh(vertices, faces)
    starts, ends = lattice_segments(300)
    hits = mesh.first_hits(starts, ends)
    reasons = set()
    for start, end, face in zip(starts, ends, hits.face):
        verdicts = mesh.explain(start, end)
        reasons |= {verdict.reason for verdict in verdicts}
        first = [verdict.face for verdict in verdicts if verdict.reason == pierce.Reason.FIRST_HIT]
        assert first == ([face] if face != pierce.NO_FACE else [])
        assert all(verdict.text for verdict in verdicts)
    assert len(reasons) > 6
    with pytest.raises(ValueError, match="one segment"):
        mesh.explain(starts, ends)


def test_mesh_report() -> None:
    vertices, faces = tetrahedron()
    report = pierce.CollisionMesh(vertices, faces).mesh_report()
    assert report.closed and report.edges_with[2] == 6 and "closed" in str(report)
    report = pierce.CollisionMesh(vertices, [*faces[1:].tolist(), faces[1].tolist(), [0, 0, 1]]).mesh_report()
    assert not report.closed and report.duplicates == 1 and report.zero_area == 1
    assert report.zero_area_triangles.tolist() == [4] and report.duplicate_triangles.tolist() == [3]
    assert report.border_edge_list.shape[1] == 2 and report.misoriented_edge_list.shape[1] == 2


def test_statistics_and_options() -> None:
    vertices, faces = sphere()
    numbers = np.arange(len(faces)) // 2
    for broadphase in ("tree", "grid"):
        mesh = pierce.CollisionMesh(vertices, faces, face_numbers=numbers, broadphase=broadphase, backend="plain",
                                    threads=2)
        statistics = mesh.statistics()
        assert statistics["broadphase"] == broadphase and statistics["backend"] == "plain"
        assert statistics["triangles"] == len(mesh) == len(faces) and statistics["faces"] == len(set(numbers))
        hits = mesh.first_hits(2 * vertices, np.zeros(3))
        assert (hits.face == hits.triangle // 2)[hits.hit].all() and hits.hit.any()


def test_answers_are_indexed_and_say_what_they_lack() -> None:
    vertices, faces = sphere()
    mesh = pierce.CollisionMesh(vertices, faces)
    hits = mesh.first_hits(2 * vertices, np.zeros(3))
    some = hits[hits.hit]
    assert isinstance(some, pierce.Hits) and len(some) == hits.hit.sum() and some.hit.all()
    assert len(hits[3]) == len(hits[-1]) == 1 and (hits[-1].point == hits.point[-1:]).all()
    assert (hits[10:20].face == hits.face[10:20]).all()
    assert (pickle.loads(pickle.dumps(hits)).point == hits.point).all()
    assert "point" in dir(hits) and "fraction" in repr(hits)
    few = mesh.first_hits(2 * vertices, np.zeros(3), wanted=["face"])
    assert set(few.columns()) == {"hit", "face"} and (few.face == hits.face).all()
    with pytest.raises(AttributeError, match="Hits.point was not asked for"):
        few.point
    with pytest.raises(AttributeError, match="Hits.colour does not exist"):
        hits.colour
    with pytest.raises(TypeError):
        iter(hits)
    with pytest.raises(ValueError, match="there is no 'colour'"):
        mesh.first_hits(vertices, vertices, wanted=("face", "colour"))
    offsets, all_hits = mesh.all_hits(2 * vertices, -2 * vertices, wanted=())
    assert set(all_hits.columns()) == {"hit"} and offsets[-1] == len(all_hits)
    for sides in ("left", 3, -1, 2**70, np.int64(-1), 1.0, None):
        with pytest.raises(ValueError, match="sides"):
            mesh.first_hits(vertices, vertices, sides=sides)  # type: ignore[arg-type]
    back = mesh.first_hits(vertices / 2, 2 * vertices, sides="back").face
    assert (back != pierce.NO_FACE).all()
    assert (mesh.first_hits(vertices / 2, 2 * vertices, sides=np.uint8(1)).face == back).all()
    assert len(hits[-1]) == len(hits[np.int64(0)]) == 1
    for index in (len(hits), -len(hits) - 1):
        with pytest.raises(IndexError, match=f"Hits\\[{index}\\], of {len(hits)}"):
            hits[index]
    located = mesh.locate(vertices)
    assert len(located[2:5].touches) == len(located.touches) and len(located[2:5]) == 3


def test_masks_of_other_faces() -> None:
    """A flag for each face, on a mesh, one with numbers of faces, a step and its ends."""
    vertices, faces = sphere(10)
    numbers = np.arange(len(faces)) // 2
    deforming = pierce.DeformingMesh(vertices, faces)
    for some, count, longer in [(pierce.CollisionMesh(vertices, faces), len(faces), False),
                                (pierce.CollisionMesh(vertices, faces, face_numbers=numbers), numbers[-1] + 1, True),
                                (deforming.step().after, len(faces), False)]:
        for size in {0, 1, count - 1, count, count + 1}:
            for ask in (some.first_hits, some.any_hits, some.all_hits):
                if size == count or (longer and size > count):
                    ask(-2 * vertices, 2 * vertices, mask=np.ones(size, bool))
                    continue
                with pytest.raises(ValueError, match=f"mask: {size} entries, where .*{count} are needed"):
                    ask(vertices, vertices, mask=np.ones(size, bool))
    with pytest.raises(ValueError, match="mask: 1 entries"):
        deforming.step().sweep(vertices, vertices, mask=[True])
    nothing = pierce.CollisionMesh([], [])
    assert not nothing.any_hits(vertices, -vertices, mask=np.ones(len(nothing), bool)).any()


def test_numbers_of_enumerators() -> None:
    from pierce import _pierce

    kinds = (pierce.Sides, pierce.Feature, pierce.Place, pierce.PassageKind, pierce.MoveState, pierce.Reason)
    ours = {kind.__name__: {one.name.lower(): int(one) for one in kind} for kind in kinds}
    assert ours == _pierce.enumerators()
