"""examples/python: each runs without a screen, on a real mesh and a box whose answers are known, and draws."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from test_exact_judge import box
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def bunny(tmp_path_factory):
    folder = tmp_path_factory.mktemp("meshes")
    subprocess.run([ROOT / "tests" / "real_meshes", folder], check=True)
    return folder / "bunny00.off"


@pytest.fixture
def cube(tmp_path):
    vertices, faces = box()
    path = tmp_path / "cube.off"
    rows = [" ".join(map(str, row)) for row in vertices.tolist()] + [f"3 {a} {b} {c}" for a, b, c in faces.tolist()]
    path.write_text("\n".join([f"OFF\n{len(vertices)} {len(faces)} 0", *rows]) + "\n")
    return path


def run(name, mesh, picture, *options):
    """What the example prints, and its picture."""
    done = subprocess.run([sys.executable, ROOT / "examples" / "python" / f"{name}.py", mesh, "--picture", picture,
                           *options], check=True, capture_output=True, text=True, timeout=300)
    print(done.stdout, done.stderr)
    return done.stdout, np.asarray(Image.open(picture))


def number(pattern, text):
    return float(re.search(pattern, text)[1].replace(",", ""))


def has(pixels, colour):
    return bool((pixels == colour).all(axis=-1).any())


def test_occupancy_of_a_cube(cube, tmp_path):
    """Four cells along each side: 4^3 of the points are inside, as the surface counts on three sides, and 5^3 - 3^3 lie
    on it."""
    said, pixels = run("occupancy", cube, tmp_path / "cube.png", "--cells", "4")
    assert number(r"inside +([\d,]+) of", said) == 64
    assert number(r"points; ([\d,]+) lie", said) == 98
    assert has(pixels, (150, 165, 185)) and has(pixels, (60, 60, 60))


def test_occupancy_of_the_bunny(bunny, tmp_path):
    said, pixels = run("occupancy", bunny, tmp_path / "bunny.png", "--cells", "40")
    assert 10_000 < number(r"inside +([\d,]+) of", said) < 20_000
    assert has(pixels, (150, 165, 185)) and pixels.shape[0] > 100


def test_lidar_sweep(bunny, tmp_path):
    said, pixels = run("lidar_sweep", bunny, tmp_path / "lidar.png")
    assert number(r"beams +([\d,]+) on", said) == 64 * 20 * 900
    assert 700_000 < number(r"s; ([\d,]+) come back", said) < 800_000
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 100


def test_thickness_of_a_cube(cube, tmp_path):
    said, pixels = run("thickness", cube, tmp_path / "cube.png")
    assert number(r"; (\d+) found no way out", said) == 0
    assert "thickness from 1 to 1, median 1" in said
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 2


def test_thickness_of_the_bunny(bunny, tmp_path):
    said, _ = run("thickness", bunny, tmp_path / "bunny.png")
    assert number(r"; (\d+) found no way out", said) == 0
    assert 0.1 < number(r"median ([\d.]+)", said) < 0.6
