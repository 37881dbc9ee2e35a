# SPDX-License-Identifier: BSD-3-Clause
"""delone.Voronoi and PowerDiagram: against scipy, volumes of boxes, and diagrams that are known."""
import itertools
import math
import pickle

import numpy as np
import pytest
from hypothesis import given

import delone
from spatial_support import QUICK, general_points, lattice_points


def lists(offsets, items):
    return [tuple(items[a:b].tolist()) for a, b in zip(offsets, offsets[1:])]


@pytest.mark.parametrize("dimension", range(2, 6))
def test_diagram_is_that_of_scipy(dimension):
    scipy_spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(dimension).random((60, dimension))
    ours, theirs = delone.Voronoi(points), scipy_spatial.Voronoi(points)
    order, their_order = np.lexsort(ours.vertices.T), np.lexsort(theirs.vertices.T)
    np.testing.assert_allclose(ours.vertices[order], theirs.vertices[their_order], rtol=1e-6, atol=1e-6)
    number = np.empty(len(order) + 1, int)
    number[their_order], number[-1] = order, -1
    mine = {frozenset(pair): frozenset(ridge) for pair, ridge in zip(ours.ridge_points.tolist(), lists(ours.ridge_offsets, ours.ridge_vertices))}
    for pair, ridge in zip(theirs.ridge_points.tolist(), theirs.ridge_vertices):
        assert mine[frozenset(pair)] == frozenset(number[ridge].tolist())


@QUICK
@given(lattice_points())
def test_arrays_fit_together(points):
    v = delone.Voronoi(points)
    distinct = len(np.unique(points, axis=0))
    assert v.num_regions == distinct == len(v.is_bounded) and v.num_points == len(points) and v.points.tolist() == points.tolist()
    assert (points[v.region_points[v.point_region]] == points).all()
    regions, ridges = lists(v.region_offsets, v.region_vertices), lists(v.ridge_offsets, v.ridge_vertices)
    assert [v.region(i).tolist() for i in range(v.num_regions)] == list(map(list, regions))
    assert [v.ridge(i).tolist() for i in range(v.num_ridges)] == list(map(list, ridges))
    assert [(-1 not in region) and region != () for region in regions] == v.is_bounded.tolist() or v.affine_dimension < 1
    for pair, ridge in zip(v.ridge_points, ridges):  # vertices of a ridge are as near to its two sites as to any
        for vertex in v.vertices[[i for i in ridge if i >= 0]]:
            distances = np.linalg.norm(points - vertex, axis=1)
            np.testing.assert_allclose(distances[pair], distances.min(), rtol=1e-9, atol=1e-9)
    assert v.ray_directions.shape == (v.num_rays, points.shape[1]) and v.ray_points.shape[0] == len(v.ray_vertices) == v.num_rays
    with pytest.raises(IndexError):
        v.region(v.num_regions)
    with pytest.raises(IndexError):
        v.ridge(v.num_ridges)


@QUICK
@given(general_points(dimension=3))
def test_volumes_fill_a_box(points):
    v = delone.Voronoi(points)
    low, high = v.bounding_box(0.5)
    volumes = v.region_volumes((low, high))
    assert np.isclose(volumes.sum(), np.prod(high - low), rtol=1e-9)
    whole = v.region_volumes()
    assert (np.isinf(whole) == ~v.is_bounded).all() and (volumes <= whole * (1 + 1e-9)).all()
    assert (np.isinf(v.ridge_volumes()) == [-1 in ridge for ridge in lists(v.ridge_offsets, v.ridge_vertices)]).all()


def test_square():
    v = delone.Voronoi([[0, 0], [2, 0], [0, 2], [2, 2], [1, 1], [1, 1]])
    assert sorted(v.vertices.tolist()) == [[0, 1], [1, 0], [1, 2], [2, 1]]
    assert v.is_bounded.tolist() == [False] * 4 + [True] and v.point_region.tolist() == [0, 1, 2, 3, 4, 4]
    np.testing.assert_allclose(v.region_volumes(), [np.inf] * 4 + [2], rtol=1e-15)
    np.testing.assert_allclose(v.region_volumes(([0, 0], [2, 2])), [0.5, 0.5, 0.5, 0.5, 2], rtol=1e-15)
    assert repr(v) == "<delone.Voronoi: 6 points in dimension 2, 5 regions, 4 vertices>"
    assert [x.tolist() for x in v.bounding_box(0.5)] == [[-1, -1], [3, 3]]


