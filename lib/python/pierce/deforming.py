"""Meshes whose vertices move from step to step."""

from __future__ import annotations

from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _pierce
from ._moves import Moving
from .answers import SweepHits
from .enums import Sides
from .mesh import CollisionMesh
from .motions import Pose

Progress = Optional[Callable[[int, int], Any]]


class DeformationStep(Moving):
    """One step of a deforming mesh. It stays as it is, whatever the mesh goes on to; any number of threads may ask
    it."""

    _core: _pierce.Step

    def __init__(self, core: _pierce.Step) -> None:
        self._core = core

    @property
    def before(self) -> CollisionMesh:
        """The mesh as it stands still at the beginning: every query that `CollisionMesh` has."""
        return CollisionMesh._of_core(self._core.before)

    @property
    def after(self) -> CollisionMesh:
        """The same at the end."""
        return CollisionMesh._of_core(self._core.after)

    def sweep(self, starts: ArrayLike, ends: ArrayLike, *, sides: Union[str, Sides] = "front",
              max_fraction: float = np.inf, mask: Optional[ArrayLike] = None, threads: int = 1,
              progress: Progress = None) -> SweepHits:
        """Points go straight from `starts` to `ends`, shape (n, 3), while the mesh goes from `before` to `after`: their
        first contacts in time, decided exactly. Without a hit the point may be moved to its end, otherwise to the hit's
        `place`. ValueError where lengths differ, TypeError for dtypes with more digits than the mesh's."""
        return SweepHits(self._core.sweep(starts, ends, sides, max_fraction, mask, threads, progress))


class DeformingMesh:
    """Holds the current step, and makes the next one.

    The arguments are those of `CollisionMesh`. `rebuild_above`: a new order of the triangles is made where a query may
    be expected to cost so many times what it did. The first step is one in which nothing moves. One thread at a time
    begins a step; RuntimeError where another one does so just now. Steps may be asked by all threads meanwhile.

    >>> import numpy as np, pierce
    >>> vertices = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])
    >>> mesh = pierce.DeformingMesh(vertices, [[0, 1, 2]])
    >>> mesh.begin_step(vertices + [0, 0, 2])
    >>> step = mesh.step()
    >>> hits = step.sweep([[1, 1, 1]], [[1, 1, 1]])
    >>> hits.hit.tolist(), bool(hits.place[0, 2] >= 2), step.after.first_hits([1, 1, 3], [1, 1, 1]).hit.tolist()
    ([True], True, [True])
    """

    _core: _pierce.Deforming

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, *, face_numbers: Optional[ArrayLike] = None,
                 rebuild_above: float = 2, broadphase: str = "automatic", cell_size: float = 0,
                 max_grid_bytes: int = 0, backend: str = "", threads: int = 1) -> None:
        self._core = _pierce.Deforming(vertices, faces, face_numbers, rebuild_above, broadphase, cell_size,
                                       max_grid_bytes, backend, threads)

    def begin_step(self, vertices: ArrayLike, *, threads: int = 1) -> None:
        """The next step leads from where the current one ends to these positions, shape (n, 3), in some two thirds of
        the time of a build. ValueError where there are not as many as vertices, `MeshError` for one that is not finite;
        the current step stays then."""
        self._core.begin_step(vertices, threads)

    def begin_pose(self, pose: Pose, *, threads: int = 1) -> None:
        """The next step leads to a pose of the mesh as it was built: each vertex is put there, rounded, and goes
        straight in between."""
        self._core.begin_pose(pose.rotation, pose.translation, threads)

    def step(self) -> DeformationStep:
        """The current step."""
        return DeformationStep(self._core.step())
