"""Arrays of other libraries' meshes."""

from __future__ import annotations

from typing import Any


def arrays_of(mesh: Any) -> dict[str, Any]:
    """`vertices` and `faces`, and `face_numbers` where the object has such, for `CollisionMesh`.

    TypeError where the object has no vertices and faces.
    """
    try:
        arrays = {"vertices": mesh.vertices, "faces": mesh.faces}
    except AttributeError:
        raise TypeError(f"a {type(mesh).__name__} has no vertices and faces") from None
    if getattr(mesh, "face_numbers", None) is not None:
        arrays["face_numbers"] = mesh.face_numbers
    return arrays
