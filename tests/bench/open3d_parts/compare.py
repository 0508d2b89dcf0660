"""Open3D and pierce are asked the same, and an exact judge says who is wrong: tests/bench/open3d runs this."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from statistics import median

import numpy as np
import open3d as o3d

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

from exact_judge import Judge  # noqa: E402
from libraries import Open3D, Pierce, hits_something  # noqa: E402
from models import Model, read_models  # noqa: E402
from questions import Rays, points_aimed, points_anywhere, rays_aimed, rays_anywhere  # noqa: E402
from timing import Times, measure  # noqa: E402
from verdicts import RayAnswers, Tally, judge_points, judge_rays  # noqa: E402

AGREED = 100  # questions of a kind and model on which the libraries agree, judged as well
KINDS = {"anywhere": (points_anywhere, rays_anywhere), "aimed": (points_aimed, rays_aimed)}


def compare_points(model: Model, judge: Judge, points: np.ndarray, most: int) -> Tally:
    peer = Open3D(model)
    theirs = {"occupancy": peer.occupancy(points), "distance": peer.negative_distance(points),
              "vote": peer.vote(points)}
    return judge_points(judge, points, Pierce(model).occupancy(points), theirs, most, AGREED)


def compare_rays(model: Model, judge: Judge, rays: Rays, most: int) -> Tally:
    ours, theirs = Pierce(model), Open3D(model)
    our_answers = RayAnswers(ours.first_hits(*rays), ours.occluded(*rays), ours.occupancy(rays[0]))
    their_answers = RayAnswers(theirs.first_hits(*rays), theirs.occluded(*rays), theirs.count(*rays) % 2 != 0)
    return judge_rays(judge, *rays, our_answers, their_answers, most, AGREED)


def table(heads: list[str], rows: list[list[str]]) -> None:
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


POINTS = {"pierce": "pierce", "Open3D occupancy": "occupancy", "sign of distance": "distance", "vote of 3": "vote",
          "(on the surface)": "on the surface"}
RAYS = {"pierce": "pierce", "pierce any": "pierce any", "Open3D missed": "missed", "elsewhere": "elsewhere",
        "invented": "invented", "occlusion": "occluded", "odd count": "count", "(face beside)": "neighbour",
        "(touch missed)": "touch missed", "(set aside)": "set aside"}


def print_tallies(tallies: dict[str, dict[str, Tally]], columns: dict[str, str], what: str) -> dict[str, Tally]:
    """Returns the sums of each kind."""
    sums = {kind: Tally() for kind in KINDS}
    rows = []
    for kind, total in sums.items():
        for name, of_kinds in {**tallies, "all": {kind: total}}.items():
            tally = of_kinds[kind]
            rows.append([f"{name}, {kind}", f"{tally.asked:,}", f"{tally.differ:,}", f"{tally.judged:,}",
                         *(tally.show(column) for column in columns.values())])
            if tally is not total:
                total.add(tally)
    table(["model", what, "differ", "judged", *columns], rows)
    return sums


def print_times(times: dict[str, dict[str, Times]]) -> dict[str, float]:
    names = list(next(iter(times.values())))
    table(["model", *(f"{name}, Open3D / pierce" for name in names)],
          [[model, *(f"{one.theirs:.0f} / {one.ours:.0f} ({one.ratio:.2f})" for one in row.values())]
           for model, row in times.items()])
    return {name: median(row[name].ratio for row in times.values()) for name in names}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", type=Path, help="folder of libcgal-demo's meshes")
    parser.add_argument("--quick", action="store_true", help="half a minute: four models, few questions")
    parser.add_argument("--times", type=int, default=0, help="only times, on so many threads")
    arguments = parser.parse_args()
    if not hits_something():
        print("Open3D hits nothing here, see ray_mask.c: it can't be compared", file=sys.stderr)
        return 2
    quick = arguments.quick
    count, most, repetitions = (8_000, 200, 5) if quick else (80_000, 2_000, 7)

    models = read_models(arguments.meshes, quick)
    if arguments.times:
        return time_all(models, count, repetitions, arguments.times)
    points: dict[str, dict[str, Tally]] = {}
    rays: dict[str, dict[str, Tally]] = {}
    for model in models:
        print(f"{model.name}: {len(model.faces)} faces", file=sys.stderr)
        judge = Judge(model.vertices, model.faces)
        asked = ask(model, count)
        points[model.name] = {kind: compare_points(model, judge, one[0], most) for kind, one in asked.items()}
        rays[model.name] = {kind: compare_rays(model, judge, one[1], most) for kind, one in asked.items()}
    print(f"Open3D {o3d.__version__}. Numbers of wrong answers; ~: scaled from a random part of the differences. In "
          "brackets: not counted as wrong.\n")
    of_points = print_tallies(points, POINTS, "points")
    of_rays = print_tallies(rays, RAYS, "rays")
    sums = [*of_points.values(), *of_rays.values()]
    print(f"Judged in all: {sum(one.judged for one in sums):,} questions on which the libraries differ, "
          f"{sum(one.agreed_judged for one in sums):,} on which they agree.\n")
    return print_wrong(of_points, of_rays)


def ask(model: Model, count: int) -> dict[str, tuple[np.ndarray, Rays]]:
    """Points and rays of each kind."""
    random = np.random.default_rng(2026)
    return {kind: (make_points(model, count, random), make_rays(model, count, random))
            for kind, (make_points, make_rays) in KINDS.items()}


def time_all(models: list[Model], count: int, repetitions: int, threads: int) -> int:
    clock = "1 thread, time of the process" if threads == 1 else f"{threads} threads, time on the wall"
    for kind in KINDS:
        times = {model.name: measure(model, *ask(model, count)[kind], threads, repetitions) for model in models}
        print(f"Nanoseconds a question (build: a face), {kind}, {clock}; in brackets Open3D's time over pierce's, the "
              "median within repetitions:\n")
        for name, ratio in print_times(times).items():
            if name != "build" or kind == "anywhere":
                print(f"ratio open3d.{name}.{kind}{f'.threads{threads}' if threads > 1 else ''} {ratio:.2f}")
        print()
    return 0


def print_wrong(of_points: dict[str, Tally], of_rays: dict[str, Tally]) -> int:
    """Parts of wrong answers. Returns 1 if there is one of pierce's."""
    for what, tallies, columns in (("points", of_points, ("occupancy", "distance", "vote")),
                                   ("rays", of_rays, ("missed", "elsewhere", "invented", "occluded", "count"))):
        for kind, tally in tallies.items():
            for column in columns:
                print(f"ratio open3d.wrong.{what}.{column}.{kind} {tally.found[column] / tally.asked:.3g}")
    sums = [*of_points.values(), *of_rays.values()]
    ours = sum(one.found[name] for one in sums for name in ("pierce", "pierce any"))
    print(f"ratio pierce.wrong {ours / sum(one.asked for one in sums):.3g}")
    return 1 if ours else 0


if __name__ == "__main__":
    sys.exit(main())
