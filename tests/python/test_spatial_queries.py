# SPDX-License-Identifier: BSD-3-Clause
"""delone.spatial.Delaunay.find_simplex sorts out queries beyond the points before it looks for simplices; and short imports."""
import math
import subprocess
import sys

import numpy as np
import pytest

from delone import spatial
from delone.spatial import _delaunay


class Counting:
    """A triangulation that counts the queries that it answers."""

    def __init__(self, core):
        self._core, self.located, self.searched = core, 0, 0

    def __getattr__(self, name):
        return getattr(self._core, name)

    def find_simplex(self, queries, **options):
        self.located += len(np.atleast_2d(queries))
        return self._core.find_simplex(queries, **options)

    def _find_accepting(self, queries, *more):
        self.searched += len(queries)
        return self._core._find_accepting(queries, *more)


def counted(points):
    tri = spatial.Delaunay(points)
    tri._core = Counting(tri._core)
    return tri


def turned(points):
    turn = np.array([[np.cos(0.55), -np.sin(0.55)], [np.sin(0.55), np.cos(0.55)]])
    return np.concatenate([points[:, :2] @ turn.T, points[:, 2:]], axis=1)


def grid(side, dimension):
    return np.stack(np.meshgrid(*[np.arange(float(side))] * dimension), -1).reshape(-1, dimension)


SETS = [np.random.default_rng(1).random((20, 2)), np.random.default_rng(2).random((20, 3)), np.random.default_rng(3).random((400, 3)),
        turned(grid(5, 2)), turned(grid(4, 3)) * 1e-3 + 7, np.random.default_rng(4).random((9, 4)) * [1, 1e-9, 1e3, 1],
        np.random.default_rng(5).standard_normal((30, 2)) * 1e300, np.random.default_rng(6).random((40, 2)) * [1, 1e-13]]


@pytest.mark.parametrize("points", SETS)
@pytest.mark.parametrize("tol", [None, 0, 1e-9, 0.3])
def test_what_is_sorted_out_has_no_simplex(points, tol):
    """The same answers as a search for every query, asked at once, a few at a time, and one by one."""
    random = np.random.default_rng(8)
    low, high = points.min(axis=0), points.max(axis=0)
    around = low + (high - low) * (random.random((300, points.shape[1])) * 1.4 - 0.2)
    corners = points[random.integers(len(points), size=(300, 2))]
    between = corners[:, 0] + (corners[:, 1] - corners[:, 0]) * random.random((300, 1))
    off = between + (high - low) * random.standard_normal(between.shape) * 10.0**-random.integers(6, 18, (300, 1))
    queries = np.concatenate([around, between, off, points, low[None], high[None], 2 * high[None] - low])
    tri = spatial.Delaunay(points)
    search, used = tri._search, _delaunay.DEFAULT_TOLERANCE if tol is None else tol
    broad = math.sqrt(used) if search.has_thin else used
    expected = np.array(tri._core.find_simplex(queries))
    unsure = (expected < 0) | search.is_thin[expected]
    reach = min(1.5 * _delaunay._reach(max(broad, used), tri.ndim, search.diameter), 1e300)
    accepting = tri._core._find_accepting(queries[unsure], tri.transform, tri.neighbors, used, broad, reach)
    expected[unsure] = np.where(accepting >= 0, accepting, expected[unsure])
    few = np.concatenate([tri.find_simplex(some, tol=tol) for some in np.array_split(queries, 40)])
    single = [int(tri.find_simplex(query, tol=tol)) for query in queries]
    for found in (tri.find_simplex(queries, tol=tol), few, np.array(single)):
        np.testing.assert_array_equal(found >= 0, expected >= 0)
        other = np.flatnonzero(found != expected)  # on a face of both
        maps = tri.transform[found[other]]
        weights = np.einsum("qij,qj->qi", maps[:, :-1], queries[other] - maps[:, -1])
        assert not (np.c_[weights, 1 - weights.sum(axis=1)] < -max(broad, 1e-9)).any()


