# SPDX-License-Identifier: BSD-3-Clause
"""delone.Delaunay: cells and all that is derived from them, against scipy on general points and against integers on lattices."""
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import delone
from exact_support import in_sphere, orientation, squared_distance, weights
from spatial_support import DIMENSIONS, QUICK, SIZES, general_points, lattice_points, rows_as_set

KINDS = ("in_cell", "on_face", "on_vertex", "outside_hull", "outside_affine_hull")


def full(points):
    """The triangulation of lattice points that do not lie in a flat, or None."""
    t = delone.Delaunay(points)
    return t if t.affine_dimension == t.dimension else None


@pytest.mark.parametrize("dimension", DIMENSIONS)
def test_cells_are_those_of_scipy(dimension):
    scipy_spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(dimension).random((3 * SIZES[dimension], dimension))
    t = delone.Delaunay(points)
    assert rows_as_set(t.cells) == rows_as_set(scipy_spatial.Delaunay(points).simplices)
    assert (np.linalg.det(points[t.cells[:, 1:]] - points[t.cells[:, :1]]) > 0).all()


@QUICK
@given(lattice_points())
def test_no_point_is_inside_a_sphere_and_cells_are_oriented(points):
    t = full(points)
    if t is None:
        return
    sites = np.unique(points, axis=0)
    volume = 0
    for cell in points[t.cells]:
        assert orientation(cell) > 0
        volume += orientation(cell)
        assert all(in_sphere(cell, site) >= 0 for site in sites)
    # Cells with these spheres do not overlap, so that they cover the hull if they have its volume.
    hull = delone.ConvexHull(points)
    assert np.isclose(float(volume), hull.volume * np.prod(np.arange(1.0, t.dimension + 1)), rtol=1e-12)


@QUICK
@given(lattice_points())
def test_arrays_fit_together(points):
    t = delone.Delaunay(points)
    cells, neighbors, k = t.cells, t.neighbors, t.affine_dimension
    assert cells.shape == neighbors.shape == (len(t), k + 1) == (t.num_cells, k + 1)
    assert len(t.axes) == k and t.num_points == len(points) and t.points.tolist() == points.tolist()
    for i, row in enumerate(neighbors):
        for j, other in enumerate(row):
            if other >= 0 and k > 0:
                back = neighbors[other].tolist().index(i)
                assert set(np.delete(cells[i], j)) == set(np.delete(cells[other], back))

    first = [next(j for j in range(len(points)) if (points[j] == point).all()) for point in points]
    assert t.vertex_of_point.tolist() == first
    assert t.duplicates.tolist() == [[i, j] for i, j in enumerate(first) if i != j]
    assert t.num_duplicates == len(t.duplicates) and t.num_vertices == len(set(first)) == len(np.unique(cells))
    assert all(first[i] in cells[c] for i, c in enumerate(t.cell_of_point))

    expected = {i: set() for i in range(len(points))}
    for cell in cells.tolist():
        for i in cell:
            expected[i] |= set(cell) - {i}
    indptr, indices = t.vertex_neighbors
    assert [indices[a:b].tolist() for a, b in zip(indptr, indptr[1:])] == [sorted(expected[i]) for i in range(len(points))]


@QUICK
@given(lattice_points())
def test_hull_facets_look_outwards(points):
    t = full(points)
    if t is None:
        return
    facets = t.hull_facets
    assert len(facets) == (t.neighbors == -1).sum() and facets.shape[1:] == (t.dimension,)
    if t.dimension == 1:
        return
    inside = points[t.cells[0]].mean(axis=0)
    for facet in facets:
        matrix = points[facet] - inside
        assert np.linalg.det(matrix) > 0


@QUICK
@given(lattice_points(), st.randoms(use_true_random=False))
def test_result_depends_on_the_set_of_points_alone(points, random):
    t = delone.Delaunay(points)
    rows = list(range(len(points)))
    random.shuffle(rows)
    for other in (delone.Delaunay(points[rows]), delone.Delaunay(points, order="as_given"), delone.Delaunay(points, order="shuffled", seed=7),
                  delone.Delaunay(points, threads=2)):
        assert other.hash == t.hash
        assert {frozenset(map(tuple, c)) for c in other.points[other.cells].tolist()} == {frozenset(map(tuple, c)) for c in points[t.cells].tolist()}


@pytest.mark.parametrize("d, n", [(2, 2000), (3, 800), (4, 200), (5, 100)])
def test_arrays_do_not_depend_on_threads(d, n):
    points = np.random.default_rng(1).random((n, d))
    one = delone.Delaunay(points, threads=1)
    for threads in (0, 2, 3):
        other = delone.Delaunay(points, threads=threads)
        assert other.hash == one.hash and np.array_equal(other.cells, one.cells) and np.array_equal(other.neighbors, one.neighbors)
        assert np.array_equal(delone.Voronoi(other).vertices, delone.Voronoi(one).vertices)


