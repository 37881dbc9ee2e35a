# SPDX-License-Identifier: BSD-3-Clause
"""delone.spatial.Delaunay against scipy.spatial.Delaunay, attribute by attribute, on points in general position."""
import copy
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from delone import spatial
from spatial_support import QUICK, assert_same_kind, assert_same_neighbors, general_points, numbering, rows_as_set

scipy_spatial = pytest.importorskip("scipy.spatial")

ARRAYS = ["simplices", "neighbors", "equations", "coplanar", "good", "transform", "vertex_to_simplex", "convex_hull", "min_bound",
          "max_bound"]


def both(points, **arguments):
    return spatial.Delaunay(points, **arguments), scipy_spatial.Delaunay(points, **arguments)


def assert_agree(ours, theirs, points):
    for name in ARRAYS:
        assert_same_kind(getattr(ours, name), getattr(theirs, name))
    for name in ["ndim", "npoints", "nsimplex", "furthest_site"]:
        assert getattr(ours, name) == getattr(theirs, name), name
    np.testing.assert_array_equal(ours.points, points)
    np.testing.assert_array_equal(ours.min_bound, theirs.min_bound)
    np.testing.assert_array_equal(ours.max_bound, theirs.max_bound)
    np.testing.assert_array_equal(ours.good, theirs.good)

    assert_same_neighbors(ours, theirs)
    which, place = numbering(ours.simplices, theirs.simplices)
    assert rows_as_set(ours.convex_hull) == rows_as_set(theirs.convex_hull)
    assert (ours.simplices[ours.vertex_to_simplex] == np.arange(len(points))[:, None]).any(axis=1).all()

    np.testing.assert_allclose([ours.paraboloid_scale, ours.paraboloid_shift], [theirs.paraboloid_scale, theirs.paraboloid_shift],
                               rtol=1e-12)
    np.testing.assert_allclose(ours.equations[which], theirs.equations, rtol=1e-6, atol=1e-8)
    queries = points.mean(axis=0) + 0.3 * (points[:5] - points.mean(axis=0))
    np.testing.assert_allclose(ours.plane_distance(queries)[:, which], theirs.plane_distance(queries), rtol=1e-6, atol=1e-7)
    np.testing.assert_allclose(ours.lift_points(queries), theirs.lift_points(queries), rtol=1e-12)

    def barycentric(tri, simplex):
        c = np.einsum("mij,mj->mi", tri.transform[simplex, :-1], queries[0] - tri.transform[simplex, -1])
        return np.concatenate([c, 1 - c.sum(axis=1, keepdims=True)], axis=1)
    expected = barycentric(theirs, np.arange(theirs.nsimplex))
    mine = np.take_along_axis(barycentric(ours, which), place, axis=1)
    np.testing.assert_allclose(mine, expected, rtol=1e-6, atol=1e-6 * np.nanmax(np.abs(expected), initial=1))

    indptr, indices = ours.vertex_neighbor_vertices
    expected_indptr, expected_indices = theirs.vertex_neighbor_vertices
    assert indptr.dtype == expected_indptr.dtype and indices.dtype == expected_indices.dtype
    np.testing.assert_array_equal(indptr, expected_indptr)
    for p in range(len(points)):
        assert indices[indptr[p]:indptr[p + 1]].tolist() == sorted(expected_indices[indptr[p]:indptr[p + 1]].tolist())


@given(points=general_points())
@QUICK
def test_every_attribute_agrees(points):
    ours, theirs = both(points)
    assert_agree(ours, theirs, points)


@pytest.mark.parametrize("dimension", range(2, 8))
def test_every_attribute_agrees_in_each_dimension(dimension):
    points = np.random.default_rng(dimension).random(({2: 300, 3: 200, 4: 100, 5: 40, 6: 25, 7: 20}[dimension], dimension))
    ours, theirs = both(points)
    assert_agree(ours, theirs, points)


@given(points=general_points(), seed=st.integers(0, 2**32 - 1))
@QUICK
def test_find_simplex_agrees(points, seed):
    ours, theirs = both(points)
    spread = points.max(axis=0) - points.min(axis=0)
    queries = points.min(axis=0) - 0.1 * spread + 1.2 * spread * np.random.default_rng(seed).random((3, 20, points.shape[1]))
    found, expected = ours.find_simplex(queries), theirs.find_simplex(queries)
    assert found.shape == expected.shape == (3, 20) and found.dtype == expected.dtype
    which, _ = numbering(ours.simplices, theirs.simplices)
    np.testing.assert_array_equal(found, np.where(expected < 0, -1, which[expected]))
    np.testing.assert_array_equal(ours.find_simplex(queries, bruteforce=True), found)
    np.testing.assert_array_equal(spatial.tsearch(ours, queries), found)
    assert ours.find_simplex(queries[0, 0]).shape == theirs.find_simplex(queries[0, 0]).shape == ()


