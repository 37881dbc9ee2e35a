# SPDX-License-Identifier: BSD-3-Clause
"""What delone.Polyhedron takes, refuses, writes and pickles."""
import copy
import decimal
import pickle
import re
import xml.etree.ElementTree
from fractions import Fraction

import numpy as np
import pytest

import delone
from delone import Polyhedron

A = np.array([[3, 1], [-1, 0], [0, -1]])
B = np.array([1, 0, 0])
TRIANGLE = Polyhedron(A, B)
HALF = Polyhedron([[2, 1], [-1, 0], [0, -1]], [1, 0, 0])


class Ratio:
    """A number of some other library."""

    def __init__(self, numerator, denominator):
        self.ratio = numerator, denominator

    def as_integer_ratio(self):
        return self.ratio


@pytest.mark.parametrize("dtype", [np.float16, np.float32, np.float64, np.longdouble, np.int8, np.int16, np.int32, np.int64, object])
def test_arrays_of_every_type(dtype):
    assert Polyhedron(A.astype(dtype), B.astype(dtype)) == TRIANGLE
    assert Polyhedron(np.asfortranarray(A.astype(dtype))[::-1], B.astype(dtype)[::-1]) == TRIANGLE
    swapped = A.astype(dtype) if dtype is object else A.astype(np.dtype(dtype).newbyteorder())
    assert Polyhedron(swapped, B.tolist()) == TRIANGLE


@pytest.mark.parametrize("dtype", [bool, np.uint8, np.uint16, np.uint32, np.uint64])
def test_arrays_without_signs(dtype):
    p = Polyhedron.from_generators(np.eye(2).astype(dtype))
    assert p.vertices.tolist() == [[0, 1], [1, 0]]
    if dtype is not bool:
        largest = np.iinfo(dtype).max
        assert Polyhedron.from_generators(np.array([[largest]], dtype)).vertex_integers.tolist() == [[int(largest), 1]]


@pytest.mark.parametrize("half", [0.5, Fraction(1, 2), "1/2", "0.5", "5e-1", decimal.Decimal("0.5"), Ratio(1, 2), np.float32(0.5), np.longdouble(0.5)])
def test_numbers_of_every_kind(half):
    for rows in ([[1, half], [-1, 0], [0, -1]], np.array([[1, half], [-1, 0], [0, -1]], object)):
        assert Polyhedron(rows, [half, 0, 0]) == HALF
    assert HALF.contains([half, 0]) and HALF.maximize([half, 0]).value_fraction == Fraction(1, 4)


def test_text_in_arrays():
    assert Polyhedron(np.array([["1", "1/2"], ["-1", "0"], ["0", "-1"]]), np.array(["0.5", "0", "0"])) == HALF


def test_numerators_and_denominators():
    pair = (np.array([[2, 1], [-1, 0], [0, -1]]), np.array([[2, 2], [1, 1], [1, 1]]))
    assert Polyhedron(pair, ([1, 0, 0], [2, 1, 1])) == HALF
    assert Polyhedron(([[2, 1], [-1, 0], [0, -1]], 1), ([1, 0, 0], 1)) == HALF
    assert Polyhedron(([[2, 1], [-2, 0], [0, -7]], [[2], [1], [3]]), (np.array([1, 0, 0], object), 2)) == HALF
    large = 10 ** 400
    assert Polyhedron(([[2 * large, -large], [-1, 0], [0, 1]], [[2 * large, -2 * large], [1, 1], [1, -1]]), (["-1", "0", "0"], -2)) == HALF
    huge = Polyhedron.from_generators(([[large + 1], [0]], [[large], [1]]))
    assert huge.vertex_fractions.tolist() == [[0], [Fraction(large + 1, large)]]
    assert Polyhedron.from_generators(((0, 1), (2, 3))).vertices.tolist() == [[0, 1], [2, 3]]  # a tuple of rows is no pair


