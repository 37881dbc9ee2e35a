# SPDX-License-Identifier: BSD-3-Clause
"""delone.LinearInterpolator: values, gradients, what is outside, shapes and types."""
import pickle

import numpy as np
import pytest
from hypothesis import given

import delone
from spatial_support import DIMENSIONS, QUICK, SIZES, general_points, lattice_points


@pytest.mark.parametrize("dimension", DIMENSIONS)
@pytest.mark.parametrize("kind", [float, complex])
def test_values_are_those_of_scipy(dimension, kind):
    scipy_interpolate = pytest.importorskip("scipy.interpolate")
    random = np.random.default_rng(dimension)
    points, queries = random.random((2 * SIZES[dimension], dimension)), random.random((200, dimension)) * 1.2 - 0.1
    values = random.random((len(points), 3)).astype(kind) * (1 if kind is float else 1 + 2j)
    ours, theirs = delone.LinearInterpolator(points, values)(queries), scipy_interpolate.LinearNDInterpolator(points, values)(queries)
    assert ours.dtype == theirs.dtype and ours.shape == theirs.shape == (200, 3)
    np.testing.assert_allclose(ours, theirs, rtol=1e-8, atol=1e-8)


@QUICK
@given(general_points())
def test_linear_functions_are_reproduced(points):
    d = points.shape[1]
    slope = np.arange(1.0, d + 1)
    function = delone.LinearInterpolator(points, points @ slope - 3)
    queries = points[delone.Delaunay(points).cells].mean(axis=1)[:40]
    np.testing.assert_allclose(function(queries), queries @ slope - 3, rtol=1e-9, atol=1e-9)
    # Gradients of thin cells have few digits: as many as the cells' matrices.
    t = delone.Delaunay(points)
    cells = t.find_simplex(queries)
    good = np.linalg.cond(t.transform[cells, :-1]) < 1e4
    np.testing.assert_allclose(function.gradient(queries)[good], np.broadcast_to(slope, (good.sum(), d)), rtol=1e-6, atol=1e-6)


@QUICK
@given(lattice_points())
def test_values_at_points_are_those_given(points):
    values = np.random.default_rng(len(points)).random(len(points))
    t = delone.Delaunay(points)
    expected = values[t.vertex_of_point]  # of equal points that of the first
    for function in (delone.LinearInterpolator(t, values), delone.LinearInterpolator(points, values)):
        assert function(points).tolist() == expected.tolist()


def test_outside():
    points, values = [[0, 0], [4, 0], [0, 4]], [1.0, 2.0, 5.0]
    queries = [[1, 1], [5, 0], [0, -1], [4, 4]]
    assert delone.LinearInterpolator(points, values)(queries)[0] == 2.25
    assert np.isnan(delone.LinearInterpolator(points, values)(queries)).tolist() == [False, True, True, True]
    assert delone.LinearInterpolator(points, values, fill_value=-7)(queries).tolist() == [2.25, -7, -7, -7]
    nearest = delone.LinearInterpolator(points, values, outside="nearest")
    assert nearest(queries).tolist() == [2.25, 2, 1, 2]  # of two nearest points the first
    assert nearest.gradient(queries).tolist() == [[0.25, 1], [0, 0], [0, 0], [0, 0]]
    assert np.isnan(delone.LinearInterpolator(points, values).gradient(queries)[1:]).all()
    refusing = delone.LinearInterpolator(points, values, outside="error")
    assert refusing(queries[0]) == 2.25
    with pytest.raises(delone.InputError) as raised:
        refusing(queries)
    assert raised.value.rows in ([1], [2], [3])
    with pytest.raises(ValueError, match="outside: 'fill', 'nearest', 'error' or 'project', not 'raise'"):
        delone.LinearInterpolator(points, values, outside="raise")


