"""Hits against an exact judge in fractions, on coordinates where most queries are degenerate."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import judge
import pierce
from meshes import lattice_segments, lattice_soup, random_segments, sphere, tetrahedron


@pytest.fixture(params=["lattice", "sphere"])
def case(request: pytest.FixtureRequest, scalar: Any) -> Any:
    """A mesh, its triangles for the judge, and segments."""
    if request.param == "lattice":
        (vertices, faces), (starts, ends) = lattice_soup(), lattice_segments(1500)
    else:
        (vertices, faces), (starts, ends) = sphere(4), random_segments(300)
    vertices, starts, ends = (array.astype(scalar) for array in (vertices, starts, ends))
    triangles = [[judge.exact(vertices[corner]) for corner in face] for face in faces]
    return pierce.CollisionMesh(vertices, faces), triangles, starts, ends


def test_first_and_any_and_all_hits(case: Any) -> None:
    mesh, triangles, starts, ends = case
    hits, any_hits = mesh.first_hits(starts, ends), mesh.any_hits(starts, ends)
    offsets, all_hits = mesh.all_hits(starts, ends)
    ulp = Fraction(float(np.finfo(mesh.dtype).eps))
    some = 0
    for i, (start, end) in enumerate(zip(starts, ends)):
        expected = judge.hits_in_order(start, end, triangles)
        assert hits.hit[i] == any_hits[i] == bool(expected)
        row = all_hits[offsets[i]:offsets[i + 1]]
        assert row.face.tolist() == [hit.face for hit in expected]
        if not expected:
            assert hits.face[i] == pierce.NO_FACE and not hits.point[i].any() and hits.fraction[i] == 0
            continue
        some += 1
        first = expected[0]
        assert hits.face[i] == hits.triangle[i] == first.face
        assert hits.side[i] == pierce.Sides.FRONT
        assert hits.feature[i] == first.zero_edges
        assert hits.at_start[i] == (first.fraction == 0)
        assert abs(Fraction(float(hits.exact_fraction[i])) - first.fraction) <= ulp
        assert Fraction(float(hits.fraction[i])) <= first.fraction
        if mesh.dtype == np.float64:  # a fraction becomes the nearest float
            assert hits.position[i].tolist() == [float(x) for x in first.position]
    assert some > 50


def test_the_way_to_a_point_is_clear(case: Any) -> None:
    mesh, _, starts, ends = case
    hits = mesh.first_hits(starts, ends)
    assert not mesh.any_hits(starts[hits.hit], hits.point[hits.hit]).any()
    assert mesh.any_hits(starts[hits.hit], ends[hits.hit]).all()


def test_options(case: Any) -> None:
    mesh, triangles, starts, ends = case
    allowed = np.arange(len(triangles)) % 3 != 0
    masked = mesh.first_hits(starts, ends, mask=allowed)
    early = mesh.first_hits(starts, ends, max_fraction=0.5)
    for i, (start, end) in enumerate(zip(starts, ends)):
        expected = judge.hits_in_order(start, end, triangles)
        rest = [hit.face for hit in expected if allowed[hit.face]]
        assert masked.face[i] == (rest[0] if rest else pierce.NO_FACE)
        assert early.hit[i] == bool(expected and expected[0].fraction <= Fraction(1, 2))
    assert (mesh.any_hits(starts, ends, mask=allowed.astype(np.int64)) == masked.hit).all()
    assert not mesh.any_hits(starts, ends, mask=np.zeros(len(triangles), bool)).any()
    assert not mesh.any_hits(starts, ends, max_fraction=float("nan")).any()
    back = mesh.first_hits(starts, ends, sides="back")
    assert (back.side[back.hit] == pierce.Sides.BACK).all() and back.hit.any()
    both = mesh.any_hits(starts, ends, sides=pierce.Sides.BOTH)
    assert (both | ~mesh.any_hits(starts, ends)).all()


def test_places_in_a_tetrahedron(scalar: Any) -> None:
    vertices, faces = tetrahedron()
    mesh = pierce.CollisionMesh(vertices.astype(scalar), faces)
    axis = np.arange(-2, 11) / 2
    points = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3).astype(scalar)
    planes = np.concatenate([points, 4 - points.sum(axis=1, keepdims=True)], axis=1)  # exact: halves
    least = planes.min(axis=1)
    expected = np.where(least > 0, pierce.Place.INSIDE,
                        np.where(least == 0, pierce.Place.ON_SURFACE, pierce.Place.OUTSIDE))
    located = mesh.locate(points)
    assert (located.place == expected).all() and len(set(expected)) == 3
    on_surface = expected == pierce.Place.ON_SURFACE
    assert (located.face_count == np.where(on_surface, (planes == 0).sum(axis=1), 0)).all()
    assert (located.winding_number == mesh.winding_numbers(points)).all()
    assert (mesh.contains(points) == (located.winding_number != 0)).all()
    assert (mesh.contains(points)[~on_surface] == (least[~on_surface] > 0)).all()
    plane_of = {0: 2, 1: 1, 2: 0, 3: 3}  # the faces' planes among the columns
    for i in np.flatnonzero(on_surface):
        touches = located.touches[located.first_face[i]:located.first_face[i] + located.face_count[i]]
        zero = sorted(np.flatnonzero(planes[i] == 0).tolist())
        assert sorted(plane_of[int(face)] for face in touches.face) == zero
        assert (touches.feature == len(zero) - 1).all()


def test_crossings_and_passages(case: Any) -> None:
    mesh, _, starts, ends = case
    crossings = mesh.crossings(starts, ends)
    met = 0
    for i in range(200):
        passages = mesh.passages(starts[i], ends[i])
        met += len(passages)
        assert passages.crossings.sum() == crossings[i] == passages.touches.crossing.sum()
        assert passages.face_count.sum() == len(passages.touches)
        assert (np.diff(passages.fraction) >= 0).all()
        kinds = np.where(passages.crossings > 0, pierce.PassageKind.ENTERING,
                         np.where(passages.crossings < 0, pierce.PassageKind.LEAVING, pierce.PassageKind.GRAZING))
        assert (passages.kind == kinds).all()
    assert met > 100


def test_winding_numbers_of_a_closed_mesh(scalar: Any) -> None:
    vertices, faces = sphere()
    mesh = pierce.CollisionMesh(vertices.astype(scalar), faces)
    starts, ends = (points.astype(scalar) for points in random_segments(5000))
    assert (mesh.crossings(starts, ends) == mesh.winding_numbers(ends) - mesh.winding_numbers(starts)).all()
    radius = np.linalg.norm(starts, axis=1)
    assert mesh.contains(starts)[radius < 0.7].all() and not mesh.contains(starts)[radius > 1.2].any()
