"""The mesh, made ready for queries."""

from __future__ import annotations

from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _pierce, adapters
from ._hits import HitQueries
from ._motion import MotionQueries
from ._moves import Moving
from ._places import PlaceQueries
from ._reports import Reports
from ._spheres import SphereQueries


class CollisionMesh(HitQueries, PlaceQueries, SphereQueries, MotionQueries, Moving, Reports):
    """Triangles in a tree, or a grid, for queries that are decided as if in exact arithmetic.

    `vertices`: shape (n, 3). float32 makes a mesh in single precision, float64 one in double; integers and lists
    become float64. `faces`: shape (m, 3), integers: the corners of each triangle as rows of `vertices`,
    counter-clockwise seen from the front. The mesh may be open, may cut itself, and may hold duplicate triangles or
    such without area: these are kept, and never hit. `face_numbers`: shape (m,), the number that answers know each
    triangle by (several may share one); by default its row in `faces`. What is needed is copied.

    `broadphase`: "tree", "grid" or "automatic"; `cell_size` and `max_grid_bytes` are for the grid, `backend` names the
    wide kernels ("avx512", "avx2", "sse2", "neon", "plain"). None of these changes an answer. `threads`: how many
    build it, 0 for one on each core.

    Raises `MeshError` where an index is out of range or a coordinate is not finite, naming it; ValueError for shapes
    and options that have no meaning, TypeError for dtypes. Takes n log n time.

    **Queries** take arrays of shape (n, 3) in any memory layout and answer with arrays. float32 goes to a float64 mesh
    as it is; float64 to a float32 mesh is a TypeError, as it would be rounded. A point of shape (3,) stands for all
    where there are many of the other kind. NaN and infinity hit nothing, and are counted in `statistics()`.

    All of them take `threads` (1 by default, 0 for one on each core; started for the call) and `progress`, called
    with (done, total) some ten times a second. Python's lock is released meanwhile, and Ctrl-C ends the call. Answers
    do not depend on either. The arrays must not be written to while a call runs in another thread.

    >>> import numpy as np, pierce
    >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> hits = floor.first_hits([[1, 1, 3], [9, 9, 3]], [[1, 1, -1], [9, 9, -1]])
    >>> hits.hit.tolist(), hits.exact_fraction.tolist()
    ([True, False], [0.75, 0.0])
    """

    _core: _pierce.Mesh

    @classmethod
    def of(cls, mesh: Any, **options: Any) -> CollisionMesh:
        """The mesh of another library's object: of anything with `vertices` and `faces`, as trimesh's and
        `TriangleSoup`; `pierce.adapters.arrays_of` knows the others. `options`: as of the constructor. TypeError: it is
        none of them.

        >>> import pierce
        >>> soup = pierce.TriangleSoup(vertices=[[0, 0, 0], [4, 0, 0], [0, 4, 0]], faces=[[0, 1, 2]])
        >>> pierce.CollisionMesh.of(soup)
        <CollisionMesh: 1 triangles, float64>
        """
        return cls(**{**adapters.arrays_of(mesh), **options})

    @classmethod
    def _of_core(cls, core: _pierce.Mesh) -> CollisionMesh:
        mesh = cls.__new__(cls)
        mesh._core = core
        return mesh

    def __init__(self, vertices: ArrayLike, faces: ArrayLike, *, face_numbers: Optional[ArrayLike] = None,
                 broadphase: str = "automatic", cell_size: float = 0, max_grid_bytes: int = 0, backend: str = "",
                 threads: int = 1) -> None:
        self._core = _pierce.Mesh(vertices, faces, face_numbers, broadphase, cell_size, max_grid_bytes, backend,
                                  threads)

    @property
    def dtype(self) -> np.dtype[Any]:
        """float32 or float64: that of the vertices, and of all points in answers."""
        return np.dtype(np.float64 if self._core.is_double else np.float32)

    def statistics(self) -> dict[str, Any]:
        """What was built, and how many queries were invalid so far, by name. Takes constant time.

        vertices, faces, triangles, degenerate (of area exactly zero), clusters, broadphase, nodes, cell_size,
        grid_references, backend, bytes, invalid_queries (those with a coordinate that is NaN or infinite).

        >>> import pierce
        >>> mesh = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> mesh.contains([[float("nan"), 0, 0]]).tolist(), mesh.statistics()["invalid_queries"]
        ([False], 1)
        """
        return self._core.statistics()

    def __len__(self) -> int:
        """How many triangles there are."""
        return int(self.statistics()["triangles"])

    def __repr__(self) -> str:
        return f"<CollisionMesh: {len(self)} triangles, {self.dtype}>"
