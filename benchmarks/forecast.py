#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Forecasts beside what constructions take: ratios forecast / found of cells, bytes and seconds.

  PYTHONPATH=build/release/python forecast.py data/*.csv       all choices of two or more columns of each file
  PYTHONPATH=build/release/python forecast.py --kinds          sets of `delone generate`, 1D to 8D; uniform ones tell whether
                                                               the constants of src/forecast/model/cost.cpp still hold
  PYTHONPATH=build/release/python forecast.py --hard           seconds that estimates take where samples are hard: at most 1.5

Each construction runs in a process of its own, on one thread. Times are processor times, bytes the growth of the peak of resident memory.
Bytes below 4 MB and times below 20 ms are shown, and not counted.
"""
import argparse
import itertools
import math
import multiprocessing
import pathlib
import time

import numpy

import delone

PROMISED = 1.5
LEAST = {"cells": 0, "bytes": 4e6, "seconds": 0.02}
SIZES = {1: 100000, 2: 100000, 3: 40000, 4: 10000, 5: 3000, 6: 1000, 7: 384, 8: 192}
SLOW = {"cospherical": 20, "mixed_scales": 20, "moment": 20, "nudged_grid": 10, "sphere": 4, "ulp_sphere": 4}


def memory(field):
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) * 1024 for line in status if line.startswith(field))


def construct(points):
    delone.Delaunay(points[:10], threads=1)
    pathlib.Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
    before, start = memory("VmRSS"), time.process_time()
    triangulation = delone.Delaunay(points, threads=1)
    return {"seconds": time.process_time() - start, "bytes": memory("VmHWM") - before, "cells": triangulation.num_cells}


def sets_of_files(paths):
    """name, points, forecast"""
    for path in paths:
        points = delone.read(path)
        for count in range(2, points.shape[1] + 1):
            for columns in itertools.combinations(range(points.shape[1]), count):
                chosen = numpy.ascontiguousarray(points[:, columns])
                yield f"{pathlib.Path(path).stem} {columns}", chosen, delone.estimate(chosen, threads=1)


def sets_of_kinds(kinds):
    for kind, dimension in itertools.product(kinds, SIZES):
        n = max(SIZES[dimension] // SLOW.get(kind, 1), 30)
        try:
            points = delone.generate(kind, n, dimension)
        except ValueError:  # some need two dimensions
            continue
        yield f"{kind} {dimension}D", points, delone.forecast(dimension, n, kind, threads=1)


def time_hard_estimates():
    for kind, n, dimension in (("mixed_scales", 50, 10), ("mixed_scales", 50, 12), ("sphere", 10000, 9), ("moment", 1000, 9), ("uniform", 1000, 12),
                               ("uniform", 1000, 30), ("uniform", 1100, 1000), ("uniform", 2000, 1000)):
        points = delone.generate(kind, n, dimension)
        delone.estimate(points[:2], threads=1)
        start = time.perf_counter()
        found = delone.estimate(points, threads=1)
        seconds = time.perf_counter() - start
        low, high = found.bytes_range
        print(f"{kind:<14} {dimension:5}D {n:7} points  {seconds:6.2f} s{'*' if seconds > 1.5 else ' '}  sample of {found.num_sampled:5}   "
              f"bytes {low:.2g} to {high:.2g}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*")
    parser.add_argument("--kinds", nargs="*", help="of `delone generate`; all of them, if none is named")
    parser.add_argument("--hard", action="store_true", help="only time estimates of hard sets")
    arguments = parser.parse_args()
    if arguments.hard:
        return time_hard_estimates()
    sets = sets_of_files(arguments.files)
    if arguments.kinds is not None:
        sets = itertools.chain(sets, sets_of_kinds(arguments.kinds or ["uniform", "ball", "clusters", "cospherical", "flat", "gaussian", "grid",
                                                                       "manifold", "moment", "nudged_grid", "plummer", "sphere"]))
    beyond, total = dict.fromkeys(LEAST, 0), 0
    for name, points, forecast in sets:
        with multiprocessing.get_context("spawn").Pool(1) as pool:
            found = pool.apply(construct, (points,))
        ratios = {what: getattr(forecast, what) / found[what] for what in LEAST}
        outside = {what for what, ratio in ratios.items() if found[what] >= LEAST[what] and abs(math.log(ratio)) > math.log(PROMISED)}
        for what in outside:
            beyond[what] += 1
        total += 1
        shown = "  ".join(f"{what} {ratio:5.2f}{'*' if what in outside else ' '}" for what, ratio in ratios.items())
        print(f"{name:<36} {len(points):7} points  {found['cells']:9} cells  {found['seconds']:7.3f} s   {shown}", flush=True)
    print(f"{total} sets; beyond {PROMISED} (*): " + ", ".join(f"{count} {what}" for what, count in beyond.items()))


if __name__ == "__main__":
    main()
