"""`pierce.ray.RayMeshIntersector`: shapes, names and answers that users of trimesh expect."""

import inspect
from types import SimpleNamespace

import numpy as np
import pytest

import pierce
from exact_judge import Judge
from test_exact_judge import box, joined
from pierce.ray import RayMeshIntersector


def nested():
    """A cube in a cube."""
    return joined(box(), box(-1, 2))


def rays_of(mesh):
    vertices, faces = mesh
    return RayMeshIntersector(SimpleNamespace(vertices=vertices, faces=faces))


ORIGINS = np.array([[0.25, 0.125, 3], [5, 5, 3], [0.25, 0.125, 0.5]], dtype=np.float64)
DOWN = np.tile([0, 0, -2.0], (3, 1))


def test_all_hits():
    index_tri, index_ray = rays_of(nested()).intersects_id(ORIGINS, DOWN)
    assert index_ray.tolist() == [0, 0, 0, 0, 2, 2]
    assert (index_tri >= 12).tolist() == [True, False, False, True, False, True]
    assert index_tri.dtype == index_ray.dtype == np.int64


def test_locations():
    locations, index_ray, index_tri = rays_of(nested()).intersects_location(ORIGINS, DOWN)
    assert locations.tolist() == [[0.25, 0.125, z] for z in (2, 1, 0, -1, 0, -1)]
    again = rays_of(nested()).intersects_id(ORIGINS, DOWN, return_locations=True)
    for one, other in zip((index_tri, index_ray, locations), again):
        assert (one == other).all()


def test_the_first_hits():
    rays = rays_of(nested())
    locations, index_ray, index_tri = rays.intersects_location(ORIGINS, DOWN, multiple_hits=False)
    assert index_ray.tolist() == [0, 2] and locations[:, 2].tolist() == [2, 0]
    first = rays.intersects_first(ORIGINS, DOWN)
    assert first.tolist() == [index_tri[0], -1, index_tri[1]]
    assert rays.intersects_any(ORIGINS, DOWN).tolist() == [True, False, True]


def test_so_many_hits():
    index_tri, index_ray = rays_of(nested()).intersects_id(ORIGINS, DOWN, max_hits=3)
    assert index_ray.tolist() == [0, 0, 0, 2, 2]
    everything, of_ray = rays_of(nested()).intersects_id(ORIGINS, DOWN)
    assert index_tri.tolist() == [*everything[of_ray == 0][:3], *everything[of_ray == 2]]


def test_a_place_comes_once_and_a_triangle_too():
    """Through two opposite corners, and along a diagonal of two faces."""
    vertices, faces = box()
    rays = rays_of((vertices, faces))
    origins, ways = [[-1, -1, -1], [0.5, 0.5, 3]], [[1, 1, 1], [0, 0, -1]]
    locations, index_ray, _ = rays.intersects_location(origins, ways)
    assert index_ray.tolist() == [0, 0, 1, 1]
    assert locations.tolist() == [[0, 0, 0], [1, 1, 1], [0.5, 0.5, 1], [0.5, 0.5, 0]]
    index_tri, index_ray = rays.intersects_id(origins, ways)
    judge = Judge(vertices, faces)
    for ray in (0, 1):
        assert sorted(index_tri[index_ray == ray]) == sorted(face for _, face in judge.hits(origins[ray], ways[ray]))


def test_places_of_two_rays_are_two():
    rays = rays_of(box())
    for ways in ([[1, 0, 0]] * 2, [[1, 0, 0], [0, 1, 0]]):
        locations, index_ray, _ = rays.intersects_location([[0.5, 0.5, 0.25]] * 2, ways)
        assert index_ray.tolist() == [0, 1] and len(locations) == 2


def test_places_that_round_to_one_are_two():
    """Two sheets less than a unit in the last place apart: so are their t."""
    far, unit = 2.0**30, 2.0**-22
    vertices = [[-1, -9, far], [-1, 9, far], [1, 0, far + unit], [3, 0, far + unit]]
    locations, _, index_tri = rays_of((vertices, [[0, 1, 2], [0, 1, 3]])).intersects_location([[0, 0, far]], [[0, 0, 1]])
    assert locations.tolist() == [[0, 0, far]] * 2 and index_tri.tolist() == [1, 0]


