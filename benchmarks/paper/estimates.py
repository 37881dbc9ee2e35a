# SPDX-License-Identifier: BSD-3-Clause
"""Rough estimates of what a run will take, before anything has been measured: for the order of the cases, for --minutes and for
--dry-run. No figure of the write-up depends on them."""

# program -> dimension -> (points, processor seconds, exponent) of uniform points on a machine of about 2022
UNIFORM = {
    "delone": {2: (1e6, 0.5, 1.02), 3: (1e6, 1.7, 1.03), 4: (1e5, 0.9, 1.09), 5: (32e3, 2.3, 1.12), 6: (8e3, 4.5, 1.25), 7: (1e3, 2.7, 1.4),
               8: (500, 8.0, 1.6)},
    "cgal_d": {2: (1e6, 1.8, 1.02), 3: (1e6, 13.8, 1.03), 4: (1e5, 11.7, 1.09), 5: (1e4, 13.2, 1.25), 6: (1e3, 9.2, 1.5), 7: (1e3, 50.0, 1.6)},
    "qhull": {2: (1e6, 7.0, 1.08), 3: (1e6, 34.0, 1.05), 4: (1e5, 25.0, 1.09), 5: (1e4, 17.0, 1.25), 6: (1e3, 8.4, 1.6), 7: (1e3, 79.0, 2.0),
              8: (120, 10.0, 3.0)},
    "cgal_2": {2: (1e6, 0.8, 1.02)},
    "cgal_3": {3: (1e6, 5.0, 1.03)},
    "cgal_3_parallel": {3: (1e6, 6.0, 1.03)},
    "triangle": {2: (1e6, 1.2, 1.05)},
    "delaunator": {2: (1e6, 1.1, 1.1)},
    "geogram": {2: (1e6, 1.4, 1.05), 3: (1e6, 4.0, 1.03)},
    "hxt": {3: (1e6, 2.7, 1.03)},
    "tetgen": {3: (1e6, 6.2, 1.03)},
    "cddlib": {2: (240, 0.025, 2.0), 3: (120, 0.035, 2.3), 4: (60, 0.03, 2.7), 5: (30, 0.02, 3.0), 6: (30, 0.1, 3.0)},
    "cddlib_gmp": {2: (120, 0.4, 2.5), 3: (60, 0.5, 3.0), 4: (30, 0.4, 3.0), 5: (30, 3.0, 3.0), 6: (30, 10.0, 3.0)},
    "lrs": {2: (240, 0.2, 1.8), 3: (120, 0.33, 2.1), 4: (30, 0.05, 2.5), 5: (30, 0.3, 3.0), 6: (30, 2.0, 3.0)},
}
LIKE = {"delone:report": ("delone", 1.1), "delone:curve": ("delone", 1.1), "delone:shuffled": ("delone", 3.0), "scipy": ("qhull", 1.1),
        "qhull_qt": ("qhull", 1.2), "clarkson": ("delone", 10.0)}
# Peak memory of delone on uniform points, at the largest sizes.
BYTES_PER_POINT = {2: 250, 3: 800, 4: 3_500, 5: 18_600, 6: 145_000, 7: 700_000, 8: 2_500_000}
# Time of other inputs as a multiple of that of uniform points; for hulls, of points on a sphere, of one dimension less.
INPUT = {"uniform": 1.0, "order": 1.0, "manifold": 1.0, "small": 1.0, "hulls": 1.0, "degenerate": 1.5, "tiny": 2.0}
MANIFOLD = {2: 1.5, 3: 4.0, 4: 3.0, 5: 2.5, 6: 1.5}
REAL_POINTS = 2_000
START_SECONDS = {"scipy": 0.5, "lrs": 0.2, "hull_lrs": 0.2, "clarkson": 0.2}
CHECK_SECONDS_PER_CASE = 0.5


def construction_seconds(experiment, program, dimension, points):
    """Processor seconds of one construction; 0 if unknown."""
    like, factor = LIKE.get(program, (program, 1.0))
    if program.startswith("hull_"):
        like, dimension = program.removeprefix("hull_").replace("cgal", "cgal_d"), dimension - 1
    known = UNIFORM.get(like, {}).get(dimension)
    if not known:
        return 0.0
    size, seconds, exponent = known
    if experiment == "manifold":
        factor *= MANIFOLD[dimension]
    return INPUT[experiment] * factor * seconds * ((points or REAL_POINTS) / size) ** exponent


def turns(seconds, limits):
    """The number of turns of a program that takes so long."""
    done = 1
    while done < limits.rounds and done * seconds <= limits.turn_seconds:
        done += 1
    return done


def process_seconds(program, seconds, limits):
    """All turns of a program that takes so long to construct, with the overhead of a process; 0 if it would not be tried."""
    if seconds > limits.of(program):
        return 0.0
    whole = 1.1 * seconds + START_SECONDS.get(program, 0.03)
    return whole * turns(whole, limits)


def case_seconds(case, limits):
    """A case, roughly, all programs and turns."""
    if case.points * BYTES_PER_POINT.get(case.dimension, 0) > limits.memory_bytes and case.experiment == "uniform":
        return 0.0
    total = sum(process_seconds(key, construction_seconds(case.experiment, key, case.dimension, case.points), limits)
                for key in case.programs if key != "clarkson")
    return total + CHECK_SECONDS_PER_CASE * (case.experiment in ("degenerate", "tiny"))