def test_queries_far_outside_are_not_located():
    points, random = np.random.default_rng(0).random((200, 3)), np.random.default_rng(1)
    tri = counted(points)
    assert (tri.find_simplex(random.random((20_000, 3)) + 100) == -1).all()
    assert tri._core.located == tri._core.searched == 0
    queries = random.random((1000, 3)) * 3 - 1
    tri.find_simplex(queries)
    assert tri._core.located <= 60
    for few in (np.full(3, 5.0), np.full((9, 3), 5.0)):
        assert (tri.find_simplex(few) == -1).all()
    tri = counted(points)
    assert tri.find_simplex([2.0, 0.5, 0.5]) == -1 and "transform" not in vars(tri)


def test_queries_beyond_a_facet_are_not_searched():
    tri = counted(np.random.default_rng(0).random((20, 3)))
    queries = np.random.default_rng(1).random((10_000, 3))
    found = tri.find_simplex(queries)
    assert np.count_nonzero(found < 0) > 1000 and tri._core.searched < 10


def test_queries_that_are_not_finite_have_no_simplex():
    tri = spatial.Delaunay(np.random.default_rng(0).random((20, 2)))
    queries = np.random.default_rng(1).random((100, 2))
    expected = tri.find_simplex(queries)
    queries[3, 1], queries[5, 0], queries[7] = np.nan, np.inf, -np.inf
    expected[[3, 5, 7]] = -1
    np.testing.assert_array_equal(tri.find_simplex(queries), expected)
    np.testing.assert_array_equal(tri.find_simplex(queries[:10]), expected[:10])
    assert [int(tri.find_simplex(queries[i])) for i in (3, 5, 7)] == [-1] * 3


def test_imports_compile_no_patterns_and_no_types():
    """The first use of a hull in a program is mostly the import."""
    code = """
import dataclasses, inspect, numpy, re, sys
compiled, compile = [], re.compile
re.compile = lambda *arguments: compiled.append(arguments) or compile(*arguments)
before = "numpy.typing" in sys.modules
import delone.spatial
print(compiled, "numpy.typing" in sys.modules and not before)
"""
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[] False\n"


@pytest.mark.parametrize("points", [np.random.default_rng(3).random((400, 3)), np.array([[0, 0], [2, 1], [4, 2], [6, 3.0]])])
@pytest.mark.parametrize("furthest", [False, True])
def test_single_queries_of_all_forms_get_the_answer_of_a_batch(points, furthest):
    tri = spatial.Delaunay(points, furthest_site=furthest, flat="result")
    inside = 0.6 * points[:20] + 0.4 * points[1:21].mean(axis=0)  # in one simplex each
    queries = np.concatenate([inside, 3 * inside - 1, 1.01 * points[:20], points.mean(axis=0)[None] + 1e-9])
    expected = tri.find_simplex(queries).tolist()
    wide = np.repeat(queries, 2, axis=1)
    forms = [lambda i: queries[i], lambda i: wide[i, ::2], lambda i: queries[i].tolist(), lambda i: queries[i].astype(np.longdouble),
             lambda i: np.asfortranarray(queries[i][None])[0], lambda i: queries[i].astype(object), lambda i: np.ma.array(queries[i])]
    for form in forms:
        found = [tri.find_simplex(form(i)) for i in range(len(queries))]
        assert [int(each) for each in found] == expected
        assert all(type(each) is np.ndarray and each.shape == () and each.dtype == np.intc for each in found)
    for bad in (np.nan, np.inf, 1e300, -1e308):
        assert tri.find_simplex(np.full(points.shape[1], bad)) == -1
    with pytest.raises(ValueError):
        tri.find_simplex(np.zeros(points.shape[1] + 1))


def test_single_queries_follow_added_points():
    points = np.random.default_rng(5).random((60, 2))
    tri = spatial.Delaunay(points[:30], incremental=True)
    assert tri.find_simplex(points[0]) >= 0
    tri.add_points(points[30:] + 5)
    assert tri.find_simplex(points[40] + 5) >= 0
