# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of delone.spatial share: points in general position, and comparisons that do not depend on numbering."""
import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st

DIMENSIONS = range(2, 8)
# Enough that there are inner points, few enough that scipy takes a moment.
SIZES = {2: 60, 3: 50, 4: 40, 5: 30, 6: 22, 7: 18}

# Examples are the same in every run: a failure is a fault, not bad luck.
QUICK = settings(max_examples=12, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))


@st.composite
def general_points(draw, dimension=None):
    """Random points, which are in general position for all that binary64 can see: (n, d), of various scales and places."""
    d = draw(st.sampled_from(list(DIMENSIONS))) if dimension is None else dimension
    n = draw(st.integers(d + 2, SIZES[d]))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    kind = draw(st.sampled_from(["uniform", "normal", "sphere"]))
    points = random.random((n, d)) if kind == "uniform" else random.standard_normal((n, d))
    if kind == "sphere":
        points /= np.linalg.norm(points, axis=1, keepdims=True)
        points += 0.05 * random.random((n, d))
    return points * draw(st.sampled_from([1.0, 0.125, 30.0])) + draw(st.sampled_from([0.0, 3.0]))


@st.composite
def lattice_points(draw, dimension=None):
    """Points with small integer coordinates: many on one sphere, in one hyperplane, equal, or all in a flat."""
    d = draw(st.integers(1, 5)) if dimension is None else dimension
    n = draw(st.integers(1, 14))
    return np.array(draw(st.lists(st.lists(st.integers(0, 2), min_size=d, max_size=d), min_size=n, max_size=n)), dtype=float)


def rows_as_set(rows):
    """The rows of an array as a set of increasing tuples."""
    return set(map(tuple, np.sort(rows, axis=1).tolist()))


def numbering(ours, theirs):
    """For each simplex of `theirs` the one of `ours` with the same vertices, and in it the place of each vertex: two arrays."""
    places = {tuple(sorted(simplex)): i for i, simplex in enumerate(ours.tolist())}
    assert len(places) == len(ours) == len(theirs)
    which = np.array([places[tuple(sorted(simplex))] for simplex in theirs.tolist()])
    place = (theirs[:, :, None] == ours[which][:, None, :]).argmax(axis=2)
    assert (np.take_along_axis(ours[which], place, axis=1) == theirs).all()
    return which, place


def assert_same_neighbors(ours, theirs):
    """Two triangulations or hulls have the same simplices with the same neighbors."""
    which, place = numbering(ours.simplices, theirs.simplices)
    mine = np.take_along_axis(ours.neighbors[which], place, axis=1)
    expected = np.where(theirs.neighbors < 0, -1, which[theirs.neighbors])
    np.testing.assert_array_equal(mine, expected)


def assert_same_kind(ours, theirs):
    """Two arrays have the same shape and kind, and can be written to alike."""
    assert ours.shape == theirs.shape and ours.dtype == theirs.dtype
    assert ours.flags.writeable and ours.flags.c_contiguous
