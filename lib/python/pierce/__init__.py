"""pierce: where a moving point, a segment or a ray first passes through a triangle mesh, exactly.

    mesh = pierce.CollisionMesh(vertices, faces)
    hits = mesh.first_hits(starts, ends)
"""

from ._pierce import MeshError
from ._pierce import version as __version__
from .answers import NO_FACE, Answers, Hits
from .enums import Feature, MoveState, PassageKind, Place, Reason, Sides
from .mesh import CollisionMesh
from .soup import NO_NAME, TriangleSoup, read_mesh

__all__ = [
    "NO_FACE", "NO_NAME", "Answers", "CollisionMesh", "Feature", "Hits", "MeshError", "MoveState", "PassageKind",
    "Place", "Reason", "Sides", "TriangleSoup", "read_mesh", "__version__",
]
