# SPDX-License-Identifier: BSD-3-Clause
"""A project that delone was added to installs nothing of it.

Usage: installs_nothing.py CMAKE BUILD_DIR
"""
import pathlib
import subprocess
import sys
import tempfile

cmake, build = sys.argv[1:]
with tempfile.TemporaryDirectory() as prefix:
    done = subprocess.run([cmake, "--install", build, "--prefix", prefix], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
    found = sorted(str(path) for path in pathlib.Path(prefix).rglob("*"))
    assert not found, found
