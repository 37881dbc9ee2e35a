# SPDX-License-Identifier: BSD-3-Clause
"""delone.spatial.HalfspaceIntersection against scipy.spatial.HalfspaceIntersection, attribute by attribute."""
import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from delone import spatial
from spatial_support import QUICK, assert_same_kind

scipy_spatial = pytest.importorskip("scipy.spatial")


@st.composite
def bounded_halfspaces(draw):
    """(halfspaces, interior point): a simplex around the point and random halfspaces that contain it, in general position."""
    d = draw(st.integers(2, 6))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n = draw(st.integers(0, {2: 30, 3: 25, 4: 18, 5: 12, 6: 8}[d]))
    normals = np.concatenate([np.eye(d), -np.ones((1, d)), random.standard_normal((n, d))])
    normals += 0.1 * random.standard_normal(normals.shape)
    interior = random.standard_normal(d)
    distances = 1 + random.random(len(normals))
    return np.c_[normals, -normals @ interior - distances * np.linalg.norm(normals, axis=1)], interior


def both(halfspaces, interior_point, **arguments):
    return (spatial.HalfspaceIntersection(halfspaces, interior_point, **arguments),
            scipy_spatial.HalfspaceIntersection(halfspaces, interior_point, **arguments))


def assert_agree(ours, theirs):
    for name in ["halfspaces", "interior_point", "intersections", "dual_points", "dual_equations", "dual_vertices"]:
        assert_same_kind(getattr(ours, name), getattr(theirs, name))
    assert (ours.ndim, ours.nineq) == (theirs.ndim, theirs.nineq)
    np.testing.assert_array_equal(ours.halfspaces, theirs.halfspaces)
    np.testing.assert_array_equal(ours.dual_vertices, theirs.dual_vertices)
    np.testing.assert_allclose(ours.dual_points, theirs.dual_points, rtol=1e-9, atol=1e-12)
    places = {tuple(sorted(facet)): i for i, facet in enumerate(ours.dual_facets)}
    assert len(places) == len(ours.dual_facets) == len(theirs.dual_facets)
    which = [places[tuple(sorted(facet))] for facet in theirs.dual_facets]
    np.testing.assert_allclose(ours.dual_equations[which], theirs.dual_equations, rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(ours.intersections[which], theirs.intersections, rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose([ours.dual_volume, ours.dual_area], [theirs.dual_volume, theirs.dual_area], rtol=1e-9)
    assert ours.is_bounded is True


@given(case=bounded_halfspaces())
@QUICK
def test_every_attribute_agrees(case):
    assert_agree(*both(*case))


@given(case=bounded_halfspaces(), parts=st.integers(1, 3))
@QUICK
def test_adding_halfspaces_agrees(case, parts):
    halfspaces, interior = case
    first = halfspaces.shape[1]
    ours = spatial.HalfspaceIntersection(halfspaces[:first], interior, incremental=True)
    for rows in np.array_split(halfspaces[first:], parts):
        ours.add_halfspaces(rows)
    # Compared with scipy in one batch: scipy refuses some additions, and misses dual vertices after others.
    assert_agree(ours, scipy_spatial.HalfspaceIntersection(halfspaces, interior))
    ours.close()
    with pytest.raises(RuntimeError):
        ours.add_halfspaces(halfspaces)


def test_a_cube_has_eight_vertices_and_exact_ones():
    halfspaces = [[*(sign * np.eye(3)[axis]), -1] for axis, sign in itertools.product(range(3), (-1, 1))]
    cube = spatial.HalfspaceIntersection(halfspaces + [[1, 1, 0, -2], [1, 1, 1, -5]], [0.1, 0.2, 0])
    assert set(map(tuple, cube.intersections.tolist())) == set(itertools.product((-1.0, 1.0), repeat=3))
    assert cube.dual_vertices.tolist() == [0, 1, 2, 3, 4, 5]
    assert cube.is_bounded


def test_unbounded_intersections_have_their_finite_vertices():
    corner = spatial.HalfspaceIntersection([[-1, 0, 0], [0, -1, 0]], [1, 1], flat="result")
    assert corner.intersections.tolist() == [[0, 0]] and not corner.is_bounded


def test_a_point_that_is_not_inside_is_a_qhull_error_as_in_scipy():
    halfspaces = np.array([[-1, 0.0, 0], [0, -1, 0], [1, 1, -2]])
    for module in (spatial, scipy_spatial):
        with pytest.raises(module.QhullError):
            module.HalfspaceIntersection(halfspaces, np.array([3.0, 3]))
        with pytest.raises(ValueError, match="Feasible point"):
            module.HalfspaceIntersection(halfspaces, np.array([3.0, 3, 3]))
        with pytest.raises(ValueError):
            module.HalfspaceIntersection(np.ma.masked_array(halfspaces), np.array([0.5, 0.5]))
    grown = spatial.HalfspaceIntersection(halfspaces, [0.5, 0.5], incremental=True)
    with pytest.raises(spatial.QhullError, match=r"feasible: .* strictly inside halfspace 1: \[1\.0, 0\.0, -0\.25\]"):
        grown.add_halfspaces([[1, 0, -4], [1, 0, -0.25]])
    assert grown.nineq == 3 and len(grown.halfspaces) == 3


# Too few; a strip; hyperplanes through one point, one of them redundant; two of them equal.
@pytest.mark.parametrize("halfspaces", [[[-1, 0, 0], [0, -1, 0]], [[-1, 0, 0], [1, 0, -2]], [[-1, 0, 0], [0, -1, 0], [-1, -1, 0]],
                                        [[-1, 0, 0], [-2, 0, 0], [0, -1, 0]]])
def test_flat_dual_points_are_an_error_as_in_scipy_unless_a_result_is_wanted(halfspaces):
    for module in (spatial, scipy_spatial):
        with pytest.raises(module.QhullError, match="flat|not enough points"):
            module.HalfspaceIntersection(np.array(halfspaces, float), np.ones(2))
    result = spatial.HalfspaceIntersection(halfspaces, [1, 1], flat="result")
    assert not result.is_bounded and len(result.intersections) <= 2


@pytest.mark.parametrize("halfspaces", [[[-1, 0, 0], [0, -1, 0], [-1, -1, -1]], [[-1, 0, 0], [0, -1, 0], [1, 1, -3]]])
def test_other_halfspaces_are_no_error(halfspaces):
    assert len(spatial.HalfspaceIntersection(halfspaces, [1, 1]).dual_vertices) == 3 - (halfspaces[2][2] == -1)
    scipy_spatial.HalfspaceIntersection(np.array(halfspaces, float), np.ones(2))


def test_one_halfspace_may_be_added_as_a_vector():
    square = spatial.HalfspaceIntersection([[-1, 0, 0], [0, -1, 0], [1, 0, -2], [0, 1, -2]], [1, 1], incremental=True)
    square.add_halfspaces([1, 1, -3])
    assert (square.nineq, square.ndim, len(square.intersections)) == (5, 2, 5)
    with pytest.raises(ValueError, match="2D array"):
        square.add_halfspaces(np.ones((1, 1, 3)))
    with pytest.raises(ValueError, match="invalid size"):
        square.add_halfspaces([1, 1, 1, 1])
    with pytest.raises(AttributeError, match="interior_point of HalfspaceIntersection cannot be assigned"):
        square.interior_point = [0.5, 0.5]
