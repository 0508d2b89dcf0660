"""Open3D and pierce are asked the same, and an exact judge says who is wrong: tests/bench/open3d runs this."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from statistics import median

import numpy as np
import open3d as o3d

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "support"))

from exact_judge import Judge  # noqa: E402
from libraries import Open3D, Pierce, hits_something  # noqa: E402
from models import Model, read_models  # noqa: E402
from questions import make_points, make_rays  # noqa: E402
from timing import Times, measure  # noqa: E402
from verdicts import RayAnswers, Tally, judge_points, judge_rays  # noqa: E402

AGREED = 250  # questions a model on which the libraries agree, judged as well


def compare_points(model: Model, judge: Judge, count: int, most: int, random: np.random.Generator) -> Tally:
    points = make_points(model, count, random)
    peer = Open3D(model)
    theirs = {"occupancy": peer.occupancy(points), "distance": peer.negative_distance(points),
              "vote": peer.vote(points)}
    return judge_points(judge, points, Pierce(model).occupancy(points), theirs, most, AGREED, random)


def compare_rays(model: Model, judge: Judge, count: int, most: int, random: np.random.Generator) -> Tally:
    origins, directions = make_rays(model, count, random)
    ours, theirs = Pierce(model), Open3D(model)
    our_answers = RayAnswers(ours.first_hits(origins, directions), ours.occluded(origins, directions),
                             ours.occupancy(origins))
    their_answers = RayAnswers(theirs.first_hits(origins, directions), theirs.occluded(origins, directions),
                               theirs.count(origins, directions) % 2 != 0)
    return judge_rays(judge, origins, directions, our_answers, their_answers, most, AGREED, random)


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


def print_tallies(tallies: dict[str, Tally], columns: dict[str, str], what: str) -> Tally:
    total = Tally()
    for tally in tallies.values():
        total.add(tally)
    rows = [[name, f"{tally.asked:,}", f"{tally.differ:,}", f"{tally.judged:,}"]
            + [tally.show(column) for column in columns.values()]
            for name, tally in {**tallies, "all": total}.items()]
    table(["model", what, "differ", "judged", *columns], rows)
    return total


def print_times(times: dict[str, dict[str, Times]], threads: int) -> dict[str, float]:
    names = list(next(iter(times.values())))
    table(["model", *(f"{name}, Open3D / pierce" for name in names)],
          [[model, *(f"{one.theirs:.0f} / {one.ours:.0f} ({one.ratio:.2f})" for one in row.values())]
           for model, row in times.items()])
    return {name: median(row[name].ratio for row in times.values()) for name in names}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("meshes", type=Path, help="folder of libcgal-demo's meshes")
    parser.add_argument("--shared", type=Path, default=Path(), help="folder that may have dragon.ply")
    parser.add_argument("--quick", action="store_true", help="half a minute: three models, few questions")
    parser.add_argument("--threads", type=int, default=2, help="of the second table of times")
    arguments = parser.parse_args()
    if not hits_something():
        print("Open3D hits nothing here, see ray_mask.c: it can't be compared", file=sys.stderr)
        return 2
    quick = arguments.quick
    count, most, repetitions = (4_000, 60, 3) if quick else (160_000, 2_500, 7)

    points, rays = {}, {}
    times: dict[int, dict[str, dict[str, Times]]] = {1: {}} if quick else {1: {}, arguments.threads: {}}
    for model in read_models(arguments.meshes, arguments.shared, quick):
        print(f"{model.name}: {len(model.faces)} faces", file=sys.stderr)
        random = np.random.default_rng(2026)
        judge = Judge(model.vertices, model.faces)
        points[model.name] = compare_points(model, judge, count, most, random)
        rays[model.name] = compare_rays(model, judge, count, most, random)
        asked = make_points(model, count, random), *make_rays(model, count, random)
        for threads, rows in times.items():
            rows[model.name] = measure(model, *asked, threads=threads, repetitions=repetitions)

    print(f"Open3D {o3d.__version__}. Numbers of wrong answers; ~: scaled from a random part of the differences. In "
          "brackets: not counted as wrong.\n")
    of_points = print_tallies(points, POINTS, "points")
    of_rays = print_tallies(rays, RAYS, "rays")
    print(f"Agreements judged: {of_points.agreed_judged} points, {of_rays.agreed_judged} rays.\n")
    ratios = {}
    for threads, rows in times.items():
        print(f"Nanoseconds a question (build: a face), {threads} thread{'s' * (threads > 1)}; in brackets Open3D's time "
              "over pierce's, the median within repetitions:\n")
        ending = "" if threads == 1 else f".{threads}threads"
        ratios.update({name + ending: ratio for name, ratio in print_times(rows, threads).items()})
    for name, ratio in ratios.items():
        print(f"ratio open3d.{name} {ratio:.2f}")
    for name, tally, columns in (("points", of_points, ("occupancy", "distance", "vote")),
                                 ("rays", of_rays, ("missed", "elsewhere", "invented", "occluded", "count"))):
        for column in columns:
            print(f"ratio open3d.wrong.{name}.{column} {tally.found[column] / tally.asked:.3g}")
    ours = sum(tally.found[name] for tally in (of_points, of_rays) for name in ("pierce", "pierce any"))
    print(f"ratio pierce.wrong {ours / (of_points.asked + of_rays.asked):.3g}")
    return 1 if ours else 0


if __name__ == "__main__":
    sys.exit(main())
