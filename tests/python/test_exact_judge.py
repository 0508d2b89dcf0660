"""The judge of tests/bench/open3d and of the tests here, on cases that can be decided by hand."""

from fractions import Fraction

import numpy as np
import pytest

from exact_judge import FirstHit, Judge, Location


def box(low=0.0, high=1.0, flipped=False):
    """A cube, counter-clockwise seen from outside; corner number 4 x + 2 y + z."""
    corners = np.array([[x, y, z] for x in (low, high) for y in (low, high) for z in (low, high)], dtype=np.float64)
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))])
    return corners, faces[:, ::-1] if flipped else faces


def joined(*meshes):
    vertices, faces, count = [], [], 0
    for corners, triangles in meshes:
        vertices.append(corners)
        faces.append(triangles + count)
        count += len(corners)
    return np.concatenate(vertices), np.concatenate(faces)


def normals(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def test_the_box_looks_outwards():
    vertices, faces = box()
    assert (np.einsum("ij,ij->i", normals(vertices, faces), vertices[faces[:, 0]] - 0.5) > 0).all()


@pytest.mark.parametrize("mesh, point, expected", [
    (box(), (0.5, 0.5, 0.5), Location(False, 1, 1)),
    (box(), (0.5, 0.5, 1.5), Location(False, 0, 0)),
    (box(flipped=True), (0.5, 0.5, 0.5), Location(False, -1, 1)),
    (joined(box(), box(-1, 2)), (0.5, 0.5, 0.5), Location(False, 2, 2)),
    (joined(box(flipped=True), box(-1, 2)), (0.5, 0.5, 0.5), Location(False, 0, 2)),  # a hollow
    (joined(box(flipped=True), box(-1, 2)), (1.5, 0.5, 0.5), Location(False, 1, 1)),
])
def test_winding_numbers(mesh, point, expected):
    where = Judge(*mesh).locate(point)
    assert (where.on_surface, where.winding_number) == expected[:2]
    assert where.crossings % 2 == expected.crossings % 2


@pytest.mark.parametrize("point, winding", [
    ((0, 0.5, 0.5), 1),  # moved by (e, e^2, e^3) it is inside: x counts first
    ((1, 0.5, 0.5), 0),
    ((0, 0, 0), 1),  # corners and edges
    ((1, 1, 1), 0),
    ((0, 1, 0), 0),
    ((0, 0, 1), 0),
    ((0.5, 0, 0), 1),
    ((0.5, 0.5, 0), 1),  # on the diagonal of a face
    ((0.5, 0.5, 1), 0),
])
def test_points_of_the_surface(point, winding):
    assert Judge(*box()).locate(point)[:2] == (True, winding)


@pytest.mark.parametrize("point, winding", [
    ((0.5, -0.25, 0.25), 0),  # moved by (e, e^2, e^3) along (1, -1, 1): outwards, as x counts first
    ((-0.5, 0.25, 0.25), 1),  # along (-1, 1, 1): inwards
])
def test_the_first_coordinate_counts_first(point, winding):
    corners = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=np.float64)
    faces = np.array([face[::s] for x in (0, 1) for y in (2, 3) for z in (4, 5)
                      for face, s in [((x, y, z), -1 if (x + y + z) % 2 else 1)]])
    assert Judge(corners, faces).locate(point)[:2] == (True, winding)


def test_rays_through_rims_are_not_counted():
    judge = Judge(*box())
    for way in ((1, 1, 1), (0, 1, 1), (1, 0, 0)):  # a corner, an edge, the diagonal of a face
        assert judge._along_ray((0.5, 0.5, 0.5), way, nudged=False) is None
    assert judge._along_ray((0.5, 0.5, 0.5), (5, 2, 1), nudged=False) == Location(False, 1, 1)


def test_a_grain_decides():
    """The next number in front of a face and behind it, in a place where doubles say zero."""
    vertices, faces = box(1e6, 1e6 + 1)
    judge = Judge(vertices, faces)
    inside = (1e6 + 0.3, 1e6 + 0.7, np.nextafter(1e6, 2e6))
    assert judge.locate(inside)[:2] == (False, 1)
    assert judge.locate((inside[0], inside[1], np.nextafter(1e6, 0)))[:2] == (False, 0)
    slanted = Judge(np.array([[0, 0, 0], [1, 0, 0.1], [0, 1, 0.3], [0.2, 0.2, -5.0]]),
                    np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]))
    height = Fraction(0.1) * Fraction(0.3) + Fraction(0.3) * Fraction(0.4)
    below, above = float(height), float(height)
    while Fraction(below) >= height:
        below = float(np.nextafter(below, -1))
    while Fraction(above) <= height:
        above = float(np.nextafter(above, 1))
    assert slanted.locate((0.3, 0.4, below))[:2] == (False, 1)
    assert slanted.locate((0.3, 0.4, above))[:2] == (False, 0)


