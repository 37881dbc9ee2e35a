# SPDX-License-Identifier: BSD-3-Clause
"""delone.interpolate against scipy.interpolate on points in general position, and what it is without scipy."""
import pickle
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import delone
from delone import interpolate, spatial
from spatial_support import QUICK, general_points


@pytest.fixture
def theirs():
    return pytest.importorskip("scipy.interpolate")


def values_of(points, kind, random):
    if kind == "real":
        return np.sin(3 * points[:, 0]) * points[:, 1]
    if kind == "integer":
        return random.integers(0, 100, len(points))
    if kind == "trailing":
        return random.random((len(points), 2, 3))
    return random.random((len(points), 2)) + 1j * random.random((len(points), 2))


def queries_of(points, random):
    low, spread = points.min(axis=0), np.ptp(points, axis=0)
    return np.concatenate([low - 0.1 * spread + 1.2 * spread * random.random((40, points.shape[1])), points])


KINDS = st.sampled_from(["real", "integer", "trailing", "complex"])


@given(points=general_points(), kind=KINDS, rescale=st.booleans(), seed=st.integers(0, 2**32 - 1))
@QUICK
def test_linear_agrees(points, kind, rescale, seed):
    theirs = pytest.importorskip("scipy.interpolate")
    random = np.random.default_rng(seed)
    values, queries = values_of(points, kind, random), queries_of(points, random)
    for fill in (np.nan, -7.0):
        expected = theirs.LinearNDInterpolator(points, values, fill_value=fill, rescale=rescale)(queries)
        found = interpolate.LinearNDInterpolator(points, values, fill_value=fill, rescale=rescale)(queries)
        assert found.shape == expected.shape and found.dtype == expected.dtype
        np.testing.assert_allclose(found, expected, rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_values_that_are_not_finite_are_no_fill_values(bad):
    points = np.array([[0, 0], [4, 0], [0, 4], [4, 4.5], [1, 2]])
    function = interpolate.LinearNDInterpolator(points, [bad, 1, 2, 3, 4], fill_value=-7)
    found = function([[0.1, 0.1], [3.5, 3.5], [9, 9], [4, 4.5]])
    assert not np.isfinite(found[0]) and np.isfinite(found[1]) and found[2] == -7 and found[3] == 3
    function.values = [0, 1, 2, 3, 4]
    np.testing.assert_array_equal(np.isfinite(function([[0.1, 0.1], [9, 9]])), [True, True])


@given(points=general_points(dimension=2), kind=KINDS, rescale=st.booleans(), seed=st.integers(0, 2**32 - 1))
@QUICK
def test_cubic_agrees(points, kind, rescale, seed):
    theirs = pytest.importorskip("scipy.interpolate")
    random = np.random.default_rng(seed)
    values, queries = values_of(points, kind, random), queries_of(points, random)
    expected = theirs.CloughTocher2DInterpolator(points, values, fill_value=-7, rescale=rescale)
    found = interpolate.CloughTocher2DInterpolator(points, values, fill_value=-7, rescale=rescale)
    scale = 1 + np.abs(expected.grad).max() * np.ptp(points)
    np.testing.assert_allclose(found.grad, expected.grad, rtol=1e-10, atol=1e-10 * np.abs(expected.grad).max())
    assert found(queries).shape == expected(queries).shape and found(queries).dtype == expected(queries).dtype
    np.testing.assert_allclose(found(queries), expected(queries), rtol=1e-10, atol=1e-10 * scale)


@pytest.mark.parametrize("kind", ["real", "trailing", "complex"])
@pytest.mark.parametrize("rescale", [False, True])
def test_gradients_of_cubics(kind, rescale):
    random = np.random.default_rng(5)
    points = random.random((200, 2)) * [1, 30 if rescale else 1]
    points = np.concatenate([points, points[:3]])
    function = interpolate.CloughTocher2DInterpolator(points, values_of(points, kind, random), tol=1e-12, rescale=rescale)
    queries = points.mean(axis=0) + (random.random((50, 5, 2)) - 0.5) * np.ptp(points, axis=0) * 0.8
    found, step = function.gradient(queries), 1e-5 * np.ptp(points, axis=0)
    assert found.shape == (50, 5, *function.values_shape, 2) and found.dtype == function(queries).dtype
    for axis in range(2):  # differences of a cubic: a kink between two thirds costs O(step)
        ahead, behind = queries.copy(), queries.copy()
        ahead[..., axis] += step[axis]
        behind[..., axis] -= step[axis]
        np.testing.assert_allclose(found[..., axis], (function(ahead) - function(behind)) / (2 * step[axis]), rtol=1e-3,
                                   atol=1e-3 * np.abs(found[..., axis]).max())
    inner = np.flatnonzero((np.abs(points - points.mean(axis=0)) < 0.4 * np.ptp(points, axis=0)).all(axis=1) & (np.arange(len(points)) < 200))
    scale = 1 if function.scale is None else function.scale
    at_points = (function.grad / scale).reshape(len(points), *function.values_shape, 2)
    np.testing.assert_allclose(function.gradient(points[inner]), at_points[inner], rtol=1e-6, atol=1e-6 * np.abs(at_points).max())
    np.testing.assert_array_equal(function.gradient(queries[..., 0], queries[..., 1]), found)
    assert np.isnan(function.gradient([[-9, 0], [np.nan, 0.5], [np.inf, 1]])).all()


def test_gradients_of_cubics_on_a_lattice():
    points = np.mgrid[:6, :6].reshape(2, -1).T.astype(float)
    function = interpolate.CloughTocher2DInterpolator(points, points @ [2, -3], tol=1e-14)
    queries = np.concatenate([points, points[:-7] + 0.5, points[:-7] + 1 / 3])
    inside = queries[(queries <= 5).all(axis=1)]
    np.testing.assert_allclose(function.gradient(inside), np.tile([2, -3], (len(inside), 1)), atol=1e-9)
    function.values = points[:, 0] ** 2
    assert abs(function.gradient(2.5, 2.5)[0] - 5) < 0.2
    with pytest.raises(ValueError, match="dimensions"):
        function.gradient([[1, 2, 3]])


@given(points=general_points(), kind=KINDS, rescale=st.booleans(), seed=st.integers(0, 2**32 - 1))
@QUICK
def test_nearest_agrees(points, kind, rescale, seed):
    theirs = pytest.importorskip("scipy.interpolate")
    random = np.random.default_rng(seed)
    values, queries = values_of(points, kind, random), queries_of(points, random)
    expected = theirs.NearestNDInterpolator(points, values, rescale=rescale)(queries)
    found = interpolate.NearestNDInterpolator(points, values, rescale=rescale)(queries)
    np.testing.assert_array_equal(found, expected)
    if not rescale:
        np.testing.assert_array_equal(interpolate.NearestNDInterpolator(delone.Delaunay(points), values)(queries), expected)


@pytest.mark.parametrize("method", ["nearest", "linear", "cubic"])
def test_griddata_agrees(theirs, method):
    random = np.random.default_rng(2)
    points, values = random.random((100, 2)), random.random(100)
    grid = np.mgrid[0.1:0.9:8j, 0.1:0.9:5j]
    for where, queries in [(points, tuple(grid)), (tuple(points.T), np.moveaxis(grid, 0, -1)), (points, (0.4, grid[1]))]:
        expected = theirs.griddata(where, values, queries, method=method, rescale=True, fill_value=3)
        found = interpolate.griddata(where, values, queries, method=method, rescale=True, fill_value=3)
        assert found.shape == expected.shape
        np.testing.assert_allclose(found, expected, rtol=1e-10)
    line = interpolate.griddata(points[:, 0], values, grid[0], method=method)
    np.testing.assert_array_equal(line, theirs.griddata(points[:, 0], values, grid[0], method=method))


def test_griddata_refuses_what_scipy_refuses():
    points = np.random.default_rng(2).random((10, 3))
    for arguments in [{"method": "cubic"}, {"method": "quintic"}, {"simplex_tolerance": 0}]:
        with pytest.raises(ValueError, match="Unknown interpolation method|simplex_tolerance"):
            interpolate.griddata(points, points[:, 0], points, **arguments)


@pytest.mark.parametrize("kind", [interpolate.LinearNDInterpolator, interpolate.CloughTocher2DInterpolator,
                                  interpolate.NaturalNeighborInterpolator])
def test_a_triangulation_is_used_as_it_is(kind):
    points = np.random.default_rng(3).random((60, 2))
    values, queries = points @ [1, 2], 0.2 + 0.6 * np.random.default_rng(4).random((30, 2))
    for tri in (delone.Delaunay(points), spatial.Delaunay(points), spatial.Delaunay(points, incremental=True)):
        function = kind(tri, values)
        assert function.tri is tri
        np.testing.assert_allclose(function(queries), queries @ [1, 2], rtol=1e-5)
        np.testing.assert_array_equal(function(queries[:, 0], queries[:, 1]), function(queries))
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(function))(queries), function(queries))
        with pytest.raises(ValueError, match="Rescaling is not supported"):
            kind(tri, values, rescale=True)
    tri.add_points([[0.5, 0.5]])
    with pytest.raises(RuntimeError, match="points were added"):
        function(queries)
    with pytest.raises(ValueError, match="furthest-site"):
        kind(spatial.Delaunay(points, furthest_site=True), values)


