# SPDX-License-Identifier: BSD-3-Clause
"""Forecasts, and limits of memory and time that end a construction."""
import math
import pickle
import re
import warnings

import numpy as np
import pytest

import delone

BYTES, TIME = r"[\d.]+ [kMGTPE]?B", r"[\d.]+ \w+"
WHOLE = rf"; the whole would have taken about {BYTES} \({BYTES} to {BYTES}\) and about {TIME} \({TIME} to {TIME}\)"


def points_of(n, dimension):
    return np.random.default_rng(1).random((n, dimension))


def on_sphere(n, dimension):
    points = np.random.default_rng(0).standard_normal((n, dimension))
    return points / np.linalg.norm(points, axis=1, keepdims=True)


@pytest.mark.parametrize("dimension, n", [(2, 3000), (3, 1500), (5, 400)])
def test_forecasts_are_close(dimension, n):
    points = points_of(n, dimension)
    cells = delone.Delaunay(points).num_cells
    for forecast in (delone.forecast(dimension, n), delone.estimate(points)):
        assert abs(math.log(forecast.cells / cells)) < math.log(1.5)
        assert (forecast.dimension, forecast.affine_dimension, forecast.num_points) == (dimension, dimension, n)
        for name in ("cells", "bytes", "seconds"):
            low, high = getattr(forecast, name + "_range")
            assert low <= getattr(forecast, name) <= high
        again = pickle.loads(pickle.dumps(forecast))
        assert repr(again) == repr(forecast) and again.seconds_range == forecast.seconds_range and again.num_sampled == forecast.num_sampled
        assert re.fullmatch(rf"<delone.Forecast: {n} points in {dimension}D, about \S+ cells, \S+ \w+, \S+ \w+>", repr(forecast))


def test_bad_arguments():
    with pytest.raises(ValueError, match="kind: ball, .*, uniform; not 'unknown'"):
        delone.forecast(3, 10, "unknown")
    with pytest.raises(ValueError, match="dimension"):
        delone.forecast(0, 10)
    with pytest.raises(ValueError, match="threads"):
        delone.forecast(3, 10, threads=-1)
    for bad in (0, -1, math.nan, math.inf):
        with pytest.raises(ValueError, match="sample_seconds"):
            delone.estimate(points_of(10, 2), sample_seconds=bad)
        for limit in ("time_limit", "memory_limit"):
            with pytest.raises(ValueError, match=limit):
                delone.Delaunay(points_of(10, 2), **{limit: bad})
    for bad in ("long", True):
        with pytest.raises(TypeError, match="time_limit"):
            delone.Delaunay(points_of(10, 2), time_limit=bad)
    with pytest.raises(delone.InputError, match="points: row 1, column 1"):
        delone.estimate([[0, 0], [0, math.nan]])


MANY, SPHERE = points_of(100_000, 5), on_sphere(50_000, 7)
MAKERS = {
    "Delaunay": lambda **limits: delone.Delaunay(MANY, **limits),
    "Regular": lambda **limits: delone.Regular(MANY, np.zeros(len(MANY)), **limits),
    "ConvexHull": lambda **limits: delone.ConvexHull(SPHERE, **limits),
    "of_extreme_points": lambda **limits: delone.ConvexHull.of_extreme_points(SPHERE, **limits),
    "lower_hull": lambda **limits: delone.lower_hull(SPHERE, **limits),
    "convex_hulls": lambda **limits: delone.convex_hulls([SPHERE], **limits),
    "HalfspaceIntersection": lambda **limits: delone.HalfspaceIntersection(np.c_[SPHERE, -np.ones(len(SPHERE))], [0] * 7, **limits),
}


@pytest.mark.parametrize("name", MAKERS)
def test_a_limit_of_time_ends_constructions(name):
    with pytest.raises(delone.TimeLimitError, match="stopped at the limit of 0.2 seconds") as caught:
        MAKERS[name](time_limit=0.2)
    assert isinstance(caught.value, (delone.Error, TimeoutError))


@pytest.mark.parametrize("name", ["Delaunay", "lower_hull"])
def test_a_limit_of_memory_ends_constructions(name):
    with pytest.raises(delone.OutOfMemoryError, match="stopped at the limit of 1 MB") as caught:
        MAKERS[name](memory_limit=1e6)
    assert isinstance(caught.value, MemoryError)


def test_the_whole_is_told():
    with pytest.raises(delone.TimeLimitError, match=r"with (less than )?\d+ % of the points inserted" + WHOLE):
        delone.Delaunay(points_of(20_000, 5), threads=1, time_limit=0.4)


def test_a_wrapped_set_says_what_the_whole_takes():
    with pytest.raises(delone.TimeLimitError, match="while cells were made" + WHOLE):
        delone.Delaunay(points_of(3000, 7), time_limit=0.3)


def test_a_set_larger_than_memory_is_a_warning():
    large = points_of(3000, 12)  # petabytes
    with pytest.warns(RuntimeWarning, match=rf"expected to take about \S+ [TPE]B of memory \({BYTES} to {BYTES}\), but only {BYTES} is available$"):
        with pytest.raises(delone.CancelledError):
            delone.Delaunay(large, progress=lambda fraction: False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(RuntimeWarning):
            delone.Regular(large, np.zeros(len(large)))
        with pytest.raises(delone.TimeLimitError):  # a limit says it
            delone.Delaunay(large, time_limit=0.1)
        with pytest.raises(delone.OutOfMemoryError):
            delone.Delaunay(large, memory_limit=1e6)
        delone.Delaunay(points_of(1000, 5))
        delone.FurthestSite(points_of(1000, 2))


def test_an_estimate_ends_also_within_a_sample():
    found = delone.estimate(points_of(1100, 1000))  # a sample of 1003 points would take hours
    assert found.num_sampled == 0
    assert found.seconds_range[1] > 100 * found.seconds_range[0]


def test_what_was_there_stays():
    triangulation = delone.Delaunay(points_of(100, 5), time_limit=0.4)
    before = triangulation.hash
    for _ in range(2):  # the limit stays, whatever has been asked meanwhile
        with pytest.raises(delone.TimeLimitError):
            triangulation.insert_range(MANY + 2)
        assert triangulation.num_points == 100
        assert triangulation.hash == before
    triangulation.insert_range(points_of(10, 5) + 2)
    assert triangulation.num_points == 110


def test_progress_is_heard_within_limits():
    heard = []
    delone.Delaunay(points_of(40_000, 3), progress=lambda fraction: heard.append(fraction), time_limit=100, memory_limit=1e12)
    assert heard == sorted(heard)
