"""Rays by the names that users of trimesh know: `RayMeshIntersector` in place of that of `trimesh.ray`."""

from __future__ import annotations

from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .adapters import arrays_of
from .answers import Hits
from .mesh import CollisionMesh

Numbers = NDArray[np.int64]
Points = NDArray[np.floating[Any]]


class RayMeshIntersector:
    """Where rays hit a mesh, from both sides, decided exactly.

    `mesh`: a `CollisionMesh`, or what `CollisionMesh.of` takes, such as a mesh of trimesh: of that a mesh in double
    precision is built, so that rays may have either; TypeError for vertices of more digits. `threads`: for all calls, 0
    for one on each core. The mesh is copied: make a new intersector when it has changed.

    What differs from trimesh: no hit is lost or found twice to rounding, triangles without area and triangles in whose
    plane a ray lies are not hit, and a ray that starts on a face hits it only if it leaves it to the back. Answers come
    in order of rays, then of places along them. A triangle is named by its row in the mesh's faces.

    >>> import pierce.ray
    >>> class Wedge:
    ...     vertices = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4.0]]
    ...     faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> rays = pierce.ray.RayMeshIntersector(Wedge)
    >>> rays.intersects_location([[1, 1, 9]], [[0, 0, -1]])[0].tolist()
    [[1.0, 1.0, 2.0], [1.0, 1.0, 0.0]]
    >>> rays.intersects_first([[1, 1, 9], [5, 5, 9]], [[0, 0, -1], [0, 0, -1]]).tolist()
    [3, -1]
    >>> rays.contains_points([[1, 1, 1], [2, 2, 2]]).tolist()
    [True, False]
    """

    def __init__(self, mesh: Any, *, threads: int = 1) -> None:
        if not isinstance(mesh, CollisionMesh):
            arrays = arrays_of(mesh)
            vertices = arrays["vertices"]
            if vertices.dtype.kind == "f" and vertices.dtype.itemsize < 8:  # exact
                vertices = vertices.astype(np.float64)
            mesh = CollisionMesh(vertices, arrays["faces"], threads=threads)
        self.mesh: CollisionMesh = mesh
        self.threads = threads

    def intersects_id(self, ray_origins: ArrayLike, ray_directions: ArrayLike, return_locations: bool = False,
                      multiple_hits: bool = True, max_hits: Optional[int] = None,
                      ) -> Union[tuple[Numbers, Numbers], tuple[Numbers, Numbers, Points]]:
        """Triangles that rays hit: `index_tri` and `index_ray`, shape (h,) each, and `locations`, shape (h, 3), if
        `return_locations`.

        `ray_origins`, `ray_directions`: shape (m, 3); directions of any length. `multiple_hits`: all hits of a ray, or
        the first alone. `max_hits`: the first so many of each ray. With locations each place on a ray comes once, with
        the first of its triangles, and so do places so near to each other that both t and location round to the same
        numbers; without them each triangle that is hit does.
        """
        hits, index_ray = self._hits(ray_origins, ray_directions, multiple_hits, return_locations)
        if max_hits is not None:
            first_of_ray = np.searchsorted(index_ray, index_ray)
            kept = np.arange(len(index_ray)) - first_of_ray < max_hits
            hits, index_ray = hits[kept], index_ray[kept]
        index_tri = hits.triangle.astype(np.int64)
        return (index_tri, index_ray, hits.position) if return_locations else (index_tri, index_ray)

    def intersects_location(self, ray_origins: ArrayLike, ray_directions: ArrayLike, multiple_hits: bool = True,
                            max_hits: Optional[int] = None) -> tuple[Points, Numbers, Numbers]:
        """Places where rays hit the mesh, each once: `locations` (h, 3), `index_ray` and `index_tri` (h,)."""
        index_tri, index_ray, *locations = self.intersects_id(
            ray_origins, ray_directions, return_locations=True, multiple_hits=multiple_hits, max_hits=max_hits)
        return locations[0], index_ray, index_tri

    def intersects_first(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> Numbers:
        """The triangle that each ray hits first, -1 where it hits none: shape (m,)."""
        hits = self.mesh.first_hits_of_rays(ray_origins, ray_directions, sides="both", wanted="triangle",
                                            threads=self.threads)
        return np.where(hits.hit, hits.triangle.astype(np.int64), -1)

    def intersects_any(self, ray_origins: ArrayLike, ray_directions: ArrayLike) -> NDArray[np.bool_]:
        """Whether each ray hits anything: shape (m,)."""
        return self.mesh.any_hits_of_rays(ray_origins, ray_directions, sides="both", threads=self.threads)

    def contains_points(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Whether each point is inside of the mesh, which has to be closed: shape (n,)."""
        return self.mesh.contains(points, threads=self.threads)

    def _hits(self, origins: ArrayLike, directions: ArrayLike, all_of_them: bool, places: bool) -> tuple[Hits, Numbers]:
        """Hits and the rays that they are of; of those in one place the first one, if `places`."""
        wanted = ("triangle", "exact_fraction", "position") if places else ("triangle",)
        if not all_of_them:
            hits = self.mesh.first_hits_of_rays(origins, directions, sides="both", wanted=wanted, threads=self.threads)
            return hits[hits.hit], np.flatnonzero(hits.hit)
        offsets, hits = self.mesh.all_hits_of_rays(origins, directions, sides="both", wanted=wanted,
                                                   threads=self.threads)
        index_ray = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets.astype(np.int64)))
        if not places or not len(index_ray):
            return hits, index_ray
        new = np.ones(len(index_ray), dtype=bool)
        new[1:] = ((np.diff(index_ray) != 0) | (np.diff(hits.exact_fraction) != 0)
                   | (np.diff(hits.position, axis=0) != 0).any(axis=1))
        return hits[new], index_ray[new]
