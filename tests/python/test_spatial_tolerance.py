# SPDX-License-Identifier: BSD-3-Clause
"""The default tolerance of hulls and diagrams in delone.spatial: rounded boxes and crystals come out as programs expect."""
import itertools
import pickle

import numpy as np
import pytest

from delone import spatial


def turned_box(seed, n=4):
    """The surface of a subdivided box, turned at random: (points, its volume)."""
    turn, _ = np.linalg.qr(np.random.default_rng(seed).standard_normal((3, 3)))
    grid = np.array(list(itertools.product(range(n), repeat=3)), float) * [1, 0.7, 0.3]
    return grid[((grid == 0) | (grid == grid.max(axis=0))).any(axis=1)] @ turn + [0.1, 0.2, 0.3], (n - 1)**3 * 0.21


@pytest.mark.parametrize("seed", range(5))
def test_turned_boxes_have_eight_vertices_and_six_planes(seed):
    points, volume = turned_box(seed)
    hull, exact = spatial.ConvexHull(points), spatial.ConvexHull(points, tolerance=0)
    assert len(hull.vertices) == 8 and hull.nsimplex == 12
    assert len(np.unique(hull.equations, axis=0)) == 6
    assert len(exact.vertices) > 8
    np.testing.assert_allclose([hull.volume, exact.volume], volume, rtol=1e-12)
    assert (points @ hull.equations[:, :-1].T + hull.equations[:, -1]).max() <= 2 * hull.tolerance
    for options in ("Q0", "QJ"):
        assert len(spatial.ConvexHull(points, qhull_options=options).vertices) == len(exact.vertices)


def test_coplanar_points_within_the_tolerance_are_listed():
    points, _ = turned_box(1)
    hull = spatial.ConvexHull(points, qhull_options="Qc")
    assert sorted([*hull.vertices, *hull.coplanar[:, 0]]) == list(range(len(points)))
    plane = hull.equations[hull.coplanar[:, 1]]
    assert np.abs((points[hull.coplanar[:, 0]] * plane[:, :-1]).sum(axis=1) + plane[:, -1]).max() < 10 * hull.tolerance


def test_options_widen_the_tolerance():
    random = np.random.default_rng(3)
    points = np.concatenate([turned_box(1)[0] + 1e-7 * random.random((56, 3))])
    assert len(spatial.ConvexHull(points).vertices) > 8
    for option in ("W1e-6", "C1e-6", "C-1e-6", "E1e-6"):
        assert len(spatial.ConvexHull(points, qhull_options=option).vertices) == 8, option


def test_points_within_the_tolerance_of_a_plane_are_flat():
    flat = turned_box(2)[0]
    flat = (flat - flat.mean(axis=0)) @ np.diag([1, 1, 0]) @ np.linalg.qr(np.random.default_rng(5).standard_normal((3, 3)))[0]
    assert spatial.ConvexHull(flat, tolerance=0).affine_dimension == 3
    with pytest.raises(spatial.QhullError, match="flat"):
        spatial.ConvexHull(flat)
    assert spatial.ConvexHull(flat, flat="result").affine_dimension == 2


@pytest.mark.parametrize("incremental", [False, True])
def test_added_points_and_copies_keep_the_tolerance(incremental):
    points, _ = turned_box(3)
    hull = spatial.ConvexHull(points[:30] if incremental else points, incremental=incremental)
    if incremental:
        hull.add_points(points[30:])
    assert len(hull.vertices) == 8
    again = pickle.loads(pickle.dumps(hull))
    assert again.tolerance == hull.tolerance and (again.simplices == hull.simplices).all()


@pytest.mark.parametrize("kind", ["ConvexHull", "Voronoi"])
@pytest.mark.parametrize("tolerance", [-1e-9, np.nan, np.inf, 100.0])
def test_bad_tolerances_are_value_errors(kind, tolerance):
    with pytest.raises(ValueError, match="tolerance"):
        getattr(spatial, kind)(np.random.default_rng(1).random((20, 3)), tolerance=tolerance)


def test_points_far_from_the_origin_have_a_tolerance_within_their_extent():
    points = 1e17 + np.array([[0, 0], [16, 0], [0, 16], [16, 16]], float)
    assert spatial.Voronoi(points).tolerance <= 16
    with pytest.raises(spatial.QhullError):
        spatial.ConvexHull(points)
    assert len(spatial.ConvexHull(points, tolerance=0).vertices) == 4


def test_sites_of_rounded_crystals_have_the_ridges_of_crystallography():
    fcc = np.array([[0, 0, 0], [0, 0.5, 0.5], [0.5, 0, 0.5], [0.5, 0.5, 0]])
    shifts = np.array(list(itertools.product(range(-2, 3), repeat=3)), float)
    for basis, faces in [(np.concatenate([fcc, fcc + 0.25]), 16), (fcc, 12), (np.array([[0, 0, 0], [0.5, 0.5, 0.5]]), 14)]:
        points = 3.57 * (basis[None] + shifts[:, None]).reshape(-1, 3)
        middle = int(np.flatnonzero((points == 0).all(axis=1))[0])
        counts = [sum(middle in pair for pair in spatial.Voronoi(points, **arguments).ridge_dict) for arguments in ({}, {"tolerance": 0})]
        assert counts[0] == faces <= counts[1]


def test_the_largest_coordinates():
    square = np.array([[0, 0], [1, 0], [0, 1], [1, 1.0]])
    assert len(spatial.ConvexHull(square * 6e307).vertices) == 4
    assert len(spatial.Voronoi(np.r_[square, [[0.4, 0.3]]] * 1e308).vertices) == 4
    with pytest.raises(spatial.QhullError, match="within the tolerance of"):
        spatial.ConvexHull(square, qhull_options="W0.9")
