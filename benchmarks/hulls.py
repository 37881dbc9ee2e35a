#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times convex hulls by delone and by its rivals, one thread each, in turn on the same files.

  hulls.py build/bench                        a table; needs a build with DELONE_BUILD_BENCHMARKS=ON
  hulls.py build/bench --only sphere          inputs whose name contains a text, also repeated
  hulls.py build/bench --record               also benchmarks/history/DATE-COMMIT-hulls.json

Figures are medians over the rounds: seconds, processor seconds (user and system; quote their ratios if the machine is shared) and
peak memory. A rival has no figures if it fails, takes longer than --patience seconds, or was not built. If it finds another number
of facets than delone, that number is shown.
"""
import argparse
import itertools
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

import numpy as np

import record

RIVALS = pathlib.Path(__file__).resolve().parent / "rivals"
MANY = ("hull_delone", "hull_qhull", "hull_cgal_d{d}")
FLAT = ("hull_delone", "hull_delone --points extreme", "hull_qhull")
SMALL = MANY + ("hull_cddlib", "hull_cddlib_gmp", "hull_lrs.py")

# name -> (kind, dimension, number of points, programs)
STANDARD = {
    "sphere 3D 1e6": ("sphere", 3, 1_000_000, MANY),
    "sphere 4D 1e5": ("sphere", 4, 100_000, MANY),
    "sphere 5D 2e4": ("sphere", 5, 20_000, MANY[:2]),
    "sphere 6D 5e3": ("sphere", 6, 5_000, MANY[:2]),
    "sphere 8D 500": ("sphere", 8, 500, MANY[:2]),
    "ball 4D 1e5": ("ball", 4, 100_000, MANY[:2]),
    "ball 5D 2e4": ("ball", 5, 20_000, MANY[:2]),
    "ball 6D 5e3": ("ball", 6, 5_000, MANY[:2]),
    "ball 7D 1e3": ("ball", 7, 1_000, MANY[:2]),
    "ball 8D 500": ("ball", 8, 500, MANY[:2]),
    "cube 4D 1e5": ("uniform", 4, 100_000, MANY[:2]),
    "cube 5D 2e4": ("uniform", 5, 20_000, MANY[:2]),
    "cube 6D 5e3": ("uniform", 6, 5_000, MANY[:2]),
    "cube 7D 1e3": ("uniform", 7, 1_000, MANY[:2]),
    "cube 8D 500": ("uniform", 8, 500, MANY[:2]),
    "square 2D 1e6": ("uniform", 2, 1_000_000, FLAT),
    "cube 3D 1e6": ("uniform", 3, 1_000_000, FLAT),
    "inside 3D 1e6": ("corners", 3, 1_000_000, MANY[:2]),
    "inside 4D 1e6": ("corners", 4, 1_000_000, MANY[:2]),
    "inside 5D 1e6": ("corners", 5, 1_000_000, MANY[:2]),
    "small 4D 100": ("sphere", 4, 100, SMALL),
    "small 6D 50": ("sphere", 6, 50, SMALL),
    "small 8D 40": ("sphere", 8, 40, SMALL),
}


def make_points(delone, kind, dimension, n, path):
    """`corners`: a cube with n points inside."""
    if kind == "corners":
        cube = np.array(list(itertools.product([0.0, 1.0], repeat=dimension)))
        np.save(path, np.vstack([np.random.default_rng(1).random((n, dimension)), cube]))
    else:
        subprocess.run([delone, "generate", kind, "-d", str(dimension), "-n", str(n), "--seed", "1", "-o", path], check=True)


def command_line(build, program, dimension, path):
    """The command line of a program, or None if it was not built."""
    if program.endswith(".py"):
        return [sys.executable, str(RIVALS / program), path]
    name, *options = program.format(d=dimension).split()
    executable = build / "rivals" / name
    return [str(executable), path, *options] if executable.exists() else None


def measure(command, patience):
    """One report of a program, or None."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=patience)
        return json.loads(done.stdout) if done.returncode == 0 else None
    except (subprocess.TimeoutExpired, json.JSONDecodeError):
        return None


def summary(runs):
    return {"seconds": statistics.median(s for run in runs for s in run["seconds"]),
            "cpu_seconds": statistics.median(s for run in runs for s in run["cpu_seconds"]),
            "peak_bytes": max(run["peak_bytes"] for run in runs), "facets": runs[-1].get("facets", runs[-1]["cells"]),
            "program": runs[-1]["program"], "version": runs[-1]["version"], "flags": runs[-1]["flags"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", action="append", metavar="TEXT", help="inputs whose name contains TEXT")
    parser.add_argument("--patience", type=float, default=300, help="seconds for one run of a program")
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/")
    options = parser.parse_args()
    delone = options.build / "delone"
    print(f"{'input':<15}{'program':<16}{'facets':>9}{'seconds':>10}{'cpu s':>10}{'peak MB':>9}{'ratio':>8}{'cpu ratio':>10}")
    results = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, (kind, dimension, n, programs) in STANDARD.items():
            if options.only and not any(text in name for text in options.only):
                continue
            path = f"{folder}/points.npy"
            make_points(delone, kind, dimension, n, path)
            commands = {program: command_line(options.build, program, dimension, path) for program in programs}
            runs = {program: [] for program in programs}
            for _ in range(options.rounds):
                for program, command in list(commands.items()):
                    report = measure(command, options.patience) if command else None
                    if report is None:
                        commands[program] = None
                    else:
                        runs[program].append(report)
            figures = results[name] = {program: summary(reports) for program, reports in runs.items() if reports}
            own = figures.get("hull_delone")
            if own is None:
                sys.exit(f"{name}: delone has failed")
            for program, figure in figures.items():
                label = " ".join([figure["program"], *program.split()[2:]])
                differs = "" if figure["facets"] == own["facets"] else " (other facets)"
                print(f"{name:<15}{label:<16}{figure['facets']:>9}{figure['seconds']:>10.4f}{figure['cpu_seconds']:>10.4f}"
                      f"{figure['peak_bytes'] / 1e6:>9.1f}{figure['seconds'] / own['seconds']:>8.2f}"
                      f"{figure['cpu_seconds'] / own['cpu_seconds']:>10.2f}{differs}", flush=True)

    if options.record:
        print("recorded in", record.write("hulls", options.build / "rivals" / "hull_delone", results).relative_to(record.ROOT))


if __name__ == "__main__":
    main()
