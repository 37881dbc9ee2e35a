# SPDX-License-Identifier: BSD-3-Clause
"""delone.ConvexHull: facets of the polytope, extreme points, containment."""
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import delone
from exact_support import orientation
from spatial_support import DIMENSIONS, QUICK, SIZES, lattice_points, rows_as_set


def lattice(side, dimension):
    return np.stack(np.meshgrid(*[np.arange(float(side))] * dimension), axis=-1).reshape(-1, dimension)


def lists(offsets, items):
    return [tuple(items[a:b].tolist()) for a, b in zip(offsets, offsets[1:])]


@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_hull_is_that_of_scipy(dimension):
    scipy_spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(dimension).standard_normal((3 * SIZES[dimension], dimension))
    hull, theirs = delone.ConvexHull(points), scipy_spatial.ConvexHull(points)
    assert rows_as_set(hull.cells) == rows_as_set(theirs.simplices) and len(hull) == hull.num_facets == len(theirs.simplices)
    assert hull.vertices.tolist() == sorted(theirs.vertices)
    assert abs(hull.volume - theirs.volume) <= 1e-9 * theirs.volume and abs(hull.area - theirs.area) <= 1e-9 * theirs.area
    assert 0 <= hull.volume_error < 1e-9 * hull.volume and 0 <= hull.area_error < 1e-9 * hull.area


@pytest.mark.parametrize("dimension", range(1, 6))
def test_a_lattice_is_a_cube(dimension):
    points = lattice(3, dimension)
    hull = delone.ConvexHull(points)
    assert hull.f_vector == tuple(comb(dimension, j) * 2 ** (dimension - j) for j in range(dimension))
    assert np.isclose(hull.volume, 2.0**dimension) and np.isclose(hull.area, dimension * 2.0**dimension)
    inner = (points == 1).sum(axis=1)
    assert hull.point_kinds.tolist() == np.where(inner == 0, 0, np.where(inner == dimension, 2, 1)).tolist()
    assert all(len(facet) == 2 ** (dimension - 1) for facet in lists(*hull.facets))
    assert set(map(tuple, np.abs(hull.equations[:, :-1]).tolist())) == set(map(tuple, np.eye(dimension).tolist()))
    ridge_facets, offsets, rows = hull.ridges
    assert ridge_facets.shape == (hull.num_ridges, 2) and (dimension == 1 or all(len(r) == 2 ** (dimension - 2) for r in lists(offsets, rows)))


@QUICK
@given(lattice_points())
def test_containment_is_exact(points):
    hull = delone.ConvexHull(points)
    if hull.affine_dimension < hull.dimension:
        return
    k = hull.dimension
    queries = np.concatenate([lattice(4, k)[:60] - 0.5, lattice(3, k)[:40], points])
    inside = points[np.unique(hull.cells)].mean(axis=0)
    kinds = []
    for query in queries:
        # With an inner point x positively oriented against each cell: where is the query?
        sides = [orientation([query, *points[cell]]) for cell in hull.cells]
        kinds.append(0 if min(sides) > 0 else 1 if min(sides) == 0 else 2)
    assert all(orientation([inside, *points[cell]]) > 0 for cell in hull.cells)
    where = hull.locate(queries)
    assert where.kind.tolist() == kinds and where.kinds == ("inside", "on_boundary", "outside", "outside_affine_hull")
    assert hull.contains(queries).tolist() == [kind < 2 for kind in kinds]
    for i, point in enumerate(points):  # a point of the input is on the face that it spans if it is extreme
        kind, _, face = where[len(queries) - len(points) + i]
        if hull.point_kinds[hull.vertex_of_point[i]] == 0:
            assert kind == "on_boundary" and face == (hull.vertex_of_point[i],)
    for query in queries[:10]:
        seen = hull.visible_facets(query)
        beyond = {hull.facet_of_cell[i] for i, cell in enumerate(hull.cells) if orientation([query, *points[cell]]) < 0}
        assert seen.tolist() == sorted(beyond)


@QUICK
@given(lattice_points(), st.integers(0, 14))
def test_adding_points_in_parts(points, i):
    hull = delone.ConvexHull(points[:i])
    hull.insert_range(points[i:])
    whole = delone.ConvexHull(points)
    assert hull.hash == whole.hash and hull.point_kinds.tolist() == whole.point_kinds.tolist()
    assert sorted(lists(*hull.facets)) == sorted(lists(*whole.facets)) and hull.points.tolist() == points.tolist()


