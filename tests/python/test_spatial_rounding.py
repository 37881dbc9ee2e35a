# SPDX-License-Identifier: BSD-3-Clause
"""What the default tolerance promises: each column counts in its own scale, strays change nothing, and nothing is swallowed silently."""
import itertools
import pickle

import numpy as np
import pytest

import delone
from delone import interpolate, spatial

UNITS = {
    "pressure and mole fraction": lambda r: np.c_[1e5 + 1e5 * r.random(1000), 1e-7 * r.random(1000)],
    "pressure, ppm and share": lambda r: np.c_[1e7 * r.random(60), 1e-6 * r.random(60), r.random(60)],
    "seconds since 1970 and metres in degrees": lambda r: np.c_[1.7e9 + 3600 * r.random(60), 1e-4 * r.random((60, 2))],
    "GHz and mV": lambda r: np.c_[1e9 * (1 + r.random(60)), 1e-3 * r.random(60)],
    "a heavy tail and a share": lambda r: np.c_[np.exp(8 * r.standard_normal(300)), r.random(300)],
    "metres far from the origin": lambda r: np.c_[5e5 + r.random(300), 5e6 + r.random(300), 10 * r.random(300)],
    "a stray far out": lambda r: np.r_[r.random((200, 3)), [[1e14, 0.5, 0.5]]],
    "strays of two sizes": lambda r: np.r_[r.random((200, 3)), [[1e14, 0.3, 0.5], [1e9, -0.4, 0.3]]],
    "a stray twenty times": lambda r: np.r_[r.random((200, 3)), [[1e14, 0.3, 0.5]] * 20],
}


def volume_of(points, rows):
    """Of the exact hull of some of the points."""
    return delone.ConvexHull(points[np.sort(rows)]).volume


@pytest.mark.parametrize("name", UNITS)
@pytest.mark.parametrize("seed", range(3))
def test_no_column_is_swallowed(name, seed):
    points = UNITS[name](np.random.default_rng(seed))
    whole = volume_of(points, np.arange(len(points)))
    loss = 1 - volume_of(points, spatial.ConvexHull(points).vertices) / whole
    assert loss < 1e-9
    try:
        from scipy.spatial import ConvexHull, QhullError
        theirs = 1 - volume_of(points, ConvexHull(points).vertices) / whole
    except (ImportError, QhullError):
        return
    assert loss <= max(1e-9, 2 * theirs)


@pytest.mark.parametrize("stray", [[1e14, 0.5, 0.5], [1e14, 1e14, 1e14], [0.5, -3e15, 0.1], [1e200, 0, 0]])
def test_a_stray_changes_nothing_among_the_others(stray):
    cloud = np.random.default_rng(7).random((200, 3))
    both = np.r_[cloud, [stray]]
    hull, exact = spatial.ConvexHull(both), spatial.ConvexHull(both, tolerance=0)
    assert set(hull.vertices) == set(exact.vertices)
    alone = spatial.ConvexHull(cloud)
    np.testing.assert_array_equal(hull.axis_tolerances <= 2 * alone.axis_tolerances, True)
    lattice = np.array(list(itertools.product(range(4), repeat=3)), float) @ np.linalg.qr(np.random.default_rng(1).standard_normal((3, 3)))[0]
    turned = spatial.ConvexHull(np.r_[lattice, [[40, 1, 2], [1e14, 1, 2]]])
    assert set(turned.vertices) <= {0, 3, 12, 15, 48, 51, 60, 63, 64, 65}


@pytest.mark.parametrize("stray", [[1e15, 0.5], [-1e15, 1e15]])
def test_a_diagram_with_a_stray_has_all_its_vertices(stray):
    points = np.r_[np.random.default_rng(3).random((200, 2)), [stray]]
    assert len(spatial.Voronoi(points).vertices) == len(spatial.Voronoi(points, tolerance=0).vertices) > 380


def test_columns_of_a_diagram_keep_their_features():
    """Stations that measure at the same seconds: bisectors across are much closer to each other than seconds are rounded."""
    rows = np.array(list(itertools.product(1.7e9 + 60 * np.arange(5), 47 + 1e-7 * np.arange(6))))
    default, exact = spatial.Voronoi(rows), spatial.Voronoi(rows, tolerance=0)
    assert len(default.vertices) == len(exact.vertices) == 20
    assert default.axis_tolerances[1] < 1e-8 < default.axis_tolerances[0]


