#!/usr/bin/env python3
"""A lidar drives past a few copies of a mesh on a plain and turns meanwhile: 64 beams, 20 turns. Draws the points that
it sees from above, and the last turn as a picture of ranges."""

from __future__ import annotations

import sys
import time

import numpy as np
import pierce

import pictures

BEAMS, TURNS, STEPS = 64, 20, 900  # steps in a turn
FAR = 60.0  # metres
COPIES = [(12, 6, 0.4), (20, -7, 2.0), (31, 5, 3.9), (40, -9, 5.1), (52, 8, 1.2)]  # x, y, turned by
HEIGHT = 5.0


def street(soup: pierce.TriangleSoup) -> tuple[np.ndarray, np.ndarray]:
    """Copies of the mesh that stand on a plain, in metres."""
    own = soup.vertices - (soup.vertices.min(axis=0) + soup.vertices.max(axis=0)) / 2
    own *= HEIGHT / np.ptp(own[:, 1])  # y is up in these files
    own = own[:, [2, 0, 1]]
    own[:, 2] -= own[:, 2].min()
    vertices = [np.array([[-80, -80, 0], [140, -80, 0], [140, 80, 0], [-80, 80, 0]])]
    faces = [np.array([[0, 1, 2], [0, 2, 3]])]
    for x, y, angle in COPIES:
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        faces.append(soup.faces.astype(np.int64) + sum(map(len, vertices)))
        vertices.append(own @ turn.T + [x, y, 0])
    return np.concatenate(vertices).astype(np.float32), np.concatenate(faces)


def sweep() -> tuple[np.ndarray, np.ndarray]:
    """Origins and directions of all beams in the order of time, shape (steps, BEAMS, 3): the sensor moves from step to
    step."""
    steps = np.arange(TURNS * STEPS)
    origins = np.stack([60 * steps / len(steps), 1.5 * np.sin(steps / 2000), np.full(len(steps), 1.8)], axis=-1)
    azimuth = 2 * np.pi * steps / STEPS
    elevation = np.radians(np.linspace(-22, 12, BEAMS))
    directions = np.stack([np.cos(elevation) * np.cos(azimuth)[:, None], np.cos(elevation) * np.sin(azimuth)[:, None],
                           np.broadcast_to(np.sin(elevation), (len(steps), BEAMS))], axis=-1)
    return (np.broadcast_to(origins[:, None], directions.shape).astype(np.float32), directions.astype(np.float32))


def from_above(points: np.ndarray, pixels_of_a_metre: int = 14) -> np.ndarray:
    """A dot for each point, coloured by height."""
    left, right, low, high = -5, 65, -16, 16
    width, height = (right - left) * pixels_of_a_metre, (high - low) * pixels_of_a_metre
    column = ((points[:, 0] - left) * pixels_of_a_metre).astype(int)
    row = ((high - points[:, 1]) * pixels_of_a_metre).astype(int)
    seen = (column >= 0) & (column < width) & (row >= 0) & (row < height)
    order = np.argsort(points[seen, 2])  # what is higher is drawn over it
    pixels = np.broadcast_to(pictures.BACKGROUND, (height, width, 3)).copy()
    shades = pictures.coloured(HEIGHT - points[seen, 2], 0, HEIGHT)
    shades[points[seen, 2] < 0.05] = 205
    pixels[row[seen][order], column[seen][order]] = shades[order]
    return pixels


def main() -> int:
    arguments = pictures.options(__doc__, "lidar_sweep.png").parse_args()
    mesh = pierce.CollisionMesh(*street(pictures.read(arguments.mesh)), threads=0)
    origins, directions = sweep()
    begin = time.perf_counter()
    hits = mesh.first_hits_of_rays(origins.reshape(-1, 3), directions.reshape(-1, 3), limit=FAR,
                                   wanted=("position", "exact_fraction"), threads=0)
    seconds = time.perf_counter() - begin
    print(f"beams     {len(hits):,} on {len(mesh):,} triangles in {seconds:.2f} s; {hits.hit.sum():,} come back")

    ranges = np.where(hits.hit, hits.exact_fraction, np.nan).reshape(-1, BEAMS)[-STEPS:].T[::-1]
    panorama = pictures.coloured(np.nan_to_num(ranges), 2, 40)
    panorama[np.isnan(ranges)] = pictures.BACKGROUND
    panorama = np.repeat(panorama, 3, axis=0)
    above = from_above(hits.position[hits.hit])
    wide = np.broadcast_to(pictures.BACKGROUND, (len(panorama), above.shape[1], 3)).copy()
    wide[:, :STEPS] = panorama
    pictures.write(np.concatenate([above, wide]), arguments.picture,
                   "above: all points, by height, red high; below: ranges of the last turn, red near, blue 40 m")
    return 0


if __name__ == "__main__":
    sys.exit(main())