@pytest.mark.parametrize("options", ["Qbb Qc Qz Q12", "Qbb", "Qc", "", "Qbb Qc", "QJ Qbb", "Qt Qx Pp", "Qs Q3 Q7"])
def test_options_scale_the_paraboloid_as_scipy_does(options):
    points = np.random.default_rng(5).random((40, 3)) + 1
    ours, theirs = both(points, qhull_options=options)
    assert rows_as_set(ours.simplices) == rows_as_set(theirs.simplices)
    np.testing.assert_allclose([ours.paraboloid_scale, ours.paraboloid_shift], [theirs.paraboloid_scale, theirs.paraboloid_shift],
                               rtol=1e-6, atol=1e-12)


@given(points=general_points())
@QUICK
def test_furthest_sites_agree(points):
    ours, theirs = both(points, furthest_site=True)
    assert ours.furthest_site is theirs.furthest_site is True
    np.testing.assert_allclose([ours.paraboloid_scale, ours.paraboloid_shift], [theirs.paraboloid_scale, theirs.paraboloid_shift],
                               rtol=1e-12)
    assert_same_neighbors(ours, theirs)
    which, _ = numbering(ours.simplices, theirs.simplices)
    np.testing.assert_allclose(ours.equations[which], theirs.equations, rtol=1e-6, atol=1e-8)
    # Points within the hull are no vertices.
    hidden = ~np.isin(np.arange(len(points)), theirs.simplices)
    np.testing.assert_array_equal(ours.vertex_to_simplex == -1, hidden)
    np.testing.assert_array_equal(theirs.vertex_to_simplex == -1, hidden)
    assert rows_as_set(ours.convex_hull) == rows_as_set(theirs.convex_hull)
    by_option = spatial.Delaunay(points, qhull_options="Qbb Qc Qu")
    assert by_option.furthest_site and rows_as_set(by_option.simplices) == rows_as_set(ours.simplices)


@given(points=general_points(), parts=st.integers(1, 3))
@QUICK
def test_adding_points_agrees(points, parts):
    first = points.shape[1] + 2
    ours, theirs = both(points[:first], incremental=True)
    for rows in np.array_split(points[first:], parts):
        ours.add_points(rows)
        theirs.add_points(rows)
    assert rows_as_set(ours.simplices) == rows_as_set(theirs.simplices)
    assert_agree(ours, theirs, points)
    ours.add_points(points[:1], restart=True)
    assert ours.npoints == len(points) + 1 and ours.coplanar[:, [0, 2]].tolist() == [[len(points), 0]]


def test_adding_points_needs_the_incremental_mode():
    points = np.random.default_rng(1).random((10, 2))
    for module in (spatial, scipy_spatial):
        closed = module.Delaunay(points, incremental=True)
        closed.close()
        for tri in (module.Delaunay(points), closed):
            with pytest.raises(RuntimeError, match="incremental mode not enabled or already closed"):
                tri.add_points(points)
        with pytest.raises(ValueError, match="invalid size for new points array"):
            module.Delaunay(points, incremental=True).add_points(np.zeros((3, 3)))
        assert len(closed.simplices) > 0


def test_failed_addition_changes_nothing():
    points = np.random.default_rng(1).random((10, 2))
    tri = spatial.Delaunay(points, incremental=True)
    before = tri.simplices.copy()
    with pytest.raises(ValueError, match="NaN"):
        tri.add_points([[0.5, 0.5], [0.2, np.nan]])
    np.testing.assert_array_equal(tri.simplices, before)
    assert tri.npoints == 10
    tri.add_points([[0.5, 0.5]])
    assert tri.npoints == 11 and 10 in tri.simplices


@pytest.mark.parametrize("cls", ["Delaunay", "ConvexHull", "Voronoi"])
def test_infinities_are_a_qhull_error_as_in_scipy(cls):
    points = np.random.default_rng(1).random((10, 2))
    points[3, 1] = np.inf
    for module in (spatial, scipy_spatial):
        with pytest.raises(module.QhullError):
            getattr(module, cls)(points)


