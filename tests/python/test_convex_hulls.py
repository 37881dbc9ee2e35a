# SPDX-License-Identifier: BSD-3-Clause
"""delone.convex_hulls: many hulls at once are those of single sets; delone.ConvexHull.of_extreme_points."""
import numpy as np
import pytest

import delone

RANDOM = np.random.default_rng(20)


def lines(cells):
    return sorted(map(tuple, np.sort(cells, axis=1).tolist()))


def sets_of(d):
    return [RANDOM.random((20, d)), np.empty((0, d)), RANDOM.random((1, d)), RANDOM.integers(0, 3, (60, d)).astype(float),
            RANDOM.random((d, d)), RANDOM.random((300, d)), np.zeros((4, d))]


@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_each_is_the_hull_of_its_set(d):
    sets = sets_of(d)
    hulls = delone.convex_hulls(sets)
    assert len(hulls) == len(sets) and f"{len(sets)} hulls" in repr(hulls)
    for points, hull in zip(sets, hulls):
        single = delone.ConvexHull(points)
        assert hull.affine_dimension == single.affine_dimension
        assert hull.vertices.tolist() == single.vertices.tolist()
        if hull.affine_dimension < d:
            assert len(hull.cells) == 0 and hull.volume == 0
            continue
        extreme, rows = delone.ConvexHull.of_extreme_points(points)
        assert lines(hull.cells) == lines(rows[extreme.cells])
        assert np.isclose(hull.volume, single.volume) and np.isclose(hull.area, single.area)
        heights = points @ hull.equations[:, :-1].T + hull.equations[:, -1]
        assert heights.max() < 1e-12
        if d > 1:
            for cell, across in zip(hull.cells, hull.neighbors):
                for j in range(d):
                    assert set(np.delete(cell, j)) <= set(hull.cells[across[j]])


def test_offsets_and_arrays_of_sets_are_the_same():
    points = RANDOM.random((50, 20, 3))
    one, other = delone.convex_hulls(points), delone.convex_hulls(points.reshape(-1, 3), np.arange(0, 1001, 20))
    for name in delone.ConvexHulls.__slots__:
        assert np.array_equal(getattr(one, name), getattr(other, name))
        assert not getattr(one, name).flags.writeable
    assert one[-1].vertices.max() < 20
    with pytest.raises(IndexError):
        one[50]


def test_bad_input_is_refused():
    points = RANDOM.random((10, 2))
    for offsets in ([], [0, 5], [1, 10], [0, 7, 3, 10], [-1, 10], [0, 11]):
        with pytest.raises(ValueError):
            delone.convex_hulls(points, offsets)
    with pytest.raises(ValueError, match="whole numbers"):
        delone.convex_hulls(points, [0.0, 10.0])
    with pytest.raises(ValueError, match="set 1"):
        delone.convex_hulls([points, RANDOM.random((5, 3))])
    with pytest.raises(ValueError, match="no sets"):
        delone.convex_hulls([])
    points[7, 1] = np.nan
    with pytest.raises(delone.InputError, match="7"):
        delone.convex_hulls(points, [0, 10])
    assert len(delone.convex_hulls(np.empty((0, 2)), [0])) == 0


@pytest.mark.parametrize("d", [2, 3, 4])
def test_extreme_points_alone(d):
    for points in (RANDOM.random((3000, d)), RANDOM.integers(0, 6, (500, d)) / 7):
        hull, rows = delone.ConvexHull.of_extreme_points(points)
        single = delone.ConvexHull(points)
        assert np.sort(rows[hull.vertices]).tolist() == single.vertices.tolist()
        assert set(np.unique(hull.cells)) == set(hull.vertices)
        assert np.array_equal(hull.points, points[rows]) and hull.num_facets == single.num_facets
        assert hull.hash == delone.ConvexHull(points[single.vertices]).hash
        tolerant, rows = delone.ConvexHull.of_extreme_points(points, tolerance=0.05)
        assert tolerant.hash == delone.ConvexHull(points, tolerance=0.05).hash


def test_a_sequence_has_slices_and_ends():
    hulls = delone.convex_hulls(np.random.default_rng(0).random((3, 9, 2)))
    assert [hull.volume for hull in hulls[::-1]] == [hull.volume for hull in reversed(list(hulls))]
    assert hulls[-1].volume == hulls[2].volume
    with pytest.raises(IndexError, match="hull 3 of 3"):
        hulls[3]


def test_normals_of_needles():
    points = np.array([[2, 2, 2.22e-16], [0, 0, 1 + 2**-52], [2, 0, 0], [2, 2.22e-16, 0], [1, 2, 2.22e-16]])
    for hull in (delone.convex_hulls([points]), delone.ConvexHull(points)):
        np.testing.assert_allclose(np.linalg.norm(hull.equations[:, :3], axis=1), 1)
        assert (hull.equations[:, :3] @ points.T + hull.equations[:, 3:]).max() < 1e-15
    assert np.isfinite(delone.ConvexHull(points).equation_errors).all()


def test_volumes_of_intersections():
    """Against exact ones, of flat, empty, equal, nested and touching hulls, too."""
    random = np.random.default_rng(3)
    for d in (1, 2, 3):
        sets = [random.integers(0, 9, (12, d)).astype(float) for _ in range(6)]
        sets += [sets[0].copy(), sets[0] + 100, 2 * sets[0] - 4, sets[1][:d], np.empty((0, d)), sets[0] + (sets[0].max(axis=0) - sets[0].min(axis=0))]
        hulls = delone.convex_hulls(sets)
        exact = [delone.Polyhedron.from_generators(points) if len(points) else delone.Polyhedron.empty(d) for points in sets]
        expected = [[a.intersection(b).volume for b in exact] for a in exact]
        found = hulls.intersection_volumes(threads=2)
        np.testing.assert_allclose(found, expected, atol=1e-10)
        assert (found == found.T).all() and (np.diag(found) == hulls.volumes).all()
        pairs = random.integers(0, len(sets), (20, 2))
        assert (hulls.intersection_volumes(pairs) == found[pairs[:, 0], pairs[:, 1]]).all()
    assert hulls.intersection_volumes(np.empty((0, 2), int)).shape == (0,)


def test_the_points_of_hulls_are_a_copy():
    points = np.array([[0.0, 0], [1, 0], [0, 1], [0, 0], [2, 0], [0, 2]])
    hulls = delone.convex_hulls(points, [0, 3, 6])
    points *= 10
    assert hulls.points.max() == 2 and not hulls.points.flags.writeable
    assert hulls.intersection_volumes([[0, 1]]).tolist() == [0.5]


def test_bad_pairs_are_refused():
    hulls = delone.convex_hulls([[[0], [3]], [[1], [5]]])
    for pairs in ([0, 1], [[0, 1, 1]], [[0.0, 1.0]]):
        with pytest.raises(ValueError, match="pairs: an array"):
            hulls.intersection_volumes(pairs)
    for pairs in ([[0, 1], [0, 2]], [[1, 1], [-1, 0]]):
        with pytest.raises(IndexError, match="pairs: row 1 .*2 hulls"):
            hulls.intersection_volumes(pairs)
    for name, value in {"vertices": hulls.vertices + 9, "cell_offsets": hulls.cell_offsets[::-1], "volumes": hulls.volumes[:1],
                        "equations": hulls.equations[:-1], "vertex_offsets": np.array([0, 0, 4])}.items():
        changed = delone.convex_hulls([[[0], [3]], [[1], [5]]])
        setattr(changed, name, value)
        with pytest.raises(ValueError, match="not the arrays"):
            changed.intersection_volumes()
