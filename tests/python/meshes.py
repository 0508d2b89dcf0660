"""Meshes and queries for tests, made from a seed."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


def tetrahedron() -> tuple[Array, Array]:
    """Closed, outwards, with the corner (0, 0, 0) and edges of length 4 along the axes."""
    vertices = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]], np.float64)
    return vertices, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32)


def sphere(rings: int = 24, seed: int = 0) -> tuple[Array, Array]:
    """Closed and rough, around the origin, with radii from 0.8 to 1.2."""
    rng = np.random.default_rng(seed)
    columns = 2 * rings
    latitude = np.linspace(0, np.pi, rings + 1)[1:-1, None]
    longitude = np.linspace(0, 2 * np.pi, columns, endpoint=False)[None, :]
    grid = np.stack([np.sin(latitude) * np.cos(longitude), np.sin(latitude) * np.sin(longitude),
                     np.cos(latitude) * np.ones_like(longitude)], axis=-1).reshape(-1, 3)
    vertices = np.concatenate([[[0, 0, 1.0]], grid, [[0, 0, -1.0]]])
    vertices *= rng.uniform(0.8, 1.2, (len(vertices), 1))
    faces = []
    row = 1 + np.arange(columns)
    after = np.roll(row, -1)
    last = len(vertices) - 1
    faces.append(np.stack([np.zeros_like(row), row, after], axis=1))
    for ring in range(rings - 2):
        a, b = row + ring * columns, after + ring * columns
        faces += [np.stack([a, a + columns, b], axis=1), np.stack([b, a + columns, b + columns], axis=1)]
    a, b = row + (rings - 2) * columns, after + (rings - 2) * columns
    faces.append(np.stack([a, np.full_like(a, last), b], axis=1))
    return vertices, np.concatenate(faces).astype(np.uint32)


def lattice_soup(triangles: int = 60, size: int = 4, seed: int = 0) -> tuple[Array, Array]:
    """Triangles with small whole coordinates: they share corners, planes and edges, and some have no area."""
    rng = np.random.default_rng(seed)
    vertices = rng.integers(0, size + 1, (3 * triangles, 3)).astype(np.float64)
    return vertices, np.arange(3 * triangles, dtype=np.uint32).reshape(-1, 3)


def lattice_segments(count: int, size: int = 4, seed: int = 1) -> tuple[Array, Array]:
    """Segments between small whole points: most of those that hit something hit an edge, or begin in a plane."""
    rng = np.random.default_rng(seed)
    starts, ends = rng.integers(-1, size + 2, (2, count, 3)).astype(np.float64)
    return starts, ends


def random_segments(count: int, reach: float = 1.5, seed: int = 1) -> tuple[Array, Array]:
    """Segments through the box around the sphere."""
    rng = np.random.default_rng(seed)
    starts, ends = rng.uniform(-reach, reach, (2, count, 3))
    return starts, ends