@pytest.mark.parametrize("points", [np.full((5, 2), np.nan), np.empty((0, 2)), np.ma.masked_array(np.ones((5, 2)))])
def test_bad_points_are_value_errors_as_in_scipy(points):
    for cls in ("Delaunay", "ConvexHull", "Voronoi"):
        for module in (spatial, scipy_spatial):
            with pytest.raises(ValueError):
                getattr(module, cls)(points)


@pytest.mark.parametrize("cls", ["Delaunay", "ConvexHull", "Voronoi"])
def test_an_array_with_more_dimensions_is_named_by_their_number(cls):
    with pytest.raises(ValueError, match="2 dimensions"):
        getattr(spatial, cls)(np.ones((2, 3, 4)))


def test_wrong_queries_are_value_errors_as_in_scipy():
    points = np.random.default_rng(1).random((10, 2))
    for tri in both(points):
        with pytest.raises(ValueError, match="wrong dimensionality in xi"):
            tri.find_simplex(np.zeros((4, 3)))
        with pytest.raises(ValueError, match="different dimensionality"):
            tri.plane_distance(np.zeros((4, 3)))


def test_old_name_of_simplices_warns():
    tri = spatial.Delaunay(np.random.default_rng(1).random((10, 2)))
    with pytest.warns(DeprecationWarning):
        assert tri.vertices is tri.simplices


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy, lambda tri: pickle.loads(pickle.dumps(tri))])
@pytest.mark.parametrize("incremental", [False, True])
def test_copies_are_complete(duplicate, incremental):
    random = np.random.default_rng(1)
    tri = spatial.Delaunay(random.random((30, 3)), incremental=incremental)
    if incremental:
        tri.add_points(random.random((20, 3)))
    again = duplicate(tri)
    queries = random.random((100, 3))
    assert_same_neighbors(again, tri)
    which, _ = numbering(again.simplices, tri.simplices)
    found = tri.find_simplex(queries)
    np.testing.assert_array_equal(again.find_simplex(queries), np.where(found < 0, -1, which[found]))
    np.testing.assert_allclose(again.equations[which], tri.equations, rtol=1e-9, atol=1e-12)
    if not incremental:
        np.testing.assert_array_equal(again.simplices, tri.simplices)
    if incremental:
        again.add_points([[2, 2, 2]])
        assert 50 in again.simplices and tri.npoints == 50 and tri.find_simplex([2, 2, 2]) == -1


def test_arrays_are_the_callers_own():
    points = np.random.default_rng(1).random((30, 2))
    tri, untouched = spatial.Delaunay(points), spatial.Delaunay(points)
    queries = tri.points[tri.simplices].mean(axis=1)
    tri.simplices.sort(axis=1)
    tri.neighbors[:] = -1
    np.testing.assert_array_equal(tri.find_simplex(queries), np.arange(tri.nsimplex))
    for name in ["transform", "equations", "convex_hull", "vertex_to_simplex"]:
        np.testing.assert_array_equal(getattr(tri, name), getattr(untouched, name))


@pytest.mark.parametrize("name", ["simplices", "neighbors", "points", "_points", "transform", "_transform", "convex_hull", "nsimplex",
                                  "equations", "min_bound", "furthest_site", "vertex_neighbor_vertices"])
def test_results_cannot_be_assigned(name):
    tri = spatial.Delaunay(np.random.default_rng(1).random((30, 2)))
    before = tri.simplices.copy()
    with pytest.raises(AttributeError, match=f"{name} of Delaunay cannot be assigned"):
        setattr(tri, name, None)
    tri.label = "mine"
    copied = pickle.loads(pickle.dumps(tri))
    assert copied.label == "mine" and (copied.simplices == before).all()


@pytest.mark.parametrize("dimension", [2, 3, 5])
def test_simplices_are_counterclockwise_in_the_plane_and_increasing_otherwise(dimension):
    points = np.random.default_rng(1).random((40, dimension))
    tri = spatial.Delaunay(points)
    corners = points[tri.simplices]
    if dimension == 2:
        assert (np.linalg.det(corners[:, 1:] - corners[:, :1]) > 0).all()
    else:
        assert (np.diff(tri.simplices) > 0).all()
    for i, j in zip(*np.nonzero(tri.neighbors >= 0)):
        mine = set(tri.simplices[i]) - {tri.simplices[i, j]}
        assert mine < set(tri.simplices[tri.neighbors[i, j]])
    tri.find_simplex(corners.mean(axis=1))
    np.testing.assert_array_equal(tri.find_simplex(corners.mean(axis=1)), np.arange(tri.nsimplex))
