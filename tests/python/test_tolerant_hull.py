# SPDX-License-Identifier: BSD-3-Clause
"""delone.ConvexHull with a tolerance: shapes in rounded coordinates, flats, errors."""
import copy
import itertools
import pickle

import numpy as np
import pytest

import delone


def turned(points, seed):
    q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(points.shape[1],) * 2))
    return points @ q.T


def box(n, *lengths):
    grid = np.array(list(itertools.product(range(n + 1), repeat=len(lengths))), float)
    return grid[((grid == 0) | (grid == n)).any(1)] / n * lengths


@pytest.mark.parametrize("seed", range(30))
def test_a_turned_box_has_eight_vertices(seed):
    points = turned(box(6, 1, 2.3, 0.7), seed)
    hull = delone.ConvexHull(points, tolerance=1e-14)
    assert (hull.num_vertices, hull.num_facets, hull.num_ridges) == (8, 6, 12)
    assert hull.f_vector == (8, 12, 6)
    assert hull.tolerance == 1e-14 and 0 < hull.max_distance <= 1e-14
    assert hull.volume == pytest.approx(1 * 2.3 * 0.7, rel=1e-13)
    assert set(hull.cells.ravel()) == set(hull.vertices)
    assert np.all(hull.plane_distance(points) <= hull.tolerance + hull.equation_errors + 1e-15)


@pytest.mark.parametrize("lengths, k", [((1, 2, 0), 2), ((1, 0, 0), 1), ((1, 1, 0, 0), 2)])
def test_points_near_a_flat(lengths, k):
    hull = delone.ConvexHull(turned(box(4, *lengths), 1), tolerance=1e-14)
    assert hull.affine_dimension == len(hull.axes) == k
    assert hull.num_vertices == 2**k and hull.num_facets == 2 * k


def test_a_tolerance_of_zero_is_exact():
    points = np.random.default_rng(1).normal(size=(200, 3))
    assert delone.ConvexHull(points, tolerance=0).hash == delone.ConvexHull(points).hash
    assert delone.ConvexHull(points).tolerance == delone.ConvexHull(points).max_distance == 0


def test_it_is_pickled_and_grows():
    points = turned(box(4, 1, 1, 1), 3)
    hull = delone.ConvexHull(points[:40], tolerance=1e-14)
    hull.insert_range(points[40:])
    assert hull.num_vertices == 8
    for other in (pickle.loads(pickle.dumps(hull)), copy.deepcopy(hull)):
        assert other.tolerance == 1e-14 and other.hash == hull.hash


@pytest.mark.parametrize("tolerance, text", [(-1, "finite number from 0 on"), (float("nan"), "finite number"),
                                             (float("inf"), "finite number"), (3, "larger than the set")])
def test_bad_tolerances(tolerance, text):
    with pytest.raises(ValueError, match=text):
        delone.ConvexHull(np.eye(3), tolerance=tolerance)


@pytest.mark.parametrize("exponent", [0, 332, 900, -332, -900])
def test_facets_do_not_depend_on_the_scale(exponent):
    cube = np.stack(np.meshgrid(*[range(2)] * 5), axis=-1).reshape(-1, 5)
    turned = cube @ np.linalg.qr(np.random.default_rng(1).normal(size=(5, 5)))[0]
    hull = delone.ConvexHull(turned * 2.0**exponent, tolerance=2.0**exponent * 1e-10)
    assert hull.num_facets == 10 and len(hull.vertices) == 32