@QUICK
@given(lattice_points())
def test_cells_and_neighbors_share_ridges(points):
    hull = delone.ConvexHull(points)
    cells, neighbors = hull.cells, hull.neighbors
    assert cells.shape == neighbors.shape == (hull.num_cells, max(hull.affine_dimension, 0)) or hull.affine_dimension < 1
    for i, row in enumerate(neighbors):
        for j, other in enumerate(row):
            assert set(np.delete(cells[i], j)) <= set(cells[other])
    assert len(hull.facet_of_cell) == hull.num_cells
    for cell, facet in zip(cells, hull.facet_of_cell):
        normal = hull.equations[facet]
        if hull.affine_dimension == hull.dimension:
            np.testing.assert_allclose(points[cell] @ normal[:-1] + normal[-1], 0, atol=1e-12)


def test_distances_and_shapes():
    hull = delone.ConvexHull([[0, 0], [2, 0], [0, 2]])
    queries = np.array([[[0.5, 0.5], [3, 0]], [[-1, 0], [1, 1]]])
    assert hull.contains(queries).tolist() == [[True, False], [False, True]]
    assert hull.contains([1, 1]) and hull.contains([1, 1]).shape == ()
    distances = hull.plane_distance(queries)
    assert distances.shape == (2, 2, 3)
    np.testing.assert_allclose(distances, queries @ hull.equations[:, :-1].T + hull.equations[:, -1])
    assert (hull.equation_errors > 0).all() and (hull.equation_errors < 1e-14).all()
    with pytest.raises(ValueError, match=r"queries: an array of shape \(\.\.\., 2\)"):
        hull.contains([[1, 2, 3]])
    with pytest.raises(ValueError, match="one point"):
        hull.visible_facets([[1, 2], [3, 4]])


@pytest.mark.parametrize("rows, affine_dimension, vertices, facets", [
    (np.zeros((0, 2)), -1, [], 0),
    (np.ones((3, 2)), 0, [0], 0),
    ([[0, 0, 0], [1, 1, 1], [2, 2, 2]], 1, [0, 2], 2),
    ([[0, 0, 7], [1, 0, 7], [0, 1, 7], [1, 1, 7], [0.5, 0.5, 7]], 2, [0, 1, 2, 3], 4),
])
def test_flat_and_tiny_input(rows, affine_dimension, vertices, facets):
    hull = delone.ConvexHull(rows)
    assert hull.affine_dimension == affine_dimension and hull.vertices.tolist() == vertices and hull.num_facets == facets
    assert hull.f_vector[:1] == ((len(vertices),) if affine_dimension > 0 else ())
    if affine_dimension == 2:
        assert hull.volume == 1 and hull.area == 4
        assert [kind for kind, _, _ in hull.locate([[0.2, 0.2, 7], [0, 0.5, 7], [2, 2, 7], [0, 0, 0]])] == [
            "inside", "on_boundary", "outside", "outside_affine_hull"]


def test_representation():
    assert repr(delone.ConvexHull(lattice(3, 3))) == "<delone.ConvexHull: 27 points in dimension 3, 8 vertices, 6 facets>"
    assert repr(delone.ConvexHull([[0, 1], [1, 1]])) == (
        "<delone.ConvexHull: 2 points in dimension 2, affine dimension 1, 2 vertices, 2 facets>")
    assert delone.ConvexHull(lattice(3, 2)).statistics["insertions"] > 0


@pytest.mark.parametrize("d, n", [(3, 2000), (4, 500), (5, 200)])
def test_arrays_do_not_depend_on_threads(d, n):
    points = np.random.default_rng(2).normal(size=(n, d))
    points[::2] /= np.linalg.norm(points[::2], axis=1)[:, None] / 4
    one = delone.ConvexHull(points, threads=1)
    for threads in (0, 2, 3):
        other = delone.ConvexHull(points, threads=threads)
        assert other.hash == one.hash and np.array_equal(other.cells, one.cells) and np.array_equal(other.neighbors, one.neighbors)
        assert np.array_equal(other.equations, one.equations) and np.array_equal(other.point_kinds, one.point_kinds)
