#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts what constructions of Delaunay triangulations of named point sets create, and what they cost: the table that the
constants of the forecast are fitted to (fit_forecast.py).

  forecast_runs.py build/release/delone --python build/release/python -o runs.csv       all kinds, 1D to 8D

For every kind and dimension the number of points doubles until a construction takes more than --longest seconds. Each runs in a
process of its own, on one thread. Times are processor times, bytes the growth of the peak of resident memory. Lines that the file
has already are not measured again, so that a run can be continued.
"""
import argparse
import csv
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

COLUMNS = ["kind", "dimension", "points", "affine_dimension", "vertices", "cells", "infinite_cells", "created_cells", "seconds", "bytes"]
KINDS = ["ball", "clusters", "collinear", "cospherical", "cube01", "duplicates", "equal", "flat", "gaussian", "grid", "manifold",
         "mixed_scales", "moment", "nudged_grid", "offset", "plummer", "sphere", "tilted_grid", "ulp_sphere", "uniform"]


def memory(field):
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) * 1024 for line in status if line.startswith(field))


def construct(path):
    """Runs in a process of its own: figures of one construction, as a line of numbers."""
    import numpy
    import delone
    points = numpy.load(path)
    delone.Delaunay(points[:min(len(points), 10)], threads=1)
    pathlib.Path("/proc/self/clear_refs").write_text("5")
    before, start = memory("VmRSS"), time.process_time()
    triangulation = delone.Delaunay(points, threads=1)
    seconds, peak = time.process_time() - start, memory("VmHWM") - before
    infinite = len(triangulation.hull_facets) if triangulation.affine_dimension > 0 else 1
    print(triangulation.affine_dimension, triangulation.num_vertices, triangulation.num_cells, infinite,
          triangulation.statistics["created_cells"], f"{seconds:.4f}", peak)


def sizes(kind, dimension, longest_set):
    """Numbers of points, doubling; of lattices, also those with whole sides."""
    n = 16 if dimension < 7 else 12
    while n <= longest_set:
        yield n
        n *= 2


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--python", required=True, help="the folder that has the module")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--longest", type=float, default=2, help="seconds")
    parser.add_argument("--most-bytes", type=float, default=3e9)
    parser.add_argument("--kinds", nargs="*", default=KINDS)
    parser.add_argument("--dimensions", nargs="*", type=int, default=list(range(1, 9)))
    parser.add_argument("--sizes", nargs="*", type=int, help="these sizes instead of doubling ones")
    arguments = parser.parse_args()
    output = pathlib.Path(arguments.output)
    known = set()
    if output.exists():
        with open(output, newline="", encoding="ascii") as file:
            known = {(row["kind"], int(row["dimension"]), int(row["points"])): row for row in csv.DictReader(file)}
    else:
        known = {}
        output.write_text(",".join(COLUMNS) + "\n")
    for dimension in arguments.dimensions:
        for kind in arguments.kinds:
            cost = 0.0, 0.0
            last = 0.0, 0.0
            for n in arguments.sizes or sizes(kind, dimension, 4_000_000):
                if cost[0] > arguments.longest or (last[0] > 0.05 and cost[0] ** 2 / last[0] > 2.5 * arguments.longest) or cost[1] > arguments.most_bytes / 2:
                    break
                last = cost
                key = (kind, dimension, n)
                if key in known:
                    cost = float(known[key]["seconds"]), float(known[key]["bytes"])
                    continue
                with tempfile.TemporaryDirectory() as folder:
                    path = f"{folder}/points.npy"
                    made = subprocess.run([arguments.command, "generate", kind, "-d", str(dimension), "-n", str(n), "--seed", "1", "-o", path],
                                          stderr=subprocess.DEVNULL)
                    if made.returncode != 0:
                        break
                    environment = {**os.environ, "PYTHONPATH": arguments.python, "DELONE_FORECAST_POINTS": path}
                    run = subprocess.run([sys.executable, __file__], env=environment, capture_output=True, text=True)
                if run.returncode != 0:
                    print(kind, dimension, n, run.stderr[-200:], file=sys.stderr)
                    break
                figures = run.stdout.split()
                with open(output, "a", encoding="ascii") as file:
                    file.write(",".join([kind, str(dimension), str(n), *figures]) + "\n")
                cost = float(figures[5]), float(figures[6])
                if int(figures[1]) < n / 2 and kind in ("cube01", "equal"):
                    break


if "DELONE_FORECAST_POINTS" in os.environ:
    construct(os.environ["DELONE_FORECAST_POINTS"])
elif __name__ == "__main__":
    main()
