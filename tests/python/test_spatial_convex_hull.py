# SPDX-License-Identifier: BSD-3-Clause
"""delone.spatial.ConvexHull against scipy.spatial.ConvexHull, attribute by attribute, on points in general position."""
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from delone import spatial
from spatial_support import QUICK, assert_same_kind, assert_same_neighbors, general_points, numbering, rows_as_set

scipy_spatial = pytest.importorskip("scipy.spatial")


def both(points, **arguments):
    return spatial.ConvexHull(points, **arguments), scipy_spatial.ConvexHull(points, **arguments)


def assert_agree(ours, theirs, points):
    for name in ["simplices", "neighbors", "equations", "coplanar", "vertices", "min_bound", "max_bound"]:
        assert_same_kind(getattr(ours, name), getattr(theirs, name))
    for name in ["ndim", "npoints", "nsimplex", "good"]:
        assert getattr(ours, name) == getattr(theirs, name), name
    np.testing.assert_array_equal(ours.points, points)
    assert_same_neighbors(ours, theirs)
    which, _ = numbering(ours.simplices, theirs.simplices)
    np.testing.assert_allclose(ours.equations[which], theirs.equations, rtol=1e-6, atol=1e-8 * np.abs(points).max())
    assert type(ours.volume) is type(ours.area) is float
    np.testing.assert_allclose([ours.volume, ours.area], [theirs.volume, theirs.area], rtol=1e-9)
    if points.shape[1] == 2:
        start = theirs.vertices.tolist().index(ours.vertices[0])
        np.testing.assert_array_equal(ours.vertices, np.roll(theirs.vertices, -start))
    else:
        np.testing.assert_array_equal(ours.vertices, theirs.vertices)


@given(points=general_points())
@QUICK
def test_every_attribute_agrees(points):
    ours, theirs = both(points)
    assert_agree(ours, theirs, points)


@pytest.mark.parametrize("dimension", range(2, 8))
def test_every_attribute_agrees_in_each_dimension(dimension):
    n = {2: 500, 3: 500, 4: 200, 5: 60, 6: 35, 7: 25}[dimension]
    points = np.random.default_rng(dimension).standard_normal((n, dimension))
    ours, theirs = both(points)
    assert_agree(ours, theirs, points)


@given(points=general_points(), parts=st.integers(1, 3))
@QUICK
def test_adding_points_agrees(points, parts):
    first = points.shape[1] + 1
    ours, theirs = both(points[:first], incremental=True)
    for rows in np.array_split(points[first:], parts):
        ours.add_points(rows)
        theirs.add_points(rows)
    assert_agree(ours, theirs, points)
    ours.add_points(points[:1], restart=True)
    np.testing.assert_allclose(ours.volume, theirs.volume, rtol=1e-9)
    for hull in (ours, theirs):
        hull.close()
        with pytest.raises(RuntimeError):
            hull.add_points(points)


@given(points=general_points(), row=st.integers(0, 5), sign=st.sampled_from(["", "-"]))
@QUICK
def test_good_facets_are_those_that_a_point_sees(points, row, sign):
    points[row] = points.mean(axis=0) + 2.5 * (points[row] - points.mean(axis=0))
    ours, theirs = both(points, qhull_options=f"QG{sign}{row}")
    which, _ = numbering(ours.simplices, theirs.simplices)
    assert row not in ours.simplices and row not in ours.vertices
    assert_same_kind(ours.good, theirs.good)
    np.testing.assert_array_equal(ours.good[which], theirs.good)


def test_good_facets_in_the_example_of_scipy():
    generators = np.array([[0.2, 0.2], [0.2, 0.4], [0.4, 0.4], [0.4, 0.2], [0.3, 0.6]])
    hull = spatial.ConvexHull(points=generators, qhull_options="QG4")
    assert rows_as_set(hull.simplices) == {(0, 1), (1, 2), (0, 3), (2, 3)}
    assert rows_as_set(hull.simplices[hull.good]) == {(1, 2)}
    with pytest.raises(ValueError, match="QG5"):
        spatial.ConvexHull(generators, qhull_options="QG5")


def test_copies_are_complete():
    hull = spatial.ConvexHull(np.random.default_rng(1).random((30, 3)), incremental=True)
    again = pickle.loads(pickle.dumps(hull))
    np.testing.assert_array_equal(again.simplices, hull.simplices)
    np.testing.assert_array_equal(again.equations, hull.equations)
    again.add_points([[2, 2, 2]])
    assert 30 in again.vertices and 30 not in hull.vertices


def test_simplices_are_counterclockwise_in_the_plane_and_increasing_otherwise():
    random = np.random.default_rng(1)
    points = random.random((40, 2))
    edges = points[spatial.ConvexHull(points).simplices] - points.mean(axis=0)
    assert (np.linalg.det(edges) > 0).all()
    hull = spatial.ConvexHull(random.random((40, 4)))
    assert (np.diff(hull.simplices) > 0).all()
    for i, j in np.ndindex(*hull.neighbors.shape):
        assert set(hull.simplices[i]) - {hull.simplices[i, j]} < set(hull.simplices[hull.neighbors[i, j]])


@pytest.mark.parametrize("name", ["simplices", "neighbors", "vertices", "_vertices", "volume", "area", "equations", "tolerance"])
def test_results_cannot_be_assigned(name):
    hull = spatial.ConvexHull(np.random.default_rng(1).random((30, 3)))
    with pytest.raises(AttributeError, match=f"{name} of ConvexHull cannot be assigned"):
        setattr(hull, name, None)