def test_volumes_by_point():
    box = ([0, 0], [2, 2])
    t = delone.Delaunay([[0, 0], [2, 0], [0, 2], [2, 2], [1, 1], [1, 1]])
    v = delone.Voronoi(t)
    np.testing.assert_allclose(v.region_volumes(box, at="points"), [0.5, 0.5, 0.5, 0.5, 2, 2], rtol=1e-15)
    np.testing.assert_allclose(v.region_volumes(at="points"), [np.inf] * 4 + [2, 2], rtol=1e-15)
    np.testing.assert_array_equal(v.region_volumes(box, at="regions"), v.region_volumes(box))
    t.remove([0, 4])
    volumes = delone.Voronoi(t).region_volumes(box, at="points")
    assert np.isnan(volumes[[0, 4]]).all() and volumes[5] > 0 and np.isclose(np.nansum(volumes), 4)
    r = delone.Regular([[0, 0], [1, 0], [0, 1], [1, 1], [0.5, 0.5]], [0, 0, 0, 0, -5])
    assert delone.PowerDiagram(r).region_volumes(([0, 0], [1, 1]), at="points").tolist() == [0.25] * 4 + [0]
    with pytest.raises(ValueError, match="at: 'regions' or 'points', not 'cells'"):
        v.region_volumes(at="cells")


def test_flat_input():
    v = delone.Voronoi([[0, 0, 3], [2, 0, 3], [6, 0, 3]])
    assert v.affine_dimension == 1 and sorted(v.vertices.tolist()) == [[1, 0, 3], [4, 0, 3]]
    assert v.region_volumes(([0, 0, 0], [6, 2, 5])).tolist() == [10, 30, 20]
    assert delone.Voronoi([[1.0, 2.0]]).num_regions == 1 and delone.Voronoi(np.zeros((0, 2))).num_regions == 0


@pytest.mark.parametrize("box, error, message", [
    ([0, 1], ValueError, r"box: \(low, high\)"),
    (([0, 0], [0, 1]), delone.InputError, "box"),
    (([0, 0, 0], [1, 1, 1]), delone.InputError, "box"),
])
def test_bad_boxes(box, error, message):
    with pytest.raises(error, match=message):
        delone.Voronoi([[0, 0], [1, 0], [0, 1]]).region_volumes(box)


def test_it_is_data_of_its_own():
    t = delone.Delaunay(np.random.default_rng(0).random((40, 2)))
    v = delone.Voronoi(t)
    vertices = v.vertices
    before = vertices.copy()
    t.insert_range([[0.5, 0.5]])
    assert v.num_points == 40 and (v.vertices == before).all()
    del v, t
    assert (vertices == before).all() and not vertices.flags.writeable


def test_power_diagram():
    points, weights = np.random.default_rng(1).random((50, 3)), np.random.default_rng(2).random(50) * 0.02
    r = delone.Regular(points, weights)
    p = delone.PowerDiagram(r)
    assert p.weights.tolist() == weights.tolist() and (p.point_region[r.hidden] == -1).all()
    assert p.num_regions == r.num_vertices and sorted(p.vertices.tolist()) == sorted(delone.PowerDiagram(points, weights).vertices.tolist())
    low, high = p.bounding_box()
    assert np.isclose(p.region_volumes((low, high)).sum(), np.prod(high - low))
    box = np.random.default_rng(3).random((2000, 3)) * (high - low) + low
    rows, _ = r.nearest(box)
    share = np.bincount(p.point_region[rows], minlength=p.num_regions) / 2000
    assert abs(share - p.region_volumes((low, high)) / np.prod(high - low)).max() < 0.03
    assert np.allclose(delone.PowerDiagram(points, np.zeros(50)).region_volumes(), delone.Voronoi(points).region_volumes())
    assert repr(p).startswith("<delone.PowerDiagram: 50 points in dimension 3")


def test_triangulations_of_another_kind():
    with pytest.raises(TypeError, match="PowerDiagram"):
        delone.Voronoi(delone.Regular([[0.0, 0.0]], [0.0]))
    with pytest.raises(TypeError, match="Regular"):
        delone.PowerDiagram(delone.Delaunay([[0.0, 0.0]]))
    with pytest.raises(TypeError, match="needs 'weights'; without weights it is a Voronoi()"):
        delone.PowerDiagram([[0.0, 0.0], [1.0, 0.0]])