@QUICK
@given(lattice_points(), st.integers(0, 14), st.integers(0, 14))
def test_adding_points_in_parts(points, i, j):
    i, j = sorted((min(i, len(points)), min(j, len(points))))
    t = delone.Delaunay(points[:i].reshape(-1, points.shape[1]))
    for part in (points[i:j], points[j:]):
        t.insert_range(part)
    whole = delone.Delaunay(points)
    assert t.hash == whole.hash and t.points.tolist() == points.tolist()
    assert t.vertex_of_point.tolist() == whole.vertex_of_point.tolist()


@pytest.mark.parametrize("rows, affine_dimension, cells", [
    (np.zeros((0, 3)), -1, (0, 0)),
    (np.zeros((1, 3)), 0, (1, 1)),
    (np.ones((5, 2)), 0, (1, 1)),
    ([[0, 0, 0], [1, 1, 1], [3, 3, 3]], 1, (2, 2)),
    ([[0, 0, 5], [1, 0, 5], [0, 1, 5]], 2, (1, 3)),
    ([[0], [3], [1]], 1, (2, 2)),
])
def test_flat_and_tiny_input_has_a_result(rows, affine_dimension, cells):
    t = delone.Delaunay(rows)
    assert t.affine_dimension == affine_dimension and t.cells.shape == t.neighbors.shape == cells
    assert t.transform.shape == (cells[0], cells[1], max(cells[1] - 1, 0))
    if affine_dimension >= 1:
        assert t.find_simplex(np.asarray(rows)[0]) >= 0
        assert t.locate(np.full((1, t.dimension), 0.25))[0][0] in KINDS


@QUICK
@given(lattice_points(), st.randoms(use_true_random=False))
def test_location_is_exact(points, random):
    t = full(points)
    if t is None:
        return
    queries = np.array([[random.choice([-1, 0, 0.5, 1, 1.5, 2]) for _ in range(t.dimension)] for _ in range(12)])
    where, found = t.locate(queries), t.find_simplex(queries)
    cells, numbers = t.barycentric(queries)
    assert len(where) == len(queries) and where.kinds == KINDS
    for query, (kind, cell, face), number, c, b in zip(queries, where, found, cells, numbers):
        containing = {i: [w > 0 for w in all_weights] for i, corners in enumerate(points[t.cells])
                      if min(all_weights := weights(corners, query)) >= 0}
        assert (cell >= 0) == (number >= 0) == (c >= 0) == bool(containing)
        if not containing:
            assert kind == "outside_hull" and face == () and np.isnan(b).all()
            continue
        assert {cell, number, c} <= set(containing)
        expected = tuple(sorted(t.cells[cell][containing[cell]].tolist()))
        assert face == expected
        assert kind == ("in_cell" if len(face) == t.dimension + 1 else "on_vertex" if len(face) == 1 else "on_face")
        assert (b > 0).tolist() == containing[c] and b.min() >= 0
        np.testing.assert_allclose(b @ points[t.cells[c]], query, atol=1e-14)


def test_location_out_of_the_flat():
    t = delone.Delaunay([[0, 0, 1], [4, 0, 1], [0, 4, 1]])
    where = t.locate([[1, 1, 1], [1, 1, 1 + 2**-52], [9, 9, 1], [2, 2, 1]])
    assert [kind for kind, _, _ in where] == ["in_cell", "outside_affine_hull", "outside_hull", "on_face"]
    assert where.cell.tolist() == [0, -1, -1, 0] and where[3][2] == (1, 2)
    assert repr(where) == "<delone.Locations: 1 in_cell, 1 on_face, 1 outside_hull, 1 outside_affine_hull>"
    assert where[-1] == where[3] and len(list(where)) == 4
    with pytest.raises(IndexError):
        where[4]


@QUICK
@given(general_points())
def test_transform_and_barycentric_agree(points):
    t = delone.Delaunay(points)
    queries = points[t.cells].mean(axis=1)[:50]
    cells, numbers = t.barycentric(queries)
    transform = t.transform[cells]
    np.testing.assert_allclose(np.einsum("qij,qj->qi", transform[:, :-1], queries - transform[:, -1]), numbers[:, :-1], atol=1e-6)
    np.testing.assert_allclose(np.einsum("qi,qij->qj", numbers, points[t.cells[cells]]), queries, rtol=1e-9, atol=1e-9)