def test_lists_are_not_rounded():
    large = 2 ** 70 + 1
    assert Polyhedron.from_generators([[large, 0.5]]).vertex_fractions.tolist() == [[large, Fraction(1, 2)]]
    assert Polyhedron.from_generators([[2 ** 63, -1]]).vertex_integers.tolist() == [[2 ** 63, -1, 1]]
    assert Polyhedron.from_generators(np.array([[2 ** 64 - 1]], np.uint64)).vertex_integers.tolist() == [[2 ** 64 - 1, 1]]
    for x in (2 ** 63 - 1, -2 ** 63, 2 ** 63, -2 ** 63 - 1, 2 ** 64, -2 ** 64, 3 ** 200, -(3 ** 200), 10 ** 5000):
        p = Polyhedron.from_generators([[x]])
        assert p.vertex_integers.tolist() == [[x, 1]]
        assert (p.vertex_integers.dtype == np.int64) == (-2 ** 63 <= x < 2 ** 63)


def test_frames():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"x": [3, -1, 0], "y": [1.0, 0.0, -1.0]})
    assert Polyhedron(frame, pandas.Series(B)) == TRIANGLE
    assert TRIANGLE.contains(frame.iloc[2:]).tolist() == [False]


SQUARE = Polyhedron([[1, 0], [-1, 0], [0, 1], [0, -1]], [1, 0, 1, 0])
LINE = Polyhedron.from_generators(lines=[[1, 1]])
NAN, INF = float("nan"), float("inf")
REFUSED = {
    "A: row 1, column 0: nan is not finite": (lambda: Polyhedron([[1, 2], [NAN, 3]], [0, 0]), [1]),
    "A: row 2, column 1: inf is not finite": (lambda: Polyhedron(np.array([[1, 2], [1, 3], [1, INF]]), [0, 0, 0]), [2]),
    "b: row 1: -inf is not finite": (lambda: Polyhedron([[1], [2]], [0, -INF]), [1]),
    "A: row 0, column 1: NaN is not finite": (lambda: Polyhedron([[1, decimal.Decimal("NaN")]], [0]), [0]),
    "A: row 0, column 0: Infinity is not finite": (lambda: Polyhedron([[decimal.Decimal("inf")]], [0]), [0]),
    "A: row 0, column 1: nan is not finite": (lambda: Polyhedron(np.array([[1, NAN]], np.longdouble), [0]), [0]),
    "A: row 1, column 1: '3/x' is not a rational number": (lambda: Polyhedron([[1, 2], ["1", "3/x"]], [0, 0]), [1]),
    "b: row 0: '1/0' has the denominator 0": (lambda: Polyhedron([[1, 2]], ["1/0"]), [0]),
    "b: row 1: the denominator is 0": (lambda: Polyhedron([[1], [2]], ([1, 2], [3, 0])), [1]),
    "b: row 0: the denominator is 0": (lambda: Polyhedron([[1]], [Ratio(1, 0)]), [0]),
    "A: row 0, column 1: None is not a number": (lambda: Polyhedron([[1, None]], [0]), [0]),
    "A: row 0, column 0: a complex is not a rational number": (lambda: Polyhedron([[1j, 1]], [0]), [0]),
    "A: row 1, column 0: numerators and denominators are integers": (lambda: Polyhedron(([[1], [0.5]], [[1], [2]]), [0, 0]), [1]),
    "equations[0]: row 0, column 1: nan is not finite": (lambda: Polyhedron(A, B, ([[1, NAN]], [1])), [0]),
    "equations[1]: row 0: None is not a number": (lambda: Polyhedron(A, B, ([[1, 1]], [None])), [0]),
    "vertices: row 1, column 0: nan is not finite": (lambda: Polyhedron.from_generators([[0.0], [NAN]]), [1]),
    "rays: row 0, column 0: '' is not a rational number": (lambda: Polyhedron.from_generators([[0]], [[""]]), [0]),
    "lines: row 0, column 0: inf is not finite": (lambda: Polyhedron.from_generators(lines=[[INF]]), [0]),
    "points: row 1, column 0: nan is not finite": (lambda: SQUARE.contains([[0, 0], [NAN, 0]]), [1]),
    "c: row 1: nan is not finite": (lambda: SQUARE.maximize([0, NAN]), [1]),
    "there is no vertex 4": (lambda: SQUARE.facets_of_vertex(4), []),
    "there is no vertex -1": (lambda: SQUARE.facets_of_vertex(-1), []),
    "there is no ray 0": (lambda: SQUARE.facets_of_ray(0), []),
    "there is no facet 9": (lambda: SQUARE.vertices_of_facet(9), []),
    "there is no facet -3": (lambda: SQUARE.rays_of_facet(-3), []),
    "there is no axis 2": (lambda: SQUARE.projection([2]), []),
    "axis 1 comes twice": (lambda: SQUARE.projection([1, 1]), []),
    "axes: 2 flags, one for each coordinate, not 3": (lambda: SQUARE.projection([True, False, True]), []),
    "polyhedra in 2 and 3 dimensions": (lambda: SQUARE.intersection(Polyhedron.space(3)), []),
    "the dimension must be at least 0": (lambda: Polyhedron.empty(-1), []),
    "a coefficient of row 1 of polyhedron 2 is not finite": (lambda: delone.polyhedra_vertices(np.r_[np.zeros(10), NAN, 0].reshape(3, 2, 2), np.zeros((3, 2))), [2]),
    "the bound of row 0 of polyhedron 1 is not finite": (lambda: delone.polyhedra_vertices([[[1]], [[1]]], [[0], [INF]]), [1]),
}