@QUICK
@given(lattice_points())
def test_furthest_sites(points):
    f = delone.FurthestSite(points)
    v = delone.FurthestVoronoi(f)
    assert not v.is_bounded.any() and (v.point_region == -1).tolist() == [row in f.hidden for row in range(len(points))]
    for pair, ridge in zip(v.ridge_points, lists(v.ridge_offsets, v.ridge_vertices)):
        for vertex in v.vertices[[i for i in ridge if i >= 0]]:
            distances = np.linalg.norm(points - vertex, axis=1)
            np.testing.assert_allclose(distances[pair], distances.max(), rtol=1e-9, atol=1e-9)
    for vertex, direction, sites in zip(v.ray_vertices, v.ray_directions, v.ray_points):
        distances = np.linalg.norm(points - (v.vertices[vertex] + direction), axis=1)
        np.testing.assert_allclose(distances[sites], distances.max(), rtol=1e-9, atol=1e-9)
    assert np.isinf(v.region_volumes()).all()
    assert delone.check(v)
    if f.num_vertices > 0:
        low, high = v.bounding_box()
        np.testing.assert_allclose(v.region_volumes((low, high)).sum(), np.prod(high - low), rtol=1e-9)


def test_furthest_sites_of_points():
    points = np.random.default_rng(3).random((30, 2))
    v = delone.FurthestVoronoi(points, tolerance=0.0)
    assert repr(v).startswith("<delone.FurthestVoronoi: 30 points") and v.to_data().kind == "furthest_voronoi"
    again = pickle.loads(pickle.dumps(v))
    assert type(again) is delone.FurthestVoronoi and (again.vertices == v.vertices).all() and (again.ray_directions == v.ray_directions).all()
    assert "<html" in v.to_html()
    with pytest.raises(TypeError, match="FurthestVoronoi"):
        delone.Voronoi(delone.FurthestSite(points))
    for other in (delone.Delaunay(points), delone.Regular(points, np.zeros(30))):
        with pytest.raises(TypeError, match="FurthestSite"):
            delone.FurthestVoronoi(other)


def turned(points, degrees):
    a = np.deg2rad(degrees)
    return points @ np.array([[np.cos(a), np.sin(a)], [-np.sin(a), np.cos(a)]])


def test_tolerance():
    grid = np.stack(np.meshgrid(np.arange(9.0), np.arange(9.0), indexing="ij"), -1).reshape(-1, 2)
    interior = ((grid > 0) & (grid < 8)).all(1)
    points = turned(grid, 31.5)
    exact, v = delone.Voronoi(points), delone.Voronoi(points, tolerance=1e-12)
    assert (exact.tolerance, exact.max_displacement, v.tolerance) == (0, 0, 1e-12) and 0 < v.max_displacement <= 1e-12
    counts = np.bincount(v.ridge_points.ravel(), minlength=len(points))
    assert (counts[interior] == 4).all() and v.num_ridges < exact.num_ridges and v.num_vertices < exact.num_vertices
    assert all(len(v.region(r)) == 4 for r in v.point_region[interior])
    box = v.bounding_box()
    np.testing.assert_array_equal(v.region_volumes(box), exact.region_volumes(box))
    assert len(v.ridge_volumes()) == v.num_ridges
    again = pickle.loads(pickle.dumps(v))
    assert again.tolerance == v.tolerance and (again.ridge_vertices == v.ridge_vertices).all()
    power = delone.PowerDiagram(points, np.full(len(points), 0.25), tolerance=1e-12)
    assert sorted(map(tuple, power.ridge_points.tolist())) == sorted(map(tuple, v.ridge_points.tolist()))
    assert delone.Voronoi(delone.Delaunay(points), tolerance=1e-12).num_ridges == v.num_ridges


@pytest.mark.parametrize("tolerance", [-1.0, np.nan, np.inf, 1e3])
def test_bad_tolerances(tolerance):
    points = np.random.default_rng(0).random((20, 2))
    with pytest.raises(ValueError, match="the tolerance"):
        delone.Voronoi(points, tolerance=tolerance)
    with pytest.raises(ValueError, match="the tolerance"):
        delone.PowerDiagram(points, np.zeros(20), tolerance=tolerance)


