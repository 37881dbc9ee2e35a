# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C at any line while points are added to an object of delone.spatial: its arrays are those of the points that it then has."""
import copy
import os
import pickle
import sys

import numpy as np
import pytest

from delone import spatial

RANDOM = np.random.default_rng(5)
FIRST, MORE = RANDOM.random((8, 2)), RANDOM.random((4, 2)) * 3
FOLDER = os.path.dirname(spatial.__file__)
SQUARE = np.array([[1.0, 0, -1], [-1, 0, -1], [0, 1, -1], [0, -1, -1]])
CUT = np.array([[1.0, 1, -1], [-1, 1, -1]])


class Stop(BaseException):
    pass


def stopped(action, line):
    """Whether the action raised Stop at the n-th line that it ran in delone.spatial, or had fewer."""
    left = line

    def trace(frame, event, argument):
        nonlocal left
        if not frame.f_code.co_filename.startswith(FOLDER):
            return None
        if event in ("line", "return"):
            left -= 1
            if left == 0:
                raise Stop
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        action()
    except Stop:
        return True
    finally:
        sys.settrace(before)
    return False


def cells(made, name):
    return sorted(tuple(sorted(cell)) for cell in getattr(made, name).tolist())


def check_delaunay(made):
    fresh = spatial.Delaunay(made.points)
    assert made.npoints == len(made.points) and made.nsimplex == len(made.simplices) == len(made.neighbors)
    assert cells(made, "simplices") == cells(fresh, "simplices") and cells(made, "convex_hull") == cells(fresh, "convex_hull")
    np.testing.assert_array_equal(made.max_bound, fresh.max_bound)
    assert (made.find_simplex(made.points) >= 0).all() and len(made.transform) == made.nsimplex


def check_hull(made):
    fresh = spatial.ConvexHull(made.points)
    assert made.npoints == len(made.points) and made.nsimplex == len(made.equations) and np.isclose(made.volume, fresh.volume)
    assert cells(made, "simplices") == cells(fresh, "simplices") and sorted(made.vertices) == sorted(fresh.vertices)
    assert made.coplanar.tolist() == fresh.coplanar.tolist() and made.affine_dimension == 2


def check_voronoi(made):
    fresh = spatial.Voronoi(made.points)
    assert made.npoints == len(made.points) == len(made.point_region) and len(made.ridge_points) == len(made.ridge_vertices)
    assert cells(made, "ridge_points") == cells(fresh, "ridge_points") and len(made.vertices) == len(fresh.vertices)
    assert made.tolerance == fresh.tolerance and max(made.point_region) == len(made.regions) - 1 and made.ridge_dict


def check_halfspaces(made):
    fresh = spatial.HalfspaceIntersection(made.halfspaces, [0, 0])
    assert made.nineq == len(made.halfspaces) == len(made.dual_points) and made.ndim == 2 and made.is_bounded
    assert sorted(made.intersections.tolist()) == sorted(fresh.intersections.tolist())
    assert np.isclose(made.dual_area, fresh.dual_area) and len(made.dual_facets) == len(fresh.dual_facets)


KINDS = {
    "Delaunay": (lambda: spatial.Delaunay(FIRST, incremental=True), lambda made, **how: made.add_points(MORE, **how), check_delaunay),
    "ConvexHull": (lambda: spatial.ConvexHull(FIRST, incremental=True), lambda made, **how: made.add_points(MORE, **how), check_hull),
    "Voronoi": (lambda: spatial.Voronoi(FIRST, incremental=True), lambda made, **how: made.add_points(MORE, **how), check_voronoi),
    "HalfspaceIntersection": (lambda: spatial.HalfspaceIntersection(SQUARE, [0, 0], incremental=True),
                              lambda made, **how: made.add_halfspaces(CUT, **how), check_halfspaces),
}


@pytest.mark.parametrize("restart", [False, True])
@pytest.mark.parametrize("kind", KINDS)
def test_stopped_at_any_line(kind, restart):
    make, add, check = KINDS[kind]
    sizes, lines = [], 0
    while True:
        lines += 1
        made = make()
        start = len(made._points)
        if not stopped(lambda: add(made, restart=restart), lines):
            break
        uses = [lambda: None, lambda: copy.deepcopy(made), lambda: pickle.dumps(made)]
        uses[lines % 3]()
        check(made)
        sizes.append(len(made._points) - start)
        if lines % 5 == 0:  # it can go on
            add(made)
            check(made)
    added = len(CUT if kind == "HalfspaceIntersection" else MORE)
    assert set(sizes) == {0, added} and lines > 20


@pytest.mark.parametrize("kind", KINDS)
def test_stopped_twice(kind):
    """The second time while it puts itself in order."""
    make, add, check = KINDS[kind]
    for first in range(12, 60, 6):
        for second in (2, 5, 9, 14):
            made = make()
            stopped(lambda: add(made), first)
            stopped(lambda: made.min_bound, second)
            check(made)


def test_an_error_leaves_everything_as_it_was():
    made = spatial.HalfspaceIntersection(SQUARE, [0, 0], incremental=True)
    for restart in (False, True):
        with pytest.raises(spatial.QhullError):
            made.add_halfspaces([[1.0, 0, 1]], restart=restart)
        check_halfspaces(made)
        assert made.nineq == 4


def test_adding_to_an_uninitialized_object():
    for cls, add in ((spatial.Delaunay, "add_points"), (spatial.ConvexHull, "add_points"), (spatial.Voronoi, "add_points"),
                     (spatial.HalfspaceIntersection, "add_halfspaces")):
        with pytest.raises(TypeError, match="the object is not initialized"):
            getattr(cls.__new__(cls), add)([[1.0, 2.0]])