@pytest.mark.parametrize("message", REFUSED)
def test_bad_numbers_are_named(message):
    call, rows = REFUSED[message]
    with pytest.raises(delone.InputError) as caught:
        call()
    assert str(caught.value) == message and list(caught.value.rows) == rows


SHAPES = {
    "A: an array of shape (n, d), not (2,)": lambda: Polyhedron([1, 2], [1]),
    "b: an array of shape (3,), not (2,)": lambda: Polyhedron(A, [1, 2]),
    "b: an array of shape (n,), not (3, 1)": lambda: Polyhedron(A, [[1], [2], [3]]),
    "A: rows of different lengths": lambda: Polyhedron([[1, 2], [3]], [1, 2]),
    "A: masked values are not numbers": lambda: Polyhedron(np.ma.masked_array(A, A == 3), B),
    "A: an array of numbers, not of complex128": lambda: Polyhedron(A.astype(complex), B),
    "A: an array of numbers, not of datetime64[D]": lambda: Polyhedron(A.astype("M8[D]"), B),
    "b: missing, the vector for A": lambda: Polyhedron(A),
    "A: missing, the matrix for b": lambda: Polyhedron(b=B),
    "A and b, or equations; Polyhedron.space(d) is all of space": lambda: Polyhedron(),
    "equations: a pair (C, e) of a matrix and a vector, for C x = e": lambda: Polyhedron(A, B, [[1, 1, 1]]),
    "equations[0]: an array of shape (e, 2), not (1, 3): as many columns as A": lambda: Polyhedron(A, B, ([[1, 1, 1]], [1])),
    "vertices, rays or lines, with their coordinates; Polyhedron.empty(d) is empty": lambda: Polyhedron.from_generators([]),
    "rays: an array of shape (n, 2), not (1, 3): as many columns as the others": lambda: Polyhedron.from_generators([[1, 2]], [[1, 2, 3]]),
    "A: denominators of shape (3,) for numerators of shape (3, 2)": lambda: Polyhedron((A, [1, 2, 3]), B),
    "points: an array of shape (..., 2), not (3,)": lambda: SQUARE.contains([1, 2, 3]),
    "points: an array of shape (d,) or (..., d), not a int": lambda: SQUARE.contains(3),
    "c: an array of shape (2,), not (3,)": lambda: SQUARE.minimize([1, 2, 3]),
    "matrix: an array of shape (n, 2), not (1, 3)": lambda: SQUARE.image([[1, 2, 3]]),
    "matrix: an array of shape (2, n), not (1, 3)": lambda: SQUARE.preimage([[1, 2, 3]]),
    "translation: an array of shape (1,), not (2,)": lambda: SQUARE.image([[1, 2]], [1, 2]),
    "translation: an array of shape (2,), not (1,)": lambda: SQUARE.preimage([[1], [2]], [1]),
    "time_limit: a finite number of seconds above 0, or None, not 0": lambda: Polyhedron(A, B, time_limit=0),
    "b: an array of shape (n, m), not (3,)": lambda: delone.polyhedra_vertices(A, B),
    "A: an array of shape (2, 3, d) or (3, d), not (2, 2)": lambda: delone.polyhedra_vertices([[1, 2], [3, 4]], [B, B]),
    "A: at least one inequality, and one dimension": lambda: delone.polyhedra_vertices(np.zeros((2, 3, 0)), [B, B]),
}


