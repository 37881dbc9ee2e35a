# SPDX-License-Identifier: BSD-3-Clause
"""What may be given as an array, what is refused, what is copied, and how long arrays live."""
import gc
import re
import signal
import time
import tracemalloc
from fractions import Fraction

import numpy as np
import pytest

import delone
from delone import _core

SQUARE = [[0, 0], [3, 0], [0, 3], [3, 3], [1, 2]]
EXPECTED = delone.Delaunay(np.array(SQUARE, float)).hash


@pytest.mark.parametrize("dtype", ["f2", "f4", "f8", "longdouble", ">f8", "<f4", ">i4", "i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "O"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_every_dtype_and_order(dtype, order):
    assert delone.Delaunay(np.array(SQUARE, dtype=dtype, order=order)).hash == EXPECTED


def test_array_likes():
    array = np.array(SQUARE, float)
    wide = np.full((10, 6), np.nan)
    wide[::2, 1:5:3] = SQUARE
    fixed = array.copy()
    fixed.flags.writeable = False
    memory = memoryview(array)

    class Convertible:
        def __array__(self, dtype=None, copy=None):
            return array if dtype is None else array.astype(dtype)

    unaligned = np.frombuffer(b"x" + array.tobytes(), dtype="V80", count=1, offset=1).view("f8").reshape(5, 2)
    for points in (SQUARE, tuple(map(tuple, SQUARE)), wide[::2, 1:5:3], array[::-1][::-1], fixed, memory, Convertible(), np.asmatrix(array),
                   [[Fraction(x) for x in row] for row in SQUARE], np.ma.array(array), unaligned):
        assert delone.Delaunay(points).hash == EXPECTED
    assert delone.Delaunay(np.array([[True], [False]])).num_vertices == 2


@pytest.mark.parametrize("dtype, value", [
    ("i8", 2**53 + 1), ("i8", -(2**53) - 1), ("i8", 2**63 - 1), ("u8", 2**64 - 1), ("u8", 2**63 + 1), ("O", 2**53 + 1), ("O", Fraction(1, 3)), ("O", 2**70 + 1),
])
def test_numbers_that_are_not_exact_are_refused(dtype, value):
    points = np.array([[0, 0], [1, value], [2, 0]], dtype=dtype)
    with pytest.raises(ValueError, match=r"points: row 1: .* is not exact in double precision"):
        delone.Delaunay(points)


@pytest.mark.parametrize("value", [2**53, -(2**53), 2**62, -(2**63), 2**53 + 2, 2**60 + 2**10])
def test_large_numbers_that_are_exact_are_taken(value):
    assert delone.Delaunay(np.array([[0], [value]], dtype="i8")).points[1, 0] == value
    if value > 0:
        assert delone.Delaunay(np.array([[0], [value]], dtype="u8")).points[1, 0] == value
    assert delone.Delaunay([[0], [value]]).points[1, 0] == value


def test_long_doubles_must_be_exact():
    if np.finfo(np.longdouble).nmant > 52:
        with pytest.raises(ValueError, match="row 1"):
            delone.Delaunay(np.array([[0], [np.longdouble(1) + np.finfo(np.longdouble).eps]]))


@pytest.mark.parametrize("points, message", [
    ([1.0, 2.0], r"points: an array of shape \(n, d\), d at least 1, not \(2,\)"),
    (3.0, r"points: an array of shape \(n, d\), d at least 1, not \(\)"),
    (np.zeros((2, 2, 2)), r"points: an array of shape \(n, d\), d at least 1, not \(2, 2, 2\)"),
    (np.zeros((3, 0)), r"points: an array of shape \(n, d\), d at least 1, not \(3, 0\)"),
    ([["a", "b"]], "points: not numbers, but <U1"),
    (np.array([["2001-01-01"]], dtype="M8"), "points: not numbers, but datetime64"),
    ([[1j, 0]], "points: complex numbers are not real"),
    (np.ma.array([[1.0, 2.0]], mask=[[True, False]]), "points: masked values are not numbers"),
])
def test_what_is_no_array_of_points(points, message):
    with pytest.raises(ValueError, match=message):
        delone.Delaunay(points)


@pytest.mark.parametrize("value, message", [
    (10**400, r"1000000\d*… is beyond the range of double precision"), (-10**400, "is beyond the range of double precision"),
    pytest.param(10**10_000, "a huge int is beyond the range of double precision", id="huge"), (None, "None is not a number"), (Fraction(1, 3), "1/3 is not exact in double precision"),
    ([1], "a list is not a number"), (1j, "a complex is not a number"), (object(), "an object is not a number"), (2**70 + 1, "is not exact in double precision"),
])
def test_objects_that_are_no_numbers_are_named(value, message):
    points = np.zeros((3, 2), object)
    points[1, 1] = value
    with pytest.raises(delone.InputError, match=f"^points: row 1: .*{message}$") as raised:
        delone.Delaunay(points)
    assert raised.value.rows == [1] and len(str(raised.value)) < 160


LARGE = 2**53 + 1  # the least integer that is not exact in float64


@pytest.mark.parametrize("points", [
    [[0.5, 0], [0, LARGE]], [[0.5, 0], [0, -LARGE]], ([0.5, 0], (np.int64(LARGE), 0)), [np.array([0.5, 0]), np.array([LARGE, 0])],
    [[0.5, 0], [0, np.uint64(LARGE)]], [[np.int64(-1), 0], [0, np.uint64(2**64 - 1)]], [[2**63, 0], [-LARGE, 0]], [[0.5, 0], [True, LARGE]],
    [[np.nan, 0], [LARGE, 0]], [[np.float32(0.5), 0], [LARGE, 0]], [[np.longdouble(0.5), 0], [2**80 + 1, 0]], [[0.5, 0], [Fraction(1, 3), 0]],
])
def test_integers_among_floats_must_be_exact(points):
    """NumPy makes floats of such lists, and rounds."""
    t = delone.Delaunay([[0, 0], [1, 0], [0, 1]])
    for take in (delone.Delaunay, delone.ConvexHull, t.find_simplex, delone.HalfspaceIntersection, lambda p: delone.convex_hulls([p]),
                 lambda p: delone.convex_hulls([[[1, 1]], p]), lambda p: delone.convex_hulls(p, [0, 2]), lambda p: delone.convex_hulls([p, p]),
                 lambda p: delone.LinearInterpolator(np.eye(2), p)):
        with pytest.raises(delone.InputError, match=r": row 1: .* is not exact in double precision") as raised:
            take(list(points))
        assert raised.value.rows == [1]


def test_integers_of_sets_among_floats_must_be_exact():
    for sets in ([[[0.5, 1]], [[LARGE, 1]]], [np.array([[0.5, 1]]), np.array([[LARGE, 1]])], [[[0.5, 1]], np.array([[LARGE, 0.5]], object)]):
        with pytest.raises(delone.InputError, match="^points: set 1: row 0: 9007199254740993 is not exact"):
            delone.convex_hulls(sets)
    with pytest.raises(delone.InputError, match="^points: row 3: 9007199254740993 is not exact"):
        delone.convex_hulls(np.array([[[0, 0], [1, 1]], [[0, 0], [LARGE, 1]]]))
    for values in ([1j, LARGE, 0], [LARGE * 1j, LARGE, 0], np.array([0, 1, np.clongdouble(1) / 3])):
        with pytest.raises(delone.InputError, match="^values: row .* is not exact"):
            delone.LinearInterpolator([[0, 0], [1, 0], [0, 1]], values)


def test_large_integers_among_floats_that_are_exact():
    t = delone.Delaunay([[0.5, 0], [0, 2**60], [np.float64(1e300), 2**53], (float(2**70), 2**70)])
    assert t.points.tolist() == [[0.5, 0], [0, 2**60], [1e300, 2**53], [2.0**70, 2.0**70]]
    f = delone.LinearInterpolator([[0, 0], [1, 0], [0, 1]], [1j, 2**60, 0.5])
    assert f.values.tolist() == [1j, 2**60, 0.5]
    assert len(delone.convex_hulls([[[0.5, 2**60], [1, 2]], np.array([[1, 2]], object)])) == 2


def test_masked_values_are_refused_everywhere():
    points, mask = np.array(SQUARE, float), np.zeros((5, 2), bool)
    mask[3, 1] = True
    masked, open_ = np.ma.array(points, mask=mask), np.ma.array(points, mask=np.zeros((5, 2)))
    t = delone.Delaunay(points)
    uses = {
        "points": [delone.Delaunay, delone.ConvexHull, lambda p: delone.convex_hulls([p]), lambda p: delone.convex_hulls(np.ma.stack([p, p])),
                   lambda p: delone.convex_hulls(p, [0, 5]), lambda p: delone.LinearInterpolator(p, np.zeros(5)),
                   lambda p: delone.interpolate.NearestNDInterpolator(p, np.zeros(5)), lambda p: delone.interpolate.LinearNDInterpolator(p, np.zeros(5)),
                   lambda p: delone.interpolate.LinearNDInterpolator((p[:, 0], p[:, 1]), np.zeros(5)),
                   lambda p: delone.interpolate.LinearNDInterpolator(t, np.zeros(5))(p)],
        "values": [lambda v: delone.LinearInterpolator(points, v), lambda v: delone.LinearInterpolator(points, v + 1j),
                   lambda v: delone.NaturalNeighborInterpolator(points, v), lambda v: delone.interpolate.LinearNDInterpolator(points, v),
                   lambda v: delone.interpolate.NearestNDInterpolator(points, v)],
        "gradients": [lambda g: delone.NaturalNeighborInterpolator(points, np.zeros(5), smooth=True, gradients=g)],
        "queries": [t.find_simplex, delone.LinearInterpolator(points, np.zeros(5))],
    }
    for name, functions in uses.items():
        for function in functions:
            with pytest.raises(ValueError, match=f"{name}: .*masked values are not numbers"):
                function(masked)
            function(open_)
    with pytest.raises(ValueError, match="offsets: masked"):
        delone.convex_hulls(points, np.ma.array([0, 5], mask=[False, True]))


@pytest.mark.parametrize("name", ["__float__", "__str__"])
def test_ctrl_c_in_a_conversion_is_not_taken_for_an_answer(name):
    """Where numbers are objects of Python, a signal handler can run in their methods."""
    def interrupted(self):
        raise KeyboardInterrupt

    number = type("Number", (), {"__float__": lambda self: 0.5, "__eq__": lambda self, other: self is other, "__hash__": None, name: interrupted})()
    with pytest.raises(KeyboardInterrupt):
        delone.Delaunay([[0, number]])


@pytest.mark.skipif(not hasattr(signal, "ITIMER_PROF"), reason="timers as POSIX has them")
def test_ctrl_c_ends_the_conversion_of_many_objects():
    points = np.full((3_000_000, 1), 0.5, object)

    def ring(signum, frame):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGPROF, ring)
    begin = time.process_time()
    try:
        signal.setitimer(signal.ITIMER_PROF, 0.1)
        with pytest.raises(KeyboardInterrupt):
            delone.Delaunay(points)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
    assert time.process_time() - begin < 0.4


LONG = "\x1b[31m" + "y" * 100_000


class Odd:
    def __repr__(self):
        return LONG

    __str__ = __repr__


@pytest.mark.parametrize("use", [
    lambda: delone.Delaunay(SQUARE, order=LONG), lambda: delone.LinearInterpolator(SQUARE, [0] * 5, outside=LONG),
    lambda: delone.spatial.Delaunay(SQUARE, flat=LONG), lambda: delone.spatial.Delaunay(SQUARE, flat=Odd()),
    lambda: delone.spatial.Delaunay(SQUARE, qhull_options=LONG), lambda: delone.spatial.ConvexHull(SQUARE, qhull_options="QG" + "1" * 4000),
    lambda: delone.interpolate.griddata(SQUARE, [0] * 5, SQUARE, method=LONG), lambda: delone.Delaunay(SQUARE, progress=type(LONG, (), {})()),
    lambda: delone.Delaunay([[0, type(LONG, (), {})()]]), lambda: delone.Delaunay([[10**400, None]]), lambda: delone.Delaunay(np.zeros(1, [("y" * 1000, "f8")])),
    lambda: delone.Delaunay(np.zeros((1,) * 32)), lambda: delone.Delaunay(SQUARE, order=10**5000), lambda: delone.interpolate.griddata(SQUARE, [0] * 5, SQUARE, method=10**5000),
    lambda: delone.Delaunay(SQUARE, order="\udcff\u202e"), lambda: delone.spatial.Delaunay(SQUARE, flat="\udcff\u202e"),
])
def test_foreign_text_in_messages_is_printable_and_short(use):
    with pytest.raises((ValueError, TypeError)) as raised:
        use()
    text = str(raised.value)
    assert len(text) < 300 and text.isprintable()


BIG, T = [[0.5, 0.25]] * 10_000, delone.Delaunay(SQUARE)


@pytest.mark.parametrize("use, error, text", [
    (lambda: delone.Delaunay(BIG, thread=2), TypeError, "Delaunay() has no argument 'thread'; did you mean 'threads'?"),
    (lambda: delone.Delaunay(BIG, seed=-1), ValueError, "seed: at least 0, not -1"),
    (lambda: delone.Delaunay(BIG, threads="a"), TypeError, "threads: an integer was expected, not 'a'"),
    (lambda: delone.Delaunay(BIG, threads=BIG), TypeError, "threads: an integer was expected, not a list"),
    (lambda: delone.Delaunay(BIG, threads=2**40), ValueError, "threads: 1099511627776 is too large"),
    (lambda: delone.Voronoi(BIG, progress=True), TypeError, "Voronoi() has no argument 'progress'; it has points, tolerance"),
    (lambda: delone.Voronoi(BIG, 0.0, 0.0), TypeError, "Voronoi() takes at most 2 arguments by position, not 3"),
    (lambda: delone.Regular(BIG), TypeError, "Regular() needs the argument 'weights'"),
    (lambda: T.trim("a"), TypeError, "tolerance: a number was expected, not 'a'"),
    (lambda: T.alpha_complex("a"), TypeError, "radius: a number, or None, was expected, not 'a'"),
    (lambda: T.nearest(BIG, k=1.5), TypeError, "k: an integer, or None, was expected, not 1.5"),
    (lambda: delone.forecast(3, num_points=1e6), TypeError, "num_points: an integer was expected, not 1000000.0"),
    (lambda: delone.Delaunay(BIG, points=BIG), TypeError, "Delaunay(): 'points' is given twice"),
    (lambda: delone.Delaunay.trim(5, 1), TypeError, "trim(): of a Triangulation, not of 5"),
    (lambda: delone.ConvexHull.of_extreme_points(BIG, tolerance="a"), TypeError, "tolerance: a number was expected, not 'a'"),
    (lambda: delone.Delaunay("a.csv"), TypeError, "points: an array, not a str; delone.read() reads files"),
    (lambda: delone.Delaunay([[1, 2], [3]]), ValueError, "points: rows of different lengths"),
    (lambda: delone.LinearInterpolator(T, [0] * 5, fill_value=3, outside="nearest"), ValueError, "fill_value: only with outside='fill', not with 'nearest'"),
    (lambda: delone.LinearInterpolator(T, [0] * 5, fill_value=3j), TypeError, "fill_value: a real number, not 3j"),
])
def test_messages_name_the_argument(use, error, text):
    with pytest.raises(error, match=f"^{re.escape(text)}") as raised:
        use()
    assert type(raised.value) is error and len(str(raised.value)) < 200


def test_errors_of_what_is_called_stay_theirs():
    def fail(fraction):
        raise TypeError("mine(): incompatible " * 2)
    with pytest.raises(TypeError, match="mine.* incompatible") as raised:
        delone.Delaunay(np.random.default_rng(0).random((300_000, 3)), progress=fail)
    assert raised.traceback[-1].name == "fail"


def test_numbers_that_are_not_finite():
    with pytest.raises(delone.InputError, match=r"points: row 1, column 1: nan is not finite \(and 1 more rows\)") as raised:
        delone.Delaunay([[0, 0], [1, np.nan], [np.inf, np.nan]])
    assert raised.value.rows == [1, 2]


def test_lists_with_objects():
    for points in ([[0, 0], [10**400, 1]], [[0, 0], [None, 1]], [[0, 0], ["3", None]]):
        with pytest.raises(delone.InputError, match="points: row 1: "):
            delone.ConvexHull(points)
    assert delone.Delaunay(np.array([[0, 0], [np.float32(1), True], [Fraction(1, 2), 3]], object)).num_vertices == 3


@pytest.mark.parametrize("make", [
    lambda progress: delone.Delaunay(SQUARE, progress=progress), lambda progress: delone.ConvexHull(SQUARE, progress=progress),
    lambda progress: delone.ConvexHull.of_extreme_points(SQUARE, progress=progress), lambda progress: delone.convex_hulls([SQUARE], progress=progress),
    lambda progress: delone.HalfspaceIntersection([[1, -1], [-1, -1]], progress=progress),
    lambda progress: delone.Delaunay(SQUARE).insert_range(SQUARE, progress=progress),
])
@pytest.mark.parametrize("progress, name", [(5, "int"), ("bar", "str")])
def test_progress_is_a_function(make, progress, name):
    with pytest.raises(TypeError, match=f"progress: True, a function of the fraction done, or None, not {name}"):
        make(progress)


def test_numbers_of_regions_and_ridges():
    v = delone.Voronoi(SQUARE)
    for i in (5, 99, -1, 2**40):
        with pytest.raises(IndexError, match=f"region {i}: there are 5"):
            v.region(i)
    with pytest.raises(IndexError, match=f"ridge {v.num_ridges}: there are {v.num_ridges}"):
        v.ridge(v.num_ridges)


def test_dimensions_beyond_the_largest_are_refused_at_once():
    for columns in (2**20 + 1, 2**31 - 1, 2**31, 2**32 + 2):
        with pytest.raises(delone.InputError):
            delone.Delaunay(np.zeros((0, columns)))
        with pytest.raises(delone.InputError):
            delone.ConvexHull(np.zeros((0, columns)))


def test_orientation_in_one_dimension():
    """Cells of a triangulation are positively oriented; the ends of a hull are points, which have no orientation."""
    t = delone.Delaunay([[3], [1], [2]])
    assert (t.points[t.cells[:, 0], 0] < t.points[t.cells[:, 1], 0]).all()
    hull = delone.ConvexHull([[3], [1], [2]])
    assert sorted(hull.cells[:, 0]) == [0, 1]
    assert "k = d > 1" in type(hull).cells.__doc__ and "k = d > 1" in type(t).hull_facets.__doc__


@pytest.mark.parametrize("make", [delone.Delaunay, delone.FurthestSite, delone.ConvexHull, delone.Voronoi, lambda p: delone.Regular(p, [0] * len(p))])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_rows_that_are_not_finite_are_named(make, bad):
    with pytest.raises(delone.InputError, match="3") as raised:
        make([[0, 0], [1, 0], [0, 1], [bad, 0], [2, 2]])
    assert raised.value.rows == [3] and isinstance(raised.value, ValueError) and isinstance(raised.value, delone.Error)


def test_wrong_number_of_coordinates_in_later_rows():
    for made in (delone.Delaunay(SQUARE), delone.ConvexHull(SQUARE), delone.FurthestSite(SQUARE)):
        with pytest.raises(ValueError, match=r"points: an array of shape \(n, 2\), not \(1, 3\)"):
            made.insert_range([[1, 2, 3]])


def peak(action):
    """Bytes that NumPy had at most at a time while it ran."""
    gc.collect()
    tracemalloc.start()
    try:
        action()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_contiguous_doubles_are_not_copied_and_others_are():
    points = np.random.default_rng(0).random((20_000, 2))
    queries = np.random.default_rng(1).random((200_000, 2))
    t = delone.Delaunay(points)
    assert peak(lambda: delone.Delaunay(points)) < points.nbytes / 10
    assert peak(lambda: t.find_simplex(queries)) < 0.4 * queries.nbytes  # the answers are a quarter
    assert peak(lambda: delone.Delaunay(np.asfortranarray(points))) >= points.nbytes
    assert peak(lambda: t.cells) < 10_000 and peak(lambda: t.points) < 10_000


def test_arrays_outlive_what_they_came_from():
    points = np.random.default_rng(0).random((500, 3))
    t, hull, v = delone.Delaunay(points), delone.ConvexHull(points), delone.Voronoi(points)
    arrays = [t.cells, t.neighbors, t.points, t.vertex_of_point, t.hull_facets, hull.cells, hull.equations, hull.points, v.vertices, v.ridge_vertices,
              v.region(3), v.points, v.ray_directions]
    copies = [array.copy() for array in arrays]
    del t, hull, v
    gc.collect()
    for array, copy in zip(arrays, copies):
        np.testing.assert_array_equal(array, copy)


def test_arrays_stay_as_they_are_when_points_are_added():
    points = np.random.default_rng(0).random((500, 2))
    for made in (delone.Delaunay(points), delone.ConvexHull(points), delone.FurthestSite(points)):
        arrays = made.cells, made.neighbors, made.points
        copies = [array.copy() for array in arrays]
        assert made.cells.__array_interface__["data"] == arrays[0].__array_interface__["data"]  # a view, not a copy
        made.insert_range([[2, 2], [-1, 0.5]])
        assert len(made.points) == 502 and len(made.cells) != len(arrays[0])
        for array, copy in zip(arrays, copies):
            np.testing.assert_array_equal(array, copy)


def test_arrays_are_read_only_and_contiguous():
    points = np.random.default_rng(0).random((60, 3))
    t, hull, v, h = delone.Delaunay(points), delone.ConvexHull(points), delone.Voronoi(points), delone.HalfspaceIntersection([[1, -1], [-1, -1]])
    for made in (t, hull, v, h):
        for name in dir(type(made)):
            value = getattr(made, name)
            if isinstance(value, np.ndarray) and name not in ("transform", "is_bounded"):
                assert value.flags.c_contiguous and not value.flags.writeable, name
                assert value.dtype in (np.float64, np.int32, np.int64, np.uint8), name
    with pytest.raises(ValueError):
        t.cells[0, 0] = 5


def test_changing_the_input_afterwards_changes_nothing():
    points = np.array(SQUARE, float)
    t = delone.Delaunay(points)
    points[:] = 7
    assert t.hash == EXPECTED and t.points.tolist() == SQUARE


def test_lists_of_lists():
    numbers = np.array([3, -1, 3, 70000, 0], np.int32)
    assert _core._lists(numbers, np.array([0, 2, 2, 5])) == [[3, -1], [], [3, 70000, 0]]
    assert _core._lists(np.arange(1000, dtype=np.int32), np.arange(0, 1001, 500)) == [list(range(500)), list(range(500, 1000))]
    assert _core._lists(numbers[:0], np.array([0])) == [] and gc.isenabled()
    for offsets in ([0, 6], [2, 1], [-1, 2]):
        with pytest.raises(ValueError):
            _core._lists(numbers, np.array(offsets))
