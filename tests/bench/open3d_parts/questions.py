"""Points and rays to ask about, in single precision: anywhere, or aimed at what is hard."""

from __future__ import annotations

import numpy as np

from models import Model

Rays = tuple[np.ndarray, np.ndarray]  # origins and directions
WAY_OF_OPEN3D = np.ones(3)  # its inside test counts along (1, 1, 1)


def points_anywhere(model: Model, count: int, random: np.random.Generator) -> np.ndarray:
    """In the box and around it."""
    _, low, high = _box(model)
    return random.uniform(low - 0.1 * model.size, high + 0.1 * model.size, (count, 3)).astype(np.float32)


def points_aimed(model: Model, count: int, random: np.random.Generator) -> np.ndarray:
    """A quarter each below vertices and below the middles of edges, seen along Open3D's ray, on a lattice over the box,
    and at coordinates that vertices have."""
    vertices, low, high = _box(model)
    part = count // 4
    at_vertices = vertices[random.integers(len(vertices), size=part)] - _steps(model, part, random) * WAY_OF_OPEN3D
    at_edges = _middles(model, part, random) - _steps(model, part, random) * WAY_OF_OPEN3D
    lattice = low + (high - low) * random.integers(0, 65, (part, 3)) / 64
    coordinates = np.stack([vertices[random.integers(len(vertices), size=part), axis] for axis in range(3)], axis=1)
    return np.concatenate([at_vertices, at_edges, lattice, coordinates]).astype(np.float32)


def rays_anywhere(model: Model, count: int, random: np.random.Generator) -> Rays:
    """From the box and around it, in any direction."""
    return points_anywhere(model, count, random), random.normal(size=(count, 3)).astype(np.float32)


def rays_aimed(model: Model, count: int, random: np.random.Generator) -> Rays:
    """At vertices and at the middles of edges. Half of them from anywhere, so that rounding decides on which side they
    pass, half from where they pass exactly through them."""
    vertices, _, _ = _box(model)
    part = count // 4
    targets = np.concatenate([vertices[random.integers(len(vertices), size=part)], _middles(model, part, random)])
    origins = points_anywhere(model, 2 * part, random)
    exact_origins, exact_directions = _exact_rays(model, 2 * part, random)
    return (np.concatenate([origins, exact_origins]),
            np.concatenate([(targets - origins).astype(np.float32), exact_directions]))


def _exact_rays(model: Model, count: int, random: np.random.Generator) -> Rays:
    """Rays whose line goes through a vertex, or the middle of an edge, as the numbers stand."""
    vertices, _, _ = _box(model)
    origins, directions = [], []
    while sum(map(len, origins)) < count:
        target = np.concatenate([vertices[random.integers(len(vertices), size=count)], _middles(model, count, random)])
        way = random.integers(-4, 5, (2 * count, 3)).astype(np.float64)
        origin = target - _steps(model, 2 * count, random) * way  # exact in double
        kept = (origin.astype(np.float32) == origin).all(axis=1) & way.any(axis=1)
        origins.append(origin[kept].astype(np.float32))
        directions.append(way[kept].astype(np.float32))
    order = random.permutation(sum(map(len, origins)))[:count]
    return np.concatenate(origins)[order], np.concatenate(directions)[order]


def _box(model: Model) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    vertices = model.vertices.astype(np.float64)
    return vertices, vertices.min(axis=0), vertices.max(axis=0)


def _middles(model: Model, count: int, random: np.random.Generator) -> np.ndarray:
    """Middles of edges: of two numbers in single precision, so exact in double."""
    corners = model.vertices.astype(np.float64)[model.faces[random.integers(len(model.faces), size=count)]]
    edge = random.integers(3, size=count)
    rows = np.arange(count)
    return (corners[rows, edge] + corners[rows, (edge + 1) % 3]) / 2


def _steps(model: Model, count: int, random: np.random.Generator) -> np.ndarray:
    """Multiples of a power of two, up to about a quarter of the model's size."""
    grain = 2.0 ** np.floor(np.log2(model.size / 64))
    return random.integers(1, 17, (count, 1)) * grain