def test_two_places_whose_t_round_to_one():
    far, unit = 2.0**30, 2.0**-30
    vertices = [[-1, -9, 0], [-1, 9, 0], [1, 0, unit], [3, 0, unit]]
    locations, _, index_tri = rays_of((vertices, [[0, 1, 2], [0, 1, 3]])).intersects_location([[0, 0, far]],
                                                                                              [[0, 0, -1]])
    assert locations[:, 2].tolist() == [unit / 2, unit / 4] and index_tri.tolist() == [0, 1]


def test_points():
    points = [[0.5, 0.5, 0.5], [1.5, 0.5, 0.5], [2.5, 0.5, 0.5]]
    assert rays_of(nested()).contains_points(points).tolist() == [True, True, False]


def test_nothing_to_ask_and_nothing_to_hit():
    for mesh, origins in ((nested(), np.zeros((0, 3))), ((np.zeros((0, 3)), np.zeros((0, 3), np.int64)), ORIGINS)):
        rays, ways = rays_of(mesh), DOWN[:len(origins)]
        locations, index_ray, index_tri = rays.intersects_location(origins, ways)
        assert locations.shape == (0, 3) and index_ray.shape == index_tri.shape == (0,)
        assert rays.intersects_first(origins, ways).tolist() == [-1] * len(origins)
        assert not rays.intersects_any(origins, ways).any()


def test_single_precision_in_and_a_mesh_that_is_ready():
    vertices, faces = nested()
    ready = RayMeshIntersector(pierce.CollisionMesh(vertices, faces), threads=2)
    rays = rays_of((vertices.astype(np.float32), faces))
    assert rays.mesh.dtype == np.float64
    for one in (ready, rays):
        assert (one.intersects_first(ORIGINS.astype(np.float32), DOWN) == rays_of(nested()).intersects_first(
            ORIGINS, DOWN)).all()


def test_more_digits_than_double_are_refused():
    vertices, faces = nested()
    assert rays_of((vertices.astype(int), faces)).mesh.dtype == np.float64
    with pytest.raises(TypeError, match="vertices: dtype float128 has more digits"):
        rays_of((vertices.astype(np.longdouble), faces))


@pytest.mark.parametrize("name, parameters", [
    ("intersects_id", ["ray_origins", "ray_directions", "return_locations", "multiple_hits", "max_hits"]),
    ("intersects_location", ["ray_origins", "ray_directions", "multiple_hits", "max_hits"]),
    ("intersects_first", ["ray_origins", "ray_directions"]),
    ("intersects_any", ["ray_origins", "ray_directions"]),
    ("contains_points", ["points"]),
])
def test_names_of_arguments(name, parameters):
    assert list(inspect.signature(getattr(RayMeshIntersector, name)).parameters) == ["self", *parameters]


def test_against_the_judge():
    """Random triangles and rays at their corners: all hits of each, in order."""
    random = np.random.default_rng(11)
    vertices = random.integers(-5, 6, (40, 3)).astype(np.float64)
    faces = random.integers(0, 40, (120, 3))
    origins = random.integers(-9, 10, (200, 3)).astype(np.float64)
    ways = vertices[random.integers(40, size=200)] - origins
    ways[~ways.any(axis=1)] = 1
    rays, judge = rays_of((vertices, faces)), Judge(vertices, faces)
    index_tri, index_ray = rays.intersects_id(origins, ways)
    locations, place_ray, _ = rays.intersects_location(origins, ways)
    assert len(index_ray) > len(place_ray) > 200
    for ray in range(200):
        truth = sorted(judge.hits(origins[ray], ways[ray]))
        assert index_tri[index_ray == ray].tolist() == [face for _, face in truth]
        places = sorted({fraction for fraction, _ in truth})
        expected = [[float(float(o) + t * int(d)) for o, d in zip(origins[ray], ways[ray])] for t in places]
        assert np.allclose(locations[place_ray == ray], expected, rtol=1e-15, atol=1e-14)