def test_a_triangulation_of_scipy_is_refused_by_name():
    scipy_spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(3).random((60, 2))
    with pytest.raises(TypeError, match="a triangulation of scipy"):
        interpolate.LinearNDInterpolator(scipy_spatial.Delaunay(points), points[:, 0])


@pytest.mark.parametrize("kind", [interpolate.LinearNDInterpolator, interpolate.CloughTocher2DInterpolator,
                                  interpolate.NaturalNeighborInterpolator])
def test_values_may_be_assigned(kind):
    points = np.random.default_rng(3).random((60, 2))
    function = kind(points, points[:, 0])
    function.values = points[:, 1] * 1j
    np.testing.assert_allclose(function([0.5, 0.4]), [0.4j], rtol=1e-5)
    with pytest.raises(ValueError, match="different number of values and points"):
        function.values = [1, 2]


@pytest.mark.parametrize("kind", [interpolate.LinearNDInterpolator, interpolate.CloughTocher2DInterpolator,
                                  interpolate.NearestNDInterpolator, interpolate.NaturalNeighborInterpolator])
def test_wrong_input_is_an_error_as_in_scipy(kind):
    points = np.random.default_rng(3).random((20, 2))
    for where, values in [(points, points[:5]), (points[:, 0], points[:, 0]), (points[None], points[:1]), (points, 1.0)]:
        with pytest.raises(ValueError):
            kind(where, values)
    with pytest.raises(ValueError, match="number of dimensions in xi"):
        kind(points, points)(np.zeros((4, 3)))
    assert kind(points, points)(np.zeros((0, 2))).shape == (0, 2)
    if kind is not interpolate.NearestNDInterpolator:
        with pytest.raises(spatial.QhullError, match="flat"):
            kind(np.outer(np.arange(4), [1, 2]), np.arange(4))
        with pytest.raises(ValueError, match="simplex_tolerance"):
            kind(points, points)(points, simplex_tolerance=-1)
        assert np.isnan(kind(points, points)([[np.nan, 0.5], [np.inf, 0.5]])).all()


