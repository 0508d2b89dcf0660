"""Where points are: a part of `CollisionMesh`."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _pierce

Progress = Optional[Callable[[int, int], Any]]


class PlaceQueries:
    """Inside or outside, by the winding number, which is exact on a closed mesh.

    On an open mesh it is that of one way out, along an axis: `mesh_report()` says whether a mesh is closed.
    """

    _core: _pierce.Mesh

    def contains(self, points: ArrayLike, *, threads: int = 1, progress: Progress = None) -> NDArray[np.bool_]:
        """Whether the winding number of each point is not 0: bool, shape (n,).

        A point of the surface itself is taken as moved by an infinitesimal step, the same for all; `locate` tells it
        from others. TypeError where the dtype has more digits than the mesh's. Takes some logarithm of the number of
        triangles for a point, and 16 bytes of memory where points come in no order.

        >>> import pierce
        >>> tetrahedron = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]],
        ...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> tetrahedron.contains([[1, 1, 1], [2, 2, 2]]).tolist()
        [True, False]
        """
        return self._core.contains(points, threads, progress)

    def winding_numbers(self, points: ArrayLike, *, threads: int = 1, progress: Progress = None) -> NDArray[np.int32]:
        """How many times the surface winds around each point: int32, shape (n,). 1 inside of a closed mesh whose faces
        look outwards, 0 outside, and for points that are not finite. Errors and cost as of `contains`.

        >>> import pierce
        >>> inside_out = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]],
        ...                                   [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
        >>> inside_out.winding_numbers([[1, 1, 1], [2, 2, 2]]).tolist()
        [-1, 0]
        """
        return self._core.winding_numbers(points, threads, progress)
