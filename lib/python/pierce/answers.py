"""Answers as arrays: entry i of each is of query i, or of hit i where a query may have many."""

from __future__ import annotations

import copy
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
    """Arrays of one length. `answers[index]` has the entries that a NumPy index, a mask or a slice names; of one number
    arrays of length 1, IndexError where there is no such entry."""

    _columns: dict[str, NDArray[Any]]

    def __init__(self, columns: dict[str, Any]) -> None:
        self._columns = columns

    def __getattr__(self, name: str) -> Any:
        columns = self.__dict__.get("_columns", {})
        if name in columns:
            return columns[name]
        why = "was not asked for: see `wanted`" if name in type(self).__annotations__ else "does not exist"
        raise AttributeError(f"{type(self).__name__}.{name} {why}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._columns]

    def __len__(self) -> int:
        return len(next(iter(self._columns.values()), ()))

    def __iter__(self) -> Iterator[Any]:
        raise TypeError(f"{type(self).__name__} holds arrays: take one of {', '.join(self._columns)}")

    def __getitem__(self: Self, index: Any) -> Self:
        if isinstance(index, (int, np.integer)):
            if not -len(self) <= index < len(self):
                raise IndexError(f"{type(self).__name__}[{index}], of {len(self)}")
            index = slice(index, index + 1 or None)
        some = copy.copy(self)
        some._columns = {name: column[index] for name, column in self._columns.items()}
        return some

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} of {', '.join(self._columns)}>"

    def columns(self) -> dict[str, NDArray[Any]]:
        """The arrays by their names."""
        return dict(self._columns)


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


class FaceTouches(Answers):
    """Triangles that points lie on, or segments pass through."""

    face: Numbers
    triangle: Numbers
    feature: Bytes
    """What of the triangle the place lies on, exactly: a `Feature`."""
    feature_index: Bytes
    crossing: NDArray[np.int8]
    """In `passages` what the triangle adds to `crossings`: 1, 0 or -1. In `locate` 0."""


class WithTouches(Answers):
    """Answers whose faces stand in an array of their own; a part of the answers has all of them."""

    touches: FaceTouches
    """The triangles of all entries: those of one are the `face_count` from `first_face` on."""

    def __init__(self, columns: dict[str, Any], touches: FaceTouches) -> None:
        super().__init__(columns)
        self.touches = touches


class Locations(WithTouches):
    """Where points are, decided exactly."""

    place: Bytes
    """A `Place`: outside, inside or on the surface. Of a point that is not finite: outside."""
    winding_number: NDArray[np.int32]
    """That of `winding_numbers`."""
    first_face: Counts
    """Where the faces of the point begin in `touches`."""
    face_count: Counts
    """How many triangles the point lies on."""


class Passages(WithTouches):
    """Where a segment passes through the surface or touches it, in exact order: one entry for each place."""

    fraction: Floats
    """In [0, 1], within 1 ulp; exactly 0 and 1 at the segment's ends."""
    position: Floats
    """The true point, each coordinate rounded correctly."""
    normal: Floats
    """Unit normal of `face`."""
    face: Numbers
    """The face that stands for all that meet there."""
    triangle: Numbers
    side: Bytes
    crossings: NDArray[np.int32]
    """How often the segment passes from front to back here, less how often the other way."""
    kind: Bytes
    """A `PassageKind`: what `crossings` says."""
    feature: Bytes
    feature_index: Bytes
    at_start: Flags
    at_end: Flags
    first_face: Counts
    """Where the faces of the passage begin in `touches`."""
    face_count: Counts
    """How many triangles meet there."""


class SphereHits(Answers):
    """Where balls run into the mesh. Of a miss `face` and `triangle` are `NO_FACE`, all else is 0."""

    hit: Flags
    fraction: Floats
    """The time of impact, rounded down; 0 where the ball starts in contact and goes in."""
    center: Floats
    """Where to stop the ball: verified, it penetrates nothing there nor on the way."""
    contact: Floats
    """The point of the triangle that is touched, rounded."""
    normal: Floats
    """Unit vector from there to the center."""
    overlap: Floats
    """How deep the ball overlaps the triangle at the start; more than 0 if and only if it overlaps."""
    face: Numbers
    triangle: Numbers
    side: Bytes
    feature: Bytes
    feature_index: Bytes
    at_start: Flags


class SweepHits(Answers):
    """Where points run into a mesh that moves. Of a miss `face` and `triangle` are `NO_FACE`, all else is 0."""

    hit: Flags
    time: Floats
    """A lower bound of the time of contact, a part of the step in [0, 1]."""
    place: Floats
    """A place for the point at the end of the step, from which the next step goes on."""
    place_verified: Flags
    """Whether the way to `place` is certified to have no contact."""
    position: Floats
    """The place of the contact, in space."""
    normal: Floats
    """Unit normal of the face at that time."""
    barycentric: Floats
    surface_motion: Floats
    """How far the mesh's material at the contact goes in the whole step."""
    face: Numbers
    triangle: Numbers
    side: Bytes
    feature: Bytes
    feature_index: Bytes
    at_start: Flags


class RigidHits(SweepHits):
    """The same for a mesh that turns."""

    local: Floats
    """`place` in the mesh's own coordinates; verified in any case."""
    local_position: Floats
    """The contact in the mesh's coordinates, correctly rounded."""
    local_normal: Floats
    """Unit normal in the mesh."""


class MoveContacts(Answers):
    """What moves met: row i, if there is room for k contacts a particle, is number i % k of particle i // k.

    Where there was none `face` and `triangle` are `NO_FACE`, all else is 0.
    """

    point: Floats
    """Where the particle was, or the center of the ball."""
    normal: Floats
    """Unit normal, towards the particle."""
    speed: Floats
    """At which it approached the surface along the normal."""
    seconds: Floats
    """How much of the step was left."""
    face: Numbers
    triangle: Numbers
    side: Bytes


class Moves(Answers):
    """What became of particles in one step."""

    position: Floats
    """Where they are after it."""
    velocity: Floats
    """Exactly 0 where they rest."""
    travel: Floats
    """`position` less where they began."""
    remainder: Floats
    """The way left undone where a move's queries were used up; else 0."""
    contacts: Counts
    """How many contacts there were, those included for which there was no room."""
    casts: NDArray[np.int32]
    """Queries that were made."""
    state: Bytes
    """A `MoveState`."""
    met: MoveContacts
    """The contacts; empty unless asked for."""

    def __init__(self, columns: dict[str, Any], met: MoveContacts) -> None:
        super().__init__(columns)
        self.met = met