@pytest.mark.parametrize("smooth", [False, True])
@pytest.mark.parametrize("rescale", [False, True])
def test_natural_neighbors_take_scipys_arguments(smooth, rescale):
    random = np.random.default_rng(8)
    points, values = random.random((80, 3)) * [1, 20, 1], random.random((80, 2)) + 1j * random.random((80, 2))
    queries = (0.3 + 0.4 * random.random((5, 6, 3))) * [1, 20, 1]
    function = interpolate.NaturalNeighborInterpolator(points, values, fill_value=-7, rescale=rescale, smooth=smooth)
    found = function(*np.moveaxis(queries, -1, 0))
    np.testing.assert_array_equal(function(queries), found)
    assert found.shape == (5, 6, 2) and found.dtype == complex
    assert (function([9, 9, 9]) == -7).all() and np.isnan(function.gradient([9, 9, 9])).all()
    scale = np.ptp(points, axis=0) if rescale else 1
    core = delone.NaturalNeighborInterpolator((points - points.mean(axis=0) if rescale else points) / scale, values, smooth=smooth)
    moved = (queries - points.mean(axis=0) if rescale else queries) / scale
    np.testing.assert_allclose(found, core(moved), rtol=1e-9)
    np.testing.assert_allclose(function.gradient(*np.moveaxis(queries, -1, 0)), core.gradient(moved) / scale, rtol=1e-6)
    np.testing.assert_array_equal(function(queries, simplex_tolerance=3), found)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(function))(queries), found)


def test_nearest_takes_the_first_of_equals_and_keeps_types():
    points = [[0, 0], [2, 0], [0, 2], [2, 0]]
    function = interpolate.NearestNDInterpolator(points, ["a", "b", "c", "d"])
    assert function([[1, 0], [2, 0], [0.9, 1.1]]).tolist() == ["a", "b", "c"]
    numbers = interpolate.NearestNDInterpolator(points, [1, 2, 3, 4])
    assert numbers([[0, 0.1]]).dtype.kind == "i"
    np.testing.assert_array_equal(numbers([[0, 0.1], [9, 9]], distance_upper_bound=1, workers=2, eps=0.1), [1, np.nan])
    high = np.random.default_rng(1).random((50, 7))
    assert interpolate.NearestNDInterpolator(high, np.arange(50))(high).tolist() == list(range(50))
    with pytest.raises(ValueError, match="^p: "):
        numbers([[0, 0]], p=1)
    with pytest.raises(ValueError, match="boxsize"):
        interpolate.NearestNDInterpolator(points, [1, 2, 3, 4], tree_options={"leafsize": 5, "boxsize": 1})
    with pytest.raises(ValueError, match="finite"):
        numbers([[np.nan, 0]])