def surface(shape, lengths):
    grid = np.array(list(itertools.product(*(range(n + 1) for n in shape))), float)
    return grid[((grid == 0) | (grid == shape)).any(axis=1)] / shape * lengths


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("shape, lengths", [((20, 15), (1, 3)), ((5, 5, 5), (1, 2.3, 0.7)), ((5, 5, 5), (1, 1, 1e-3)), ((3, 3, 2, 2), (1, 2, 0.5, 0.7))])
def test_boxes_come_out_wherever_they_are_moved(seed, shape, lengths):
    random, d = np.random.default_rng(seed), len(shape)
    box, turn = surface(shape, np.array(lengths)), np.linalg.qr(random.standard_normal((d, d)))[0]
    middle, corner = box.mean(axis=0), box[0]
    turned = box @ turn
    for points in [turned, (box - middle) @ turn, (box - middle * (np.arange(d) > 0)) @ turn, turned + 1000 * random.standard_normal(d),
                   turned - turned[random.integers(len(box))], (box @ turn + 3) - (corner @ turn + 3)]:
        hull = spatial.ConvexHull(points)
        assert len(hull.vertices) == 2**d and len(np.unique(hull.equations, axis=0)) == 2 * d


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("scale", [1e-1, 1e-2, 1e-3])
def test_a_box_with_most_points_near_a_corner_at_the_origin(seed, scale):
    """What was rounded is the coordinates before the move, so points near the corner are off by as much as all others."""
    box = surface((1, 1, 1), np.array([1, 2.3, 0.7]))
    dense = surface((9, 9, 9), np.array([1, 2.3, 0.7])) * scale
    dense = dense[(dense == 0).any(axis=1)]
    points = np.r_[box, dense] @ np.linalg.qr(np.random.default_rng(seed).standard_normal((3, 3)))[0] + [3.1, 4.7, -2.2]
    points -= points[0]
    hull = spatial.ConvexHull(points)
    assert len(hull.vertices) == 8 and len(np.unique(hull.equations, axis=0)) == 6


def facets_of(hull):
    data = hull.to_data()
    return sorted(map(tuple, map(sorted, np.split(data.facet_vertices, data.facet_offsets[1:-1]))))


@pytest.mark.parametrize("name", ["box", "cloud", "lattice"])
def test_scaling_columns_by_powers_of_two_changes_no_answer(name):
    random = np.random.default_rng(11)
    turn = np.linalg.qr(random.standard_normal((3, 3)))[0]
    points = {"box": surface((4, 4, 4), np.array([1, 2.3, 0.7])) @ turn + [0.3, 5, -2], "cloud": random.standard_normal((300, 3)),
              "lattice": np.array(list(itertools.product(range(5), repeat=3)), float) @ turn}[name]
    plain = spatial.ConvexHull(points)
    for exponents in [(0, 3, -5), (30, 0, -30), (-200, 100, 1), (0, 0, 90)]:
        scaled = points * 2.0**np.array(exponents)
        hull = delone.ConvexHull(scaled, tolerance=spatial._tolerance.Rounding(scaled).of_hull())
        same = delone.ConvexHull(points, tolerance=spatial._tolerance.Rounding(points).of_hull())
        np.testing.assert_array_equal(hull.vertices, same.vertices)
        np.testing.assert_array_equal(hull.vertices, np.sort(plain.vertices))
        assert facets_of(hull) == facets_of(same)
        if max(exponents) - min(exponents) < 10:
            np.testing.assert_array_equal(spatial.ConvexHull(scaled).vertices, plain.vertices)


PENTAHEDRON = np.array([[99.74, 0, 33.0479], [-12.6916, 0, 3.44958], [-101.56, 0, 26.5365], [4.35763, 2.002, 1.29742], [97.9272, 4.0039, 31.4817]])


def test_what_is_flat_within_the_rounding_says_so():
    thin = PENTAHEDRON * [1, 1e-13, 1]
    for points, k in [(thin, 2), (np.c_[1e9 * (1 + np.random.default_rng(1).random(60)), 1e-9 * np.random.default_rng(2).random(60)], 1)]:
        d = points.shape[1]
        with pytest.raises(spatial.QhullError, match=f"QH6154 .*{len(points)} points span {d} dimensions, but are within the rounding "
                                                     rf"\d.* of a flat of dimension {k}. tolerance=0 gives the exact hull") as caught:
            spatial.ConvexHull(points)
        assert len(str(caught.value)) < 300
        assert spatial.ConvexHull(points, flat="result").affine_dimension == k
        assert spatial.ConvexHull(points, tolerance=0).affine_dimension == d
    with pytest.raises(spatial.QhullError, match="but are within the tolerance of 0.5 of a flat of dimension 2"):
        spatial.ConvexHull(PENTAHEDRON * [1, 0.1, 1], tolerance=0.5)
    with pytest.raises(spatial.QhullError, match="5 points span a flat of dimension 2 in 3 dimensions. flat='result'"):
        spatial.ConvexHull(PENTAHEDRON * [1, 0, 1])
    assert len(spatial.ConvexHull(PENTAHEDRON * [1, 1e-7, 1]).vertices) == 5


