"""Hits of segments and rays: a part of `CollisionMesh`."""

from __future__ import annotations

from typing import Any, Callable, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _pierce
from .answers import Hits
from .enums import Sides

Progress = Optional[Callable[[int, int], Any]]
Wanted = Union[None, str, Sequence[str]]
WhichSides = Union[str, Sides]


class HitQueries:
    """Where segments and rays meet the mesh.

    A segment hits the front of a closed triangle when `start` lies in front of its plane or on it, `end` lies strictly
    behind, and the two meet: one that ends on a face has not hit it yet. All of it is decided as if in exact arithmetic
    on the coordinates given. The options of all calls:

    - `sides`: "front" (the default), "back" or "both": where a segment must come from;
    - `max_fraction`: only hits at this fraction of the segment (t of the ray) or before count;
    - `mask`: flags by face number, shape (number of faces,): only faces whose flag is set count. ValueError for another
      length; with `face_numbers` it may be longer than the largest of these asks for;
    - `wanted`: names of the arrays that are made, all by default; `hit` always is;
    - `threads`, `progress`: as said in `CollisionMesh`.

    A hit that an option leaves out hides nothing behind it.
    """

    _core: _pierce.Mesh

    def first_hits(self, starts: ArrayLike, ends: ArrayLike, *, sides: WhichSides = "front",
                   max_fraction: float = np.inf, mask: Optional[ArrayLike] = None, wanted: Wanted = None,
                   threads: int = 1, progress: Progress = None) -> Hits:
        """The hit of each segment with the exactly smallest fraction; of equal ones that of the smallest face.

        `starts`, `ends`: shape (n, 3); one of them may be a single point of shape (3,).

        Raises ValueError where lengths differ, TypeError where the dtype has more digits than the mesh's. As a rule a
        segment takes the logarithm of the number of triangles.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> hits = floor.first_hits([1, 1, 3], [[1, 1, -1], [3, 3, -3]], wanted=("face", "position"))
        >>> hits.position[hits.hit].tolist(), hits.face[hits.hit].tolist()
        ([[1.0, 1.0, 0.0], [2.0, 2.0, 0.0]], [0, 0])
        """
        return Hits(self._core.first_hits(starts, ends, None, sides, max_fraction, mask, wanted, threads, progress))

    def first_hits_of_rays(self, origins: ArrayLike, directions: ArrayLike, limit: ArrayLike = np.inf, *,
                           sides: WhichSides = "front", max_fraction: float = np.inf,
                           mask: Optional[ArrayLike] = None, wanted: Wanted = None, threads: int = 1,
                           progress: Progress = None) -> Hits:
        """The same for rays: all points origin + t * direction with t from 0 to `limit`.

        `origins`, `directions`: shape (n, 3), directions of any length but 0: nothing is normalised or rounded.
        `limit`: one number, or shape (n,). `fraction` and `exact_fraction` are t. Errors and cost as of `first_hits`.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> floor.first_hits_of_rays([[1, 1, 3]], [0, 0, -1]).exact_fraction.tolist()
        [3.0]
        """
        return Hits(self._core.first_hits_of_rays(origins, directions, limit, sides, max_fraction, mask, wanted,
                                                  threads, progress))

    def any_hits(self, starts: ArrayLike, ends: ArrayLike, *, sides: WhichSides = "front",
                 max_fraction: float = np.inf, mask: Optional[ArrayLike] = None, threads: int = 1,
                 progress: Progress = None) -> NDArray[np.bool_]:
        """Whether each segment has a hit: bool, shape (n,). Lines of sight. As `first_hits`, and faster.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> floor.any_hits([[1, 1, 3], [1, 1, -3]], [[1, 1, -1], [1, 1, 3]]).tolist()
        [True, False]
        >>> floor.any_hits([[1, 1, 3], [1, 1, -3]], [[1, 1, -1], [1, 1, 3]], sides="both").tolist()
        [True, True]
        """
        return self._core.any_hits(starts, ends, None, sides, max_fraction, mask, threads, progress)

    def any_hits_of_rays(self, origins: ArrayLike, directions: ArrayLike, limit: ArrayLike = np.inf, *,
                         sides: WhichSides = "front", max_fraction: float = np.inf, mask: Optional[ArrayLike] = None,
                         threads: int = 1, progress: Progress = None) -> NDArray[np.bool_]:
        """Whether each ray has a hit: bool, shape (n,). As `first_hits_of_rays`.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> floor.any_hits_of_rays([1, 1, 3], [[0, 0, -1], [0, 0, -1], [0, 0, 1]], limit=[4, 2, 9]).tolist()
        [True, False, False]
        """
        return self._core.any_hits_of_rays(origins, directions, limit, sides, max_fraction, mask, threads, progress)

    def all_hits(self, starts: ArrayLike, ends: ArrayLike, *, sides: WhichSides = "front",
                 max_fraction: float = np.inf, mask: Optional[ArrayLike] = None, wanted: Wanted = None,
                 threads: int = 1, progress: Progress = None) -> tuple[NDArray[np.int64], Hits]:
        """All hits of each segment, as compressed rows: (offsets, hits).

        Those of segment i, in exact order of (fraction, face, triangle), are `hits[offsets[i]:offsets[i + 1]]`;
        `offsets` has the shape (n + 1,). Each `point` is clear of all hits but those strictly before it. With
        `wanted=()` they are only counted, which is much faster. Errors as of `first_hits`. The time of a segment is
        quadratic in the number of its hits.

        >>> import pierce
        >>> sheets = pierce.CollisionMesh([[0, 0, z] for z in (1, 2)] + [[4, 0, z] for z in (1, 2)] +
        ...                               [[0, 4, z] for z in (1, 2)], [[0, 2, 4], [1, 3, 5]])
        >>> offsets, hits = sheets.all_hits([[1, 1, 4], [1, 1, 1.5], [9, 9, 4]], [[1, 1, 0], [1, 1, 0], [9, 9, 0]])
        >>> offsets.tolist(), hits.face.tolist(), hits.exact_fraction[:2].tolist()
        ([0, 2, 3, 3], [1, 0, 0], [0.5, 0.75])
        """
        offsets, hits = self._core.all_hits(starts, ends, None, sides, max_fraction, mask, wanted, threads, progress)
        return offsets, Hits(hits)

    def all_hits_of_rays(self, origins: ArrayLike, directions: ArrayLike, limit: ArrayLike = np.inf, *,
                         sides: WhichSides = "front", max_fraction: float = np.inf, mask: Optional[ArrayLike] = None,
                         wanted: Wanted = None, threads: int = 1,
                         progress: Progress = None) -> tuple[NDArray[np.int64], Hits]:
        """All hits of each ray, as compressed rows (`all_hits`).

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> offsets, hits = floor.all_hits_of_rays([1, 1, 3], [[0, 0, -1], [0, 0, 1]], wanted="exact_fraction")
        >>> offsets.tolist(), hits.exact_fraction.tolist()
        ([0, 1, 1], [3.0])
        """
        offsets, hits = self._core.all_hits_of_rays(origins, directions, limit, sides, max_fraction, mask, wanted,
                                                    threads, progress)
        return offsets, Hits(hits)
