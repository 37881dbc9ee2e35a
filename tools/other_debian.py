#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds a wheel of the committed tree in another release of Debian, and runs the Python tests and SciPy's own tests with it there.

Usage: other_debian.py RELEASE [OUTPUT]

In OUTPUT, build/RELEASE if not given: root, a system of that release (tools/clean_system.py), in which `make wheels` runs, and then the
tests of scipy.spatial and scipy.interpolate, as they are and with delone in the place of scipy (tests/python/programs). The system stays,
with its packages and the cache of its compiler; delete it for one with the newest packages. CMAKE_BUILD_PARALLEL_LEVEL in the environment
sets the jobs of the compiler, whose warnings are errors. Needs root, a Debian, mmdebstrap, and a mirror in /etc/apt. Exit status 1 if a test failed.
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

import clean_system
from clean_system import run

ROOT = pathlib.Path(__file__).resolve().parent.parent
PACKAGES = ["make", "git", "ccache"]  # `make wheels` installs the others


def main():
    parser = argparse.ArgumentParser(description="Builds a wheel in another release of Debian, and tests it there.")
    parser.add_argument("release", help="its name, for example trixie")
    parser.add_argument("output", nargs="?", type=pathlib.Path, help="build/RELEASE by default")
    arguments = parser.parse_args()
    output = (arguments.output or ROOT / "build" / arguments.release).resolve()
    output.mkdir(parents=True, exist_ok=True)
    root, fresh = output / "root", output / "fresh"
    if not root.exists():
        clean_system.make(fresh, arguments.release, PACKAGES)
        fresh.rename(root)
    tree, installed = root / "delone", root / "installed"
    for old in (tree, installed):
        shutil.rmtree(old, ignore_errors=True)
    run("git", "clone", "--quiet", "--depth=1", f"file://{ROOT}", tree)
    settings = ["DELONE_CMAKE_ARGS=-DDELONE_WERROR=ON"]
    settings += [f"{name}={os.environ[name]}" for name in ["CMAKE_BUILD_PARALLEL_LEVEL"] if name in os.environ]
    inside = [str(word) for word in clean_system.inside(root)]
    ours = subprocess.run([*inside, *settings, "make", "-C", "/delone", "wheels"]).returncode
    wheels = list((tree / "build" / "wheels").glob("*.whl"))
    if not wheels:
        sys.exit("other_debian.py: there is no wheel")
    run(*inside, "dpkg-query", "--show", "g++", "pybind11-dev", "python3", "python3-numpy", "python3-scipy")
    run(*inside, "python3", "-m", "pip", "install", "--quiet", "--root-user-action=ignore", "--no-deps", "--no-index", "--target", "/installed", f"/{wheels[0].relative_to(root)}")
    theirs = subprocess.run([*inside, "PYTHONPATH=/installed", "python3", "-B", "/delone/tests/python/programs/run_programs.py", "scipy"]).returncode
    sys.exit(1 if ours or theirs else 0)


if __name__ == "__main__":
    main()