def test_shapes_and_types():
    random = np.random.default_rng(0)
    t = delone.Delaunay(random.random((30, 2)))
    queries = {shape: random.random((*shape, 2)) * 0.4 + 0.3 for shape in [(), (1,), (0,), (7,), (2, 3)]}
    for value_shape in [(), (1,), (4,), (2, 3), (0,)]:
        for kind, result in [(float, np.float64), (np.int16, np.float64), (np.float32, np.float64), (complex, np.complex128), (np.complex64, np.complex128)]:
            values = (random.random((30, *value_shape)) * 100).astype(kind)
            function = delone.LinearInterpolator(t, values)
            assert function.values.dtype == result and function.values.shape == values.shape and function.triangulation is t
            for shape, xi in queries.items():
                assert np.shape(function(xi)) == (*shape, *value_shape) and function(xi).dtype == result
                gradient = function.gradient(xi)
                assert gradient.shape == (*shape, *value_shape, 2) and gradient.dtype == result


def test_complex_values_and_gradients_are_two_real_ones():
    random = np.random.default_rng(1)
    points, queries = random.random((40, 3)), random.random((50, 3))
    real, imaginary = random.random((2, 40, 2))
    both = delone.LinearInterpolator(points, real + 1j * imaginary, fill_value=2 - 3j)
    parts = [delone.LinearInterpolator(points, real, fill_value=2), delone.LinearInterpolator(points, imaginary, fill_value=-3)]
    np.testing.assert_array_equal(both(queries), parts[0](queries) + 1j * parts[1](queries))
    np.testing.assert_array_equal(both.gradient(queries).real, parts[0].gradient(queries))
    np.testing.assert_array_equal(both.gradient(queries).imag, parts[1].gradient(queries))


def test_flat_points():
    function = delone.LinearInterpolator([[0, 0, 1], [2, 0, 1], [0, 2, 1]], [0.0, 2.0, 6.0])
    assert function([[0.5, 0.5, 1]]).tolist() == [2] and np.isnan(function([0.5, 0.5, 1.1]))
    np.testing.assert_allclose(function.gradient([0.5, 0.5, 1]), [1, 3, 0], atol=1e-15)


def test_of_a_regular_triangulation_hidden_values_do_not_count():
    r = delone.Regular([[0, 0], [4, 0], [0, 4], [1, 1]], [0, 0, 0, -99])
    assert delone.LinearInterpolator(r, [0, 4, 8, 1000])([1, 1]) == 3


def test_nan_spreads_to_its_cells():
    function = delone.LinearInterpolator([[0, 0], [1, 0], [0, 1], [9, 9]], [1.0, 1.0, 1.0, np.nan])
    assert function([0.25, 0.25]) == 1 and np.isnan(function([3, 3]))


@pytest.mark.parametrize("values, message", [
    ([1.0, 2.0], "values: 2 rows, not one for each of 3 points"),
    (1.0, "values"),
    (["a", "b", "c"], "values: not numbers"),
    ([1, 2**60 + 1, 3], "values: row 1: 1152921504606846977 is not exact"),
])
def test_bad_values(values, message):
    with pytest.raises(ValueError, match=message):
        delone.LinearInterpolator([[0, 0], [1, 0], [0, 1]], values)


def test_bad_queries():
    function = delone.LinearInterpolator([[0, 0], [1, 0], [0, 1]], [1, 2, 3])
    with pytest.raises(ValueError, match=r"queries: an array of shape \(\.\.\., 2\)"):
        function([[1, 2, 3]])
    with pytest.raises(delone.InputError) as raised:
        function([[0, 0], [np.nan, 0]])
    assert raised.value.rows == [1]


def test_values_are_a_copy_that_cannot_be_changed():
    values = np.array([1.0, 2.0, 3.0])
    function = delone.LinearInterpolator([[0, 0], [1, 0], [0, 1]], values)
    values[:] = 100
    assert function([0, 0]) == 1 and function.values.tolist() == [1, 2, 3]
    with pytest.raises(ValueError):
        function.values[0] = 5


