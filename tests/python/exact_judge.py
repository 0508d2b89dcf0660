"""Decides in whole numbers where a point is and what a ray hits first: a judge that shares nothing with pierce.

Written from the rules in include/pierce/hit.h, collision_mesh.h and location.h, by other ways than the library's: rays
in directions without accidents for winding numbers, and every face that bounds in double precision cannot refuse.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction
from typing import Iterable, NamedTuple, Sequence

import numpy as np

Numbers = tuple[int, int, int]
GROUP = 32  # faces that share a box


class Location(NamedTuple):
    """Where a point is. On the surface the numbers are those of the point moved by (e, e^2, e^3), e -> 0+."""

    on_surface: bool
    winding_number: int
    crossings: int  # of a ray from there, each surface counted once: odd is inside where sheets don't overlap


@dataclass(frozen=True)
class FirstHit:
    """What is hit first: the exact fraction, and all faces that are hit there, in order."""

    fraction: Fraction
    faces: tuple[int, ...]


class Judge:
    """A mesh of triangles, ready to be asked. Coordinates are taken as the exact numbers that they are."""

    def __init__(self, vertices: np.ndarray, faces: np.ndarray) -> None:
        self._corners = np.asarray(vertices, dtype=np.float64)[np.asarray(faces, dtype=np.int64)]
        assert np.isfinite(self._corners).all()
        self._last_ray: tuple | None = None
        self._last_meetings: list[tuple[int, int, int, bool | None]] = []
        middles = self._corners.mean(axis=1)
        self._order = _along_a_curve(middles)
        sorted_corners = self._corners[self._order]
        starts = np.arange(0, len(self._order), GROUP)
        low = np.minimum.reduceat(sorted_corners.min(axis=1), starts) if len(starts) else np.zeros((0, 3))
        high = np.maximum.reduceat(sorted_corners.max(axis=1), starts) if len(starts) else np.zeros((0, 3))
        self._box_middle = (low + high) / 2
        # Half of the box, with room for the rounding of both.
        self._box_half = (high - low) / 2 * (1 + 1e-12) + np.abs(low) * 1e-15 + np.abs(high) * 1e-15

    def first_hit(self, origin: Sequence[float], direction: Sequence[float], *, limit: float | None = None,
                  sides: str = "both") -> FirstHit | None:
        """The first hit of the ray `origin + t * direction`, t from 0 to `limit` (None: without end)."""
        hits = self.hits(origin, direction, limit=limit, sides=sides)
        if not hits:
            return None
        first = min(fraction for fraction, _ in hits)
        return FirstHit(first, tuple(sorted(face for fraction, face in hits if fraction == first)))

    def first_hit_of_segment(self, start: Sequence[float], end: Sequence[float], *,
                             sides: str = "both") -> FirstHit | None:
        """The first hit of the segment, whose direction need not be a floating-point number."""
        direction = [Fraction(b) - Fraction(a) for a, b in zip(_floats(start), _floats(end))]
        return self.first_hit(start, direction, limit=1, sides=sides)

    def hits(self, origin: Sequence[float], direction: Sequence[float | Fraction], *, limit: float | None = None,
             sides: str = "both") -> list[tuple[Fraction, int]]:
        """All hits as (fraction, face), in no order."""
        found = []
        for face, front, along, meets in self._meetings_of(origin, direction):
            # Without an end the side is that of the direction: far away the plane's constant does not count.
            end = along if limit is None else front + Fraction(limit) * along
            if meets and along != 0 and _changes_side(front, end, sides):
                found.append((Fraction(front, -along), face))
        return found

    def lies_in_a_plane(self, origin: Sequence[float], direction: Sequence[float]) -> bool:
        """Whether the ray's line meets a face in whose plane it lies: pierce does not call that a hit, others may."""
        return any(meets and front == 0 == along for _, front, along, meets in self._meetings_of(origin, direction))

    def locate(self, point: Sequence[float]) -> Location:
        """Where a point is. The mesh must be closed and of one orientation: then no way out is better than another."""
        where = self._along_rays(point, nudged=False)
        if not where.on_surface:
            return where
        return Location(True, *self._along_rays(point, nudged=True)[1:])

    def _along_rays(self, point: Sequence[float], nudged: bool) -> Location:
        directions = random.Random(repr(tuple(point)))
        while True:
            direction = [directions.randint(-1000, 1000) for _ in range(3)]
            counted = self._along_ray(point, direction, nudged) if any(direction) else None
            if counted is not None:
                return counted

    def _along_ray(self, point: Sequence[float], direction: Sequence[int], nudged: bool) -> Location | None:
        """Counts along one ray; None where it meets a corner, an edge or a face edgewise."""
        winding = crossings = 0
        for _, front, along, meets in self._meetings(point, direction, nudged=nudged, accidents=True):
            if meets is None or along == 0:
                return None  # met at the rim, or in its plane
            if meets and front == 0:
                return Location(True, 0, 0)
            if meets and (front < 0) == (along > 0):
                winding += 1 if along > 0 else -1
                crossings += 1
        return Location(False, winding, crossings)

    def _meetings_of(self, origin: Sequence[float], direction: Sequence) -> list[tuple[int, int, int, bool | None]]:
        """Those of the last ray are kept: it is asked about several times."""
        key = (*map(float, origin), *direction)
        if key != self._last_ray:
            self._last_ray, self._last_meetings = key, list(self._meetings(origin, direction))
        return self._last_meetings

    def _meetings(self, origin: Sequence[float], direction: Sequence, *, nudged: bool = False, accidents: bool = False,
                  ) -> Iterable[tuple[int, int, int, bool | None]]:
        """For each face with an area that the line may meet: its number, the signed volumes of the origin in front of
        its plane and of the direction, and whether the line meets the closed face. With `accidents` that is None where
        it meets the rim, unless the origin itself is there."""
        candidates = self.candidates(_floats(origin), np.array([float(x) for x in direction]))
        direction = [x if isinstance(x, (int, Fraction)) else float(x) for x in direction]
        rows = [_floats(origin), direction] + [corner for face in candidates for corner in self._corners[face].tolist()]
        whole = _whole_numbers(rows)
        start, way, bits = whole[0], whole[1], max(abs(x) for row in whole for x in row).bit_length()
        corners = whole[2:]
        if nudged:
            # Volumes are linear in the origin, with whole coefficients below 2^(2 bits + 4): so small a step changes no
            # sign but those of volumes that are zero.
            shift = 2 * bits + 8
            corners = [tuple(x << 3 * shift for x in corner) for corner in corners]
            start = tuple((x << 3 * shift) + (1 << (2 - i) * shift) for i, x in enumerate(start))
        for k, face in enumerate(candidates):
            a, b, c = (_less(corner, start) for corner in corners[3 * k:3 * k + 3])
            normal = _cross(_less(b, a), _less(c, a))
            if normal == (0, 0, 0):
                continue
            front, along = -_dot(normal, a), _dot(normal, way)
            if front == 0 == along:
                edges = [_dot(normal, _cross(way, corner)) for corner in (a, b, c)]  # which side of the line it is on
                meets: bool | None = min(edges) <= 0 <= max(edges)
            else:
                edges = [_dot(way, _cross(b, a)), _dot(way, _cross(c, b)), _dot(way, _cross(a, c))]
                meets = not min(edges) < 0 < max(edges)
            if accidents and meets and 0 in edges and front != 0:
                meets = None
            yield face, front, along, meets

    def candidates(self, origin: Sequence[float], direction: np.ndarray) -> list[int]:
        """The faces that the line may meet, and as few others as doubles can tell. Nothing that it meets is left out:
        each comparison has room for several times the rounding that it can have, and not-a-number keeps the face."""
        o, d = np.asarray(origin, dtype=np.float64), np.asarray(direction, dtype=np.float64)
        d = d / np.abs(d).max() if np.isfinite(d).all() and np.abs(d).max() > 0 else d  # rounds: allowed for below
        with np.errstate(all="ignore"):
            groups = np.flatnonzero(self._boxes_near(o, d))
            places = (groups[:, None] * GROUP + np.arange(GROUP)).ravel()
            faces = self._order[places[places < len(self._order)]]
            a, b, c = (self._corners[faces, k] - o for k in range(3))
            certain = [_certain_sign(d, second, first) for first, second in ((a, b), (b, c), (c, a))]
            positive = np.logical_or.reduce([sign > 0 for sign in certain])
            negative = np.logical_or.reduce([sign < 0 for sign in certain])
        return np.sort(faces[~(positive & negative)]).tolist()

    def _boxes_near(self, o: np.ndarray, d: np.ndarray) -> np.ndarray:
        """Which boxes the line may meet: it is apart from one if it is in the projection along an axis."""
        away = self._box_middle - o
        near = np.ones(len(away), dtype=bool)
        for j, k in ((0, 1), (1, 2), (2, 0)):
            left, right = d[j] * away[:, k], d[k] * away[:, j]
            room = np.abs(d[j]) * self._box_half[:, k] + np.abs(d[k]) * self._box_half[:, j]
            noise = 1e-12 * (np.abs(left) + np.abs(right) + np.abs(d[j] * o[k]) + np.abs(d[k] * o[j])) + 1e-290
            near &= ~(np.abs(left - right) > room * (1 + 1e-9) + noise)
        return near


