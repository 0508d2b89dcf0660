"""Every example of the documentation runs and says what it says; types and stubs are those of the module."""

import doctest
import importlib
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import pierce

MODULES = sorted(module.name for module in pkgutil.iter_modules(pierce.__path__) if module.name != "_pierce")
FOLDER = Path(pierce.__file__).parent
ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert doctest.testmod(importlib.import_module(f"pierce.{name}")).failed == 0


def test_public_calls_have_examples() -> None:
    finder = doctest.DocTestFinder()
    examples = {test.name for name in MODULES for test in finder.find(importlib.import_module(f"pierce.{name}"))
                if test.examples}
    mine = [name for name in dir(pierce.CollisionMesh) if not name.startswith("_") and name not in ("dtype",)]
    told = {name.rsplit(".", 1)[-1] for name in examples}
    assert len(mine) >= 25
    assert [name for name in mine if name not in told and name not in ("rebuild", "refit_cost")] == []
    undocumented = [name for name in pierce.__all__ if callable(getattr(pierce, name))
                    and not getattr(pierce, name).__doc__]
    assert undocumented == []


PAGES = {"README.md": ["hits face 0 at [1. 1. 0.]"],
         "examples/guide/python.md": ["hits face [0] at [[1. 1. 0.]]", "points: dtype float64 on a float32 mesh: ",
                                      "RESTING True"]}


@pytest.mark.parametrize("page", PAGES)
def test_pages(page: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Each block of Python stands by itself, and prints what the page says."""
    blocks = re.findall(r"^```python\n(.*?)^```$", (ROOT / page).read_text(), re.MULTILINE | re.DOTALL)
    assert len(blocks) == len(PAGES[page])
    for block, expected in zip(blocks, PAGES[page]):
        exec(compile(block, page, "exec"), {})
        assert capsys.readouterr().out.startswith(expected)


def run(*words: str) -> None:
    done = subprocess.run([sys.executable, "-m", *words], cwd=FOLDER.parent, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_types(tmp_path: Path) -> None:
    run("mypy", "--strict", "--cache-dir", str(tmp_path), "-p", "pierce")


def test_stubs_are_those_of_the_module(tmp_path: Path) -> None:
    config, known = tmp_path / "mypy.ini", tmp_path / "known"
    config.write_text(f"[mypy]\ncache_dir = {tmp_path}\n")
    # pybind11's classes have a metaclass that has no name to write; their members are looked at all the same.
    known.write_text("".join(f"pierce\\._pierce\\.{name}\n" for name in ("Deforming", "Mesh", "RigidMotion", "Step")))
    run("mypy.stubtest", "--mypy-config-file", str(config), "--allowlist", str(known), "pierce._pierce")