@pytest.mark.parametrize("message", SHAPES)
def test_bad_shapes_are_named(message):
    with pytest.raises(ValueError, match="^" + re.escape(message) + "$"):
        SHAPES[message]()


@pytest.mark.parametrize("call, message", [
    (lambda: Polyhedron("A", B), "A: an array, not a str"), (lambda: SQUARE.intersection(3), "other: "), (lambda: SQUARE.projection(["x"]), "axes: "),
    (lambda: SQUARE.projection([True, 0]), "axes: integers or flags, not both"), (lambda: SQUARE.projection(3), "axes: a list of integers"), (lambda: SQUARE.projection(np.ones((1, 2), bool)), "axes: a list of integers"),
    (lambda: Polyhedron(A, B, progress=3), "progress: True, a function of the fraction done, or None, not int"),
    (lambda: Polyhedron(A, B, memory_limit="all"), "memory_limit: a number of bytes, or None, not str"),
    (lambda: SQUARE.facets_of_vertex("a"), "vertex: "), (lambda: SQUARE.save(3), ""), (lambda: SQUARE < SQUARE, "'<' not supported")])
def test_bad_types(call, message):
    with pytest.raises(TypeError, match=re.escape(message)):
        call()


def test_nothing_is_assigned():
    for name in ("vertices", "volume", "dimension"):
        with pytest.raises(AttributeError):
            setattr(SQUARE, name, 1)
    with pytest.raises(ValueError, match="read-only"):
        SQUARE.vertices[0] = 1


SETS = {"square": SQUARE, "triangle": TRIANGLE, "line": LINE, "third": Polyhedron([["3"], [-1]], [1, "1/7"]), "empty": Polyhedron.empty(2),
        "nothing": Polyhedron.empty(0), "point": Polyhedron.space(0), "space": Polyhedron.space(3), "cone": Polyhedron.from_generators(rays=np.eye(3)),
        "flat": Polyhedron(A, B, ([[1, 1]], ["1/5"])), "large": Polyhedron.from_generators([[10 ** 40, "1/3"], [0, 0]], [[1, -10 ** 50]])}


@pytest.mark.parametrize("name", SETS)
def test_files_and_pickles(name, tmp_path):
    p = SETS[name]
    for extension in ("ine", "ext", "ine.gz"):
        if extension.endswith("gz"):
            import gzip
            (tmp_path / "a.ine.gz").write_bytes(gzip.compress((tmp_path / "a.ine").read_bytes()))
        else:
            p.save(tmp_path / f"a.{extension}")
        for back in (delone.read_polyhedron(tmp_path / f"a.{extension}"), delone.read(tmp_path / f"a.{extension}"), delone.read(str(tmp_path / f"a.{extension}"))):
            assert back == p and back.hash == p.hash
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        back = pickle.loads(pickle.dumps(p, protocol))
        assert back == p and back.row_kinds.tolist() == p.row_kinds.tolist() and back.redundant_rows.tolist() == p.redundant_rows.tolist()
        assert back.vertex_integers.tolist() == p.vertex_integers.tolist()
    assert copy.deepcopy(p) == p and copy.copy(p) == p


