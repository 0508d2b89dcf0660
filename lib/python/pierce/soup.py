"""Meshes from files."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import DTypeLike, NDArray

from . import _pierce

NO_NAME = 0xFFFFFFFF
"""Stands for the name of a face that has none, in `material_of_face` and `group_of_face`."""


@dataclass(frozen=True)
class TriangleSoup:
    """What a file holds: vertices and triangles, with no connectivity, whatever its topology."""

    vertices: NDArray[Any]
    """Shape (n, 3), float64 or float32, in the units of the file."""
    faces: NDArray[np.uint32]
    """Shape (m, 3): corners as rows of `vertices`, counter-clockwise seen from the front."""
    face_numbers: Optional[NDArray[np.uint32]] = None
    """Shape (m,): for each triangle the face of the file that it was cut from. None if all of these are triangles."""
    materials: list[str] = field(default_factory=list)
    """Names of materials, each once, in the order of the file; empty unless asked for."""
    material_of_face: Optional[NDArray[np.uint32]] = None
    """For each face of the file the place of its name in `materials`, or `NO_NAME`."""
    groups: list[str] = field(default_factory=list)
    """Names of groups, in the same way."""
    group_of_face: Optional[NDArray[np.uint32]] = None
    """As `material_of_face`, of groups."""


def read_mesh(path: Union[str, os.PathLike[str]], dtype: DTypeLike = np.float64, *, materials: bool = False,
              groups: bool = False) -> TriangleSoup:
    """Reads OBJ, OFF, PLY or STL, text and binary; the kind is told from the name's ending.

    Every number is read at the precision of `dtype` (float64 or float32), correctly rounded. Polygons are cut into
    triangles; no face is left out. Time and memory are linear in the size of the file.

    Raises `MeshError`, one line that names the file, the line or byte and the reason, where the file can't be opened
    or is damaged.

    >>> import pierce
    >>> with open("floor.off", "w") as file:
    ...     _ = file.write("OFF\\n4 1 0\\n0 0 0\\n1 0 0\\n1 1 0\\n0 1 0\\n4 0 1 2 3\\n")
    >>> soup = pierce.read_mesh("floor.off")
    >>> soup.vertices.shape, soup.faces.shape, soup.face_numbers.tolist()
    ((4, 3), (2, 3), [0, 0])
    """
    kind = np.dtype(dtype)
    if kind not in (np.dtype(np.float32), np.dtype(np.float64)):
        raise TypeError(f"dtype {kind}, where float32 or float64 is needed")
    return TriangleSoup(**_pierce.read_mesh(path, kind == np.float32, materials, groups))
