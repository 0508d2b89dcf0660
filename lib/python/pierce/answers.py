"""Answers as arrays: entry i of each is of query i, or of hit i where a query may have many."""

from __future__ import annotations

from typing import Any, Iterator, TypeVar

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]
Flags = NDArray[np.bool_]
Numbers = NDArray[np.uint32]
Bytes = NDArray[np.uint8]
Counts = NDArray[np.int64]

Self = TypeVar("Self", bound="Answers")

NO_FACE = 0xFFFFFFFF
"""The face and triangle of a miss."""


class Answers:
    """Arrays of one length. `answers[index]` has the entries that a NumPy index, a mask or a slice names."""

    def __init__(self, columns: dict[str, Any]) -> None:
        self.__dict__.update(columns)

    def __getattr__(self, name: str) -> Any:
        if name in _names(type(self)):
            raise AttributeError(f"{type(self).__name__}.{name} was not asked for: see `wanted`")
        raise AttributeError(f"{type(self).__name__} has no {name!r}")

    def __len__(self) -> int:
        return len(next(iter(self.__dict__.values()), ()))

    def __iter__(self) -> Iterator[Any]:
        raise TypeError(f"{type(self).__name__} holds arrays: take one of {', '.join(self.__dict__)}")

    def __getitem__(self: Self, index: Any) -> Self:
        if isinstance(index, (int, np.integer)):
            index = slice(index, index + 1 or None)
        return type(self)({name: column[index] for name, column in self.__dict__.items()})

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} of {', '.join(self.__dict__)}>"

    def columns(self) -> dict[str, NDArray[Any]]:
        """The arrays by their names."""
        return dict(self.__dict__)


def _names(answers: type) -> list[str]:
    return [name for one in answers.__mro__ for name in one.__dict__.get("__annotations__", ())]


class Hits(Answers):
    """Where segments or rays meet the mesh. Of a miss `face` and `triangle` are `NO_FACE`, all else is 0.

    Points and vectors have the shape (n, 3) and the mesh's dtype.
    """

    hit: Flags
    """Whether there is a hit."""
    fraction: Floats
    """A lower bound of the true fraction that belongs to `point`; of a ray its t."""
    exact_fraction: Floats
    """Where the segment meets the face, within 1 ulp; not verified."""
    point: Floats
    """A place to stop at: the way there has no hit itself, so that a particle that is put there and stepped again
    can't get through the mesh."""
    position: Floats
    """The true point of intersection, each coordinate rounded correctly; it may lie behind the face."""
    normal: Floats
    """Unit normals of the faces, pointing to their fronts whichever side was hit."""
    barycentric: Floats
    """Weights of the corners in the true point, each within 1 ulp of 1."""
    face: Numbers
    """The caller's number of the face: its row in `faces`, or its entry in `face_numbers`."""
    triangle: Numbers
    """The row in `faces`."""
    side: Bytes
    """`Sides.FRONT` or `Sides.BACK`: where the segment came from."""
    feature: Bytes
    """What is hit, exactly: a `Feature`."""
    feature_index: Bytes
    """Which edge or corner (`Feature`)."""
    at_start: Flags
    """The segment starts on the face."""