def _certain_sign(d: np.ndarray, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """The sign of d . (first x second), or 0 where rounding may have changed it: less than 16 roundings a term."""
    value = np.zeros(len(first))
    size = np.zeros(len(first))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        left, right = first[:, j] * second[:, k], first[:, k] * second[:, j]
        value += d[i] * (left - right)
        size += np.abs(d[i]) * (np.abs(left) + np.abs(right))
    return np.where(np.abs(value) > size * 64 * 2.0**-52 + 1e-290, np.sign(value), 0)


def _changes_side(front: int, end: int | Fraction, sides: str) -> bool:
    """The rule for hits: `front` and `end` are the signed distances from the plane, by any positive factor each."""
    if sides == "front":
        return front >= 0 > end
    if sides == "back":
        return front <= 0 < end
    return front >= 0 > end or front < 0 <= end


def _along_a_curve(points: np.ndarray) -> np.ndarray:
    """An order in which neighbours are near: by the interleaved bits of coordinates (Morton)."""
    if not len(points):
        return np.zeros(0, dtype=np.int64)
    size = np.maximum(np.ptp(points, axis=0).max(), 1e-300)
    cells = ((points - points.min(axis=0)) / size * 1023).astype(np.int64)
    code = np.zeros(len(points), dtype=np.int64)
    for bit in range(10):
        for axis in range(3):
            code |= ((cells[:, axis] >> bit) & 1) << (3 * bit + axis)
    return np.argsort(code, kind="stable")


def _floats(point: Sequence[float]) -> list[float]:
    return [float(x) for x in point]


def _whole_numbers(rows: Sequence[Sequence[float | int | Fraction]]) -> list[Numbers]:
    """All of them times one power of two (or other number) that makes them whole: no sign or quotient changes."""
    ratios = [[Fraction(x) for x in row] for row in rows]
    scale = max((x.denominator for row in ratios for x in row), default=1)  # powers of two divide one another
    assert scale & (scale - 1) == 0
    return [tuple(x.numerator * (scale // x.denominator) for x in row) for row in ratios]


def _less(p: Numbers, q: Numbers) -> Numbers:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def _cross(p: Numbers, q: Numbers) -> Numbers:
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]


def _dot(p: Numbers, q: Numbers) -> int:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
