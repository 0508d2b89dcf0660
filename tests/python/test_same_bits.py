"""Every batch gives the bits of the C++ one, whatever the threads and the memory layout."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pierce
from meshes import random_segments, sphere
from same_bits import dump, expect_same, hit_layout, move_layout, sphere_layout, sweep_layout

COUNT = 20_000


@pytest.fixture
def given(scalar: Any) -> Any:
    """Vertices, faces, starts and ends of one dtype, with some that are not finite."""
    vertices, faces = sphere()
    starts, ends = random_segments(COUNT)
    starts[5], ends[6], starts[7], ends[8] = np.nan, np.inf, ends[7], 1e30
    return vertices.astype(scalar), faces, starts.astype(scalar), ends.astype(scalar)


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize("kind", ["first", "both", "rays"])
def test_first_hits(given: Any, kind: str, threads: int, tmp_path: Path) -> None:
    vertices, faces, starts, ends = given
    mesh = pierce.CollisionMesh(vertices, faces)
    if kind == "rays":
        hits = mesh.first_hits_of_rays(starts, ends, 2, threads=threads)
    else:
        hits = mesh.first_hits(starts, ends, sides="both" if kind == "both" else "front", threads=threads)
    expected = np.frombuffer(dump(tmp_path, kind, *given), hit_layout(vertices.dtype))
    assert 1000 < hits.hit.sum() < COUNT
    assert (hits.hit == (expected["triangle"] != pierce.NO_FACE)).all()
    expect_same(hits.columns(), expected)


@pytest.mark.parametrize("threads", [1, 3])
def test_answers_of_one_number(given: Any, threads: int, tmp_path: Path) -> None:
    vertices, faces, starts, ends = given
    mesh = pierce.CollisionMesh(vertices, faces)
    answers = {
        "any": mesh.any_hits(starts, ends, threads=threads),
        "any_rays": mesh.any_hits_of_rays(starts, ends, 2, threads=threads),
        "contains": mesh.contains(starts, threads=threads),
        "winding": mesh.winding_numbers(starts, threads=threads),
        "crossings": mesh.crossings(starts, ends, threads=threads),
        "crossings_rays": mesh.crossings_of_rays(starts, ends, 2, threads=threads),
    }
    for kind, answer in answers.items():
        assert answer.shape == (COUNT,) and answer.any() and not answer.all(), kind
        assert answer.tobytes() == dump(tmp_path, kind, *given), kind


def test_all_hits(given: Any, tmp_path: Path) -> None:
    vertices, faces, starts, ends = given
    offsets, hits = pierce.CollisionMesh(vertices, faces).all_hits(starts, ends, threads=2)
    answers = dump(tmp_path, "all", *given)
    assert offsets.tobytes() == answers[:8 * (COUNT + 1)]
    assert len(hits) == offsets[-1] > 1000 and hits.hit.all()
    expect_same(hits.columns(), np.frombuffer(answers[8 * (COUNT + 1):], hit_layout(vertices.dtype)))


def test_spheres(given: Any, tmp_path: Path) -> None:
    vertices, faces, starts, ends = given
    hits = pierce.CollisionMesh(vertices, faces).sweep_spheres(starts, ends, 0.125)
    expected = np.frombuffer(dump(tmp_path, "spheres", *given), sphere_layout(vertices.dtype))
    assert len(expected) == hits.hit.sum() > 1000
    expect_same(hits[hits.hit].columns(), expected)


@pytest.mark.parametrize("kind", ["straight", "turning", "deforming"])
def test_sweeps(given: Any, kind: str, tmp_path: Path) -> None:
    vertices, faces, starts, ends = given
    mesh = pierce.CollisionMesh(vertices, faces)
    if kind == "straight":
        hits = mesh.sweep(starts, ends, pierce.Translation([0, 0, 0], [0.25, 0, -0.5]), threads=2)
    elif kind == "turning":
        end = pierce.Pose([[0, -1, 0], [1, 0, 0], [0, 0, 1]], [0.25, 0, 0])
        hits = mesh.sweep(starts, ends, pierce.RigidMotion(pierce.Pose(), end, 0.01), threads=2)
    else:
        deforming = pierce.DeformingMesh(vertices, faces)
        deforming.begin_step(vertices * np.array([1, 1, 0.5], vertices.dtype))
        hits = deforming.step().sweep(starts, ends, threads=2)
    expected = np.frombuffer(dump(tmp_path, kind, *given), sweep_layout(vertices.dtype))
    assert len(expected) == hits.hit.sum() > 1000
    local = ("local", "local_position", "local_normal")
    expect_same(hits[hits.hit].columns(), expected, but=local)
    if kind == "turning":
        assert np.isfinite(hits.columns()["local"][hits.hit]).all()


@pytest.mark.parametrize("kind", ["slide", "bounce"])
def test_moves(given: Any, kind: str, tmp_path: Path) -> None:
    vertices, faces, starts, ends = given
    mesh = pierce.CollisionMesh(vertices, faces)
    if kind == "slide":
        moves = mesh.move_and_slide(starts, ends, 0.5, threads=2)
    else:
        moves = mesh.move_and_bounce(starts, ends, 0.5, restitution=0.5, friction=0.25, threads=2)
    expected = np.frombuffer(dump(tmp_path, kind, *given), move_layout(vertices.dtype))
    assert set(moves.state[[5, 6]]) == {pierce.MoveState.INVALID} and (moves.contacts > 0).sum() > 1000
    expect_same(moves.columns(), expected)
