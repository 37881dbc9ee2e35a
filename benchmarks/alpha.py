#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times alpha complexes beside their triangulation and beside GUDHI (Debian: python3-gudhi): processor times of one run.

  PYTHONPATH=build/release/python benchmarks/alpha.py -n 1000000
  PYTHONPATH=build/release/python benchmarks/alpha.py -n 100000 --gudhi --record

In each round all work on the same points of a unit cube, in turn, with one thread. GUDHI makes its simplex tree with all alpha values
(precision "fast" and "safe"), which has what delone's alpha_filtration() has; both include their triangulation. Figures are medians.
"""
import argparse
import datetime
import os
import platform
import statistics
import subprocess
import time

import numpy as np

import delone
import record


def seconds(action):
    begin = time.process_time()
    result = action()
    return time.process_time() - begin, result


def measure(n, dimension, seed, with_gudhi):
    points = np.random.default_rng(seed).random((n, dimension))
    times = {}
    times["triangulation"], t = seconds(lambda: delone.Delaunay(points, threads=1))
    len(t.cells)
    radius = float(np.sqrt(np.median(t.alpha_values(dimension)[::97])))
    times["alpha complex"], complex = seconds(lambda: t.alpha_complex(radius))
    times["all faces and values"], levels = seconds(t.alpha_filtration)
    times["circumradii"], _ = seconds(lambda: t.circumradii)
    times["qualities"], _ = seconds(t.qualities)
    counts = {"cells": len(t), "cells of the complex": len(complex), "boundary facets": len(complex.boundary),
              "faces": sum(len(values) for _, values in levels)}
    if with_gudhi:
        import gudhi
        for precision in ("fast", "safe"):
            times[f"gudhi {precision}"], tree = seconds(
                lambda: gudhi.AlphaComplex(points=points, precision=precision).create_simplex_tree())
            if tree.num_simplices() != counts["faces"]:
                raise SystemExit(f"gudhi finds {tree.num_simplices()} faces, delone {counts['faces']}")
            del tree
    return times, counts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-n", type=int, default=100_000)
    parser.add_argument("-d", "--dimension", type=int, default=3)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--gudhi", action="store_true", help="time GUDHI, too")
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/")
    options = parser.parse_args()
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # delone would use all cores
    rounds = []
    for number in range(options.rounds):
        times, counts = measure(options.n, options.dimension, number, options.gudhi)
        rounds.append(times)
    figures = {name: statistics.median(times[name] for times in rounds) for name in rounds[0]}
    own = statistics.median(times["triangulation"] + times["all faces and values"] for times in rounds)
    print(f"{options.n} points in dimension {options.dimension}: {counts}")
    for name, value in figures.items():
        print(f"{name:<24}{value:>9.3f} s {value / figures['triangulation']:>8.2f} of the triangulation", flush=True)
    for name in figures:
        if name.startswith("gudhi"):
            print(f"{name}: {figures[name] / own:.1f} times the triangulation and all faces and values together")
    if options.record:
        commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=record.ROOT, capture_output=True, text=True).stdout.strip()
        date = datetime.date.today().isoformat()
        record.save("alpha", {"date": date, "commit": commit, "machine": f"{platform.processor()}, {platform.system()} {platform.machine()}",
                              "threads": 1, "rounds": options.rounds, "points": options.n, "dimension": options.dimension, "counts": counts,
                              "seconds": figures})


if __name__ == "__main__":
    main()
