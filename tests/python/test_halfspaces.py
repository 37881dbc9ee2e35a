# SPDX-License-Identifier: BSD-3-Clause
"""delone.HalfspaceIntersection: polyhedra that are known, scipy on general ones, integers on degenerate ones."""
import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import delone
from spatial_support import DIMENSIONS, QUICK


def cube(dimension):
    """|x_j| <= 1."""
    unit = np.eye(dimension)
    return np.concatenate([np.concatenate([unit, -unit]), -np.ones((2 * dimension, 1))], axis=1)


def lists(offsets, items):
    return [tuple(items[a:b].tolist()) for a, b in zip(offsets, offsets[1:])]


def sorted_rows(rows):
    return np.array(sorted(np.asarray(rows).tolist()))


@pytest.mark.parametrize("dimension", range(1, 6))
def test_cube(dimension):
    h = delone.HalfspaceIntersection(cube(dimension))
    assert h.state == "full" and h.is_bounded and h.rank == h.dimension == dimension and h.axes == tuple(range(dimension))
    assert sorted(map(tuple, h.vertices.tolist())) == sorted(itertools.product([-1.0, 1.0], repeat=dimension))
    assert h.facet_halfspaces.tolist() == list(range(2 * dimension)) and h.num_facets == len(h) == 2 * dimension
    for vertex, rows in zip(h.vertices, lists(h.vertex_offsets, h.vertex_halfspaces)):
        assert rows == tuple(np.flatnonzero(cube(dimension)[:, :-1] @ vertex == 1).tolist())
    assert all(len(facet) == 2 ** (dimension - 1) for facet in lists(h.facet_offsets, h.facet_vertices))
    assert len(h.edges) == dimension * 2 ** (dimension - 1) and h.rays.shape == (0, 2) and h.directions.shape == (0, dimension)
    assert np.isclose(h.volume, 2.0**dimension) and h.kinds.tolist() == [0] * (2 * dimension)
    assert (cube(dimension)[:, :-1] @ h.interior_point < 1).all()


@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_vertices_are_those_of_scipy(dimension):
    scipy_spatial = pytest.importorskip("scipy.spatial")
    random = np.random.default_rng(dimension)
    normals = random.standard_normal((dimension * 3 + 6, dimension))
    rows = np.concatenate([np.concatenate([normals, -np.ones((len(normals), 1))], axis=1), cube(dimension) * 3], axis=0)
    center = np.zeros(dimension)
    h, theirs = delone.HalfspaceIntersection(rows, center), scipy_spatial.HalfspaceIntersection(rows, center)
    np.testing.assert_allclose(sorted_rows(h.vertices.round(8) + 0.0), sorted_rows(theirs.intersections.round(8) + 0.0), atol=1e-7)
    np.testing.assert_allclose(h.dual_points, theirs.dual_points, rtol=1e-12)
    assert h.facet_halfspaces.tolist() == sorted(theirs.dual_vertices)
    assert np.isclose(h.dual_volume, theirs.dual_volume) and np.isclose(h.dual_area, theirs.dual_area)
    assert delone.HalfspaceIntersection(rows).vertices.tolist() != [] and h.interior_point.tolist() == center.tolist()


@QUICK
@given(st.integers(1, 3), st.data())
def test_vertices_satisfy_all_rows_and_meet_theirs(dimension, data):
    rows = np.array(data.draw(st.lists(st.lists(st.integers(-2, 2), min_size=dimension, max_size=dimension), min_size=0, max_size=8)))
    rows = np.concatenate([cube(dimension), np.concatenate([rows.reshape(-1, dimension), -np.ones((len(rows), 1))], axis=1)])
    h = delone.HalfspaceIntersection(rows)
    assert h.state == "full" and h.is_bounded
    values = rows[:, :-1] @ h.vertices.T + rows[:, -1:]
    assert values.max() < 1e-12
    facets = set(h.facet_halfspaces.tolist())
    for i, expected in enumerate(lists(h.vertex_offsets, h.vertex_halfspaces)):
        assert set(expected) == {j for j in np.flatnonzero(abs(values[:, i]) < 1e-12).tolist() if j in facets}
    # The same intersection is left if only facets are kept.
    again = delone.HalfspaceIntersection(rows[h.facet_halfspaces])
    assert sorted(map(tuple, again.vertices.tolist())) == sorted(map(tuple, h.vertices.tolist()))
    assert all((kind == 0) == (row in facets) for row, kind in enumerate(h.kinds))
    assert all(h.first_of_halfspace[row] < row for row in np.flatnonzero(h.kinds == 3))