@pytest.mark.parametrize("d", [2, 3, 4])
def test_volumes_of_ridges_and_regions_at_all_magnitudes(d):
    """Scaled by powers of two, numbers are scaled and not rounded, as long as they are in the range of double precision."""
    points = np.random.default_rng(7).random((30, d))
    plain = delone.Voronoi(points)
    for exponent in (-1000, -530, -511, -340, -255, 255, 340, 505, 511, 1000, 1023):
        v = delone.Voronoi(np.ldexp(points, exponent))
        finite = np.isfinite(v.vertices).all(axis=1)
        assert finite.all() or exponent > 900
        for name, power in (("ridge_volumes", d - 1), ("region_volumes", d)):
            found = getattr(v, name)()
            assert not np.isnan(found).any()
            with np.errstate(over="ignore", under="ignore"):
                expected = np.ldexp(getattr(plain, name)(), power * exponent)
            near = found == expected if exponent > 900 else np.isclose(found, expected, rtol=1e-11, atol=2e-323)
            assert (near | np.isinf(found)).all() and (near.all() or exponent > 500), (name, exponent)


def test_ridges_with_vertices_beyond_the_range_are_infinite():
    for d in (2, 3, 4):
        points = (np.random.default_rng(3).random((40, d)) * 2 - 1) * 1.7e308
        v = delone.Voronoi(points)
        finite, volumes = np.isfinite(v.vertices).all(axis=1), v.ridge_volumes()
        assert not finite.all() and not np.isnan(volumes).any()
        for i in range(v.num_ridges):
            assert np.isinf(volumes[i]) or finite[v.ridge(i)].all()


def test_areas_of_long_thin_ridges():
    """The square of their width is beyond the range of double precision, their area is not."""
    for width, length in ((1.3 * 2.0**-530, 2.0**500), (1.3 * 2.0**530, 2.0**-500), (2.0**-600, 2.0**100), (2.0**300, 2.0**300)):
        axes = np.array([width, length, 1.0])
        points = np.array([[0, 0, -1], [0, 0, 1]] + [[x, y, z] for z in (-1, 1) for x, y in ((2, 0), (-2, 0), (0, 2), (0, -2))]) * axes
        v = delone.Voronoi(points)
        pair = np.flatnonzero((np.sort(v.ridge_points, axis=1) == [0, 1]).all(axis=1))
        assert np.isclose(v.ridge_volumes()[pair], 4 * width * length, rtol=1e-12, atol=0).all() and len(pair) == 1


def volume_by_vertices(points, cells, site, direction):
    """Of a bounded region, by the formula of Lawrence (doi:10.1090/S0025-5718-1991-1079024-2): a sum over its vertices, which are simple."""
    d = points.shape[1]
    terms = []
    for cell in cells[(cells == site).any(axis=1)]:
        normals = points[cell[cell != site]] - points[site]
        vertex = np.linalg.solve(normals, 0.5 * (normals**2).sum(axis=1))
        slopes = np.linalg.solve(normals.T, direction)
        terms.append((direction @ vertex) ** d / (math.factorial(d) * abs(np.linalg.det(normals)) * np.prod(slopes)))
    return math.fsum(terms)


@pytest.mark.parametrize("d, n", [(2, 12), (3, 40), (5, 40), (8, 28)])
def test_volumes_of_regions_by_their_vertices(d, n):
    random = np.random.default_rng(d)
    points = random.normal(size=(n, d))
    points *= random.uniform(1, 1.5, size=(n, 1)) / np.linalg.norm(points, axis=1, keepdims=True)
    points = np.vstack([np.zeros(d), points])
    triangulation = delone.Delaunay(points)
    volume = delone.Voronoi(triangulation).region_volumes(at="points")[0]
    expected = np.median([volume_by_vertices(points, triangulation.cells, 0, random.normal(size=d)) for _ in range(5)])
    assert np.isfinite(volume) and np.isclose(volume, expected, rtol=1e-6, atol=0)


@pytest.mark.parametrize("d", [4, 5, 6])
def test_volumes_of_regions_of_a_root_lattice(d):
    """D_d has the determinant 4, and its roots bound the region of 0."""
    roots = [a * np.eye(d)[i] + b * np.eye(d)[j] for i, j in itertools.combinations(range(d), 2) for a in (1, -1) for b in (1, -1)]
    assert np.isclose(delone.Voronoi(np.vstack([np.zeros(d), roots])).region_volumes(at="points")[0], 2, rtol=1e-13, atol=0)
