# SPDX-License-Identifier: BSD-3-Clause
"""Where delone.spatial gives more than scipy does: flat, duplicate, cospherical and coplanar points. docs/from-scipy.md lists these
differences; each has its test here.
"""
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import delone
from delone import spatial
from spatial_support import QUICK, lattice_points, rows_as_set

CLASSES = (spatial.Delaunay, spatial.ConvexHull, spatial.Voronoi)
PLANE_IN_SPACE = np.array([[0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1], [0.3, 0.4, 1]])


@pytest.mark.parametrize("points", [PLANE_IN_SPACE, [[0, 0], [1, 1]], [[0, 0], [1, 1], [2, 2], [5, 5]], [[3, 4]] * 5, [[3, 4]]])
@pytest.mark.parametrize("cls", CLASSES)
def test_flat_points_are_an_error_as_in_scipy_unless_a_result_is_wanted(cls, points):
    with pytest.raises(spatial.QhullError, match="QH6154 .* span a flat of dimension") as caught:
        cls(points)
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is caught.type and str(again) == str(caught.value)
    k = np.linalg.matrix_rank(np.subtract(points, points[0]))
    assert cls(points, flat="result").affine_dimension == cls(points, qhull_options="QJ").affine_dimension == k
    with pytest.raises(spatial.QhullError):
        cls(points, qhull_options="QJ", flat="error")
    with pytest.raises(ValueError, match="flat: 'error' or 'result', not 'yes'"):
        cls(points, flat="yes")


@pytest.mark.parametrize("cls", CLASSES)
def test_one_dimension_is_an_error_as_in_scipy_unless_a_result_is_wanted(cls):
    with pytest.raises(ValueError, match="at least 2-D"):
        cls([[0.0], [2], [1]])
    assert cls([[0.0], [2], [1]], flat="result").affine_dimension == 1


@pytest.mark.parametrize("cls", CLASSES)
def test_errors_are_also_of_the_class_of_scipy(cls):
    scipy_spatial = pytest.importorskip("scipy.spatial")
    with pytest.raises(scipy_spatial.QhullError):
        cls(PLANE_IN_SPACE)
    with pytest.raises(scipy_spatial.QhullError):
        scipy_spatial.ConvexHull(PLANE_IN_SPACE)


def test_flat_points_are_triangulated_in_their_flat():
    tri = spatial.Delaunay(PLANE_IN_SPACE, flat="result")
    assert (tri.ndim, tri.affine_dimension, tri.simplices.shape) == (3, 2, (4, 3))
    assert tri.convex_hull.shape == (4, 2)
    found = tri.find_simplex([[0.1, 0.3, 1], [0.1, 0.3, 1 + 1e-15], [2, 2, 1]])
    assert found[0] >= 0 and found[1] == found[2] == -1
    for attribute in ("transform", "equations"):
        with pytest.raises(spatial.QhullError, match="flat of dimension 2 in 3 dimensions"):
            getattr(tri, attribute)
    with pytest.raises(spatial.QhullError):
        tri.plane_distance([[0, 0, 0]])


def test_flat_points_have_a_hull_in_their_flat():
    hull = spatial.ConvexHull(PLANE_IN_SPACE, flat="result")
    assert hull.vertices.tolist() == [0, 1, 2, 3]
    assert rows_as_set(hull.simplices) == {(0, 1), (1, 3), (2, 3), (0, 2)}
    assert (hull.volume, hull.area) == (0, pytest.approx(2))
    with pytest.raises(spatial.QhullError, match="flat of dimension 2"):
        hull.equations
    line = spatial.ConvexHull(np.outer(np.arange(5), [1.0, 2, 2]), flat="result")
    assert (line.vertices.tolist(), line.volume, line.area) == ([0, 4], 0, 0)
    segment = spatial.ConvexHull([[0, 0], [3, 4], [1.5, 2]], flat="result")
    assert (segment.vertices.tolist(), segment.volume, segment.area) == ([0, 1], 0, pytest.approx(10))


