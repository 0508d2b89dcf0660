#!/usr/bin/env python3
"""Which cells of a grid are inside of a closed mesh? Draws layers of the grid, and where Open3D says otherwise if it is
installed: its inside test counts hits of a ray along (1, 1, 1), twice or not at all where it passes through an edge."""

from __future__ import annotations

import sys
from typing import Optional

import numpy as np
import pierce

import pictures

INSIDE, WRONG, SURFACE = (150, 165, 185), (220, 30, 30), (60, 60, 60)
LAYERS = 6


def grid(vertices: np.ndarray, cells: int) -> np.ndarray:
    """Corners of cubes over the mesh's box and a little around it, shape (nx, ny, nz, 3), `cells` along the longest
    side."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    step = (high - low).max() / cells
    axes = [low[k] + step * np.arange(-2, np.ceil((high[k] - low[k]) / step) + 3) for k in range(3)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).astype(np.float32)


def of_open3d(soup: pierce.TriangleSoup, points: np.ndarray) -> Optional[np.ndarray]:
    """None where there is no Open3D, or one that hits nothing."""
    try:
        import open3d as o3d
    except ImportError:
        return None
    scene = o3d.t.geometry.RaycastingScene()
    scene.add_triangles(o3d.core.Tensor(soup.vertices), o3d.core.Tensor(soup.faces))
    answer = scene.compute_occupancy(o3d.core.Tensor(points)).numpy() != 0
    if not answer.any():
        print("Open3D says that nothing is inside: Debian's does (tests/bench/open3d_parts/ray_mask.c); it is left out")
        return None
    return answer


def main() -> int:
    parser = pictures.options(__doc__, "occupancy.png")
    parser.add_argument("--cells", type=int, default=96, help="along the longest side")
    arguments = parser.parse_args()

    soup = pictures.read(arguments.mesh)
    mesh = pierce.CollisionMesh.of(soup, threads=0)
    points = grid(soup.vertices, arguments.cells)
    flat = points.reshape(-1, 3)
    inside = mesh.contains(flat, threads=0).reshape(points.shape[:3])
    on_surface = (mesh.locate(flat, threads=0).place == pierce.Place.ON_SURFACE).reshape(inside.shape)
    print(f"inside    {inside.sum():,} of {inside.size:,} points; {on_surface.sum():,} lie exactly on the surface")

    colours = np.broadcast_to(pictures.BACKGROUND, inside.shape + (3,)).copy()
    colours[inside] = INSIDE
    colours[on_surface] = SURFACE
    theirs = of_open3d(soup, points)
    caption = f"{arguments.mesh.name}: grey inside, dark exactly on the surface"
    if theirs is not None:
        wrong = (theirs != inside) & ~on_surface
        colours[wrong] = WRONG
        print(f"Open3D    {wrong.sum():,} wrong, {(theirs & wrong).sum():,} of them outside")
        caption += f"; red: Open3D is wrong, at {wrong.sum():,} of {wrong.size:,} points"
    # Layers along the shortest side, in two rows.
    axis = int(np.argmin(inside.shape))
    chosen = np.linspace(0, inside.shape[axis] - 1, LAYERS + 2)[1:-1].round().astype(int)
    layers = [np.flipud(np.swapaxes(np.take(colours, k, axis=axis), 0, 1)) for k in chosen]
    rows = [np.concatenate(layers[k:k + LAYERS // 2], axis=1) for k in (0, LAYERS // 2)]
    pictures.write(np.concatenate(rows), arguments.picture, caption, enlarge=3)
    return 0


if __name__ == "__main__":
    sys.exit(main())
