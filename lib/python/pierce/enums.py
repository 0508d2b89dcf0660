"""Numbers that answers hold, by their names."""

from enum import IntEnum


class Sides(IntEnum):
    """Which side of a face a segment comes from; queries may be asked about both."""

    FRONT = 0
    """From in front of the face's plane or on it, to strictly behind."""
    BACK = 1
    """The same mirrored."""
    BOTH = 2
    """A change of side, where on the plane counts as in front."""


class Feature(IntEnum):
    """What of a triangle a place lies on, decided exactly."""

    FACE = 0
    EDGE = 1
    """`feature_index` k says the edge from corner k to corner k + 1 (mod 3)."""
    VERTEX = 2
    """`feature_index` says which corner."""


class Place(IntEnum):
    """Where a point is, decided exactly."""

    OUTSIDE = 0
    INSIDE = 1
    ON_SURFACE = 2


class PassageKind(IntEnum):
    """What a passage does to the winding number."""

    ENTERING = 0
    LEAVING = 1
    GRAZING = 2


class MoveState(IntEnum):
    """How a move ended."""

    FREE = 0
    """Met nothing."""
    SLID = 1
    """Met something, and goes on: along it, or off it."""
    RESTING = 2
    """Stands still on what it met, or goes with a mesh that moves."""
    WEDGED = 3
    """Stopped by three faces or more; or no place was left."""
    INVALID = 4
    """Something was NaN or infinite: nothing was moved."""
    CRUSHED = 5
    """In a step of a mesh that moves: no place was found at its end."""


class Reason(IntEnum):
    """Why a face is not the first hit, or that it is."""

    FIRST_HIT = 0
    LATER = 1
    """Hit, but another hit comes before."""
    APART = 2
    """The boxes of face and segment have no point in common."""
    ZERO_AREA = 3
    MASKED = 4
    IN_PLANE = 5
    """Both ends lie in the face's plane."""
    IN_FRONT = 6
    """The segment does not go behind the plane."""
    BEHIND = 7
    """The segment does not go in front of the plane."""
    WRONG_SIDE = 8
    """It comes from the side that `sides` leaves out."""
    OUTSIDE_EDGE = 9
    """It passes through the plane on the outer side of an edge."""
    TOO_FAR = 10
    """Hit, but beyond `max_fraction`."""
    NOT_ACCEPTED = 11
