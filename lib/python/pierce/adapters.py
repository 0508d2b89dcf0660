"""Meshes of other packages as arrays, for `CollisionMesh.of`. None of those packages is imported."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def arrays_of(mesh: Any) -> dict[str, Any]:
    """`vertices` and `faces`, and `face_numbers` where there are such, of a mesh of trimesh, PyVista (PolyData), Open3D
    (TriangleMesh, legacy or of tensors), or of anything that has the same attributes, as `TriangleSoup` has. The dtype
    of the vertices stays.

    Raises ValueError for faces that are no triangles, and TypeError for what is no such mesh.

    >>> import numpy as np
    >>> from types import SimpleNamespace
    >>> quad = SimpleNamespace(points=np.eye(4, 3), faces=np.array([4, 0, 1, 2, 3]))
    >>> arrays_of(quad)
    Traceback (most recent call last):
    ...
    ValueError: SimpleNamespace: of 1 faces 1 have not three corners, first face 0 with 4: cut them into triangles
    """
    name = type(mesh).__name__
    if hasattr(mesh, "vertex") and hasattr(mesh, "triangle"):  # Open3D's tensors; an empty mesh has neither array
        return {"vertices": _tensor(mesh.vertex, "positions", np.zeros((0, 3), np.float32)),
                "faces": _tensor(mesh.triangle, "indices", np.zeros((0, 3), np.int32))}
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles") and not hasattr(mesh, "faces"):
        return {"vertices": _rows(mesh.vertices), "faces": _rows(mesh.triangles)}
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        strips = getattr(mesh, "strips", None)
        if strips is not None and len(strips):
            raise ValueError(f"{name}: it has strips of triangles: cut them into triangles")
        return {"vertices": _rows(mesh.points), "faces": _unpacked(np.asarray(mesh.faces), name)}
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        faces = np.asarray(mesh.faces)
        if faces.ndim == 2 and len(faces) and faces.shape[1] != 3:
            raise ValueError(_polygons(name, np.full(len(faces), faces.shape[1])))
        arrays = {"vertices": _rows(mesh.vertices), "faces": _rows(faces)}
        if getattr(mesh, "face_numbers", None) is not None:
            arrays["face_numbers"] = np.asarray(mesh.face_numbers)
        return arrays
    raise TypeError(f"{name} is no mesh that is known here: what is needed are vertices and faces (trimesh), points "
                    "and faces (PyVista's PolyData: extract_surface() makes one of a grid), vertices and triangles or "
                    "vertex.positions and triangle.indices (Open3D); of a scene take one mesh, or join them")


def _rows(given: Any) -> NDArray[Any]:
    """Each row side by side in memory; of nothing no rows."""
    array = np.ascontiguousarray(given)
    return array if array.size else np.zeros((0, 3), np.int64)


def _tensor(attributes: Any, key: str, nothing: NDArray[Any]) -> NDArray[Any]:
    if key not in attributes:
        return nothing
    tensor = attributes[key]
    return np.asarray((tensor.cpu() if hasattr(tensor, "cpu") else tensor).numpy())


def _unpacked(packed: NDArray[Any], name: str) -> NDArray[Any]:
    """Faces that have their number of corners in front, as VTK's have."""
    if packed.ndim != 1:
        return _rows(packed)  # one row a face
    if len(packed) % 4 == 0 and (packed[::4] == 3).all():
        return _rows(packed.reshape(-1, 4)[:, 1:])
    sizes = []
    place = 0
    while place < len(packed):
        size = int(packed[place])
        if size < 1 or place + size >= len(packed):
            raise ValueError(f"{name}: faces is not packed as VTK packs them: entry {place} says {size} corners")
        sizes.append(size)
        place += size + 1
    raise ValueError(_polygons(name, np.array(sizes)))


def _polygons(name: str, sizes: NDArray[Any]) -> str:
    others = np.flatnonzero(sizes != 3)
    return (f"{name}: of {len(sizes)} faces {len(others)} have not three corners, first face {others[0]} with "
            f"{sizes[others[0]]}: cut them into triangles")
