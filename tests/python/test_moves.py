"""Particles and balls that are moved in steps."""

from typing import Any

import numpy as np
import pytest

import pierce
from meshes import sphere

GRAVITY = np.array([0, 0, -9.81])


@pytest.fixture
def room(scalar: Any) -> pierce.CollisionMesh:
    vertices, faces = sphere()
    return pierce.CollisionMesh(vertices.astype(scalar), faces[:, ::-1].copy())  # its fronts look inwards


@pytest.mark.parametrize("bounce", [False, True])
def test_particles_stay_in_and_come_to_rest(room: pierce.CollisionMesh, bounce: bool) -> None:
    rng = np.random.default_rng(6)
    points = rng.uniform(-0.4, 0.4, (300, 3)).astype(room.dtype)
    velocities = rng.uniform(-5, 5, points.shape).astype(room.dtype)
    seconds = 1 / 60
    for _ in range(200):
        falling = (velocities + GRAVITY * seconds).astype(room.dtype)
        if bounce:
            moves = room.move_and_bounce(points, falling, seconds, restitution=0.3, friction=0.8, rest_speed=0.5)
        else:
            moves = room.move_and_slide(points, falling, seconds)
        points, velocities = moves.position, moves.velocity
        assert room.contains(points).all()
    resting = moves.state == pierce.MoveState.RESTING
    assert not moves.velocity[resting].any()
    assert bounce is False or resting.mean() > 0.5


def test_contacts_have_their_room(room: pierce.CollisionMesh) -> None:
    points = np.zeros((50, 3), room.dtype)
    velocities = np.random.default_rng(7).uniform(-9, 9, (50, 3)).astype(room.dtype)
    moves = room.move_and_slide(points, velocities, 1.0, contacts=3)
    assert len(moves.met) == 150 and (moves.contacts > 0).all()
    rows = moves.met.face.reshape(50, 3)
    assert ((rows != pierce.NO_FACE).sum(axis=1) == np.minimum(moves.contacts, 3)).all()
    first = moves.met[::3]
    assert np.abs(np.linalg.norm(first.normal, axis=1) - 1).max() < 1e-5
    assert (first.face == room.first_hits(points, velocities).face).all()
    assert len(room.move_and_slide(points, velocities, 1.0).met) == 0


def test_response_by_face(scalar: Any) -> None:
    vertices = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0]], scalar)
    floor = pierce.CollisionMesh(vertices, [[0, 1, 2], [1, 3, 2]])
    points = np.array([[1, 1, 0.5], [3, 3, 0.5]], scalar)
    down = np.array([0.5, 0, -1], scalar)
    moves = floor.move_and_bounce(points, down, 1.0, restitution=np.array([0.5, 0], scalar))
    assert moves.velocity.tolist() == [[0.5, 0, 0.5], [0.5, 0, 0]]
    moves = floor.move_and_bounce(points, down, 1.0, friction=np.array([0.25, 0], scalar))
    assert moves.velocity.tolist() == [[0.25, 0, 0], [0.5, 0, 0]]
    for wrong in ([0.5], [0.5] * 3, []):
        with pytest.raises(ValueError, match=f"restitution: {len(wrong)} entries, where 2 are needed"):
            floor.move_and_bounce(points, down, 1.0, restitution=np.array(wrong, scalar))
    moves = floor.move_and_bounce(points, down, 1.0, restitution=np.array(0.5, scalar))  # one number
    assert moves.velocity[:, 2].tolist() == [0.5, 0.5]
    assert floor.move_and_slide(points, down, 1.0, mask=[True, False]).contacts.tolist() == [1, 0]


def test_balls(room: pierce.CollisionMesh) -> None:
    rng = np.random.default_rng(8)
    points = rng.uniform(-0.2, 0.2, (50, 3)).astype(room.dtype)
    radii = rng.uniform(0.05, 0.2, 50).astype(room.dtype)
    for _ in range(20):
        velocities = rng.uniform(-3, 3, points.shape).astype(room.dtype)
        moves = room.move_and_slide(points, velocities, 0.5, radius=radii)
        points = moves.position
        for point, radius in zip(points[:5], radii):
            assert (room.sphere_contacts(point, float(radius)).overlap <= 0).all()
    assert (moves.contacts > 0).any()
    assert room.move_and_slide(points, velocities, 0.5, radius=-1).state.tolist() == [pierce.MoveState.INVALID] * 50


def test_moves_with_a_mesh_that_moves(scalar: Any) -> None:
    vertices, faces = sphere()
    vertices = vertices.astype(scalar)
    mesh = pierce.DeformingMesh(vertices, faces[:, ::-1].copy())
    rng = np.random.default_rng(9)
    points = rng.uniform(-0.3, 0.3, (200, 3)).astype(scalar)
    velocities = np.zeros_like(points)
    for i in range(20):
        mesh.begin_step(vertices + np.array([i % 3 / 8, 0, 0], scalar))
        step = mesh.step()
        falling = (velocities + GRAVITY / 60).astype(scalar)
        moves = step.move_and_bounce(points, falling, 1 / 60, restitution=0.2, contacts=1)
        assert not step.sweep(points, moves.position).hit[moves.state != pierce.MoveState.CRUSHED].any()
        points, velocities = moves.position, moves.velocity
        assert step.after.contains(points).all()
    assert (moves.met.face != pierce.NO_FACE).any()
