# SPDX-License-Identifier: BSD-3-Clause
"""delone.spatial.Voronoi against scipy.spatial.Voronoi, attribute by attribute, on points in general position."""
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from delone import spatial
from spatial_support import QUICK, assert_same_kind, general_points

scipy_spatial = pytest.importorskip("scipy.spatial")


def both(points, **arguments):
    return spatial.Voronoi(points, **arguments), scipy_spatial.Voronoi(points, **arguments)


def vertex_numbering(ours, theirs):
    """The vertex of `ours` at each vertex of `theirs`, by their nearest sites: coordinates alone would ask for a tolerance."""
    def sites(diagram):
        found = [set() for _ in diagram.vertices]
        for point, region in enumerate(diagram.point_region):
            for vertex in diagram.regions[region]:
                if vertex >= 0:
                    found[vertex].add(point)
        return [frozenset(s) for s in found]
    places = {s: i for i, s in enumerate(sites(ours))}
    assert len(places) == len(ours.vertices) == len(theirs.vertices)
    return np.array([places[s] for s in sites(theirs)])


def is_rotation(a, b):
    """Whether the cyclic lists a and b are the same, in one direction or the other."""
    if len(a) != len(b) or set(a) != set(b):
        return False
    return not a or any(a == c[i:] + c[:i] for c in (b, b[::-1]) for i in range(len(c)))


def assert_agree(ours, theirs, points):
    for name in ["vertices", "ridge_points", "point_region", "min_bound", "max_bound"]:
        assert_same_kind(getattr(ours, name), getattr(theirs, name))
    for name in ["ndim", "npoints", "furthest_site"]:
        assert getattr(ours, name) == getattr(theirs, name), name
    np.testing.assert_array_equal(ours.points, points)
    which = vertex_numbering(ours, theirs)
    # A vertex far away is the solution of an ill-conditioned system; ours are correctly rounded, scipy's are not.
    distance = np.linalg.norm(theirs.vertices - points.mean(axis=0), axis=1) / np.ptp(points, axis=0).max()
    error = np.abs(ours.vertices[which] - theirs.vertices).max(axis=1) / np.ptp(points, axis=0).max()
    assert (error <= 1e-9 * (1 + distance)**3).all()

    renumbered = dict(zip([-1, *range(len(which))], [-1, *which.tolist()]))
    assert len(ours.regions) == len(theirs.regions)
    for point in range(len(points)):
        mine = ours.regions[ours.point_region[point]]
        expected = [renumbered[v] for v in theirs.regions[theirs.point_region[point]]]
        assert sorted(mine) == sorted(expected)
        if points.shape[1] == 2:
            assert is_rotation(mine, expected)

    assert set(map(frozenset, ours.ridge_points.tolist())) == set(map(frozenset, theirs.ridge_points.tolist()))
    expected = {frozenset(pair): [renumbered[v] for v in ridge] for pair, ridge in theirs.ridge_dict.items()}
    assert len(ours.ridge_dict) == len(ours.ridge_vertices) == len(expected)
    for pair, mine in ours.ridge_dict.items():
        assert sorted(mine) == sorted(expected[frozenset(pair)])
        if points.shape[1] <= 3:
            assert is_rotation(mine, expected[frozenset(pair)])


@given(points=general_points())
@QUICK
def test_every_attribute_agrees(points):
    ours, theirs = both(points)
    assert_agree(ours, theirs, points)


@pytest.mark.parametrize("dimension", range(2, 8))
def test_every_attribute_agrees_in_each_dimension(dimension):
    points = np.random.default_rng(dimension).random(({2: 300, 3: 200, 4: 80, 5: 30, 6: 20, 7: 16}[dimension], dimension))
    ours, theirs = both(points)
    assert_agree(ours, theirs, points)


@given(points=general_points())
@QUICK
def test_every_attribute_agrees_for_furthest_sites(points):
    ours, theirs = both(points, furthest_site=True)
    assert_agree(ours, theirs, points)
    assert_agree(spatial.Voronoi(points, qhull_options="Qbb Qc Qu"), theirs, points)


@given(points=general_points(), parts=st.integers(1, 3))
@QUICK
def test_adding_points_agrees(points, parts):
    first = points.shape[1] + 2
    ours, theirs = both(points[:first], incremental=True)
    for rows in np.array_split(points[first:], parts):
        ours.add_points(rows)
        theirs.add_points(rows)
    assert_agree(ours, theirs, points)
    ours.add_points(points[:1], restart=True)
    assert ours.point_region[-1] == ours.point_region[0]
    for diagram in (ours, theirs):
        diagram.close()
        with pytest.raises(RuntimeError):
            diagram.add_points(points)


def test_the_region_of_the_point_at_infinity_is_there_where_scipy_has_it():
    points = np.random.default_rng(1).random((20, 2))
    for options, incremental in [(None, False), (None, True), ("Qbb Qc", False), ("Qbb Qc Qz", False)]:
        ours, theirs = both(points, qhull_options=options, incremental=incremental)
        assert ours.regions.count([]) == theirs.regions.count([])
        assert (ours.regions[0] == []) == ([] in ours.regions) and all(ours.regions[region] for region in ours.point_region)
    ours, theirs = both(np.stack(np.meshgrid(range(3), range(3)), -1).reshape(-1, 2).astype(float))  # the example of scipy's documentation
    assert ours.regions.index([]) == theirs.regions.index([]) == 0
    assert sorted(ours.point_region) == sorted(theirs.point_region) == list(range(1, 10))


def test_ridges_are_found_by_their_points():
    points = np.random.default_rng(1).random((20, 3))
    diagram = spatial.Voronoi(points)
    assert all(isinstance(key, tuple) for key in diagram.ridge_dict)
    for (p, q), ridge in diagram.ridge_dict.items():
        corners = diagram.vertices[[v for v in ridge if v >= 0]]
        np.testing.assert_allclose(np.linalg.norm(corners - points[p], axis=1), np.linalg.norm(corners - points[q], axis=1), rtol=1e-9)


def test_copies_are_complete():
    diagram = spatial.Voronoi(np.random.default_rng(1).random((30, 3)))
    again = pickle.loads(pickle.dumps(diagram))
    np.testing.assert_array_equal(again.vertices, diagram.vertices)
    assert again.regions == diagram.regions and again.ridge_dict == diagram.ridge_dict
