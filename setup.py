"""What pyproject.toml can't say to scikit-build: which options CMake gets, and where the version stands."""

import re
import sys
from pathlib import Path

from skbuild import setup

numbers = dict(re.findall(r"^#define PIERCE_VERSION_(MAJOR|MINOR|PATCH) (\d+)$",
                          Path("include/pierce/version.h").read_text(encoding="utf-8"), re.MULTILINE))

setup(
    version="{MAJOR}.{MINOR}.{PATCH}".format(**numbers),
    packages=["pierce"],
    package_dir={"": "lib/python"},
    package_data={"pierce": ["py.typed", "*.pyi"]},
    include_package_data=False,
    zip_safe=False,
    cmake_args=["-DPIERCE_BUILD_PYTHON=ON", "-DPIERCE_BUILD_EXAMPLES=OFF", "-DPIERCE_BUILD_TESTS=OFF",
                "-DPIERCE_INSTALL=OFF", "-DPIERCE_WARNINGS_AS_ERRORS=OFF", f"-DPython_EXECUTABLE={sys.executable}"],
)
