"""Meshes that move, deform and are given new positions."""

from typing import Any

import numpy as np
import pytest

import pierce
from meshes import random_segments, sphere, tetrahedron


def test_refit_and_rebuild_answer_as_a_new_mesh(scalar: Any) -> None:
    vertices, faces = sphere()
    vertices = vertices.astype(scalar)
    starts, ends = (points.astype(scalar) for points in random_segments(5000))
    moved = vertices * np.array([1, 0.5, 1.5], scalar)
    expected = pierce.CollisionMesh(moved, faces).first_hits(starts, ends)
    partly = vertices.copy()
    changed = np.arange(0, len(vertices), 7)
    partly[changed] = moved[changed]
    expected_partly = pierce.CollisionMesh(partly, faces).first_hits(starts, ends)
    for threads in (1, 2):
        mesh = pierce.CollisionMesh(vertices, faces)
        assert mesh.refit_cost() == 1
        mesh.refit(moved, threads=threads)
        assert mesh.refit_cost() != 1
        assert mesh.first_hits(starts, ends).point.tobytes() == expected.point.tobytes()
        mesh.rebuild(vertices, threads=threads)
        mesh.refit(moved, changed)  # of the others what is given is not looked at
        assert mesh.first_hits(starts, ends).point.tobytes() == expected_partly.point.tobytes()
        mesh.rebuild(moved, threads=threads)
        assert mesh.first_hits(starts, ends).point.tobytes() == expected.point.tobytes()


def test_refused_positions_leave_the_mesh() -> None:
    vertices, faces = tetrahedron()
    mesh = pierce.CollisionMesh(vertices, faces)
    with pytest.raises(ValueError):
        mesh.refit(vertices[:3])
    with pytest.raises(pierce.MeshError, match="not finite"):
        mesh.refit(vertices * np.nan)
    with pytest.raises(ValueError):
        mesh.refit(vertices, [4])
    with pytest.raises(TypeError):
        pierce.CollisionMesh(vertices.astype(np.float32), faces).refit(vertices)
    assert mesh.contains([[1, 1, 1]]).all()


def test_no_chain_of_translations_leaks(scalar: Any) -> None:
    """Points inside a closed mesh that is shaken stay inside, whatever they try."""
    vertices, faces = sphere()
    mesh = pierce.CollisionMesh(vertices.astype(scalar), faces)
    rng = np.random.default_rng(3)
    points = rng.uniform(-0.4, 0.4, (500, 3)).astype(scalar)
    at = np.zeros(3, scalar)
    met = 0
    for _ in range(30):
        to = (rng.integers(-8, 9, 3) / 8).astype(scalar)
        targets = points + rng.uniform(-2, 2, points.shape).astype(scalar)
        hits = mesh.sweep(points, targets, pierce.Translation(at, to), sides="both")
        met += hits.hit.sum()
        assert hits.place_verified[hits.hit].all()
        points = np.where(hits.hit[:, None], hits.place, targets)
        at = to
        # The mesh is seen whole from its middle, which is at `at`; the differences to it are exact.
        assert not mesh.sweep(at, points, pierce.Translation(at, at), sides="both").hit.any()
    assert met > 1000
    outside = mesh.sweep(at, points + 3, pierce.Translation(at, at), sides="both")
    assert outside.hit.all()


def test_a_turning_mesh_keeps_points_in(scalar: Any) -> None:
    vertices, faces = sphere()
    mesh = pierce.CollisionMesh(vertices.astype(scalar), faces)
    rng = np.random.default_rng(4)
    points = rng.uniform(-0.4, 0.4, (300, 3)).astype(scalar)
    pose = pierce.Pose()
    for step in range(10):
        motion = pierce.RigidMotion.screw(pose, [0, 0, 0.5], rng.normal(size=3), angle=2.5, tolerance=0.05, slide=0.3)
        targets = points + rng.uniform(-1, 1, points.shape).astype(scalar)
        hits = mesh.sweep(points, targets, motion, sides="both")
        assert hits.hit.any() and not hits.hit.all()
        points = np.where(hits.hit[:, None], hits.place, targets)[hits.place_verified | ~hits.hit]
        local = motion.end_in_mesh(points)
        assert len(points) > 250 and local.dtype == scalar and mesh.contains(local).all(), step
        pose = motion.end


def test_a_rigid_motion_places_points() -> None:
    turn = pierce.RigidMotion(pierce.Pose(), pierce.Pose([[0, -1, 0], [1, 0, 0], [0, 0, 1]], [0, 0, 5]), 0.1)
    assert turn.end_in_world([[1, 2, 3]]).tolist() == [[-2, 1, 8]]
    assert turn.end_in_mesh(np.array([[-2, 1, 8]], np.float32)).tolist() == [[1, 2, 3]]
    assert turn.start_in_mesh([1, 2, 3]).tolist() == [[1, 2, 3]]
    assert np.array(turn.end.translation).tolist() == [0, 0, 5]
    for wrong in [lambda: pierce.RigidMotion(pierce.Pose(), pierce.Pose(2 * np.eye(3)), 0.1),
                  lambda: pierce.RigidMotion(pierce.Pose(), pierce.Pose(), 0.0),
                  lambda: pierce.RigidMotion(pierce.Pose(np.eye(3)[:2]), pierce.Pose(), 0.1),
                  lambda: pierce.RigidMotion.screw(pierce.Pose(), [0, 0, 0], [0, 0, 0], 1.0, 0.1)]:
        with pytest.raises(ValueError):
            wrong()
    with pytest.raises(TypeError, match="motion: a int"):
        pierce.CollisionMesh(*tetrahedron()).sweep([0, 0, 0], [1, 1, 1], 3)  # type: ignore[call-overload]


def test_steps_of_a_deforming_mesh(scalar: Any) -> None:
    vertices, faces = sphere()
    vertices = vertices.astype(scalar)
    mesh = pierce.DeformingMesh(vertices, faces, threads=2)
    first = mesh.step()
    rng = np.random.default_rng(5)
    points = rng.uniform(-0.3, 0.3, (400, 3)).astype(scalar)
    met = 0
    for _ in range(10):
        mesh.begin_step((vertices * rng.uniform(0.9, 1.1, (len(vertices), 1))).astype(scalar), threads=2)
        step = mesh.step()
        targets = points + rng.uniform(-1, 1, points.shape).astype(scalar)
        hits = step.sweep(points, targets, sides="both")
        met += hits.hit.sum()
        points = np.where(hits.hit[:, None], hits.place, targets)[hits.place_verified | ~hits.hit]
        assert step.after.contains(points).all()
    assert met > 500 and len(points) > 300
    assert first.before.dtype == scalar and len(first.before) == len(faces)
    assert first.before.mesh_report().closed
    with pytest.raises(RuntimeError, match="the mesh of a step stays"):
        first.before.refit(vertices)
    with pytest.raises(pierce.MeshError):
        mesh.begin_step(vertices * np.array(np.nan, scalar))
    with pytest.raises(ValueError):
        mesh.begin_step(vertices[:3])


def test_a_step_to_a_pose() -> None:
    mesh = pierce.DeformingMesh(*tetrahedron())
    mesh.begin_pose(pierce.Pose(np.eye(3), [10, 0, 0]))
    step = mesh.step()
    assert step.before.contains([[1, 1, 1], [11, 1, 1]]).tolist() == [True, False]
    assert step.after.contains([[1, 1, 1], [11, 1, 1]]).tolist() == [False, True]
