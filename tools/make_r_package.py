#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the source package of R, delone_VERSION.tar.gz, of r/.

Usage: make_r_package.py [-o build/r] [--with-sources]

With the sources of the library in src/delone.tar.gz the package is complete: it needs no installed libdelone_c, but cmake and the libraries
that DESCRIPTION names. They are an archive because `R CMD build` leaves out folders named check. The version is that of CMakeLists.txt. R's `R CMD build` also makes the vignette, for which it installs the package: with
a libdelone_c that pkg-config finds; --with-sources leaves the vignette out.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOURCES = ["CMakeLists.txt", "LICENSE", "THIRD_PARTY_LICENSES", "c", "cmake", "include", "src", "viewer/dist"]


def version():
    return re.search(r"^project\(delone VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]


def copy(path, to, *left_out):
    to.parent.mkdir(parents=True, exist_ok=True)
    if path.is_file():
        shutil.copy2(path, to)
    else:
        shutil.copytree(path, to, ignore=shutil.ignore_patterns(*left_out))


def make(folder, with_sources=False):
    """The path of the package."""
    stage = folder / "stage" / "delone"
    shutil.rmtree(stage.parent, ignore_errors=True)
    # Without what builds leave there, and the tests of package geometry, which need a network.
    copy(ROOT / "r", stage, "*.o", "*.so", "Makevars", "library", "*.Rcheck", ".gitignore", "geometry", "_snaps")
    description = stage / "DESCRIPTION"
    text = description.read_text(encoding="utf-8")
    description.write_text(re.sub(r"^Version: .*", f"Version: {version()}", text, flags=re.M), encoding="utf-8")
    if with_sources:
        with tarfile.open(stage / "src" / "delone.tar.gz", "w:gz") as archive:
            for name in SOURCES:
                archive.add(ROOT / name, f"delone/{name}")
    package = folder / f"delone_{version()}.tar.gz"
    package.unlink(missing_ok=True)
    command = ["R", "CMD", "build", *["--no-build-vignettes"] * with_sources, str(stage)]
    subprocess.run(command, cwd=folder, check=True, env={**os.environ, "LC_ALL": "C.UTF-8"})
    shutil.rmtree(stage.parent)
    return package


def main():
    parser = argparse.ArgumentParser(description="Makes the source package of R.")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "build" / "r")
    parser.add_argument("--with-sources", action="store_true", help="with the sources of the library")
    arguments = parser.parse_args()
    if not shutil.which("R"):
        sys.exit("make_r_package.py: there is no R; tools/install_dependencies.sh r installs it")
    arguments.output.mkdir(parents=True, exist_ok=True)
    print(make(arguments.output.resolve(), arguments.with_sources))


if __name__ == "__main__":
    main()
