"""Balls: a part of `CollisionMesh`."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _pierce
from .answers import SphereHits

Progress = Optional[Callable[[int, int], Any]]


class SphereQueries:
    """Balls that move in a straight line without turning.

    A ball hits a closed triangle where its center comes nearer to it than the radius; to be exactly as far away is to
    touch, which is no hit. It has two sides for every triangle, so there is no `sides`. A number for `radius` is
    rounded to the mesh's dtype. A radius that is not above 0, and what is not finite, hits nothing and is counted.
    """

    _core: _pierce.Mesh

    def sweep_spheres(self, starts: ArrayLike, ends: ArrayLike, radius: ArrayLike, *, max_fraction: float = np.inf,
                      mask: Optional[ArrayLike] = None, threads: int = 1, progress: Progress = None) -> SphereHits:
        """When and where balls first run into the mesh, their centers going from `starts` to `ends`.

        `starts`, `ends`: shape (n, 3); `radius`: one number, or shape (n,). Without a hit the center may be moved to
        the end, otherwise to the hit's `center`: it penetrates nothing there. ValueError where lengths differ. Costs
        grow with the number of triangles that come within the radius of the way.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> hits = floor.sweep_spheres([[1, 1, 3], [1, 1, 3]], [[1, 1, -1], [1, 1, 2]], radius=0.5)
        >>> hits.hit.tolist(), hits.contact[0].tolist()
        ([True, False], [1.0, 1.0, 0.0])
        """
        return SphereHits(self._core.sweep_spheres(starts, ends, radius, max_fraction, mask, threads, progress))

    def sphere_hits(self, start: ArrayLike, end: ArrayLike, radius: float, *, max_fraction: float = np.inf,
                    mask: Optional[ArrayLike] = None) -> SphereHits:
        """All contacts of one step in order, each as if nothing had stopped the ball before it. `start`, `end`: (3,).

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> len(floor.sphere_hits([1, 1, 3], [1, 1, -1], 0.5))
        1
        """
        return SphereHits(self._core.sphere_hits(start, end, radius, max_fraction, mask))

    def sphere_contacts(self, center: ArrayLike, radius: float, *, mask: Optional[ArrayLike] = None) -> SphereHits:
        """What one ball that does not move is in contact with, decided exactly, the deepest first. `center`: (3,).

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> floor.sphere_contacts([1, 1, 0.25], 0.5).overlap.tolist()
        [0.25]
        """
        return SphereHits(self._core.sphere_contacts(center, radius, mask))
