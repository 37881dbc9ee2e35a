#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times the Python module against scipy: constructions, hulls, halfspaces, location of points, linear interpolation; on one core.

  PYTHONPATH=build/release/python benchmarks/python.py               a table
  PYTHONPATH=build/release/python benchmarks/python.py --record      also benchmarks/history/DATE-COMMIT-python.json

In each round both work on the same arrays, in turn. Figures are medians of processor times over the rounds, ratios are medians of
ratios. Construction includes the arrays of simplices and neighbors. SciPy always computes hyperplanes too; "with equations", delone
does as well.
"""
import argparse
import datetime
import itertools
import os
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
import delone.interpolate
import delone.spatial
import record

CONSTRUCTIONS = {2: 100_000, 3: 50_000, 4: 10_000, 5: 2_000, 6: 500, 7: 250}
LOCATIONS = {"3D": (3, 10_000, 1_000_000), "5D": (5, 2_000, 100_000)}
INTERPOLATIONS = {"2D": (2, 10_000, 1_000_000), "3D": (3, 10_000, 200_000), "5D": (5, 2_000, 50_000)}


def uniform(dimension, n, seed):
    return np.random.default_rng(seed).random((n, dimension))


def construct(module, points, attribute):
    tri = module.Delaunay(points)
    return tri.simplices, tri.neighbors, getattr(tri, attribute)


def ball(dimension, n, seed):
    random = np.random.default_rng(seed)
    points = random.standard_normal((n, dimension))
    return points / np.linalg.norm(points, axis=1)[:, None] * random.random((n, 1)) ** (1 / dimension)


def phases(components, n, seed):
    """Points of a phase diagram: compositions with small denominators, many of them with few components, and energies. Most of
    them are coplanar with many others, up to rounding."""
    random = np.random.default_rng(seed)
    parts = np.array(list(itertools.product(range(7), repeat=components)))[1:]
    random.shuffle(parts)
    parts = parts[((parts > 0).sum(axis=1) <= 3) | (random.random(len(parts)) < 0.3)]
    fractions = parts / parts.sum(axis=1, keepdims=True)
    first = np.sort(np.unique(fractions, axis=0, return_index=True)[1])[:n]
    fractions = fractions[first]
    energies = -2 * np.round(random.random(len(fractions)), 4) * (1 - (fractions**2).sum(axis=1))
    elements = np.eye(components)
    return np.vstack([np.column_stack([fractions[:, :-1], energies]), np.column_stack([elements[:, :-1], np.zeros(components)]),
                      np.append(np.full(components - 1, 1 / components), 1.0)])


def halfspaces(dimension, n, seed, depth):
    """Halfspaces that contain the origin, at distances from 1 to 1 + depth: with depth 0 none is redundant."""
    random = np.random.default_rng(seed)
    normals = random.standard_normal((n, dimension))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    return np.column_stack([normals, -1 - depth * random.random(n)])


HULLS = {"2D, 1000000 points in a square": lambda: uniform(2, 1_000_000, 1), "3D, 100000 points in a cube": lambda: uniform(3, 100_000, 1),
         "3D, 1000000 points in a cube": lambda: uniform(3, 1_000_000, 1), "3D, 100000 points in a ball": lambda: ball(3, 100_000, 1),
         "4D, 100000 points in a cube": lambda: uniform(4, 100_000, 1), "5D, 20000 points in a cube": lambda: uniform(5, 20_000, 1),
         "4D, 244 compositions": lambda: phases(4, 244, 1), "4D, 1000 compositions": lambda: phases(4, 1000, 3),
         "5D, 1000 compositions": lambda: phases(5, 1000, 2)}
HALFSPACES = {"2D, 1000 halfspaces": (2, 1000, 0), "3D, 1000 halfspaces": (3, 1000, 0), "3D, 10000 halfspaces": (3, 10_000, 0),
              "3D, 10000 halfspaces, most redundant": (3, 10_000, 1), "4D, 1000 halfspaces": (4, 1000, 0)}


def hull(module, points):
    found = module.ConvexHull(points)
    return found.simplices, found.neighbors, found.vertices


def hull_of_all(points):
    """With the points that are not extreme."""
    found = delone.ConvexHull(points)
    return found.cells, found.neighbors, found.vertices


def intersection(module, rows):
    found = module.HalfspaceIntersection(rows, np.zeros(rows.shape[1] - 1))
    return found.intersections, found.dual_facets


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
    for name, make in HULLS.items():
        points = make()
        # Qhull merges facets, and points within its rounding are no vertices.
        about = lambda a, b: abs(len(a[2]) - len(b[2])) <= 0.3 * len(a[2])
        yield f"hull, {name}", lambda: hull(delone.spatial, points), lambda: hull(scipy.spatial, points), about
        yield f"hull of all, {name}", lambda: hull_of_all(points), lambda: hull(scipy.spatial, points), about
    for name, (dimension, n, depth) in HALFSPACES.items():
        rows = halfspaces(dimension, n, 1, depth)
        yield (name, lambda: intersection(delone.spatial, rows), lambda: intersection(scipy.spatial, rows),
               lambda a, b: len(a[0]) == len(b[0]))
    for dimension in (2, 3, 4):
        sets = uniform(dimension, 20_000, 1).reshape(1000, 20, dimension)
        same = lambda a, b: a == b
        one_by_one = lambda module: sum(len(module.ConvexHull(points).vertices) for points in sets)
        yield (f"{dimension}D, 1000 hulls of 20 points", lambda: len(delone.convex_hulls(sets).vertices),
               lambda: one_by_one(scipy.spatial), same)
        yield (f"{dimension}D, 1000 hulls of 20 points, one by one", lambda: one_by_one(delone.spatial),
               lambda: one_by_one(scipy.spatial), same)
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


def queries_of_programs():
    """Location as programs use it: queries in the order of a grid, one by one, and on a border that rounding has made uneven."""
    points, grid = uniform(3, 20_000, 1), np.stack(np.meshgrid(*[np.linspace(.01, .99, 59)] * 3, indexing="ij"), -1).reshape(-1, 3)[:200_000]
    close = lambda a, b: np.allclose(a, b, rtol=1e-6, atol=1e-6, equal_nan=True)
    same = lambda a, b: (a < 0).sum() == (b < 0).sum()
    ours = delone.interpolate.LinearNDInterpolator(points, values_at(points))
    theirs = scipy.interpolate.LinearNDInterpolator(points, values_at(points))
    theirs(grid[:2])
    for order, queries in (("sorted", grid), ("random", uniform(3, 200_000, 2))):
        yield (f"3D, {len(points)} points: interpolation at {len(queries)} {order}", lambda: ours(queries), lambda: theirs(queries), close)
    for dimension in (2, 3):
        points, queries = uniform(dimension, 10_000, 1), uniform(dimension, 2_000, 2)
        ours, theirs = delone.spatial.Delaunay(points), scipy.spatial.Delaunay(points)
        theirs.transform
        yield (f"{dimension}D, {len(points)} points: find_simplex, {len(queries)} times one",
               lambda: np.array([ours.find_simplex(q) for q in queries]), lambda: np.array([theirs.find_simplex(q) for q in queries]), same)
    for dimension, size in ((2, 40), (3, 12)):
        points, queries = turned_grid_and_border(dimension, size, 2_000)
        ours, theirs = delone.spatial.Delaunay(points), scipy.spatial.Delaunay(points)
        ours.find_simplex(queries), theirs.find_simplex(queries)
        yield (f"{dimension}D, turned grid: find_simplex of {len(queries)} on its border", lambda: ours.find_simplex(queries),
               lambda: theirs.find_simplex(queries), lambda a, b: (a < 0).sum() <= (b < 0).sum())
        mine = delone.interpolate.LinearNDInterpolator(ours, values_at(points))
        other = scipy.interpolate.LinearNDInterpolator(theirs, values_at(points))
        yield (f"{dimension}D, turned grid: interpolation at {len(queries)} on its border", lambda: mine(queries), lambda: other(queries),
               lambda a, b: np.isnan(a).sum() <= np.isnan(b).sum())


def turned_grid_and_border(dimension, size, count):
    """The points of a cubic grid turned by 31.5 degrees, and uniform points on the faces of the cube that it fills, turned likewise."""
    turn = np.eye(dimension)
    angle = np.deg2rad(31.5)
    for axis in range(dimension - 1):
        plane = np.eye(dimension)
        plane[axis:axis + 2, axis:axis + 2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        turn = turn @ plane
    points = np.stack(np.meshgrid(*[np.arange(size + 1.0)] * dimension, indexing="ij"), -1).reshape(-1, dimension)
    random = np.random.default_rng(3)
    border = size * random.random((count, dimension))
    border[np.arange(count), random.integers(0, dimension, count)] = size * random.integers(0, 2, count)
    return points @ turn.T, border @ turn.T


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
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # delone would use all cores

    print(f"{'experiment':<60}{'delone, s':>10}{'scipy, s':>10}{'scipy / delone':>16}")
    results = {}
    for name, ours, theirs, same in itertools.chain(experiments(), queries_of_programs()):
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
        print(f"{name:<60}{figures['delone']:>10.3f}{figures['scipy']:>10.3f}{figures['ratio']:>16.1f}", flush=True)

    if options.record:
        commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=record.ROOT, capture_output=True, text=True).stdout.strip()
        date = datetime.date.today().isoformat()
        record.save("python", {"date": date, "commit": commit, "machine": machine(), "threads": 1, "rounds": options.rounds,
                               "python": platform.python_version(), "numpy": np.__version__, "scipy": scipy.__version__, "delone": delone.__version__,
                               "results": results})


if __name__ == "__main__":
    main()
