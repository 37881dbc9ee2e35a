# SPDX-License-Identifier: BSD-3-Clause
"""delone.NaturalNeighborInterpolator, delone.natural_neighbors, and nearest(k=)."""
import pickle

import delone
import numpy as np
import pytest

RANDOM = np.random.default_rng(1)


def dense(points, queries, lists):
    """Coordinates as a matrix."""
    indptr, rows, weights = lists
    matrix = np.zeros((len(indptr) - 1, len(points)))
    for i in range(len(indptr) - 1):
        part = slice(indptr[i], indptr[i + 1])
        assert (np.diff(rows[part]) > 0).all()
        matrix[i, rows[part]] = weights[part]
    return matrix


@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_coordinates_reproduce_queries(d):
    points = RANDOM.random((60, d))
    queries = 0.3 + 0.4 * RANDOM.random((20, d))
    matrix = dense(points, queries, delone.natural_neighbors(points, queries))
    inside = matrix.any(axis=1)
    assert inside.sum() > 10 and (matrix >= 0).all()
    assert np.allclose(matrix[inside].sum(axis=1), 1, atol=1e-14, rtol=0)
    assert np.allclose((matrix @ points)[inside], queries[inside], atol=1e-13, rtol=0)


def test_coordinates_are_stolen_areas():
    # Voronoi areas before and after an insertion, inside a box that no region of a neighbor leaves.
    points = np.concatenate([RANDOM.random((200, 2)), [[-9, -9], [9, -9], [-9, 9], [9, 9]]])
    query = np.array([0.5, 0.5])
    box = ([-50, -50], [50, 50])
    before = delone.Voronoi(points).region_volumes(box)
    after = delone.Voronoi(np.vstack([points, query])).region_volumes(box)
    matrix = dense(points, [query], delone.natural_neighbors(delone.Delaunay(points), [query]))
    assert np.allclose(matrix[0], (before - after[:-1]) / after[-1], atol=1e-9, rtol=0)


def test_lists_at_points_and_outside():
    points = [[0, 0], [4, 0], [0, 4], [4, 4], [0, 0]]
    indptr, rows, weights = delone.natural_neighbors(points, [[[2, 2], [5, 5]], [[4, 0], [0, 1]]])
    assert indptr.tolist() == [0, 4, 4, 5, 7]
    assert rows.tolist() == [0, 1, 2, 3, 1, 0, 2]
    assert weights.tolist() == [0.25, 0.25, 0.25, 0.25, 1, 0.75, 0.25]


@pytest.mark.parametrize("smooth", [False, True])
def test_values_of_any_shape(smooth):
    points, queries = RANDOM.random((50, 2)), 0.3 + 0.4 * RANDOM.random((3, 4, 2))
    values = RANDOM.random((50, 2, 3)) + 1j * RANDOM.random((50, 2, 3))
    function = delone.NaturalNeighborInterpolator(points, values, smooth=smooth)
    assert function.smooth is smooth and function.values.dtype == complex
    found, gradient = function(queries), function.gradient(queries)
    assert found.shape == (3, 4, 2, 3) and gradient.shape == (3, 4, 2, 3, 2)
    one = delone.NaturalNeighborInterpolator(function.triangulation, values[:, 1, 2].imag, smooth=smooth)
    assert np.allclose(found[..., 1, 2].imag, one(queries), atol=1e-14)
    assert np.allclose(gradient[..., 1, 2, :].imag, one.gradient(queries), atol=1e-10)
    assert np.allclose(function.site_gradients[:, 1, 2].imag, one.site_gradients)
    assert np.array_equal(function(points), values)
    assert isinstance(one(queries[0, 0]), float)
    again = pickle.loads(pickle.dumps(function))
    assert np.array_equal(again(queries), found) and again.smooth is smooth
    given = delone.NaturalNeighborInterpolator(points, values, gradients=function.site_gradients)
    assert given.smooth
    if smooth:
        assert np.allclose(given(queries), found) and np.allclose(given.gradient(points), function.gradient(points))


