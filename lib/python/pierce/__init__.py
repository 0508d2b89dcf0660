"""pierce: where a moving point, a segment or a ray first passes through a triangle mesh, exactly.

    mesh = pierce.CollisionMesh(vertices, faces)
    hits = mesh.first_hits(starts, ends)
"""

from ._pierce import MeshError
from ._pierce import version as __version__
from ._reports import FaceVerdict, MeshReport
from .answers import (NO_FACE, Answers, FaceTouches, Hits, Locations, MoveContacts, Moves, Passages, RigidHits,
                      SphereHits, SweepHits)
from .deforming import DeformationStep, DeformingMesh
from .enums import Feature, MoveState, PassageKind, Place, Reason, Sides
from .mesh import CollisionMesh
from .motions import Pose, RigidMotion, Translation
from .soup import NO_NAME, TriangleSoup, read_mesh

MeshError.__doc__ = "A mesh, or a mesh file, that can't be used: one line that names the place and the reason."

__all__ = [
    "NO_FACE", "NO_NAME", "Answers", "CollisionMesh", "DeformationStep", "DeformingMesh", "FaceTouches", "FaceVerdict",
    "Feature", "Hits", "Locations", "MeshError", "MeshReport", "MoveContacts", "MoveState", "Moves", "PassageKind",
    "Passages", "Place", "Pose", "Reason", "RigidHits", "RigidMotion", "Sides", "SphereHits", "SweepHits",
    "Translation", "TriangleSoup", "read_mesh", "__version__",
]
