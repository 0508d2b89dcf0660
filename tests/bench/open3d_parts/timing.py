"""What the answers cost: both libraries in turn, on the same arrays, which each has in its own form beforehand."""

from __future__ import annotations

import os
import time
from statistics import median
from typing import Callable, NamedTuple

import numpy as np
import open3d as o3d

from libraries import WANTED, Open3D, Pierce
from models import Model
from questions import Rays


class Times(NamedTuple):
    """Nanoseconds a question, and the median of the ratios within a repetition: above 1 pierce is faster."""

    theirs: float
    ours: float
    ratio: float


def measure(model: Model, points: np.ndarray, rays: Rays, threads: int, repetitions: int) -> dict[str, Times]:
    """On one thread time is that of the process, so that other programs don't count; on more it is on the wall.

    Open3D casts with `nthreads` threads, but fills arrays with OpenMP's: OMP_NUM_THREADS has to be the same, or these
    wait for one another in loops, at ten times the cost for a few thousand points."""
    assert os.environ.get("OMP_NUM_THREADS") == str(threads)
    clock = time.process_time if threads == 1 else time.perf_counter
    origins, directions = rays
    scene, mesh = Open3D(model, threads).scene, Pierce(model, threads).mesh
    their_points = o3d.core.Tensor(points)
    their_rays = o3d.core.Tensor(np.concatenate([origins, directions], axis=1))
    pairs: dict[str, tuple[Callable[[], object], Callable[[], object], int]] = {
        "occupancy": (lambda: scene.compute_occupancy(their_points, nthreads=threads),
                      lambda: mesh.contains(points, threads=threads), len(points)),
        "cast_rays": (lambda: scene.cast_rays(their_rays, nthreads=threads),
                      lambda: mesh.first_hits_of_rays(origins, directions, sides="both", wanted=WANTED,
                                                      threads=threads), len(origins)),
        "occlusions": (lambda: scene.test_occlusions(their_rays, nthreads=threads),
                       lambda: mesh.any_hits_of_rays(origins, directions, sides="both", threads=threads),
                       len(origins)),
        "build": (lambda: Open3D(model, threads).scene.cast_rays(their_rays[:1], nthreads=threads),
                  lambda: Pierce(model, threads).mesh.any_hits_of_rays(origins[:1], directions[:1], sides="both"),
                  len(model.faces)),
    }
    taken: dict[str, list[tuple[float, float]]] = {name: [] for name in pairs}
    for repetition in range(repetitions + 1):  # the first one warms up
        for name, (theirs, ours, count) in pairs.items():
            order = (theirs, ours) if repetition % 2 else (ours, theirs)
            seconds = {}
            for call in order:
                begin = clock()
                call()
                seconds[call] = clock() - begin
            if repetition:
                taken[name].append((seconds[theirs] / count * 1e9, seconds[ours] / count * 1e9))
    return {name: Times(median(a for a, _ in rows), median(b for _, b in rows), median(a / b for a, b in rows))
            for name, rows in taken.items()}
