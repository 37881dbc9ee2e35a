#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the R package on an installed C library: `R CMD check --as-cran`, which runs its tests and examples, the tests of package geometry
with its functions in the place of geometry's, and the examples of docs/r.md.

Usage: run.py BUILD_DIR       the work is done in BUILD_DIR/r
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import make_r_package  # noqa: E402

# What needs a network, or a clock in it. A machine without a display draws nothing.
OFFLINE = {"_R_CHECK_CRAN_INCOMING_": "false", "_R_CHECK_FUTURE_FILE_TIMESTAMPS_": "false", "_R_CHECK_SYSTEM_CLOCK_": "false",
           "_R_CHECK_ORPHANED_": "false", "_R_CHECK_FORCE_SUGGESTS_": "false", "RGL_USE_NULL": "true"}


def check_package(package, folder, environment):
    """Whether there is neither an error nor a warning."""
    command = ["R", "CMD", "check", "--as-cran", "--no-manual", package.name]
    done = subprocess.run(command, cwd=folder, env={**environment, **OFFLINE}, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    print(done.stdout)
    status = re.search(r"^Status: (.*)$", done.stdout, re.M)
    tests = folder / "delone.Rcheck/tests/testthat.Rout"
    if tests.exists():
        print("\n".join(line for line in tests.read_text(encoding="utf-8").splitlines() if line.startswith("[ FAIL")))
    return done.returncode == 0 and status is not None and "WARNING" not in status[1] and "ERROR" not in status[1]


def main(build):
    folder = build / "r"
    library, prefix = folder / "library", folder / "prefix"
    shutil.rmtree(library, ignore_errors=True)
    library.mkdir(parents=True)
    subprocess.run(["cmake", "--install", str(build), "--prefix", str(prefix)], check=True, stdout=subprocess.DEVNULL)
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "R_LIBS": str(library),
                   "PKG_CONFIG_PATH": f"{prefix}/lib/pkgconfig:{os.environ.get('PKG_CONFIG_PATH', '')}"}
    os.environ.update(environment)
    package = make_r_package.make(folder)
    good = check_package(package, folder, environment)
    subprocess.run(["R", "CMD", "INSTALL", f"--library={library}", str(package)], check=True, env=environment, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    of_geometry = folder / "geometry"
    subprocess.run([ROOT / "r/tests/geometry/fetch.sh", of_geometry], check=True)
    good &= subprocess.run(["Rscript", ROOT / "r/tests/geometry/run.R", of_geometry], env=environment).returncode == 0
    docs = [sys.executable, "-B", ROOT / "tools/check_docs.py", build, "--r", library, "--only", "docs/r.md"]
    good &= subprocess.run(docs, env=environment).returncode == 0
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