def test_points_may_not_be_added_afterwards():
    t = delone.Delaunay([[0, 0], [1, 0], [0, 1]])
    function = delone.LinearInterpolator(t, [1, 2, 3])
    t.insert_range(np.zeros((0, 2)))
    assert function([0, 0]) == 1
    t.insert_range([[1, 1]])
    with pytest.raises(RuntimeError, match="the triangulation has changed"):
        function([0, 0])


def test_the_triangulation_stays_alive():
    function = delone.LinearInterpolator(delone.Delaunay(np.random.default_rng(0).random((100, 3))), np.ones(100))
    assert abs(function([0.5, 0.5, 0.5]) - 1) < 1e-15


def turned_square(n, angle):
    grid = np.stack(np.meshgrid(np.arange(n), np.arange(n), indexing="ij"), -1).reshape(-1, 2).astype(float)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    border = np.random.default_rng(1).random((300, 2)) * (n - 1)
    border[:, 0] = 0
    return grid @ turn.T, border @ turn.T


def test_with_a_tolerance_slivers_do_not_count():
    points, border = turned_square(15, 0.55)
    f = lambda x: np.sin(x[:, 0]) + np.cos(x[:, 1])
    exact, tolerant = delone.LinearInterpolator(points, f(points)), delone.LinearInterpolator(points, f(points), tolerance=1e-9)
    assert tolerant.tolerance == 1e-9 and exact.tolerance == 0
    assert np.isnan(exact(border)).any()
    assert np.abs(tolerant(border) - f(border)).max() < 0.3
    assert (tolerant(points) == f(points)).all()
    assert np.isfinite(tolerant.gradient(border)).all()
    t = delone.Delaunay(points)
    assert (t.find_simplex(border) == -1).any() and (t.find_simplex(border, tolerance=1e-9) >= 0).all()
    cells, weights = t.barycentric(border, tolerance=1e-9)
    assert (cells >= 0).all() and (weights >= 0).all() and np.allclose(weights.sum(axis=1), 1, rtol=0, atol=1e-14)
    assert np.abs(np.einsum("qi,qij->qj", weights, points[t.cells[cells]]) - border).max() < 1e-9
    assert {kind for kind, _, _ in t.locate(border, tolerance=1e-9)} <= {"in_cell", "on_face", "on_vertex"}
    copy = pickle.loads(pickle.dumps(tolerant))
    assert copy.tolerance == 1e-9 and (copy(border) == tolerant(border)).all()


def test_projected_values_are_those_of_the_nearest_point_of_the_hull():
    points = np.array([[0, 0], [4, 0], [0, 4], [4, 4.]])
    f = delone.LinearInterpolator(points, points @ [1, 2], outside="project")
    outside = np.array([[-3, -1], [1, -50], [7, 9], [5, 1.5], [2, 2]])
    assert f(outside).tolist() == (np.clip(outside, 0, 4) @ [1, 2]).tolist()
    assert np.allclose(f.gradient(outside), [1, 2])
    space = np.c_[points, np.zeros(4)]
    flat = delone.LinearInterpolator(space, points @ [1, 2], outside="project")
    assert np.allclose(flat(np.c_[outside, np.full(5, 3.)]), f(outside))
    near = delone.LinearInterpolator(space, points @ [1, 2], tolerance=0.5)
    assert near([1, 1, 0.5]) == 3 and np.isnan(near([1, 1, 0.6]))


@pytest.mark.parametrize("bad", [-1, np.nan, np.inf])
def test_bad_tolerances_are_refused(bad):
    points = [[0, 0], [1, 0], [0, 1]]
    t = delone.Delaunay(points)
    for work in (lambda: delone.LinearInterpolator(points, [0, 1, 2], tolerance=bad), lambda: t.find_simplex([0, 0], tolerance=bad),
                 lambda: t.locate([[0, 0]], tolerance=bad), lambda: t.barycentric([[0, 0]], tolerance=bad)):
        with pytest.raises(ValueError, match="tolerance"):
            work()
