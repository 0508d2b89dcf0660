"""What the examples share: options, meshes, colours and PNG files."""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import pierce
from PIL import Image, ImageDraw

BACKGROUND = np.array([255, 255, 255], dtype=np.uint8)
# From near or thin to far or thick.
SCALE = np.array([[165, 0, 38], [244, 109, 67], [254, 224, 139], [171, 221, 164], [50, 136, 189], [49, 54, 149]], float)


def options(words: str, picture: str) -> argparse.ArgumentParser:
    """MESH and --picture, for a program that says what it does in these words."""
    parser = argparse.ArgumentParser(description=words)
    parser.add_argument("mesh", type=Path, help="OBJ, OFF, PLY or STL")
    parser.add_argument("--picture", type=Path, default=Path(picture), help="a PNG file that is written")
    return parser


def read(path: Path) -> pierce.TriangleSoup:
    """In single precision, as most meshes and sensors have it."""
    return pierce.read_mesh(path, dtype=np.float32)


def coloured(values: np.ndarray, low: float, high: float) -> np.ndarray:
    """Colours of numbers, shape (..., 3), uint8."""
    places = np.clip((values - low) / max(high - low, 1e-30), 0, 1) * (len(SCALE) - 1)
    channels = [np.interp(places, np.arange(len(SCALE)), channel) for channel in SCALE.T]
    return np.stack(channels, axis=-1).astype(np.uint8)


def write(pixels: np.ndarray, path: Path, caption: str, enlarge: int = 1) -> None:
    """`pixels`: shape (height, width, 3), the first row on top. The caption goes below."""
    image = Image.fromarray(np.ascontiguousarray(pixels)).resize(
        (pixels.shape[1] * enlarge, pixels.shape[0] * enlarge), Image.Resampling.NEAREST)
    page = Image.new("RGB", (image.width, image.height + 24), tuple(BACKGROUND.tolist()))
    page.paste(image, (0, 0))
    ImageDraw.Draw(page).text((8, image.height + 6), caption, fill=(40, 40, 40))
    page.save(path)
    print(f"picture   {path}")
