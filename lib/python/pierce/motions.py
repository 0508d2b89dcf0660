"""How a mesh that keeps its shape moves during a step."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _pierce


def _identity() -> NDArray[np.float64]:
    return np.eye(3)


def _zero() -> NDArray[np.float64]:
    return np.zeros(3)


@dataclass(frozen=True)
class Pose:
    """Where a mesh stands: a point x of it is at `rotation @ x + translation` in the world."""

    rotation: ArrayLike = field(default_factory=_identity)
    """Shape (3, 3). A `RigidMotion` takes the nearest true rotation for it."""
    translation: ArrayLike = field(default_factory=_zero)
    """Shape (3,), in units of the world."""


@dataclass(frozen=True)
class Translation:
    """The mesh stands at `start` at the start of the step and at `end` at its end, and goes straight in between.

    Shape (3,). With a float32 mesh both have to be float32 numbers, exactly: else a sweep raises TypeError.
    """

    start: ArrayLike
    end: ArrayLike


class RigidMotion:
    """A mesh that turns during a step: from one pose to another at constant angular velocity, the shorter way round,
    while one of its points, the pivot, goes straight at constant velocity.

    A sweep cuts the curve that a point takes, seen from the mesh, into chords that are no further than `tolerance` from
    it, a length in the world; what these hit is decided exactly. Where each step begins with the pose that the one
    before ended with, and each point where it was put, no chain of steps gets through a closed mesh, whatever the
    tolerance.

    `pivot`: shape (3,), in the mesh's coordinates. ValueError where a pose is none, or the tolerance not more than 0.

    >>> import numpy as np, pierce
    >>> quarter = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    >>> turn = pierce.RigidMotion(pierce.Pose(), pierce.Pose(quarter), tolerance=1e-3)
    >>> turn.end_in_world([[1, 0, 0]]).tolist()
    [[0.0, 1.0, 0.0]]
    """

    _core: _pierce.RigidMotion

    def __init__(self, start: Pose, end: Pose, tolerance: float, pivot: Optional[ArrayLike] = None) -> None:
        self._core = _pierce.RigidMotion(start.rotation, start.translation, end.rotation, end.translation, tolerance,
                                         _zero() if pivot is None else pivot)

    @classmethod
    def screw(cls, start: Pose, point: ArrayLike, direction: ArrayLike, angle: float, tolerance: float,
              slide: float = 0) -> RigidMotion:
        """A turn about an axis and a slide along it, as of a wheel or a door, in the world.

        `point`, `direction`: shape (3,), of the axis; `angle` in radians, counter-clockwise seen from where `direction`
        points, less than half a turn.

        >>> import pierce
        >>> door = pierce.RigidMotion.screw(pierce.Pose(), [0, 0, 0], [0, 0, 1], angle=0.5, tolerance=1e-3)
        >>> door.end.translation.tolist()
        [0.0, 0.0, 0.0]
        """
        motion = cls.__new__(cls)
        motion._core = _pierce.RigidMotion.screw(start.rotation, start.translation, point, direction, angle, slide,
                                                 tolerance)
        return motion

    @property
    def end(self) -> Pose:
        """The last pose, as it was given or made: the next step's first one."""
        rotation, translation = self._core.end
        return Pose(rotation, translation)

    def start_in_mesh(self, points: ArrayLike) -> NDArray[Any]:
        """Where the mesh has points of the world at the start of the step: shape (n, 3), of the dtype given."""
        return self._core.start_in_mesh(points)

    def end_in_mesh(self, points: ArrayLike) -> NDArray[Any]:
        """The same at the end of the step."""
        return self._core.end_in_mesh(points)

    def end_in_world(self, points: ArrayLike) -> NDArray[Any]:
        """Where points of the mesh are in the world at the end of the step, rounded."""
        return self._core.end_in_world(points)