def test_pickles_keep_what_rows_were():
    p = Polyhedron(np.r_[A, A[:1], [[1, 1]]], [*B, 1, 5])
    assert p.row_kinds.tolist() == [0, 0, 0, 1, 3]
    back = pickle.loads(pickle.dumps(p))
    assert back.row_kinds.tolist() == [0, 0, 0, 1, 3] and back.redundant_rows.tolist() == [3, 4]


def test_files_say_what_is_wrong(tmp_path):
    (tmp_path / "bad.ine").write_text("H-representation\nbegin\n1 2 integer\n1 x\nend\n")
    with pytest.raises(delone.InputError, match=r"bad\.ine:4: "):
        delone.read_polyhedron(tmp_path / "bad.ine")
    with pytest.raises(delone.Error, match="none.ine"):
        delone.read_polyhedron(tmp_path / "none.ine")
    with pytest.raises(delone.Error, match="npz"):
        SQUARE.save(tmp_path / "a.npz")
    with pytest.raises(TypeError, match="columns, skip_missing and frame are for points"):
        SQUARE.save(tmp_path / "a.ine")
        delone.read(tmp_path / "a.ine", columns=["x"])
    SQUARE.save(tmp_path / "a.txt", "ext")
    assert delone.read(tmp_path / "a.txt", format="ext") == SQUARE


@pytest.mark.parametrize("name, text", {
    "square": "dimension 2, 4 vertices, 4 facets", "line": "dimension 2, affine dimension 1, 1 vertex, 1 line, 0 facets", "empty": "dimension 2, empty",
    "cone": "dimension 3, 1 vertex, 3 rays, 3 facets", "point": "dimension 0, 1 vertex, 0 facets", "space": "dimension 3, 1 vertex, 3 lines, 0 facets"}.items())
def test_repr(name, text):
    assert repr(SETS[name]) == f"<delone.Polyhedron: {text}>"


@pytest.mark.parametrize("name", SETS)
def test_html(name):
    page = SETS[name]._repr_html_()
    assert xml.etree.ElementTree.fromstring(page) is not None and "delone.Polyhedron" in page
    assert ("<svg" in page) == (len(SETS[name].adjacent_vertices) > 0)


def cuts(seed, m, d):
    r = np.random.default_rng(seed)
    x = r.standard_normal((m, d))
    return x / np.linalg.norm(x, axis=1, keepdims=True), np.ones(m)


def test_limits_progress_and_threads():
    a, b = cuts(1, 60, 9)
    with pytest.raises(delone.TimeLimitError, match="0.2"):
        Polyhedron(a, b, time_limit=0.2)
    with pytest.raises(delone.OutOfMemoryError):
        Polyhedron(a, b, memory_limit=1000)
    said = []
    with pytest.raises(delone.CancelledError):
        Polyhedron(a, b, progress=lambda fraction: said.append(fraction) or False)
    assert 0 <= said[0] <= 1
    with pytest.raises(ZeroDivisionError):
        Polyhedron(a, b, progress=lambda fraction: 1 / 0)
    one = Polyhedron(*cuts(2, 25, 4), threads=1)
    assert all(Polyhedron(*cuts(2, 25, 4), threads=threads).hash == one.hash for threads in (0, 2, 5))
    cube, cross = np.r_[np.eye(8), -np.eye(8)], Polyhedron.from_generators(np.r_[np.eye(8), -np.eye(8)])
    with pytest.raises(delone.CancelledError):
        cross.minkowski_sum(Polyhedron(cube, np.ones(16)), progress=lambda fraction: False)
