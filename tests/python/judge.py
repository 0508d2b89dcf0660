"""An exact judge of segments against triangles, in fractions."""

from fractions import Fraction
from typing import Any, NamedTuple, Optional, Sequence

Vector = Sequence[Fraction]


class Meeting(NamedTuple):
    """Where a segment hits a triangle."""

    fraction: Fraction
    face: int
    position: tuple[Fraction, ...]
    zero_edges: int


def exact(point: Any) -> tuple[Fraction, ...]:
    """A point's coordinates as the numbers that they are."""
    return tuple(Fraction(float(x)) for x in point)


def minus(a: Vector, b: Vector) -> tuple[Fraction, ...]:
    return tuple(x - y for x, y in zip(a, b))


def dot(a: Vector, b: Vector) -> Fraction:
    return sum((x * y for x, y in zip(a, b)), Fraction(0))


def cross(a: Vector, b: Vector) -> tuple[Fraction, ...]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def front_hit(start: Vector, end: Vector, corners: Sequence[Vector], face: int) -> Optional[Meeting]:
    """The contract of a hit: from in front of the plane or on it to strictly behind, through the closed triangle."""
    a, b, c = corners
    normal = cross(minus(b, a), minus(c, a))
    above, below = dot(normal, minus(start, a)), dot(normal, minus(end, a))
    if above < 0 or below >= 0:
        return None
    fraction = above / (above - below)
    position = tuple(x + fraction * (y - x) for x, y in zip(start, end))
    edges = [dot(cross(minus(q, p), minus(position, p)), normal) for p, q in ((a, b), (b, c), (c, a))]
    if min(edges) < 0:
        return None
    return Meeting(fraction, face, position, edges.count(0))


def hits_in_order(start: Any, end: Any, triangles: Sequence[Sequence[Vector]]) -> list[Meeting]:
    """All hits of fronts, by fraction and then face."""
    start, end = exact(start), exact(end)
    found = (front_hit(start, end, corners, face) for face, corners in enumerate(triangles))
    return sorted((hit for hit in found if hit is not None), key=lambda hit: (hit.fraction, hit.face))