def test_unbounded():
    h = delone.HalfspaceIntersection([[-1, 0, 0], [0, -1, 0]])  # the first quadrant
    assert not h.is_bounded and h.vertices.tolist() == [[0, 0]] and h.volume == np.inf
    assert sorted(h.directions.tolist()) == [[0, 1], [1, 0]] and sorted(h.rays.tolist()) == [[0, 0], [0, 1]]
    assert lists(h.direction_offsets, h.direction_halfspaces) == [(0,) if d == [0, 1] else (1,) for d in h.directions.tolist()]
    assert repr(h) == "<delone.HalfspaceIntersection: 2 halfspaces in dimension 2, 1 vertices, 2 facets, unbounded>"


def test_lines():
    h = delone.HalfspaceIntersection([[1, 0, 0, -1], [-1, 0, 0, -1], [2, 0, 0, -2]])  # a slab
    assert h.rank == 1 and h.axes == (0,) and h.lineality.shape == (2, 3)
    assert sorted(h.vertices.tolist()) == [[-1, 0, 0], [1, 0, 0]] and h.kinds.tolist() == [0, 0, 3]


@pytest.mark.parametrize("rows, state, witness", [
    ([[1, 0, 0], [-1, 0, 0], [0, 1, -1], [0, -1, -1]], "flat", [0, 1]),
    ([[1, 0, 1], [-1, 0, 0], [0, 1, -1]], "empty", [0, 1]),
])
def test_no_interior_is_a_result(rows, state, witness):
    h = delone.HalfspaceIntersection(rows)
    assert h.state == state and h.witness.tolist() == witness and h.vertices.shape == (0, 2) and h.interior_point.shape == (0,)
    assert h.vertex_offsets.tolist() == [0] and h.num_facets == 0 and h.volume == 0
    assert repr(h) == f"<delone.HalfspaceIntersection: {len(rows)} halfspaces in dimension 2, {state}>"


@pytest.mark.parametrize("given_point", [None, [0.25, 0.25, 0.25]])
def test_adding_halfspaces(given_point):
    h = delone.HalfspaceIntersection(cube(3), given_point)
    before = h.vertices
    kept = before.copy()
    h.insert_range([[1, 1, 1, -1.5]])
    h.insert_range(np.zeros((0, 4)))
    whole = delone.HalfspaceIntersection(np.concatenate([cube(3), [[1, 1, 1, -1.5]]]))
    assert sorted_rows(h.vertices).tolist() == sorted_rows(whole.vertices).tolist() and h.num_halfspaces == 7
    assert (before == kept).all()
    with pytest.raises(delone.InputError) as raised:
        h.insert_range([[1, 0, 0, -1], [1, 0, 0, 5]])
    assert raised.value.rows == [8] or raised.value.rows == [1]
    assert h.num_halfspaces == 7


@pytest.mark.parametrize("arguments, error, message", [
    ((cube(2), [5, 0]), delone.InputError, "interior"),
    ((cube(2), [1, 0]), delone.InputError, "interior"),
    ((cube(2), [1, 0, 0]), ValueError, r"interior_point: an array of shape \(2,\), not \(3,\)"),
    ((cube(2)[:, :-1], -cube(2)[:, -1]), ValueError, r"A x <= b is one array of halfspaces, numpy.c_\[A, -b\]"),
    (([[1.0], [2.0]],), ValueError, r"halfspaces: an array of shape \(m, d\+1\)"),
    (([1.0, 2.0],), ValueError, "halfspaces: an array of shape"),
    (([[1, 0, np.nan]],), delone.InputError, "row 0|point 0|halfspace 0|finite"),
])
def test_errors(arguments, error, message):
    with pytest.raises(error, match=message):
        delone.HalfspaceIntersection(*arguments)


def test_names_of_other_programs_say_how_rows_are_made():
    with pytest.raises(TypeError, match=r"no argument 'b'; A x <= b is one array of halfspaces, numpy.c_\[A, -b\]"):
        delone.HalfspaceIntersection(cube(2)[:, :-1], b=-cube(2)[:, -1])


@pytest.mark.parametrize("d, n", [(3, 1000), (4, 300)])
def test_arrays_do_not_depend_on_threads(d, n):
    normals = np.random.default_rng(2).normal(size=(n, d))
    rows = np.column_stack([normals, -np.linalg.norm(normals, axis=1)])
    one = delone.HalfspaceIntersection(rows, threads=1)
    for threads in (0, 2, 3):
        other = delone.HalfspaceIntersection(rows, threads=threads)
        assert np.array_equal(other.vertices, one.vertices) and np.array_equal(other.edges, one.edges)
        assert np.array_equal(other.vertex_halfspaces, one.vertex_halfspaces) and np.array_equal(other.facet_vertices, one.facet_vertices)
