"""Answers of the C++ interface to the same questions, by the program tests/python/dump.cpp."""

import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray


def _vector(name: str, scalar: Any) -> tuple[str, Any, tuple[int]]:
    return (name, scalar, (3,))


def hit_layout(scalar: Any) -> np.dtype[Any]:
    """`Hit` in memory, as include/pierce/hit.h documents it."""
    return np.dtype([("fraction", scalar), *(_vector(name, scalar) for name in ("point", "position", "normal",
                                                                               "barycentric")),
                     ("exact_fraction", scalar), ("face", "u4"), ("triangle", "u4"), ("side", "u1"), ("feature", "u1"),
                     ("feature_index", "u1"), ("at_start", "?"), ("reserved", "u4")])


def sphere_layout(scalar: Any) -> np.dtype[Any]:
    """`SphereHit` in memory."""
    rest = [("reserved", "u4", (2,) if scalar == np.float32 else (1,))]
    return np.dtype([("fraction", scalar), *(_vector(name, scalar) for name in ("center", "contact", "normal")),
                     ("overlap", scalar), ("face", "u4"), ("triangle", "u4"), ("side", "u1"), ("feature", "u1"),
                     ("feature_index", "u1"), ("at_start", "?"), *rest])


def sweep_layout(scalar: Any) -> np.dtype[Any]:
    """What the program writes of hits of moving meshes."""
    return np.dtype([("time", scalar), *(_vector(name, scalar) for name in ("place", "position", "normal",
                                                                           "barycentric", "surface_motion")),
                     ("face", "u4"), ("triangle", "u4"), ("side", "u1"), ("feature", "u1"), ("feature_index", "u1"),
                     ("at_start", "?"), ("place_verified", "?")])


def move_layout(scalar: Any) -> np.dtype[Any]:
    """What the program writes of moves."""
    return np.dtype([*(_vector(name, scalar) for name in ("position", "velocity", "travel", "remainder")),
                     ("contacts", "u8"), ("casts", "i4"), ("state", "u1")])


def dump(folder: Path, kind: str, vertices: Any, faces: Any, starts: Any, ends: Any) -> bytes:
    """The program's answers."""
    given, answers = folder / "given", folder / "answers"
    scalar = "float" if vertices.dtype == np.float32 else "double"
    with open(given, "wb") as file:
        file.write(np.array([len(vertices), len(faces), len(starts)], np.uint64).tobytes())
        for array in (vertices, faces.astype(np.uint32), starts, ends):
            file.write(np.ascontiguousarray(array).tobytes())
    subprocess.run([os.environ["PIERCE_PYTHON_DUMP"], scalar, kind, given, answers], check=True)
    return answers.read_bytes()


def expect_same(columns: dict[str, NDArray[Any]], expected: Any, *, but: tuple[str, ...] = ()) -> None:
    """Each column has the bits of the member of its name."""
    names = [name for name in columns if name not in ("hit", *but)]
    assert len(names) > 4
    for name in names:
        member = expected[name]
        column = columns[name]
        assert column.shape == member.shape, name
        assert column.flags.c_contiguous
        if name == "contacts":
            column = column.astype(np.uint64)
        assert column.tobytes() == np.ascontiguousarray(member).tobytes(), name
