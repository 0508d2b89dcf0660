"""Who is right: where the libraries differ tests/python/exact_judge.py decides, and for some where they agree."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Callable

import numpy as np
from exact_judge import FirstHit, Judge

from libraries import FirstHits

PLACE = 1e-4  # two hits are in one place if their t differ by less than this part


@dataclass
class Tally:
    """What was asked and how many answers are wrong, by name. Where not all differences were judged, numbers are those
    of a random part of them, scaled."""

    asked: int = 0
    differ: int = 0
    judged: int = 0
    agreed_judged: int = 0
    found: Counter[str] = field(default_factory=Counter)
    scaled: set[str] = field(default_factory=set)  # names of numbers that are estimates

    def add(self, other: Tally) -> None:
        self.asked += other.asked
        self.differ += other.differ
        self.judged += other.judged
        self.agreed_judged += other.agreed_judged
        self.found.update(other.found)
        self.scaled |= other.scaled

    def show(self, name: str) -> str:
        return ("~" if name in self.scaled else "") + f"{round(self.found[name]):,}"


Verdict = Callable[[int], list[str]]  # what is wrong about question i


def _judge_some(differences: list[np.ndarray], most: int, agreed: int, verdict: Verdict) -> Tally:
    """Asks about at most `most` of each kind of difference, each question once, under the first of its kinds."""
    random = np.random.default_rng(7)
    tally = Tally(len(differences[0]))
    left = np.ones(tally.asked, dtype=bool)

    def judge(mask: np.ndarray, limit: int) -> tuple[int, int]:
        members = np.flatnonzero(mask)
        sample = random.permutation(members)[:limit]
        found: Counter[str] = Counter()
        for i in sample:
            found.update(verdict(int(i)))
        for name, number in found.items():
            tally.found[name] += number * len(members) / len(sample)
            if len(sample) < len(members):
                tally.scaled.add(name)
        return len(members), len(sample)

    for mask in differences:
        members, judged = judge(mask & left, most)
        tally.differ += members
        tally.judged += judged
        left &= ~mask
    tally.agreed_judged = judge(left, agreed)[1]
    return tally


def judge_points(judge: Judge, points: np.ndarray, ours: np.ndarray, theirs: dict[str, np.ndarray], most: int,
                 agreed: int) -> Tally:
    """`theirs` has Open3D's answers by name. Each is held to its library's own definition: pierce's says where the
    winding number is not 0, Open3D's counts surfaces to infinity, and is asked about no point of the surface."""

    def verdict(i: int) -> list[str]:
        where = judge.locate(points[i])
        wrong = ["pierce"] if bool(ours[i]) != (where.winding_number != 0) else []
        if where.on_surface:
            return wrong + ["on the surface"]
        return wrong + [name for name, answer in theirs.items() if bool(answer[i]) != bool(where.crossings % 2)]

    differ = np.logical_or.reduce([answer != ours for answer in theirs.values()])
    return _judge_some([differ], most, agreed, verdict)


@dataclass(frozen=True)
class RayAnswers:
    """What a library said about rays; `odd` is the parity of intersections, or whether the origin is inside."""

    first: FirstHits
    occluded: np.ndarray
    odd: np.ndarray


def judge_rays(judge: Judge, origins: np.ndarray, directions: np.ndarray, ours: RayAnswers, theirs: RayAnswers,
               most: int, agreed: int) -> Tally:
    """Open3D's answers don't count where rays start on the surface or lie in a face's plane; where the first place is
    only touched (faces are met from both sides there), to miss it is counted apart."""

    def verdict(i: int) -> list[str]:
        origin, way = origins[i], directions[i]
        truth = judge.first_hit(origin, way)
        wrong = []
        if not _is_exact(ours.first, i, truth):
            wrong.append("pierce")
        if bool(ours.occluded[i]) != (truth is not None):
            wrong.append("pierce any")
        where = judge.locate(origin)
        if where.on_surface or judge.lies_in_a_plane(origin, way):
            return wrong + ["set aside"]
        if bool(theirs.odd[i]) != bool(where.crossings % 2):
            wrong.append("count")
        touched = truth is not None and _is_touched(judge, origin, way)
        wrong += _first_hit_faults(theirs.first, i, truth, touched)
        if bool(theirs.occluded[i]) != (truth is not None):
            wrong.append("touch not seen" if touched else "occluded")
        return wrong

    a, b = ours.first, theirs.first
    both = a.hit & b.hit
    with np.errstate(invalid="ignore"):
        elsewhere = both & ~(np.abs(a.t - b.t) <= PLACE * a.t)
    grave = (a.hit != b.hit) | elsewhere | (ours.occluded != theirs.occluded)
    return _judge_some([grave, ours.odd != theirs.odd, both & (a.face != b.face)], most, agreed, verdict)


def _is_exact(first: FirstHits, i: int, truth: FirstHit | None) -> bool:
    """The right answer, the smallest face of those that are hit first, and a t within one unit in the last place."""
    if truth is None or not first.hit[i]:
        return truth is None and not first.hit[i]
    t = np.float32(first.t[i])
    return int(first.face[i]) == truth.faces[0] and abs(Fraction(float(t)) - truth.fraction) <= Fraction(
        float(np.spacing(t)))


def _is_touched(judge: Judge, origin: np.ndarray, way: np.ndarray) -> bool:
    front, back = (judge.first_hit(origin, way, sides=sides) for sides in ("front", "back"))
    return front is not None and back is not None and front.fraction == back.fraction


def _first_hit_faults(first: FirstHits, i: int, truth: FirstHit | None, touched: bool) -> list[str]:
    if truth is None:
        return ["invented"] if first.hit[i] else []
    if first.hit[i] and int(first.face[i]) in truth.faces:
        return []
    if first.hit[i] and abs(float(first.t[i]) - float(truth.fraction)) <= PLACE * float(truth.fraction):
        return ["neighbour"]
    if touched:
        return ["touch missed"]
    return ["elsewhere" if first.hit[i] else "missed"]