def faces_at(vertices, faces, corners):
    return [k for k, face in enumerate(faces) if all(corner in face for corner in corners)]


def test_all_faces_of_a_corner_are_first():
    vertices, faces = box()
    hit = Judge(vertices, faces).first_hit((-1, -1, -1), (1, 1, 1))
    assert hit == FirstHit(Fraction(1), tuple(faces_at(vertices, faces, [0])))
    inside = Judge(vertices, faces).first_hit((0.5, 0.5, 0.5), (1, 1, 1))
    assert inside == FirstHit(Fraction(1, 2), tuple(faces_at(vertices, faces, [7])))


def test_both_faces_of_an_edge_are_first():
    vertices, faces = box()
    hit = Judge(vertices, faces).first_hit((0.25, -1, -1), (0, 1, 1))
    # The edge from corner 0 to 4; the two others of its faces that end in it meet the ray as well, if they do.
    assert hit.fraction == 1 and hit.faces == tuple(faces_at(vertices, faces, [0, 4]))


def test_sides():
    judge = Judge(*box())
    start, way = (0.25, 0.125, 3), (0, 0, -1)
    assert judge.first_hit(start, way, sides="front").fraction == 2
    assert judge.first_hit(start, way, sides="back").fraction == 3
    assert judge.first_hit(start, way).fraction == 2
    assert judge.first_hit(start, (0, 0, 1)) is None
    assert len(judge.hits(start, way)) == 2


@pytest.mark.parametrize("start, end, sides, fraction", [
    ((0.25, 0.125, 2), (0.25, 0.125, 1), "front", None),  # it ends on the face
    ((0.25, 0.125, 2), (0.25, 0.125, 0.5), "front", Fraction(2, 3)),
    ((0.25, 0.125, 1), (0.25, 0.125, 0.5), "front", Fraction(0)),  # it starts there
    ((0.25, 0.125, 1), (0.25, 0.125, 0.5), "both", Fraction(0)),
    ((0.25, 0.125, 1), (0.25, 0.125, 2), "both", None),  # on the plane counts as in front
    ((0.25, 0.125, 1), (0.25, 0.125, 2), "back", Fraction(0)),
    ((0.25, 0.125, 0.5), (0.25, 0.125, 1), "both", Fraction(1)),  # onto the plane from behind
    ((0.25, 0.125, 0.5), (0.25, 0.125, 1), "back", None),
    ((0.25, 0.125, 2), (0.25, 0.125, 1), "both", None),
    ((-1, 0.5, 1), (2, 0.5, 1), "both", Fraction(1, 3)),  # in the plane of the top: the sides are hit
    ((0.25, 0.125, 0.25), (0.25, 0.125, 0.25), "both", None),
])
def test_the_rule_for_hits(start, end, sides, fraction):
    hit = Judge(*box()).first_hit_of_segment(start, end, sides=sides)
    assert (hit and hit.fraction) == fraction


def test_rays_in_a_plane_are_noticed():
    judge = Judge(*box())
    assert judge.lies_in_a_plane((-1, 0.5, 1), (1, 0, 0))
    assert not judge.lies_in_a_plane((-1, 1.5, 1), (1, 0, 0))  # in the plane, past the face
    assert not judge.lies_in_a_plane((-1, 0.5, 0.5), (1, 0, 0))
    assert judge.first_hit((-1, 1.5, 1), (1, 0, 0)) is None


def test_a_triangle_without_area_is_nothing():
    vertices, faces = box()
    judge = Judge(vertices, np.concatenate([faces, [[0, 0, 7], [0, 7, 7]]]))
    assert judge.first_hit((0.5, 0.25, 0.125), (1, 0, 0)).fraction == Fraction(1, 2)
    assert judge.locate((0.5, 0.5, 0.5))[:2] == (False, 1)


def test_no_face_that_is_met_is_left_out():
    """The boxes and bounds of doubles, against all faces, on a lattice, far away and with rays at corners."""
    random = np.random.default_rng(5)
    for size, offset in ((1.0, 0.0), (1e-3, 1e5), (2.0**60, 0.0)):
        vertices = (random.integers(-6, 7, (120, 3)) * 0.1 + offset) * size
        faces = random.integers(0, len(vertices), (400, 3))
        judge, everything = Judge(vertices, faces), Judge(vertices, faces)
        everything.candidates = lambda origin, direction: list(range(len(faces)))
        refused = 0
        for trial in range(150):
            start = (random.integers(-9, 10, 3) * 0.1 + offset) * size
            target = vertices[random.integers(len(vertices))] if trial % 2 else start + random.normal(size=3) * size
            way = target - start
            if way.any():
                assert sorted(judge.hits(start, way)) == sorted(everything.hits(start, way))
                refused += len(faces) - len(judge.candidates(start, way))
        assert refused > 150 * len(faces) / 4
