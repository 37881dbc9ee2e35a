#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times delone.polyhedra_vertices from Python, with one thread, against a loop in C over cddlib's rational arithmetic.

  PYTHONPATH=build/bench/python benchmarks/polyhedra.py build/bench              a table
  PYTHONPATH=build/bench/python benchmarks/polyhedra.py build/bench --record     also benchmarks/history/DATE-COMMIT-polyhedra.json

Figures are medians over the rounds of processor time for a polyhedron, in microseconds. That of cddlib is without the conversion of numbers;
that of delone begins and ends with NumPy arrays. Both must find the same number of generators.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import delone
import record


def integers(random, n, m, d):
    return random.integers(-9, 10, (n, m, d)).astype(float), random.integers(1, 20, (n, m)).astype(float)


def lattice(random, n, m, d):
    """Many vertices with more than d facets."""
    return random.integers(-1, 2, (n, m, d)).astype(float), random.integers(1, 3, (n, m)).astype(float)


def doubles(random, n, m, d):
    return random.standard_normal((n, m, d)), random.random((n, m)) + 0.5


def cut_boxes(random, n, m, d):
    """Boxes around the origin, and cuts through them."""
    box = np.broadcast_to(np.concatenate([np.eye(d), -np.eye(d)]), (n, 2 * d, d))
    cuts = random.standard_normal((n, m - 2 * d, d))
    return np.concatenate([box, cuts], axis=1), np.concatenate([np.ones((n, 2 * d)), random.random((n, m - 2 * d))], axis=1)


# name -> (kind, polyhedra, inequalities, dimension)
STANDARD = {"integers 3D 8": (integers, 20_000, 8, 3), "doubles 3D 8": (doubles, 5_000, 8, 3), "lattice 3D 8": (lattice, 20_000, 8, 3),
            "cut boxes 3D 8": (cut_boxes, 10_000, 8, 3), "integers 2D 6": (integers, 20_000, 6, 2), "doubles 4D 12": (doubles, 1_000, 12, 4)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--record", action="store_true", help="write the figures to benchmarks/history/")
    options = parser.parse_args()
    rival = options.build / "rivals" / "polyhedra_cddlib_gmp"
    results = {}
    print(f"{'polyhedra':<16}{'generators':>11}{'cddlib us':>11}{'delone us':>11}{'ratio':>8}")
    with tempfile.TemporaryDirectory() as folder:
        for name, (kind, n, m, d) in STANDARD.items():
            A, b = kind(np.random.default_rng(1), n, m, d)
            np.save(f"{folder}/rows.npy", np.concatenate([A, b[:, :, None]], axis=2).reshape(n * m, d + 1))
            ours, theirs = [], []
            for _ in range(options.rounds):
                begin = time.process_time()
                found = delone.polyhedra_vertices(A, b, threads=1)
                ours.append((time.process_time() - begin) / n * 1e6)
                run = subprocess.run([rival, f"{folder}/rows.npy", "--rows", str(m)], capture_output=True, text=True, check=True)
                report = json.loads(run.stdout)
                theirs.append(report["cpu_seconds"][0] / n * 1e6)
            count = len(found.vertices) + len(found.rays) + len(found.lines)
            if count != report["cells"]:
                sys.exit(f"{name}: {count} generators by delone, {report['cells']} by cddlib")
            figures = results[name] = {"polyhedra": n, "generators": count, "cddlib_us": statistics.median(theirs), "delone_us": statistics.median(ours)}
            print(f"{name:<16}{count:>11}{figures['cddlib_us']:>11.1f}{figures['delone_us']:>11.2f}{figures['cddlib_us'] / figures['delone_us']:>8.1f}", flush=True)
    if options.record:
        print("recorded in", record.write("polyhedra", rival, results).relative_to(record.ROOT))


if __name__ == "__main__":
    main()
