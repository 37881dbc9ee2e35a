#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times jobs at which delone was, or is, slower than SciPy, or slow beside another job of its own; one thread, in turn in one run.

  PYTHONPATH=build/release/python rows.py             a table: processor time of delone and of the rival, and the ratio rival/delone
  PYTHONPATH=build/release/python rows.py --only wall     rows whose name contains a text, also repeated
  PYTHONPATH=build/release/python rows.py --only recorded     what it costs to record changes, or for undo
  PYTHONPATH=build/release/python rows.py --record    also benchmarks/history/DATE-COMMIT-rows.json

Figures are least values over the rounds, in milliseconds. A ratio above 1 means that delone is faster. The rival of rows "of ..." is
a job of delone itself, that of rows "within ..." a time, and theirs is time on the clock, not of the processor.
"""
import argparse
import itertools
import time

import numpy as np
import scipy.interpolate
import scipy.spatial

import delone
import delone.interpolate
import delone.spatial
import record

ROWS = {}


def row(name):
    """Registers a function that returns a job of delone and one of the rival, or the milliseconds that it may take."""
    def register(make):
        ROWS[name] = make
        return make
    return register


def random(seed=1):
    return np.random.default_rng(seed)


def scan(floor):
    return np.vstack([random().random((20000, 3)) * [10, 10, 3], floor])


def floor(n):
    return np.c_[np.round(random(2).random((n, 2)) * 20 - 5, 3), np.zeros(n)]


def disc(n):
    radius, angle = 10 * np.sqrt(random(2).random(n)), random(3).random(n) * 2 * np.pi
    return np.c_[radius * np.cos(angle), radius * np.sin(angle), np.zeros(n)]


def walls(n):
    points = random(2).random((n, 3)) * [10, 10, 3]
    axis, end = random(3).integers(0, 3, n), random(4).integers(0, 2, n)
    points[np.arange(n), axis] = end * np.array([10, 10, 3])[axis]
    return points


TURN = np.array([[.8, -.6, 0], [.48, .64, -.6], [.36, .48, .8]])
SCANS = {
    "floor 4e4": lambda: scan(floor(40000)), "floor 1.6e5": lambda: scan(floor(160000)), "turned floor 4e4": lambda: scan(floor(40000) @ TURN),
    "six walls 4e4": lambda: scan(walls(40000)), "disc 4e4": lambda: scan(disc(40000)),
    "4D wall 2e4": lambda: np.vstack([random().random((10000, 4)), np.c_[random(2).random((20000, 3)), np.zeros(20000)]]),
}
for title, points_of in SCANS.items():
    for way, hull in {"all points": delone.ConvexHull, "extreme points": delone.ConvexHull.of_extreme_points, "spatial": delone.spatial.ConvexHull}.items():
        def scan_row(points_of=points_of, hull=hull):
            points = points_of()
            return lambda: hull(points), lambda: scipy.spatial.ConvexHull(points)
        row(f"hull, {title}, {way}")(scan_row)


def signed_permutations():
    """The 18 matrices 3 x 3 with one entry 1 or -1, and the 24 signed permutation matrices of determinant -1."""
    points = [sign * np.eye(9)[k] for k in range(9) for sign in (1, -1)]
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[np.arange(3), order] = signs
            if round(np.linalg.det(matrix)) == -1:
                points.append(matrix.ravel())
    return np.array(points)


for unit in (1.0, 0.1):
    def signed_row(unit=unit):
        points = signed_permutations() * unit
        return lambda: delone.ConvexHull(points), lambda: scipy.spatial.ConvexHull(points)
    row(f"hull, 42 signed matrices 9D times {unit:g}")(signed_row)

for dimension, count in ((4, 244), (4, 1000), (5, 1000)):
    for way, hull in {"exact": delone.ConvexHull, "spatial": delone.spatial.ConvexHull}.items():
        def shares_row(dimension=dimension, count=count, hull=hull):
            shares = random().dirichlet(np.ones(dimension), count)
            points = np.c_[shares[:, :-1], (shares**2).sum(axis=1)]
            return lambda: hull(points), lambda: scipy.spatial.ConvexHull(points)
        row(f"hull, compositions {dimension}D {count}, {way}")(shares_row)

for dimension, count in ((2, 1000), (3, 1000), (3, 10000), (4, 1000)):
    def halfspaces_row(dimension=dimension, count=count):
        normals = random().normal(size=(count, dimension))
        rows = np.c_[normals / np.linalg.norm(normals, axis=1)[:, None], -1 - random(2).random(count)]
        inside = np.zeros(dimension)
        return lambda: delone.spatial.HalfspaceIntersection(rows, inside), lambda: scipy.spatial.HalfspaceIntersection(rows, inside)
    row(f"halfspaces {dimension}D {count}")(halfspaces_row)


@row("1000 hulls of 20 points 3D, one call each")
def small_hulls():
    sets = random().random((1000, 20, 3))
    return lambda: [delone.ConvexHull(each) for each in sets], lambda: [scipy.spatial.ConvexHull(each) for each in sets]


@row("1000 hulls of 20 points 3D, one call of spatial each")
def small_hulls_of_spatial():
    sets = random().random((1000, 20, 3))
    return lambda: [delone.spatial.ConvexHull(each) for each in sets], lambda: [scipy.spatial.ConvexHull(each) for each in sets]


@row("1000 single find_simplex, 1000 points 3D")
def single_queries():
    points, queries = random().random((1000, 3)), random(2).random((1000, 3))
    ours, theirs = delone.spatial.Delaunay(points), scipy.spatial.Delaunay(points)
    return lambda: [ours.find_simplex(each) for each in queries], lambda: [theirs.find_simplex(each) for each in queries]


@row("interpolation 3D, 2e5 sorted queries")
def interpolation():
    points, queries = random().random((10000, 3)), random(2).random((200000, 3))
    queries, values = queries[np.lexsort(queries.T)], random(3).random(10000)
    ours = delone.interpolate.LinearNDInterpolator(delone.spatial.Delaunay(points), values)
    theirs = scipy.interpolate.LinearNDInterpolator(scipy.spatial.Delaunay(points), values)
    return lambda: ours(queries), lambda: theirs(queries)


for name, ours, theirs in (("Voronoi", delone.spatial.Voronoi, scipy.spatial.Voronoi), ("Delaunay", delone.spatial.Delaunay, scipy.spatial.Delaunay)):
    def salt_row(ours=ours, theirs=theirs):
        points = np.stack(np.meshgrid(*[np.arange(10.0)] * 3, indexing="ij"), -1).reshape(-1, 3) * 2.82
        return lambda: ours(points), lambda: theirs(points)
    row(f"{name}, rock salt 10^3")(salt_row)


@row("hull with tolerance 1e-3, sphere 1e5, of the exact hull")
def tolerant_hull():
    points = random().normal(size=(100000, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    return lambda: delone.ConvexHull(points, tolerance=1e-3, threads=1), lambda: delone.ConvexHull(points, threads=1)


@row("location with tolerance 0.9, 20 of 20000 points 2D, of 20 exact ones")
def tolerant_location():
    triangulation, queries = delone.Delaunay(random().random((20000, 2))), random(2).random((20, 2))
    return lambda: triangulation.find_simplex(queries, tolerance=0.9), lambda: triangulation.find_simplex(queries)


for step in (0.001, 0.005, 0.01, 0.1):
    def time_step_row(step=step, n=300000):
        spacing = 0.554 * n ** (-1 / 3)  # the mean distance to the nearest neighbor of random points
        start = random(2).random((n, 3))
        ends = itertools.cycle([start + spacing * step / np.sqrt(3) * random(3).choice((-1, 1), start.shape), start])
        triangulation, rows = delone.Delaunay(start, threads=1), np.arange(n)
        return lambda: triangulation.move(rows, next(ends)), lambda: delone.Delaunay(start, threads=1)
    row(f"time step by {step:g} of the spacing, 3e5 points 3D, of a rebuild")(time_step_row)


for dimension, n, m in ((2, 100000, 2000), (4, 20000, 100), (5, 5000, 40), (6, 2000, 10)):
    def removal_row(dimension=dimension, n=n, m=m):
        triangulation = delone.Delaunay(random().random((n, dimension)), threads=1)
        rows, points = iter(random(2).permutation(n)), random(3)

        def remove():
            for each in itertools.islice(rows, m):
                triangulation.remove([each])

        def insert():
            for _ in range(m):
                triangulation.edit(insert=points.random((1, dimension)))

        return remove, insert
    row(f"{m} removals of {n} points {dimension}D, of insertions")(removal_row)


def moves(points, spacing, m):
    """A job that moves some of the points, one by one, by a tenth of the spacing, and in the next turn back."""
    triangulation, rows = delone.Delaunay(points, threads=1), random(2).permutation(len(points))[:m]
    moved = points[rows] + 0.1 * spacing * (random(3).random((m, points.shape[1])) - 0.5)
    ends = itertools.cycle((moved, points[rows]))

    def move():
        for each, to in zip(rows, next(ends)):
            triangulation.move([each], to[None])

    return move


for dimension, side, m in ((2, 316, 2000), (3, 46, 1000), (4, 12, 100), (5, 6, 10)):
    def lattice_row(dimension=dimension, side=side, m=m):
        lattice = np.stack(np.meshgrid(*[np.arange(float(side))] * dimension, indexing="ij"), -1).reshape(-1, dimension)
        return moves(lattice, 1, m), moves(random().random(lattice.shape), 1 / side, m)
    row(f"{m} moves in a lattice {side}^{dimension}, of uniform points")(lattice_row)


def recorded_jobs(dimension, n, recording):
    """Changes of copies, and the copies: name -> job. `recording`: "changes", "undo", or nothing."""
    def begin(triangulation):
        copy = triangulation.clone()
        if recording:
            getattr(copy, f"record_{recording}")()
        return copy

    points, others, rows = random().random((n, dimension)), random(2).random((n, dimension)), random(3).permutation(n)
    empty, built = (delone.Delaunay(part, threads=1) for part in (points[:0], points))
    return {"first batch": lambda: begin(empty).insert_range(points),
            "second batch": lambda: begin(built).insert_range(others),
            "rebuild": lambda: begin(built).move(np.arange(n), others),
            "removal of 10 %": lambda: begin(built).remove(rows[:n // 10])}


for dimension, n in ((2, 200000), (3, 100000), (4, 20000)):
    for recording in ("changes", "undo"):
        for name in ("first batch", "second batch", "rebuild", "removal of 10 %"):
            def recorded_row(name=name, recording=recording, dimension=dimension, n=n):
                return tuple(recorded_jobs(dimension, n, each)[name] for each in (recording, None))
            row(f"{recording} recorded {dimension}D {n}, {name}, of off record")(recorded_row)


for name, job_of in {"cells and boundary": lambda t: lambda: len(t.alpha_complex(0.02).boundary),
                     "all faces and values": lambda t: t.alpha_filtration}.items():
    def alpha_row(job_of=job_of):
        points = random().random((100000, 3))
        return job_of(delone.Delaunay(points, threads=1)), lambda: delone.Delaunay(points, threads=1)
    row(f"alpha complex 3D 1e5, {name}, of construction")(alpha_row)


for name, points_of in {"1000D, 3000 points": lambda: random().random((3000, 1000)), "12D, 2000 points": lambda: random().random((2000, 12)),
                        "10D, 50 points on mixed scales": lambda: random().normal(size=(50, 10)) * 10.0**random(2).integers(-150, 150, (50, 10)),
                        }.items():
    def estimate_row(points_of=points_of):
        points = points_of()
        return lambda: delone.estimate(points), 1500.0
    row(f"estimate, {name}, within 1.5 s")(estimate_row)


@row("time limit of 1 s, 4e6 points 3D, within 1.1 s")
def time_limit():
    points = random().random((4000000, 3))

    def job():
        try:
            delone.Delaunay(points, time_limit=1, threads=1)
        except delone.TimeLimitError:
            return
        raise RuntimeError("the limit was not reached")
    return job, 1100.0


def least(job, rounds, patience, clock=time.process_time):
    """The least time of some runs, in milliseconds; one run if it takes longer than that."""
    best = None
    for _ in range(rounds):
        start = clock()
        job()
        seconds = clock() - start
        best = seconds if best is None else min(best, seconds)
        if seconds > patience:
            break
    return round(best * 1000, 3)


def main():
    parser = argparse.ArgumentParser(description="Times jobs beside SciPy, one thread.")
    parser.add_argument("--only", action="append", help="rows whose name contains this text")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--record", action="store_true", help="write a record to benchmarks/history")
    arguments = parser.parse_args()
    results = {}
    print(f"{'row':62}{'delone ms':>11}{'rival ms':>11}{'ratio':>8}")
    for name, make in ROWS.items():
        if arguments.only and not any(text in name for text in arguments.only):
            continue
        ours, rival = make()
        if callable(rival):
            result = {"delone_ms": least(ours, arguments.rounds, 1), "rival_ms": least(rival, arguments.rounds, 1)}
        else:
            result = {"delone_ms": least(ours, arguments.rounds, 1, time.monotonic), "rival_ms": rival}
        result["ratio"] = float(f"{result['rival_ms'] / result['delone_ms']:.3g}")
        results[name] = result
        print(f"{name:62}{result['delone_ms']:11.2f}{result['rival_ms']:11.2f}{result['ratio']:8.3g}", flush=True)
    if arguments.record:
        print(record.write("rows", delone._core.__file__, results))


if __name__ == "__main__":
    main()