@QUICK
@given(lattice_points(), st.randoms(use_true_random=False))
def test_nearest_is_the_first_of_the_nearest(points, random):
    queries = np.array([[random.choice([-2, 0, 0.5, 1, 1.5, 7]) for _ in range(points.shape[1])] for _ in range(10)])
    rows, distances = delone.Delaunay(points).nearest(queries)
    for query, row, distance in zip(queries, rows, distances):
        squares = [squared_distance(query, point) for point in points]
        assert row == squares.index(min(squares)) and np.isclose(distance**2, float(min(squares)), rtol=1e-14)


@pytest.mark.parametrize("dimension", [1, 2, 3, 6, 9])
def test_shapes_of_queries(dimension):
    random = np.random.default_rng(0)
    t = delone.Delaunay(random.random((dimension + 12, dimension)))
    for shape in [(), (1,), (0,), (5,), (2, 3), (2, 0, 4)]:
        queries = random.random((*shape, dimension))
        assert np.shape(t.find_simplex(queries)) == shape
        cells, numbers = t.barycentric(queries)
        assert np.shape(cells) == shape and numbers.shape == (*shape, dimension + 1)
        assert tuple(map(np.shape, t.nearest(queries))) == (shape, shape)
        assert len(t.locate(queries)) == int(np.prod(shape))
        np.testing.assert_array_equal(np.ravel(t.find_simplex(queries)), t.find_simplex(queries.reshape(-1, dimension)))
    for bad in (np.zeros((3, dimension + 1)), 1.0, np.zeros(dimension + 1)):
        with pytest.raises(ValueError, match=rf"queries: an array of shape \(\.\.\., {dimension}\), not"):
            t.find_simplex(bad)


def test_huge_and_tiny_coordinates():
    points = np.array([[0, 0], [1e300, 0], [0, 1e300], [1e300, 1e300], [5e-324, 5e-324]])
    t = delone.Delaunay(points)
    assert t.num_vertices == 5 and t.find_simplex([5e-324, 0]) >= 0 and t.find_simplex([-5e-324, 0]) == -1
    row, distance = t.nearest([[1e300, 0.5e300], [0, 5e-324]])
    assert row.tolist() == [1, 0] and distance.tolist() == [0.5e300, 5e-324]


def test_representation_and_statistics():
    t = delone.Delaunay(np.random.default_rng(0).random((50, 3)))
    assert repr(t) == f"<delone.Delaunay: 50 points in dimension 3, {len(t)} cells>"
    assert repr(delone.Delaunay([[0, 1], [0, 2]])) == "<delone.Delaunay: 2 points in dimension 2, affine dimension 1, 1 cells>"
    assert t.statistics["insertions"] == 50 and t.statistics["created_cells"] >= len(t)
    assert len(t.hash) == 32 and int(t.hash, 16) >= 0


@pytest.mark.parametrize("arguments, message", [
    ({"order": "random"}, "order: 'automatic', 'as_given' or 'shuffled', not 'random'"),
    ({"threads": -1}, "threads: at least 0, not -1"),
])
def test_bad_arguments(arguments, message):
    with pytest.raises(ValueError, match=message):
        delone.Delaunay([[0.0, 0.0]], **arguments)


class TestFurthestSite:
    @QUICK
    @given(lattice_points())
    def test_no_point_is_outside_a_sphere(self, points):
        t = delone.FurthestSite(points)
        extreme = np.flatnonzero(delone.ConvexHull(points).point_kinds == 0)
        assert sorted(np.unique(t.cells).tolist()) == extreme.tolist()
        first = delone.Delaunay(points).vertex_of_point
        assert t.hidden.tolist() == [i for i in range(len(points)) if first[i] not in extreme]
        assert t.num_hidden == len(t.hidden) and (t.vertex_of_point[t.hidden] == -1).all() and (t.cell_of_point[t.hidden] == -1).all()
        if t.affine_dimension == t.dimension:
            for cell in points[t.cells]:
                assert all(in_sphere(cell, point) <= 0 for point in points)

    def test_is_that_of_scipy(self):
        scipy_spatial = pytest.importorskip("scipy.spatial")
        points = np.random.default_rng(3).random((80, 3))
        t = delone.FurthestSite(points)
        assert rows_as_set(t.cells) == rows_as_set(scipy_spatial.Delaunay(points, furthest_site=True).simplices)
        assert repr(t) == f"<delone.FurthestSite: 80 points in dimension 3, {len(t)} cells>"

    def test_queries(self):
        points = np.random.default_rng(4).random((60, 2))
        t = delone.FurthestSite(points[:40])
        t.insert_range(points[40:])
        assert t.hash == delone.FurthestSite(points).hash
        inside = delone.ConvexHull(points).contains(points * 1.1)
        assert ((t.find_simplex(points * 1.1) >= 0) == inside).all()
        with pytest.raises(delone.Error):
            t.nearest([0, 0])
