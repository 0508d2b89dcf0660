"""The closed meshes that Open3D and pierce are asked about, in single precision."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pierce

# Scans and machine parts, of Debian's libcgal-demo.
REAL = ("bunny00.off", "armadillo.off", "refined_elephant.off", "diplodocus.off", "turbine.off", "fandisk_large.off",
        "anchor_dense.off", "cube-meshed.off")
CELLS = 64  # of the model of cubes, along its longest side


@dataclass(frozen=True)
class Model:
    """A closed mesh of one orientation."""

    name: str
    vertices: np.ndarray
    faces: np.ndarray

    @property
    def size(self) -> float:
        return float(np.ptp(self.vertices, axis=0).max())


def read_models(folder: Path, quick: bool) -> list[Model]:
    """Those of libcgal-demo in this folder, and cubes around the vertices of the bunny."""
    models = [_read(folder / name) for name in (REAL[:1] + REAL[-2:] if quick else REAL)]
    models.append(_cubes(models[0]))
    for model in models:
        assert _is_closed(model), f"{model.name} is not closed"
    return models


def _read(path: Path) -> Model:
    soup = pierce.read_mesh(path, dtype=np.float32)
    return Model(path.stem, soup.vertices, soup.faces)


def _cubes(model: Model) -> Model:
    """All cubes of a lattice that hold a vertex: a model along the axes, as voxels are."""
    low = model.vertices.min(axis=0)
    cells = np.floor((model.vertices - low) / model.size * CELLS).astype(np.int64) + 1
    full = np.zeros(cells.max(axis=0) + 2, dtype=bool)
    full[tuple(cells.T)] = True
    quads = []
    for axis in range(3):
        step, u, v = (np.eye(3, dtype=np.int64)[(axis + k) % 3] for k in range(3))
        for corners, side in ((((0, 0), (1, 0), (1, 1), (0, 1)), 1), (((0, 0), (0, 1), (1, 1), (1, 0)), 0)):
            neighbour = np.roll(full, -1 if side else 1, axis=axis)
            start = np.argwhere(full & ~neighbour) + side * step
            quads.append(np.stack([start + i * u + j * v for i, j in corners], axis=1))
    points, numbers = np.unique(np.concatenate(quads).reshape(-1, 3), axis=0, return_inverse=True)
    quad = numbers.reshape(-1, 4)
    faces = np.concatenate([quad[:, [0, 1, 2]], quad[:, [0, 2, 3]]])
    return Model(f"{model.name} of cubes", (points / 32 - 1).astype(np.float32), faces.astype(np.uint32, order="C"))


def _is_closed(model: Model) -> bool:
    """Whether each edge has as many faces on its one side as on its other."""
    corners = model.faces.astype(np.int64)
    count = len(model.vertices)
    edges = np.concatenate([corners[:, [k, (k + 1) % 3]] for k in range(3)])
    there, back = (np.sort(edges[:, k] * count + edges[:, 1 - k]) for k in (0, 1))
    return bool((there == back).all())