@pytest.mark.parametrize("kind", [interpolate.LinearNDInterpolator, interpolate.CloughTocher2DInterpolator,
                                  interpolate.NaturalNeighborInterpolator])
def test_queries_that_rounding_puts_outside_are_found(kind):
    random = np.random.default_rng(6)
    angle = np.radians(31.5)
    points = np.concatenate([[[0, 0], [1, 0], [0, 1], [1, 1]], 0.2 + 0.6 * random.random((50, 2))]) @ [[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]]
    hull = spatial.ConvexHull(points)
    at = random.random((100, hull.nsimplex, 1))
    queries = (at * points[hull.simplices[:, 0]] + (1 - at) * points[hull.simplices[:, 1]]).reshape(-1, 2)
    tri = spatial.Delaunay(points)
    assert (tri._core.find_simplex(queries) < 0).any()
    np.testing.assert_allclose(kind(tri, points @ [1, 2])(queries), queries @ [1, 2], rtol=1e-4)
    np.testing.assert_allclose(kind(tri, points @ [1, 2] + 1j)(queries), queries @ [1, 2] + 1j, rtol=1e-4)
    assert np.isnan(kind(tri, points[:, 0])(points.mean(axis=0) + 1.001 * (queries - points.mean(axis=0)))).all()


def test_gradients_minimize_the_curvature_of_the_network():
    """Against the normal equations of Σ ∫ W''² over all edges, solved at once."""
    random = np.random.default_rng(7)
    points, values = random.random((40, 2)), random.random(40)
    function = interpolate.CloughTocher2DInterpolator(points, values, tol=1e-14, maxiter=10_000)
    matrix, right = np.zeros((80, 80)), np.zeros(80)
    indptr, indices = spatial.Delaunay(points).vertex_neighbor_vertices
    for p in range(40):
        for q in indices[indptr[p]:indptr[p + 1]]:
            e = points[q] - points[p]
            weight = 1 / np.linalg.norm(e)**3
            matrix[2 * p:2 * p + 2, 2 * p:2 * p + 2] += 4 * weight * np.outer(e, e)
            matrix[2 * p:2 * p + 2, 2 * q:2 * q + 2] += 2 * weight * np.outer(e, e)
            right[2 * p:2 * p + 2] += 6 * weight * (values[q] - values[p]) * e
    np.testing.assert_allclose(function.grad[:, 0], np.linalg.solve(matrix, right).reshape(40, 2), rtol=1e-9, atol=1e-9)
    with pytest.warns(interpolate.GradientEstimationWarning):
        interpolate.CloughTocher2DInterpolator(points, values, maxiter=1)


def test_cubics_meet_smoothly():
    random = np.random.default_rng(8)
    points = np.stack(np.mgrid[:6, :6], axis=-1).reshape(-1, 2) + 0.3 * random.random((36, 2))
    function = interpolate.CloughTocher2DInterpolator(points, random.random(36))
    np.testing.assert_allclose(function(points), function.values[:, 0], rtol=1e-13)
    tri, step = function.tri, 1e-6
    inner = [(i, j) for i, j in zip(*np.nonzero(tri.neighbors > np.arange(tri.nsimplex)[:, None]))]
    for i, j in inner:
        a, b = points[np.delete(tri.simplices[i], j)]
        normal = np.array([a[1] - b[1], b[0] - a[0]]) / np.linalg.norm(b - a)
        at = a + 0.37 * (b - a)
        left, middle, right = function([at - step * normal, at, at + step * normal])
        slope, bend = (right - left) / (2 * step), (right - 2 * middle + left) / step
        assert abs(bend) < 0.1


def test_slivers_have_no_nan():
    """Flat triangles with neighbors that are flat as well: the tilt of cross derivatives stays finite."""
    x = np.linspace(0, 1, 12)
    points = np.concatenate([np.c_[x, 1e-17 * np.sin(99 * x)], [[0.5, 1], [0.5, -1]]])
    function = interpolate.CloughTocher2DInterpolator(points, points @ [2, 3])
    assert np.isfinite(function(points)).all()
    np.testing.assert_allclose(function(points), points @ [2, 3], atol=1e-12)


def test_scipy_is_not_imported():
    code = ("import sys, delone.interpolate as i; p = [[0, 0], [1, 0], [0, 1], [1, 1.1]]; "
            "[f(p, [1, 2, 3, 4])([0.2, 0.3]) for f in (i.LinearNDInterpolator, i.NearestNDInterpolator, i.CloughTocher2DInterpolator)]; "
            "i.griddata(p, [1, 2, 3, 4], [0.2, 0.3]); print('scipy' in sys.modules)")
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "False\n"
