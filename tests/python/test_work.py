"""Long calls: threads, progress, other threads of Python meanwhile, and Ctrl-C."""

import signal
import sys
import threading
import time
from typing import Any, Callable

import numpy as np
import pytest

import pierce
from meshes import random_segments, sphere

MANY = 1 << 24


@pytest.fixture(scope="module")
def mesh() -> pierce.CollisionMesh:
    return pierce.CollisionMesh(*sphere(40))


def many_points(count: int = MANY) -> Any:
    """So many that a call takes seconds, in the memory of a few."""
    few = random_segments(4096)[0]
    return np.broadcast_to(few[:1], (count, 3))


def every_batch(mesh: pierce.CollisionMesh) -> dict[str, Callable[..., Any]]:
    """All calls that take `threads` and `progress`."""
    starts, ends = random_segments(140_000)
    few = slice(0, 3000)
    deforming = pierce.DeformingMesh(*sphere(10))
    turn = pierce.RigidMotion(pierce.Pose(), pierce.Pose([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), 0.1)
    return {
        "first_hits": lambda **how: mesh.first_hits(starts, ends, **how).face,
        "first_hits_of_rays": lambda **how: mesh.first_hits_of_rays(starts, ends, **how).face,
        "any_hits": lambda **how: mesh.any_hits(starts, ends, **how),
        "any_hits_of_rays": lambda **how: mesh.any_hits_of_rays(starts, ends, **how),
        "all_hits": lambda **how: mesh.all_hits(starts, ends, **how)[1].face,
        "all_hits_of_rays": lambda **how: mesh.all_hits_of_rays(starts, ends, **how)[1].face,
        "contains": lambda **how: mesh.contains(starts, **how),
        "winding_numbers": lambda **how: mesh.winding_numbers(starts, **how),
        "locate": lambda **how: mesh.locate(starts, **how).place,
        "crossings": lambda **how: mesh.crossings(starts, ends, **how),
        "crossings_of_rays": lambda **how: mesh.crossings_of_rays(starts, ends, **how),
        "sweep_spheres": lambda **how: mesh.sweep_spheres(starts[few], ends[few], 0.1, **how).center,
        "sweep": lambda **how: mesh.sweep(starts[few], ends[few], pierce.Translation([0, 0, 0], [1, 0, 0]), **how).face,
        "sweep turning": lambda **how: mesh.sweep(starts[few], ends[few], turn, **how).face,
        "step.sweep": lambda **how: deforming.step().sweep(starts[few], ends[few], **how).face,
        "move_and_slide": lambda **how: mesh.move_and_slide(starts[few], ends[few], 1.0, **how).position,
        "move_and_bounce": lambda **how: mesh.move_and_bounce(starts[few], ends[few], 1.0, **how).position,
    }


def test_threads_and_progress_change_nothing(mesh: pierce.CollisionMesh) -> None:
    for name, batch in every_batch(mesh).items():
        expected = batch()
        for threads in (0, 3):
            assert batch(threads=threads).tobytes() == expected.tobytes(), name
        seen: list[tuple[int, int]] = []
        assert batch(progress=lambda done, total: seen.append((done, total))).tobytes() == expected.tobytes(), name
        done = [one for one, _ in seen]
        assert len(done) > 1 and done == sorted(set(done)) and seen[-1][0] == seen[-1][1] > 0, name
        assert {total for _, total in seen} == {done[-1]}, name


def test_progress_may_raise(mesh: pierce.CollisionMesh) -> None:
    class Stop(Exception):
        pass

    def stop(done: int, total: int) -> None:
        raise Stop

    for name, batch in every_batch(mesh).items():
        with pytest.raises(Stop):
            batch(progress=stop)
        assert len(batch()) > 0, name
    with pytest.raises(TypeError):
        mesh.contains(many_points(10), progress=3)  # type: ignore[arg-type]


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_ends_a_call(mesh: pierce.CollisionMesh, threads: int) -> None:
    seen = [0]

    def progress(done: int, total: int) -> None:
        seen.append(done)

    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.05)
        with pytest.raises(KeyboardInterrupt):
            mesh.first_hits(many_points(), [0, 0, 0], wanted=(), threads=threads, progress=progress)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert seen[-1] < MANY


def test_slow_queries_are_cut_into_short_calls() -> None:
    """Of a mesh in which each query looks at some thousand triangles; the first call is no longer than the others."""
    rng = np.random.default_rng(3)
    mesh = pierce.CollisionMesh(rng.normal(size=(3000, 3)), rng.integers(0, 3000, (4000, 3)))
    points = rng.normal(size=(20_000, 3))
    done: list[int] = []

    class Enough(Exception):
        pass

    def progress(number: int, total: int) -> None:
        done.append(number)
        raise Enough

    for ask in (mesh.contains, mesh.locate):
        with pytest.raises(Enough):
            ask(points, progress=progress)
    assert max(done) < 10_000


def test_other_threads_run_meanwhile(mesh: pierce.CollisionMesh) -> None:
    counted, done = [0], threading.Event()

    def count() -> None:
        while not done.is_set():
            counted[0] += 1
            time.sleep(0)

    interval = sys.getswitchinterval()
    other = threading.Thread(target=count)
    try:
        sys.setswitchinterval(1000)  # nobody loses the lock but who gives it away
        other.start()
        points = many_points(1 << 17)  # one call without the lock
        before = counted[0]
        sum(range(100_000))
        assert counted[0] == before
        mesh.first_hits(points, [0, 0, 0], wanted=())
        assert counted[0] > before
    finally:
        sys.setswitchinterval(interval)
        done.set()
        other.join()


def test_two_threads_ask_one_mesh(mesh: pierce.CollisionMesh) -> None:
    starts, ends = random_segments(50_000)
    expected = mesh.first_hits(starts, ends).face
    answers: list[Any] = [None] * 4

    def ask(i: int) -> None:
        answers[i] = mesh.first_hits(starts, ends).face

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all((answer == expected).all() for answer in answers)


def test_a_mesh_that_is_asked_is_not_changed() -> None:
    vertices, faces = sphere(10)
    mesh = pierce.CollisionMesh(vertices, faces)
    refused = []

    def change(done: int, total: int) -> None:
        for call in (mesh.refit, mesh.rebuild):
            with pytest.raises(RuntimeError, match="can't be changed while"):
                call(2 * vertices)
            refused.append(call)

    mesh.contains(vertices, progress=change)
    assert len(refused) == 2
    mesh.refit(2 * vertices)
    assert mesh.contains(1.5 * vertices).all()


def test_queries_that_are_not_finite_are_counted(scalar: Any) -> None:
    vertices, faces = sphere(10)
    mesh = pierce.CollisionMesh(vertices.astype(scalar), faces)
    starts, ends = (points.astype(scalar) for points in random_segments(1000))
    starts[::10, 1] = np.nan
    ends[1::10, 2] = -np.inf
    hits = mesh.first_hits(starts, ends)
    assert not hits.hit[::10].any() and not hits.hit[1::10].any() and hits.hit.any()
    assert mesh.statistics()["invalid_queries"] == 200
    mesh.contains(starts)
    assert mesh.statistics()["invalid_queries"] == 300
