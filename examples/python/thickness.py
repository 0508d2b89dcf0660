#!/usr/bin/env python3
"""How thick is a part? From each point that two cameras see a ray goes inwards, to where it leaves the part. Draws that
as colours, thin places red.

The second ray counts backs of faces alone, so it does not hit the face that it starts on, on whichever side of that
rounding put its start: nothing is moved off the surface by an epsilon."""

from __future__ import annotations

import sys
import time

import numpy as np
import pierce

import pictures

SIZE = 480  # pixels of a view
AZIMUTHS = (0.6, 2.7)


def camera(vertices: np.ndarray, azimuth: float) -> tuple[np.ndarray, np.ndarray]:
    """Origins of parallel rays, one a pixel, shape (SIZE * SIZE, 3), and their direction."""
    low, high = vertices.min(axis=0).astype(np.float64), vertices.max(axis=0).astype(np.float64)
    middle, radius = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
    forward = -np.array([np.cos(azimuth) * 0.8, np.sin(azimuth) * 0.8, 0.6])
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
    up = np.cross(right, forward)
    places = ((np.arange(SIZE) + 0.5) / SIZE * 2 - 1) * radius * 0.9
    across, down = np.meshgrid(places, -places)
    origins = middle - 2 * radius * forward + across[..., None] * right + down[..., None] * up
    return origins.reshape(-1, 3).astype(np.float32), forward.astype(np.float32)


def main() -> int:
    arguments = pictures.options(__doc__, "thickness.png").parse_args()
    soup = pictures.read(arguments.mesh)
    mesh = pierce.CollisionMesh.of(soup, threads=0)

    begin = time.perf_counter()
    views = []
    for azimuth in AZIMUTHS:
        origins, forward = camera(soup.vertices, azimuth)
        seen = mesh.first_hits_of_rays(origins, forward, wanted=("position", "normal"), threads=0)
        out = mesh.first_hits_of_rays(seen.position[seen.hit], -seen.normal[seen.hit], sides="back",
                                      wanted="exact_fraction", threads=0)
        views.append((seen, out, np.abs(seen.normal[seen.hit] @ forward)))
    seconds = time.perf_counter() - begin
    known = np.concatenate([out.exact_fraction[out.hit] for _, out, _ in views])
    lost = sum(int((~out.hit).sum()) for _, out, _ in views)
    print(f"rays      {len(views) * SIZE**2 + len(known) + lost:,} in {seconds:.2f} s; {lost} found no way out")
    print(f"thickness from {known.min():.4g} to {known.max():.4g}, median {np.median(known):.4g}")

    thick = float(np.percentile(known, 95))
    images = []
    for seen, out, light in views:
        pixels = np.broadcast_to(pictures.BACKGROUND, (SIZE * SIZE, 3)).copy()
        pixels[seen.hit] = pictures.coloured(out.exact_fraction, 0, thick) * (0.4 + 0.6 * light[:, None])
        images.append(pixels.reshape(SIZE, SIZE, 3))
    pictures.write(np.concatenate(images, axis=1), arguments.picture,
                   f"{arguments.mesh.name}: thickness from 0, red, to {thick:.3g}, blue")
    return 0


if __name__ == "__main__":
    sys.exit(main())
