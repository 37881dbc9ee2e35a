#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times the Python module against scipy: constructions, location of points, linear interpolation; one thread.

  PYTHONPATH=build/release/python benchmarks/python.py               a table
  PYTHONPATH=build/release/python benchmarks/python.py --record      also benchmarks/history/DATE-COMMIT-python.json

In each round both work on the same arrays, in turn. Figures are medians of processor times over the rounds, ratios are medians of
ratios. Construction includes the arrays of simplices and neighbors. SciPy always computes hyperplanes too; "with equations", delone
does as well.
"""
import argparse
import datetime
import json
import pathlib
import platform
import statistics
import subprocess
import sys
import time

import numpy as np
import scipy
import scipy.interpolate
import scipy.spatial

import delone
import delone.spatial

ROOT = pathlib.Path(__file__).resolve().parent.parent
CONSTRUCTIONS = {2: 100_000, 3: 50_000, 4: 10_000, 5: 2_000, 6: 500, 7: 250}
LOCATIONS = {"3D": (3, 10_000, 1_000_000), "5D": (5, 2_000, 100_000)}
INTERPOLATIONS = {"2D": (2, 10_000, 1_000_000), "3D": (3, 10_000, 200_000), "5D": (5, 2_000, 50_000)}


def uniform(dimension, n, seed):
    return np.random.default_rng(seed).random((n, dimension))


def construct(module, points, attribute):
    tri = module.Delaunay(points)
    return tri.simplices, tri.neighbors, getattr(tri, attribute)


def values_at(points):
    return np.sin(3 * points).sum(axis=1)


def experiments():
    """(name, function of delone, function of scipy, comparison of their results), each made when it is its turn."""
    for dimension, n in CONSTRUCTIONS.items():
        points = uniform(dimension, n, 1)
        same = lambda a, b: len(a[0]) == len(b[0])
        for name, attribute in (("construction", "neighbors"), ("construction with equations", "equations")):
            yield (f"{dimension}D, {n} points: {name}", lambda: construct(delone.spatial, points, attribute),
                   lambda: construct(scipy.spatial, points, attribute), same)
    for name, (dimension, n, queries) in LOCATIONS.items():
        points, queries = uniform(dimension, n, 1), uniform(dimension, queries, 2)
        ours, theirs = delone.spatial.Delaunay(points), scipy.spatial.Delaunay(points)
        theirs.transform  # computed at the first query
        yield (f"{name}, {n} points: find_simplex of {len(queries)}", lambda: ours.find_simplex(queries),
               lambda: theirs.find_simplex(queries), lambda a, b: (a < 0).sum() == (b < 0).sum())
    for name, (dimension, n, queries) in INTERPOLATIONS.items():
        points, queries = uniform(dimension, n, 1), uniform(dimension, queries, 2)
        ours = delone.LinearInterpolator(delone.Delaunay(points), values_at(points))
        theirs = scipy.interpolate.LinearNDInterpolator(scipy.spatial.Delaunay(points), values_at(points))
        theirs(queries[:2])  # computes its transforms
        yield (f"{name}, {n} points: interpolation at {len(queries)}", lambda: ours(queries), lambda: theirs(queries),
               lambda a, b: np.allclose(a, b, rtol=1e-6, atol=1e-6, equal_nan=True))


def seconds(action):
    """Processor time, which other programs on the machine disturb less than wall-clock time."""
    begin = time.process_time()
    result = action()
    return time.process_time() - begin, result


def machine():
    try:
        model = next(line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    except (OSError, StopIteration):
        model = platform.processor()
    return f"{model}, {platform.system()} {platform.machine()}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", action="append", metavar="TEXT", help="experiments whose name contains TEXT")
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/")
    options = parser.parse_args()

    print(f"{'experiment':<52}{'delone, s':>10}{'scipy, s':>10}{'scipy / delone':>16}")
    results = {}
    for name, ours, theirs, same in experiments():
        if options.only and not any(text in name for text in options.only):
            continue
        runs = []
        for _ in range(options.rounds):
            (mine, a), (other, b) = seconds(ours), seconds(theirs)
            if not same(a, b):
                sys.exit(f"{name}: the results differ")
            runs.append((mine, other))
        figures = {"delone": statistics.median(run[0] for run in runs), "scipy": statistics.median(run[1] for run in runs),
                   "ratio": statistics.median(run[1] / run[0] for run in runs)}
        results[name] = figures
        print(f"{name:<52}{figures['delone']:>10.3f}{figures['scipy']:>10.3f}{figures['ratio']:>16.1f}", flush=True)

    if options.record:
        commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True).stdout.strip()
        date = datetime.date.today().isoformat()
        record = {"date": date, "commit": commit, "machine": machine(), "threads": 1, "rounds": options.rounds,
                  "python": platform.python_version(), "numpy": np.__version__, "scipy": scipy.__version__, "delone": delone.__version__,
                  "results": results}
        history = ROOT / "benchmarks" / "history"
        history.mkdir(exist_ok=True)
        (history / f"{date}-{commit}-python.json").write_text(json.dumps(record, indent=1) + "\n")


if __name__ == "__main__":
    main()