def test_options_that_scale_measure_in_the_scaled_box():
    random = np.random.default_rng(2)
    square = np.round(random.random((40, 3)), 2)
    expected = set(spatial.ConvexHull(square).vertices)
    for scale in ((1e7, 1e-6, 1), (1e9, 1e-9, 1), (3600, 1e-7, 1e-7), (1, 1e8, 1)):
        points = square * scale + [1e5, 0, 0]
        assert set(spatial.ConvexHull(points, qhull_options="QbB").vertices) == expected
    points = square * [1, 1, 1e-15]
    with pytest.raises(spatial.QhullError, match="within the rounding"):
        spatial.ConvexHull(points)
    assert set(spatial.ConvexHull(points, qhull_options="Qbb").vertices) == expected
    # Lengths that options give are those of the box, too.
    notched = np.array([[0, 0], [1000, 0], [1000, 1], [500, 1.01], [0, 1]])
    assert [len(spatial.ConvexHull(notched, qhull_options=options).vertices) for options in ("", "W0.02", "QbB W0.02", "QbB W0.005")] == [5, 4, 4, 5]
    assert [len(spatial.ConvexHull(notched * [1e-3, 1e3], qhull_options=options).vertices) for options in ("W0.02", "QbB W0.02", "Qbb W0.02")] == [5, 4, 4]


@pytest.mark.parametrize("name", ["ConvexHull", "Voronoi"])
def test_a_tolerance_for_each_axis(name):
    points = np.random.default_rng(5).random((100, 2)) * [1e6, 1e-3]
    each = np.array([2e4, 2e-5])
    result = getattr(spatial, name)(points, tolerance=each)
    np.testing.assert_array_equal(result.axis_tolerances <= each, True)
    np.testing.assert_array_equal(result.axis_tolerances > each / 2, True)
    assert result.tolerance == result.axis_tolerances.max()
    again = pickle.loads(pickle.dumps(result))
    np.testing.assert_array_equal(again.axis_tolerances, result.axis_tolerances)
    for bad in ([1, 2, 3], [1, 0], [1, -1], [[1, 1]], [1, np.nan]):
        with pytest.raises(ValueError, match="tolerance"):
            getattr(spatial, name)(points, tolerance=bad)


def test_a_hull_with_a_tolerance_for_each_axis_is_that_of_scaled_columns():
    points = np.random.default_rng(6).standard_normal((500, 3))
    scaled = points * [2.0**40, 1, 2.0**-30]
    each = 0.05 * np.array([2.0**40, 1, 2.0**-30])
    hull, plain = delone.ConvexHull(scaled, tolerance=each), delone.ConvexHull(points, tolerance=0.05)
    np.testing.assert_array_equal(hull.vertices, plain.vertices)
    assert hull.num_facets == plain.num_facets and len(hull.vertices) < delone.ConvexHull(points).num_vertices
    assert hull.max_distance == pytest.approx(2.0**40 * plain.max_distance, rel=1e-9)
    np.testing.assert_array_equal(hull.axis_tolerances, each)
    some, rows = delone.ConvexHull.of_extreme_points(scaled, tolerance=tuple(each))
    np.testing.assert_array_equal(np.sort(rows[some.vertices]), plain.vertices)
    assert delone.ConvexHull(scaled[:400], tolerance=each).locate(scaled[400:]).kind.shape == (100,)


@pytest.mark.parametrize("extension", ["npz", "json"])
def test_files_and_checks_know_the_tolerances_of_axes(tmp_path, extension):
    points = np.random.default_rng(8).random((300, 2)) * [1e6, 1e-3]
    each = np.array([1e4, 1e-5])
    hull, diagram = delone.ConvexHull(points, tolerance=each), delone.Voronoi(points, tolerance=each / 100)
    for result, exact in [(hull, delone.ConvexHull(points)), (diagram, delone.Voronoi(points))]:
        path = str(tmp_path / f"result.{extension}")
        result.save(path)
        data = delone.read(path)
        np.testing.assert_array_equal(data.axis_tolerances, result.axis_tolerances)
        assert data.tolerance == result.tolerance and delone.check(data)
        again = pickle.loads(pickle.dumps(result))
        np.testing.assert_array_equal(again.axis_tolerances, result.axis_tolerances)
        for bad in (each[:1], [0.0, 1.0], data.axis_tolerances * [1, 0.75], data.axis_tolerances * 2):
            report = delone.check(type(data)({**data.members, "axis_tolerances": np.array(bad)}))
            assert not report and report.level == 1 and "tolerances" in report.violation
        assert len(exact.axis_tolerances) == 2 and not exact.axis_tolerances.any() and len(exact.to_data().axis_tolerances) == 0


def test_a_check_measures_where_axes_are_scaled():
    points = np.random.default_rng(8).random((300, 2)) * [1e6, 1e-3]
    data = delone.ConvexHull(points, tolerance=[1e4, 1e-5]).to_data()
    narrower = delone.HullData({**data.members, "axis_tolerances": data.axis_tolerances * [1, 2.0**-4]})
    report = delone.check(narrower)
    assert not report and "farther from the hull" in report.violation


def test_interpolation_keeps_columns_apart():
    """Queries take the values of their own simplex, however small one of the units is."""
    random = np.random.default_rng(9)
    points, values = random.random((400, 2)) * [1e6, 1e-8], random.random(400)
    queries = (0.2 + 0.6 * random.random((200, 2))) * [1e6, 1e-8]
    np.testing.assert_allclose(interpolate.LinearNDInterpolator(points, values)(queries), delone.LinearInterpolator(points, values)(queries),
                               rtol=1e-6)
