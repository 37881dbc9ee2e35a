#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the wheel, installs it into a new virtual environment, and uses it there, far from the sources.

Usage: check_wheel.py BUILD_DIR VERSION       BUILD_DIR has the compiled module, which goes into the wheel as it is

NumPy is that of this Python, since the environment sees its packages; nothing is fetched.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = ["pyproject.toml", "setup.py", "CMakeLists.txt", "README.md", "LICENSE"]

USE = """
import importlib.metadata, pathlib, pickle, sys
import numpy as np
import delone, delone.spatial
inside = pathlib.Path(sys.prefix).resolve()
assert inside in pathlib.Path(delone.__file__).resolve().parents, delone.__file__
assert importlib.metadata.version("delone") == delone.__version__ == sys.argv[1], delone.__version__
files = {file.name for file in importlib.metadata.files("delone")}
assert {"LICENSE", "py.typed", "_core.pyi", "_delaunay.py"} <= files, files
lattice = np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3)
t = delone.Delaunay(lattice)
assert t.num_cells == len(t.cells) and len(np.unique(t.cells)) == 64
assert abs(delone.spatial.ConvexHull(lattice).volume - 27) < 1e-9
assert delone.spatial.Delaunay(lattice).find_simplex([1.5, 1.5, 1.5]) >= 0
assert pickle.loads(pickle.dumps(t)).hash == t.hash
assert "scipy" not in sys.modules
print(delone.__version__, t.num_cells, "cells")
"""


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def main():
    build, version = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    clean = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "PIP_", "VIRTUAL_ENV"))}
    with tempfile.TemporaryDirectory(prefix="delone_wheel_") as folder:
        folder = pathlib.Path(folder)
        source = folder / "source"
        source.mkdir()
        for name in SOURCES:
            shutil.copy2(ROOT / name, source)
        shutil.copytree(ROOT / "python" / "delone", source / "python" / "delone", ignore=shutil.ignore_patterns("__pycache__", "*.so"))
        run(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", folder, source, cwd=folder,
            env={**clean, "DELONE_BUILD_DIR": str(build)})
        wheel, = folder.glob("delone-*.whl")
        assert wheel.name.startswith(f"delone-{version}-cp") and "none-any" not in wheel.name, wheel.name
        names = zipfile.ZipFile(wheel).namelist()
        assert sum(name.startswith("delone/_core.") and name.endswith(".so") for name in names) == 1, names
        assert all(name.startswith(("delone/", f"delone-{version}.dist-info/")) for name in names), names

        environment = folder / "environment"
        run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", environment)
        python = environment / "bin" / "python"
        run(sys.executable, "-m", "pip", "--python", python, "install", "--no-deps", "--no-index", "--ignore-installed", wheel, env=clean)
        print(run(python, "-c", USE, version, cwd=folder, env=clean).strip(), "from", wheel.name)


if __name__ == "__main__":
    main()