def test_smooth_is_exact_for_spherical_quadratics():
    points = np.concatenate([RANDOM.random((300, 3)), np.indices((2, 2, 2)).reshape(3, -1).T * 2 - 0.5])
    f = lambda x: 1 + x @ [1, 2, 3] + 5 * (x * x).sum(axis=-1)
    gradients = [1, 2, 3] + 10 * points
    queries = RANDOM.random((40, 3))
    function = delone.NaturalNeighborInterpolator(points, f(points), smooth=True, gradients=gradients)
    assert np.allclose(function(queries), f(queries), atol=1e-11)
    assert np.allclose(function.gradient(queries), [1, 2, 3] + 10 * queries, atol=1e-7)


def test_gradients_make_it_smooth():
    random = np.random.default_rng(4)
    points, queries = random.random((40, 2)), random.random((20, 2)) * 0.5 + 0.25
    values, gradients = (points**2).sum(axis=1), 2 * points
    given, smooth = delone.NaturalNeighborInterpolator(points, values, gradients=gradients), delone.NaturalNeighborInterpolator(
        points, values, gradients=gradients, smooth=True)
    np.testing.assert_array_equal(given(queries), smooth(queries))
    assert given.smooth and pickle.loads(pickle.dumps(given)).smooth
    assert not delone.NaturalNeighborInterpolator(points, values).smooth


def test_outside():
    points, values = [[0, 0], [4, 0], [0, 4]], [1.0, 2, 3]
    assert np.isnan(delone.NaturalNeighborInterpolator(points, values)([5, 5]))
    assert delone.NaturalNeighborInterpolator(points, values, fill_value=-1)([5, 5]) == -1
    assert delone.NaturalNeighborInterpolator(points, values, outside="nearest")([9, 0]) == 2
    with pytest.raises(delone.InputError, match="query 1") as caught:
        delone.NaturalNeighborInterpolator(points, values, outside="error")([[1, 1], [5, 5]])
    assert list(caught.value.rows) == [1]


@pytest.mark.parametrize("smooth", [False, True])
def test_with_a_tolerance_slivers_do_not_count(smooth):
    grid = np.stack(np.meshgrid(np.arange(20.0), np.arange(20.0)), -1).reshape(-1, 2) / 19
    c, s = np.cos(0.55), np.sin(0.55)
    turn = np.array([[c, s], [-s, c]])
    points, at = grid @ turn, RANDOM.random(500)
    border = np.concatenate([np.c_[at, 0 * at], np.c_[0 * at, at], np.c_[at, 0 * at + 1], np.c_[0 * at + 1, at]]) @ turn
    f = lambda x: np.sin(3 * x[..., 0]) + x[..., 1] ** 2
    t = delone.Delaunay(points)
    exact = delone.NaturalNeighborInterpolator(t, f(points), smooth=smooth)
    tolerant = delone.NaturalNeighborInterpolator(t, f(points), smooth=smooth, tolerance=1e-9)
    assert exact.tolerance == 0 and tolerant.tolerance == 1e-9
    assert np.isnan(exact(border)).any() and (t.find_simplex(border) < 0).any()
    assert np.abs(tolerant(border) - f(border)).max() < 5e-3
    assert (tolerant(points) == f(points)).all()
    again = pickle.loads(pickle.dumps(tolerant))
    assert again.tolerance == 1e-9 and (again(border) == tolerant(border)).all()


def test_projects():
    points = RANDOM.random((40, 2))
    space = np.insert(points, 1, 0.5, axis=1)
    f = delone.NaturalNeighborInterpolator(space, points @ [1, 2], outside="project")
    inside = 0.4 + 0.2 * RANDOM.random((20, 2))
    assert np.allclose(f(np.insert(inside, 1, -8, axis=1)), inside @ [1, 2], atol=1e-13, rtol=0)
    assert np.isfinite(f(10 * RANDOM.standard_normal((50, 3)))).all()
    assert pickle.loads(pickle.dumps(f))([0.5, 9, 0.5]) == f([0.5, 9, 0.5])
    box = np.indices((3, 3, 3)).reshape(3, -1).T / 2
    g = delone.NaturalNeighborInterpolator(box, box @ [1, 2, 3j], outside="project")
    queries = 3 * RANDOM.random((60, 3)) - 1
    assert np.allclose(g(queries), np.clip(queries, 0, 1) @ [1, 2, 3j], atol=1e-13, rtol=0)


