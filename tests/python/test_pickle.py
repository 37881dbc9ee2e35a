# SPDX-License-Identifier: BSD-3-Clause
"""Pickling and copying: equal arrays, the same numbers of cells, and independence."""
import copy
import pickle

import numpy as np
import pytest

import delone
from delone import spatial

POINTS = np.random.default_rng(0).random((80, 3))
PARTS = POINTS[:30], POINTS[30:31], POINTS[31:]


def in_parts(make):
    made = make(PARTS[0])
    insert = made.add_points if type(made).__module__.startswith("delone.spatial") else made.insert_range
    for part in PARTS[1:]:
        insert(part)
    return made


def regular():
    r = delone.Regular(POINTS, np.linspace(-0.02, 0.02, 80), seed=5, order="shuffled")
    r.insert_range([[0.1, 0.2, 0.3]], [0.1])
    return r


def halfspaces():
    normals = np.random.default_rng(1).standard_normal((20, 3))
    return np.concatenate([normals, -np.ones((20, 1))], axis=1)


MAKERS = {
    "Delaunay": lambda: delone.Delaunay(POINTS),
    "Delaunay in parts": lambda: in_parts(delone.Delaunay),
    "Delaunay of none": lambda: delone.Delaunay(np.zeros((0, 2))),
    "Regular": regular,
    "FurthestSite": lambda: in_parts(delone.FurthestSite),
    "ConvexHull": lambda: in_parts(delone.ConvexHull),
    "Voronoi": lambda: delone.Voronoi(POINTS),
    "PowerDiagram": lambda: delone.PowerDiagram(regular()),
    "HalfspaceIntersection": lambda: delone.HalfspaceIntersection(halfspaces()),
    "Polyhedron": lambda: delone.Polyhedron(np.r_[POINTS[:20], POINTS[:3]], np.r_[np.ones(20), 1, 2, 3]),
    "Polyhedron of generators": lambda: delone.Polyhedron.from_generators(POINTS[:9], POINTS[9:11] + 1),
    "PolyhedraVertices": lambda: delone.polyhedra_vertices(POINTS[:20].reshape(5, 4, 3), np.ones((5, 4))),
    "HalfspaceIntersection of a point": lambda: delone.HalfspaceIntersection(halfspaces(), [0.01, 0.02, 0.03]),
    "LinearInterpolator": lambda: delone.LinearInterpolator(delone.Delaunay(POINTS), POINTS @ [1, 2, 3j], outside="nearest"),
    "NaturalNeighborInterpolator": lambda: delone.NaturalNeighborInterpolator(
        delone.Delaunay(POINTS), POINTS @ [1, 2, 3j], outside="project", smooth=True, tolerance=0.01),
    "Locations": lambda: delone.Delaunay(POINTS).locate(POINTS[:5] + 0.1),
    "ConvexHulls": lambda: delone.convex_hulls([POINTS, POINTS[:7]]),
    "ClippedRegions": lambda: delone.Voronoi(POINTS).clipped_regions(),
    "SiteCells": lambda: delone.Delaunay(POINTS).site_cells(neighbors=True),
    "TrimResult": lambda: delone.Delaunay(POINTS).trim(0.3),
    "TrimResult of nothing": lambda: delone.Delaunay(np.zeros((0, 2))).trim(0),
    "spatial.Delaunay": lambda: in_parts(lambda p: spatial.Delaunay(p, incremental=True)),
    "spatial.ConvexHull": lambda: spatial.ConvexHull(POINTS),
    "spatial.Voronoi": lambda: spatial.Voronoi(POINTS),
    "spatial.HalfspaceIntersection": lambda: spatial.HalfspaceIntersection(halfspaces(), [0.01, 0.02, 0.03]),
}


def arrays(made):
    """All public arrays and numbers."""
    result = {}
    for name in dir(made):
        if not name.startswith("_") and name not in ("statistics", "triangulation", "good", "ridge_dict") and not callable(getattr(made, name)):
            result[name] = getattr(made, name)
    return result


def assert_same(a, b):
    assert type(a) is type(b) and repr(a).split(" at ")[0] == repr(b).split(" at ")[0]
    ours, theirs = arrays(a), arrays(b)
    assert ours.keys() == theirs.keys() and len(ours) > 0
    for name in ours:
        if isinstance(ours[name], (list, tuple)):
            assert len(ours[name]) == len(theirs[name])
            for x, y in zip(ours[name], theirs[name]):
                np.testing.assert_array_equal(x, y, err_msg=name)
        else:
            np.testing.assert_array_equal(ours[name], theirs[name], err_msg=name)


@pytest.mark.parametrize("name", MAKERS)
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_copies_are_the_same(name):
    made = MAKERS[name]()
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        assert_same(pickle.loads(pickle.dumps(made, protocol)), made)
    assert_same(copy.copy(made), made)
    assert_same(copy.deepcopy(made), made)


@pytest.mark.parametrize("make", [delone.Delaunay, delone.FurthestSite, delone.ConvexHull])
@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda made: pickle.loads(pickle.dumps(made))])
def test_copies_are_independent(make, duplicate):
    made = make(PARTS[0])
    other = duplicate(made)
    other.insert_range(PARTS[2])
    assert made.num_points == 30 and made.hash == make(PARTS[0]).hash
    assert other.num_points == 79 and other.hash == make(np.concatenate([PARTS[0], PARTS[2]])).hash


def test_a_copied_interpolator_works():
    function = MAKERS["LinearInterpolator"]()
    other = pickle.loads(pickle.dumps(function))
    queries = np.random.default_rng(2).random((50, 3)) * 2
    np.testing.assert_array_equal(function(queries), other(queries))
    np.testing.assert_array_equal(function.gradient(queries), other.gradient(queries))


@pytest.mark.parametrize("kind", [delone.Delaunay, delone.Regular, delone.FurthestSite, delone.ConvexHull, delone.HalfspaceIntersection,
                                  delone.LinearInterpolator, delone.NaturalNeighborInterpolator, delone.Polyhedron, delone.TrimResult])
@pytest.mark.parametrize("size", [3, 5, 6, 7])
def test_a_broken_state_is_refused(kind, size):
    for entry in (1, None, "as_given", [], np.zeros((3, 2))):
        made = kind.__new__(kind)
        with pytest.raises((ValueError, TypeError)):
            made.__setstate__((entry,) * size)
        with pytest.raises(TypeError, match="not initialized"):
            repr(made)


@pytest.mark.parametrize("batches", [[], [30, 30], [80, 1], [-1, 81], [0, 80], [10**18, 80 - 10**18], [2**63, 80], ["80"], None, 80])
def test_batches_are_those_of_the_rows(batches):
    for made in (delone.Delaunay(POINTS), delone.ConvexHull(POINTS)):
        state = list(made.__getstate__())
        state[3 if isinstance(made, delone.Delaunay) else 2] = batches
        with pytest.raises((ValueError, TypeError)):
            type(made).__new__(type(made)).__setstate__(tuple(state))
