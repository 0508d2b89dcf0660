"""Meshes that move as a whole, and meshes with new positions: a part of `CollisionMesh`."""

from __future__ import annotations

from typing import Any, Callable, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike

from . import _pierce
from .answers import RigidHits, SweepHits
from .enums import Sides
from .motions import RigidMotion, Translation

Progress = Optional[Callable[[int, int], Any]]
WhichSides = Union[str, Sides]


class MotionQueries:
    """Points that move while the mesh does, and changes of the mesh itself."""

    _core: _pierce.Mesh

    @overload
    def sweep(self, starts: ArrayLike, ends: ArrayLike, motion: Translation, *, sides: WhichSides = "front",
              max_fraction: float = np.inf, mask: Optional[ArrayLike] = None, threads: int = 1,
              progress: Progress = None) -> SweepHits: ...

    @overload
    def sweep(self, starts: ArrayLike, ends: ArrayLike, motion: RigidMotion, *, sides: WhichSides = "front",
              max_fraction: float = np.inf, mask: Optional[ArrayLike] = None, threads: int = 1,
              progress: Progress = None) -> RigidHits: ...

    def sweep(self, starts: ArrayLike, ends: ArrayLike, motion: Union[Translation, RigidMotion], *,
              sides: WhichSides = "front", max_fraction: float = np.inf, mask: Optional[ArrayLike] = None,
              threads: int = 1, progress: Progress = None) -> SweepHits:
        """Points go straight from `starts` to `ends`, in the world, while the mesh moves: their first contacts in time.

        `starts`, `ends`: shape (n, 3). Without a hit the point may be moved to its end, otherwise to the hit's `place`,
        which is one for the end of the step. Under a `Translation` all is decided exactly; under a `RigidMotion` within
        its tolerance of the true motion, and exactly where it comes to chains of steps. `max_fraction`: a time.

        Takes as long as `first_hits` for each chord that comes near the mesh. ValueError where lengths differ,
        TypeError for dtypes with more digits than the mesh's, of a `Translation` as well.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> rising = pierce.Translation([0, 0, 0], [0, 0, 2])
        >>> hits = floor.sweep([[1, 1, 1], [1, 1, 3]], [[1, 1, 1], [1, 1, 3]], rising)
        >>> hits.hit.tolist(), bool(hits.place[0, 2] >= 2), hits.surface_motion[0].tolist()
        ([True, False], True, [0.0, 0.0, 2.0])
        """
        rest = (sides, max_fraction, mask, threads, progress)
        if isinstance(motion, RigidMotion):
            return RigidHits(self._core.sweep_turning(starts, ends, motion._core, *rest))
        if isinstance(motion, Translation):
            return SweepHits(self._core.sweep_straight(starts, ends, motion.start, motion.end, *rest))
        raise TypeError(f"motion: a {type(motion).__name__}, where a Translation or a RigidMotion is needed")

    def refit(self, vertices: ArrayLike, changed: Optional[ArrayLike] = None, *, threads: int = 1) -> None:
        """New positions for all vertices, in a quarter of the time of a build; faces and their numbers stay.

        `vertices`: shape (n, 3), as many as before. `changed`: shape (k,), integers: only these moved. Answers are
        those of a mesh that is built from these positions, to the last bit; the time of queries grows as the mesh
        leaves the shape that it was built in (`refit_cost`).

        ValueError where there are not as many positions as vertices, `MeshError` for one that is not finite; the mesh
        stays as it was. RuntimeError where another thread asks the mesh just now, and for the mesh of a step.

        >>> import numpy as np, pierce
        >>> vertices = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])
        >>> floor = pierce.CollisionMesh(vertices, [[0, 1, 2]])
        >>> floor.refit(vertices + [0, 0, 2])
        >>> floor.first_hits([1, 1, 3], [1, 1, 1]).position.tolist()
        [[1.0, 1.0, 2.0]]
        """
        self._core.refit(vertices, changed, threads)

    def rebuild(self, vertices: ArrayLike, *, threads: int = 1) -> None:
        """The same as `refit` by a build, in its time or half of it."""
        self._core.rebuild(vertices, threads)

    def refit_cost(self) -> float:
        """What a query may be expected to cost, in parts of what it did when the mesh was built. From 1.5 or 2 on a
        `rebuild` pays where some queries are asked for each face."""
        return self._core.refit_cost()
