"""Particles that slide along what they meet, bounce off it or rest: of a mesh, or of a step of one that moves."""

from __future__ import annotations

from typing import Any, Callable, Optional, Union

from numpy.typing import ArrayLike

from . import _pierce
from .answers import MoveContacts, Moves
from .enums import Sides

Progress = Optional[Callable[[int, int], Any]]


class Moving:
    """Whole steps of many particles. The options of both calls:

    - `radius`: 0 for points; more for balls, one number or shape (n,). In a step of a mesh that moves it must be 0;
    - `surface_velocity`: shape (3,), of a conveyor, or of a wall that moves;
    - `sides`, `mask`: which faces stop a particle, as in `first_hits`;
    - `max_casts`: how many queries a move may take;
    - `contacts`: room for so many contacts a particle, which are then in `met`;
    - `threads`, `progress`: as in `CollisionMesh`.

    Numbers (`seconds`, `radius` and the like) are rounded to the mesh's dtype; a `surface_velocity` that is none of its
    numbers is a TypeError.
    """

    _core: Union[_pierce.Mesh, _pierce.Step]

    def move_and_slide(self, positions: ArrayLike, velocities: ArrayLike, seconds: float, *, radius: ArrayLike = 0,
                       surface_velocity: ArrayLike = (0, 0, 0), sides: Union[str, Sides] = "front",
                       mask: Optional[ArrayLike] = None, max_casts: int = 32, contacts: int = 0, threads: int = 1,
                       progress: Progress = None) -> Moves:
        """Moves particles by one step of `seconds`, sliding without friction along what they meet.

        `positions`, `velocities`: shape (n, 3); velocities have gravity and the like already in them. The way to the
        new position has no hit, so no chain of moves gets through the mesh. What rests is not moved by one bit.

        ValueError where lengths differ, TypeError for dtypes with more digits than the mesh's. Most moves take one to
        four queries.

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> moves = floor.move_and_slide([[1, 1, 0.5]], [[0.5, 0, -1]], 1.0)
        >>> moves.velocity.tolist(), pierce.MoveState(moves.state[0]).name
        ([[0.5, 0.0, 0.0]], 'SLID')
        """
        columns, met = self._core.moved(False, positions, velocities, seconds, radius, 0.0, 0.0, surface_velocity, 0.0,
                                        sides, mask, max_casts, contacts, threads, progress)
        return Moves(columns, MoveContacts(met))

    def move_and_bounce(self, positions: ArrayLike, velocities: ArrayLike, seconds: float, *,
                        restitution: ArrayLike = 0, friction: ArrayLike = 0, rest_speed: float = 0,
                        radius: ArrayLike = 0, surface_velocity: ArrayLike = (0, 0, 0),
                        sides: Union[str, Sides] = "front", mask: Optional[ArrayLike] = None, max_casts: int = 32,
                        contacts: int = 0, threads: int = 1, progress: Progress = None) -> Moves:
        """The same with impacts and friction: impacts above `rest_speed` bounce, others slide.

        `restitution` (the part of the approach that comes back, 0 to 1) and `friction` (Coulomb's, 0 and up): one
        number for all faces, or shape (number of faces,) by the face's number (ValueError for another length, as of
        `mask`).

        >>> import pierce
        >>> floor = pierce.CollisionMesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
        >>> moves = floor.move_and_bounce([[1, 1, 0.5]], [[0, 0, -1]], 1.0, restitution=0.5, contacts=1)
        >>> moves.velocity.tolist(), moves.met.face.tolist()
        ([[0.0, 0.0, 0.5]], [0])
        """
        columns, met = self._core.moved(True, positions, velocities, seconds, radius, restitution, friction,
                                        surface_velocity, rest_speed, sides, mask, max_casts, contacts, threads,
                                        progress)
        return Moves(columns, MoveContacts(met))
