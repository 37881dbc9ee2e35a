# SPDX-License-Identifier: BSD-3-Clause
"""delone.Regular: regular triangulations against integers on lattices, and against triangulations without weights."""
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import delone
from exact_support import in_sphere, squared_distance
from spatial_support import QUICK, general_points, lattice_points


@st.composite
def weighted_points(draw):
    points = draw(lattice_points())
    return points, np.array(draw(st.lists(st.integers(-2, 2), min_size=len(points), max_size=len(points))), dtype=float)


@QUICK
@given(weighted_points())
def test_no_point_is_below_a_cell_and_hidden_points_are_above(both):
    points, heights = both
    t = delone.Regular(points, heights)
    assert t.weights.tolist() == heights.tolist() and t.points.tolist() == points.tolist()
    assert set(t.hidden.tolist()) == set(np.flatnonzero(t.vertex_of_point == -1).tolist())
    assert t.num_hidden == len(t.hidden) and t.num_points == t.num_vertices + t.num_duplicates + t.num_hidden
    if t.affine_dimension < t.dimension:
        return
    for cell in t.cells:
        for point, weight in zip(points, heights):
            assert in_sphere(points[cell], point, [*heights[cell], weight]) >= 0
    # A point that is not hidden is a vertex; of equal points the one with the largest weight is, if any.
    for row, vertex in enumerate(t.vertex_of_point):
        if vertex >= 0:
            assert (points[vertex] == points[row]).all() and vertex in t.cells and heights[vertex] >= heights[row]


@QUICK
@given(general_points(), st.sampled_from([0.0, -3.0, 0.7]))
def test_equal_weights_change_nothing(points, weight):
    t, plain = delone.Regular(points, np.full(len(points), weight)), delone.Delaunay(points)
    assert set(map(frozenset, t.cells.tolist())) == set(map(frozenset, plain.cells.tolist()))
    assert len(t.hidden) == 0


@QUICK
@given(weighted_points(), st.randoms(use_true_random=False))
def test_nearest_has_the_least_power(both, random):
    points, heights = both
    queries = np.array([[random.choice([-2, 0, 0.5, 1, 3]) for _ in range(points.shape[1])] for _ in range(8)])
    rows, powers = delone.Regular(points, heights).nearest(queries)
    for query, row, power in zip(queries, rows, powers):
        all_powers = [squared_distance(query, point) - int(weight) for point, weight in zip(points, heights)]
        assert all_powers[row] == min(all_powers) and np.isclose(power, float(min(all_powers)), rtol=1e-12, atol=1e-12)


@QUICK
@given(weighted_points(), st.integers(0, 14))
def test_adding_points_in_parts(both, i):
    points, heights = both
    t = delone.Regular(points[:i], heights[:i])
    t.insert_range(points[i:], heights[i:])
    assert t.hash == delone.Regular(points, heights).hash and t.weights.tolist() == heights.tolist()


def test_a_light_point_is_hidden_and_a_heavy_one_hides():
    square = [[0, 0], [4, 0], [0, 4], [4, 4], [2, 2]]
    assert delone.Regular(square, [0, 0, 0, 0, -9]).hidden.tolist() == [4]
    assert delone.Regular(square, [0, 0, 0, 0, -7]).hidden.tolist() == []
    heavy = delone.Regular(square, [0, 0, 0, 0, 100])
    assert heavy.num_vertices == 5 and repr(heavy) == "<delone.Regular: 5 points in dimension 2, 4 cells>"


@pytest.mark.parametrize("weights, message", [
    ([1, 2], r"weights: an array of shape \(3,\), not \(2,\)"),
    ([[1, 2, 3]], r"weights: an array of shape \(3,\), not \(1, 3\)"),
    (["a", "b", "c"], "weights: not numbers"),
    ([1, 2**53 + 1, 3], "weights: row 1: 9007199254740993 is not exact"),
])
def test_bad_weights(weights, message):
    with pytest.raises(ValueError, match=message):
        delone.Regular([[0, 0], [1, 0], [0, 1]], weights)


def test_weights_that_are_not_finite_change_nothing():
    t = delone.Regular([[0, 0], [1, 0], [0, 1]], [0, 0, 0])
    before = t.hash
    with pytest.raises(delone.InputError) as raised:
        t.insert_range([[2, 2], [3, 3]], [0, np.inf])
    assert raised.value.rows == [1] and t.hash == before and t.num_points == 3