@pytest.mark.parametrize("bad", [-1, np.nan, np.inf])
def test_bad_tolerances_are_refused(bad):
    with pytest.raises(ValueError, match="tolerance"):
        delone.NaturalNeighborInterpolator([[0, 0], [1, 0], [0, 1]], [0, 1, 2], tolerance=bad)


def test_refusals():
    points = [[0, 0], [4, 0], [0, 4]]
    with pytest.raises(ValueError, match="values"):
        delone.NaturalNeighborInterpolator(points, [1.0])
    with pytest.raises(ValueError, match="outside"):
        delone.NaturalNeighborInterpolator(points, [1.0, 2, 3], outside="else")
    with pytest.raises(ValueError, match="gradients"):
        delone.NaturalNeighborInterpolator(points, [1.0, 2, 3], gradients=[1, 2])
    with pytest.raises(delone.Error, match="Delaunay"):
        delone.natural_neighbors(delone.Regular(points, [0, 0, 0]), [[1, 1]])
    function = delone.NaturalNeighborInterpolator(delone.Delaunay(points), [1.0, 2, 3])
    function.triangulation.insert_range([[9, 9]])
    with pytest.raises(RuntimeError):
        function([1, 1])


def test_k_nearest():
    points = RANDOM.integers(0, 5, (80, 2)).astype(float)
    first = np.unique(points, axis=0, return_index=True)[1]
    queries = RANDOM.integers(-2, 14, (6, 5, 2)) / 2
    rows, distances = delone.Delaunay(points).nearest(queries, k=9)
    assert rows.shape == distances.shape == (6, 5, 9)
    squares = ((queries[..., None, :] - points[np.sort(first)]) ** 2).sum(axis=-1)
    order = np.argsort(squares, axis=-1, kind="stable")[..., :9]
    assert np.array_equal(rows, np.sort(first)[order])
    assert np.allclose(distances**2, np.take_along_axis(squares, order, -1))


def test_k_nearest_of_few_points():
    t = delone.Delaunay([[0, 0], [1, 0], [0, 0], [0, 2]])
    rows, distances = t.nearest([2, 0], k=5)
    assert rows.tolist() == [1, 0, 3, -1, -1]
    assert np.isnan(distances[3:]).all() and distances[0] == 1
    assert t.nearest([2, 0], k=1)[0].tolist() == [1]
    assert t.nearest([2, 0])[0] == 1
    with pytest.raises(ValueError, match="k"):
        t.nearest([2, 0], k=0)
    rows, powers = delone.Regular([[0, 0], [4, 0]], [0, 24]).nearest([-0.5, 0], k=2)
    assert rows.tolist() == [1, 0] and np.allclose(powers, [-3.75, 0.25])


def test_gradients_at_a_turned_border():
    """Points just inside the hull, under slivers, have gradients like those of the grid that was not turned."""
    angle = np.deg2rad(10)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    grid = np.stack(np.meshgrid(np.arange(10.0), np.arange(10.0)), axis=-1).reshape(-1, 2)
    queries = 9 * np.random.default_rng(0).random((300, 2))

    def f(x):
        return np.sin(x[:, 0]) * np.cos(x[:, 1] / 2)

    turned = delone.NaturalNeighborInterpolator(grid @ turn, f(grid), smooth=True, tolerance=1e-10)
    assert np.abs(turned(queries @ turn) - f(queries)).max() < 0.07


def test_natural_neighbors_with_a_tolerance():
    square = [[0, 0], [1, 0], [0, 1], [1, 1], [0.4, 0.3]]
    function = delone.NaturalNeighborInterpolator(square, [0, 1, 2, 3, 1], tolerance=0.01)
    indptr, rows, weights = function.natural_neighbors([[-0.005, 0.5]])
    assert indptr.tolist() == [0, len(rows)] and set(rows.tolist()) >= {0, 2}
    assert function([[-0.005, 0.5]])[0] == pytest.approx(np.dot(function.values[rows], weights))