def test_the_measures_of_a_flat_hull_are_limits():
    thick = PLANE_IN_SPACE.copy()
    thick[0, 2] += 1e-9
    flat, thin = spatial.ConvexHull(PLANE_IN_SPACE, flat="result"), spatial.ConvexHull(thick)
    np.testing.assert_allclose([flat.volume, flat.area], [thin.volume, thin.area], atol=1e-8)


def test_flat_points_have_a_diagram_in_their_flat():
    diagram = spatial.Voronoi([[0, 0, 1], [2, 0, 1], [0, 2, 1], [2, 2, 1]], flat="result")
    assert diagram.vertices.tolist() == [[1, 1, 1]]
    assert len(diagram.ridge_points) == 4 and diagram.regions == [[]] + [[-1, 0]] * 4


@pytest.mark.parametrize("points", [[[1.0, 2.0]], [[1.0, 2.0]] * 3, [[0.0, 0], [1, 1]], [[0.0], [2], [1]], [[0.0, 0], [1, 0], [0, 1]]])
def test_few_points_have_results(points):
    tri, hull, diagram = (cls(points, flat="result") for cls in CLASSES)
    k = tri.affine_dimension
    assert hull.affine_dimension == k and tri.simplices.shape[1] == k + 1
    assert len(tri.simplices) == len(np.unique(points, axis=0)) - k
    assert (tri.find_simplex(points) >= 0).all()
    assert len(hull.vertices) == min(k + 1, 3)
    assert len(diagram.point_region) == len(points)


def test_duplicates_are_the_only_coplanar_points():
    points = np.random.default_rng(2).random((20, 3))
    points = np.concatenate([points, points[3:6], points[3:4]])
    tri = spatial.Delaunay(points)
    np.testing.assert_array_equal(tri.coplanar[:, [0, 2]], [[20, 3], [21, 4], [22, 5], [23, 3]])
    assert (tri.simplices[tri.coplanar[:, 1]] == tri.coplanar[:, 2:]).any(axis=1).all()
    assert (tri.simplices[tri.vertex_to_simplex[20:]] == tri.coplanar[:, 2:]).any(axis=1).all()
    assert not np.isin(np.arange(20, 24), tri.simplices).any()
    bare = spatial.Delaunay(points, qhull_options="Qbb")
    assert bare.coplanar.shape == (0, 3) and (bare.vertex_to_simplex[20:] == -1).all()

    diagram = spatial.Voronoi(points)
    np.testing.assert_array_equal(diagram.point_region[20:], diagram.point_region[[3, 4, 5, 3]])
    assert (spatial.Voronoi(points, qhull_options="Qbb").point_region[20:] == -1).all()


@given(points=lattice_points(), queries=st.integers(0, 2**32 - 1))
@QUICK
def test_lattices_are_triangulated_without_flat_simplices(points, queries):
    tri = spatial.Delaunay(points, flat="result")
    assert rows_as_set(tri.simplices) == rows_as_set(delone.Delaunay(points).cells)
    distinct = np.unique(points, axis=0)
    assert len(np.unique(tri.simplices)) == len(distinct)
    assert len(tri.coplanar) == len(points) - len(distinct)
    assert (tri.find_simplex(points) >= 0).all()
    # Every point of the hull is found, and found where it is: half-integers are on faces of all dimensions.
    random = np.random.default_rng(queries)
    middles = (points[random.integers(len(points), size=20)] + points[random.integers(len(points), size=20)]) / 2
    found = tri.find_simplex(middles)
    assert (found >= 0).all()
    corners = points[tri.simplices[found]]
    assert (middles >= corners.min(axis=1)).all() and (middles <= corners.max(axis=1)).all()
    if tri.affine_dimension == tri.ndim:
        volumes = np.linalg.det(corners[:, :-1] - corners[:, -1:])
        assert (np.abs(volumes) > 0.5).all()
        assert np.isfinite(tri.transform).all() and np.isfinite(tri.equations).all()


