"""What people ask of a mesh: a part of `CollisionMesh`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _pierce
from .enums import Reason, Sides


class FaceVerdict(NamedTuple):
    """Why a face is, or is not, what a segment hits first."""

    face: int
    triangle: int
    reason: Reason
    edge: int
    """For `Reason.OUTSIDE_EDGE`: k says the edge from corner k to corner k + 1. Else 0."""
    text: str
    """A few words for people."""


@dataclass(frozen=True)
class MeshReport:
    """What is odd about a mesh. Vertices with equal coordinates count as one. Lists hold the first few cases."""

    zero_area: int
    """Triangles without area: they are never hit."""
    duplicates: int
    border_edges: int
    """Edges with one triangle: a particle can get through beside them."""
    non_manifold_edges: int
    misoriented_edges: int
    """Edges that more triangles follow one way than the other."""
    non_manifold_vertices: int
    t_junctions: int
    components: int
    edges_with: list[int]
    """`edges_with[n]`: edges that n triangles share; the last one counts those of more as well."""
    zero_area_triangles: NDArray[np.uint32]
    duplicate_triangles: NDArray[np.uint32]
    border_edge_list: NDArray[np.uint32]
    """Shape (k, 2): rows of `vertices`, as in the other lists of edges."""
    non_manifold_edge_list: NDArray[np.uint32]
    misoriented_edge_list: NDArray[np.uint32]
    non_manifold_vertex_list: NDArray[np.uint32]
    t_junction_list: NDArray[np.uint32]
    closed: bool
    """Then the surface has an inside, and no particle gets from one side to the other without a hit."""
    text: str

    def __str__(self) -> str:
        return self.text


class Reports:
    """Why a face is hit or is not, and what is odd about the mesh."""

    _core: _pierce.Mesh

    def explain(self, start: ArrayLike, end: ArrayLike, *, sides: Union[str, Sides] = "front",
                max_fraction: float = np.inf, mask: Optional[ArrayLike] = None) -> list[FaceVerdict]:
        """Why each face near one segment is its first hit or is not. For debugging: it looks at all faces.

        `start`, `end`: shape (3,). Options as of `first_hits`. ValueError: more than one segment.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> [verdict.reason.name for verdict in floor.explain([1, 1, -3], [1, 1, 3])]
        ['WRONG_SIDE']
        """
        verdicts: list[Any] = self._core.explain(start, end, sides, max_fraction, mask)
        return [FaceVerdict(face, triangle, Reason(reason), edge, text)
                for face, triangle, reason, edge, text in verdicts]

    def mesh_report(self) -> MeshReport:
        """What is odd about the mesh, and whether it can keep particles in. Computed anew by each call, in about the
        time of a build.

        >>> import pierce
        >>> report = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]).mesh_report()
        >>> report.closed, report.border_edges
        (False, 3)
        """
        return MeshReport(**self._core.mesh_report())
