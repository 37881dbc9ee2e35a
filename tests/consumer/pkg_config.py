# SPDX-License-Identifier: BSD-3-Clause
"""Compiles a program with what pkg-config says of an installed package, links it, and runs it.

Usage: pkg_config.py PKG_CONFIG FOLDER PACKAGE=VERSION COMPILER [OPTION...] SOURCE...
"""
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

pkg_config, folder, package, *compiler = sys.argv[1:]
package, _, version = package.partition("=")
environment = {**os.environ, "PKG_CONFIG_PATH": folder + os.pathsep + os.environ.get("PKG_CONFIG_PATH", "")}


def ask(*options):
    return subprocess.run([pkg_config, *options, package], env=environment, text=True, stdout=subprocess.PIPE, check=True).stdout.strip()


assert ask("--modversion") == version, ask("--modversion")
libraries = ask("--variable=libdir")
for options in [("--cflags", "--libs"), ("--cflags", "--libs", "--static")]:
    with tempfile.TemporaryDirectory() as scratch:
        program = pathlib.Path(scratch) / "program"
        subprocess.run([*compiler, "-o", str(program), *shlex.split(ask(*options)), f"-Wl,-rpath,{libraries}"], check=True)
        subprocess.run([program], check=True)
