"""The two libraries, asked the same: arrays in single precision in, arrays out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import open3d as o3d
import pierce

from models import Model

VOTERS = 3
WANTED = ("exact_fraction", "face", "normal", "barycentric")  # what cast_rays returns


class FirstHits(NamedTuple):
    """Of rays: whether they hit, at which t, and which face."""

    hit: np.ndarray
    t: np.ndarray
    face: np.ndarray


class Open3D:
    """RaycastingScene, on one thread unless told otherwise."""

    def __init__(self, model: Model, threads: int = 1) -> None:
        self.threads = threads
        self.scene = o3d.t.geometry.RaycastingScene(nthreads=threads)
        self.scene.add_triangles(o3d.core.Tensor(model.vertices), o3d.core.Tensor(model.faces))

    def occupancy(self, points: np.ndarray) -> np.ndarray:
        return self.scene.compute_occupancy(o3d.core.Tensor(points), nthreads=self.threads).numpy() != 0

    def negative_distance(self, points: np.ndarray) -> np.ndarray:
        return self.scene.compute_signed_distance(o3d.core.Tensor(points), nthreads=self.threads).numpy() < 0

    def vote(self, points: np.ndarray) -> np.ndarray:
        """What most of three rays in random directions say: later versions have that as `nsamples=3`."""
        directions = np.random.default_rng(3).normal(size=(VOTERS, len(points), 3)).astype(np.float32)
        odd = sum((self.count(points, way) % 2).astype(np.int64) for way in directions)
        return odd > VOTERS // 2

    def count(self, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
        return self.scene.count_intersections(_rays(origins, directions), nthreads=self.threads).numpy()

    def first_hits(self, origins: np.ndarray, directions: np.ndarray) -> FirstHits:
        answer = self.scene.cast_rays(_rays(origins, directions), nthreads=self.threads)
        t = answer["t_hit"].numpy()
        return FirstHits(np.isfinite(t), t, answer["primitive_ids"].numpy())

    def occluded(self, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
        return self.scene.test_occlusions(_rays(origins, directions), nthreads=self.threads).numpy()


class Pierce:
    """CollisionMesh, on one thread unless told otherwise."""

    def __init__(self, model: Model, threads: int = 1) -> None:
        self.threads = threads
        self.mesh = pierce.CollisionMesh(model.vertices, model.faces, threads=threads)
        assert self.mesh.dtype == np.float32

    def occupancy(self, points: np.ndarray) -> np.ndarray:
        return self.mesh.contains(points, threads=self.threads)

    def first_hits(self, origins: np.ndarray, directions: np.ndarray) -> FirstHits:
        hits = self.mesh.first_hits_of_rays(origins, directions, sides="both", wanted=WANTED, threads=self.threads)
        return FirstHits(hits.hit, hits.exact_fraction, hits.face)

    def occluded(self, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
        return self.mesh.any_hits_of_rays(origins, directions, sides="both", threads=self.threads)


def _rays(origins: np.ndarray, directions: np.ndarray) -> o3d.core.Tensor:
    return o3d.core.Tensor(np.concatenate([origins, directions], axis=1))


def hits_something() -> bool:
    """Whether Open3D works here: Debian's hits nothing unless ray_mask.c helps it."""
    triangle = Model("", np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32), np.array([[0, 1, 2]], np.uint32))
    hits = Open3D(triangle).first_hits(*(np.array([row], np.float32) for row in ((0.2, 0.2, 1), (0, 0, -1))))
    return bool(hits.hit[0])
