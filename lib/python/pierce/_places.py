"""Where points are: a part of `CollisionMesh`."""

from __future__ import annotations

from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _pierce
from .answers import FaceTouches, Locations, Passages
from .enums import Sides

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

    def locate(self, points: ArrayLike, *, threads: int = 1, progress: Progress = None) -> Locations:
        """Whether each point is outside, inside or on the surface, exactly; its winding number, and the triangles that
        it lies on: those of point i are `touches[first_face[i]:first_face[i] + face_count[i]]`, in order of (face,
        triangle). Errors as of `contains`. Points on the surface take one query more, on one thread.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> located = floor.locate([[1, 1, 0], [2, 2, 0], [1, 1, 1]])
        >>> [pierce.Place(place).name for place in located.place]
        ['ON_SURFACE', 'ON_SURFACE', 'OUTSIDE']
        >>> [pierce.Feature(feature).name for feature in located.touches.feature]
        ['FACE', 'EDGE']
        """
        columns, touches = self._core.locate(points, threads, progress)
        return Locations(columns, FaceTouches(touches))

    def crossings(self, starts: ArrayLike, ends: ArrayLike, *, threads: int = 1,
                  progress: Progress = None) -> NDArray[np.int32]:
        """How often each segment passes through the surface: int32, shape (n,).

        +1 for each crossing from the front of a face to its back, -1 for each the other way. Both ends are taken as
        moved by an infinitesimal step, the same for all queries, so that every crossing belongs to exactly one face.
        On a closed mesh that is the winding number at the end less that at the start. Not finite: 0.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> floor.crossings([[1, 1, 1], [1, 1, -1], [9, 9, 1]], [[1, 1, -1], [1, 1, 1], [9, 9, -1]]).tolist()
        [1, -1, 0]
        """
        return self._core.crossings(starts, ends, None, threads, progress)

    def crossings_of_rays(self, origins: ArrayLike, directions: ArrayLike, limit: ArrayLike = np.inf, *,
                          threads: int = 1, progress: Progress = None) -> NDArray[np.int32]:
        """The same for rays, as `first_hits_of_rays` takes them.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> floor.crossings_of_rays([1, 1, 1], [[0, 0, -1], [0, 0, 1]]).tolist()
        [1, 0]
        """
        return self._core.crossings_of_rays(origins, directions, limit, threads, progress)

    def passages(self, start: ArrayLike, end: ArrayLike, *, sides: Union[str, Sides] = "both", max_fraction: float = 1,
                 mask: Optional[ArrayLike] = None) -> Passages:
        """The places where one segment passes through the surface or touches it, in exact order.

        `start`, `end`: shape (3,). The faces that meet the segment at one place are one passage: those of passage p are
        `touches[first_face[p]:first_face[p] + face_count[p]]`. The `crossings` of all passages add up to those of the
        segment. For thickness, and the part of a way in solid matter. ValueError: more than one segment.

        >>> import numpy as np, pierce
        >>> tetrahedron = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]],
        ...                                    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> passages = tetrahedron.passages([1, 1, 3], [1, 1, -1])
        >>> [pierce.PassageKind(kind).name for kind in passages.kind]
        ['ENTERING', 'LEAVING']
        >>> float(np.linalg.norm(passages.position[1] - passages.position[0]))
        2.0
        """
        columns, touches = self._core.passages(start, end, sides, max_fraction, mask)
        return Passages(columns, FaceTouches(touches))
