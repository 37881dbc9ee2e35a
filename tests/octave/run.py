#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Installs the Octave package in a folder of its own and tests it: its own tests and demonstrations, those of Octave with its functions
in the places of Octave's, Ctrl-C, and the examples of docs/octave.md.

Usage: run.py BUILD_DIR       BUILD_DIR has been installed into BUILD_DIR/octave/prefix
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import octave_package  # noqa: E402

OCTAVE = ["octave-cli", "--norc", "--no-history"]


def install(folder):
    """The folder of the installed package."""
    home = folder / "home"
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir(parents=True)
    package = octave_package.make(folder)
    code = f"""
        pkg ("prefix", "{home}/packages", "{home}/arch");
        pkg ("local_list", "{home}/list");
        pkg ("install", "-local", "{package}");
        pkg ("load", "delone");
        printf ("%s\\n", fileparts (fileparts (which ("delone.version"))), fileparts (which ("__delone__")));
    """
    environment = {**os.environ, "HOME": str(home), "PKG_CONFIG_PATH": str(folder / "prefix/lib/pkgconfig")}
    done = subprocess.run([*OCTAVE, "--eval", code], env=environment, text=True, stdout=subprocess.PIPE, check=True)
    return done.stdout.split("\n")[-3:-1]


def with_path(folders, code):
    return [*OCTAVE, "--eval", "".join(f'addpath ("{folder}"); ' for folder in folders) + code]


def run_tests(folders):
    done = subprocess.run(with_path(folders, f'source ("{ROOT}/tests/octave/package_test.m");'), check=False)
    return done.returncode == 0


def can_be_interrupted(folders):
    """Whether Ctrl-C ends a triangulation, a query and a hull soon, and passes through no frame of C."""
    works = {
        "a triangulation": 'delone.delaunayn (rand (3000000, 3));',
        "a hull": 'x = randn (1000000, 4); delone.convhulln (x ./ sqrt (sum (x.^2, 2)));',
        "queries": 'x = rand (20000, 3); t = delone.delaunayTriangulation (x); while (true) nearestNeighbor (t, rand (200000, 3)); end',
    }
    good = True
    for name, work in works.items():
        code = f'printf ("ready\\n"); fflush (stdout); unwind_protect {work} unwind_protect_cleanup printf ("cleaned up\\n"); end_unwind_protect'
        process = subprocess.Popen(with_path(folders, code), text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.readline()
        time.sleep(2)
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        try:
            out, _ = process.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            process.kill()
            out, _ = process.communicate()
        took = time.monotonic() - start
        print(f"Ctrl-C during {name}: {took:.1f} s")
        if "cleaned up" not in out or process.returncode < 0 or took > 5:
            print(f"  status {process.returncode}, printed {out!r}")
            good = False
    return good


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    folders = install(build / "octave")
    steps = [run_tests(folders),
             subprocess.run([sys.executable, "-B", ROOT / "tests/octave/own_tests.py", *folders], check=False).returncode == 0,
             can_be_interrupted(folders),
             subprocess.run([sys.executable, "-B", ROOT / "tools/check_docs.py", build, "--only", "docs/octave.md", "--octave", *folders],
                            check=False).returncode == 0]
    print("all of it passes" if all(steps) else "something fails, see above")
    sys.exit(not all(steps))


if __name__ == "__main__":
    main()