@given(points=lattice_points())
@QUICK
def test_simplices_of_hulls_of_lattices_use_extreme_points_only(points):
    hull = spatial.ConvexHull(points, qhull_options="Qc", flat="result", tolerance=0)
    core = delone.ConvexHull(points)
    assert sorted(hull.vertices) == core.vertices.tolist()
    if hull.affine_dimension > 0:
        assert np.unique(hull.simplices).tolist() == core.vertices.tolist()
    if hull.affine_dimension == hull.ndim:
        distances = points @ hull.equations[:, :-1].T + hull.equations[:, -1]
        assert distances.max() < 1e-9
        np.testing.assert_allclose(hull.volume, core.volume, rtol=1e-12)
    # Together with the vertices, `coplanar` has all points of the boundary.
    boundary = core.point_kinds[core.vertex_of_point] < 2
    if hull.affine_dimension > 0:
        assert sorted([*hull.vertices, *hull.coplanar[:, 0]]) == np.flatnonzero(boundary).tolist()
        assert np.isin(hull.coplanar[:, 2], hull.vertices).all()


def test_a_point_within_an_edge_is_no_vertex_of_the_hull():
    hull = spatial.ConvexHull([[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [1, 1]], qhull_options="Qc")
    assert hull.vertices.tolist() == [0, 1, 2, 3]
    assert rows_as_set(hull.simplices) == {(0, 1), (1, 2), (2, 3), (0, 3)}
    assert hull.coplanar[:, 0].tolist() == [4]


def test_cospherical_points_share_a_voronoi_vertex():
    grid = np.array([[x, y] for x in range(3) for y in range(3)], dtype=float)
    diagram = spatial.Voronoi(grid)
    assert sorted(diagram.vertices.tolist()) == [[0.5, 0.5], [0.5, 1.5], [1.5, 0.5], [1.5, 1.5]]
    assert len(diagram.ridge_points) == 12


def test_location_has_the_tolerance_of_scipy():
    tri = spatial.Delaunay([[0, 0], [1, 0], [0, 1]])
    near = [[0.5, 0.5], [0.5, np.nextafter(0.5, 1)], [0.5, 0.5 + 1e-9], [-1e-9, 0.5], [3, 3], [np.nan, 0], [np.inf, 0]]
    assert tri.find_simplex(near).tolist() == [0, 0, -1, -1, -1, -1, -1]
    assert tri.find_simplex(near, tol=0).tolist() == [0, -1, -1, -1, -1, -1, -1]
    for one, expected in zip(near, [0, 0, -1, -1, -1, -1, -1]):
        assert tri.find_simplex(one).shape == () and tri.find_simplex(one) == expected
    assert tri.find_simplex(near, tol=1e-8).tolist() == [0, 0, 0, 0, -1, -1, -1]


def test_near_sides_of_the_hull_are_found_with_a_tolerance():
    random = np.random.default_rng(4)
    points = random.random((60, 3))
    tri = spatial.Delaunay(points)
    weights = random.dirichlet([1, 1, 1], size=len(tri.convex_hull))
    on_hull = np.einsum("fi,fij->fj", weights, points[tri.convex_hull])
    assert (tri.find_simplex(on_hull, tol=1e-12) >= 0).all()
    assert (tri.find_simplex(on_hull + 0.1 * (on_hull - points.mean(axis=0)), tol=1e-12) == -1).all()


def turned_grid(d, n, angle):
    grid = np.stack(np.meshgrid(*[np.arange(n)] * d, indexing="ij"), -1).reshape(-1, d).astype(float)
    turn = np.eye(d)
    for j in range(d - 1):
        step = np.eye(d)
        step[j:j + 2, j:j + 2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        turn = turn @ step
    random = np.random.default_rng(1)
    border = random.random((500, d)) * (n - 1)
    border[np.arange(500), random.integers(0, d, 500)] = np.where(random.random(500) < .5, 0, n - 1)
    return grid @ turn.T, border @ turn.T


def accepted(tri, queries, tol):
    """Which queries a simplex accepts, by scipy's rule: all simplices are tried."""
    transform = tri.transform
    is_thin = np.isnan(transform[:, 0, 0])
    beside = np.where(tri.neighbors >= 0, is_thin[tri.neighbors], False)
    low = np.where(beside, -np.sqrt(tol), -tol)
    with np.errstate(invalid="ignore"):
        c = np.einsum("fij,qfj->qfi", transform[:, :-1], queries[:, None, :] - transform[None, :, -1])
        c = np.concatenate([c, 1 - c.sum(axis=-1, keepdims=True)], axis=-1)
        return ((c >= low) & (c <= 1 + tol)).all(axis=-1)


@pytest.mark.parametrize("d, n", [(2, 12), (3, 5), (4, 3)])
@pytest.mark.parametrize("tol", [None, 1e-12, 1e-9, 1e-3])
def test_what_a_simplex_accepts_is_found(d, n, tol):
    points, border = turned_grid(d, n, 0.55)
    border += np.random.default_rng(2).normal(size=border.shape) * np.geomspace(1e-16, 1e-2, len(border))[:, None]
    tri = spatial.Delaunay(points)
    found = tri.find_simplex(border, tol=tol)
    tol = 100 * np.finfo(float).eps if tol is None else tol
    may = accepted(tri, border, tol * 0.999 - 1e-15 if tol > 1e-14 else tol)
    is_proper = np.isfinite(tri.transform[:, 0, 0])
    assert is_proper[found[may.any(axis=1)]].all() and (found[may.any(axis=1)] >= 0).all()
    must = accepted(tri, border, tol * 1.001 + 1e-15)
    proper = (found >= 0) & is_proper[found]
    assert must[proper, found[proper]].all()
    exact = delone.Delaunay(points).find_simplex(border)
    inside = (exact >= 0) & is_proper[exact]
    assert (found[inside] == exact[inside]).all()
    assert (found[exact >= 0] >= 0).all()


def test_no_query_that_scipy_finds_is_lost():
    scipy_spatial = pytest.importorskip("scipy.spatial")
    for d, n, angle in [(2, 20, 0.55), (2, 12, 5.28), (3, 6, 0.55), (4, 3, 0.2)]:
        points, border = turned_grid(d, n, angle)
        ours, theirs = spatial.Delaunay(points), scipy_spatial.Delaunay(points)
        for tol in (None, 1e-9, 1e-3):
            lost = (theirs.find_simplex(border, tol=tol) >= 0) & (ours.find_simplex(border, tol=tol) < 0)
            assert not lost.any(), (d, n, angle, tol)


@pytest.mark.parametrize("bad", [-1, np.nan, np.inf])
def test_bad_tolerances_are_refused(bad):
    tri = spatial.Delaunay([[0, 0], [1, 0], [0, 1]])
    with pytest.raises(ValueError, match="tol: a finite number >= 0"):
        tri.find_simplex([[0, 0]], tol=bad)


def test_needles_have_no_transform_but_are_located():
    points = np.array([[0, 0], [1, 0], [0.5, 1e-15], [0.5, 1]])
    tri = spatial.Delaunay(points)
    needles = np.isnan(tri.transform).any(axis=(1, 2))
    assert needles.sum() == 1 and np.isnan(tri.transform[needles]).all()
    assert np.isfinite(tri.equations).all()
    inside = [[0.5, 5e-16]]
    assert needles[tri._core.find_simplex(inside)].all()
    assert not needles[tri.find_simplex(inside)].any()  # its neighbor accepts the point


@pytest.mark.parametrize("scale", [1e-300, 1e-160, 1e160, 1e300])
def test_extreme_coordinates_do_not_change_what_is_exact(scale):
    points = np.random.default_rng(4).integers(0, 1 << 20, (40, 3)).astype(float)
    plain, scaled = spatial.Delaunay(points), spatial.Delaunay(points * 2.0**int(np.log2(scale)))
    assert rows_as_set(plain.simplices) == rows_as_set(scaled.simplices)
    scaled.equations, scaled.transform  # rounded, perhaps to infinity, but without an error
