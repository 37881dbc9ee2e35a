# SPDX-License-Identifier: BSD-3-Clause
"""delone.Polyhedron against brute force in fractions, on random and on degenerate sets."""
import itertools
import os
import pickle
import random
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

import delone
from delone import Polyhedron
from polyhedra_support import by_brute_force, dot, faces_by_brute_force, primitive, rank, volume_by_brute_force

ROUNDS = {"small": 3, "large": 300}.get(os.environ.get("DELONE_TEST_SCALE"), 30)


def matrix(rows, width):
    """Also without rows or columns; of Fractions."""
    return np.array([[Fraction(x) for x in row] for row in rows], object).reshape(len(rows), width)


def made_of(a, b, c, e, d):
    return Polyhedron(matrix(a, d), matrix([b], len(b))[0], (matrix(c, d), matrix([e], len(e))[0]))


def tuples(rows):
    return [tuple(row) for row in rows.tolist()]


def assert_is(p, expected, d):
    assert p.dimension == d and p.is_empty == (not expected.vertices)
    assert tuples(p.vertex_fractions) == expected.vertices
    assert tuples(p.ray_integers) == expected.rays and tuples(p.line_integers) == expected.lines
    assert tuples(p.inequality_integers) == expected.inequalities and tuples(p.equation_integers) == expected.equations
    assert p.affine_dimension == (d - len(expected.equations) if expected.vertices else -1)
    assert (p.num_vertices, p.num_rays, p.num_lines) == (len(expected.vertices), len(expected.rays), len(expected.lines))
    assert (p.num_inequalities, p.num_equations) == (len(expected.inequalities), len(expected.equations))
    assert p.is_bounded == (not expected.rays and not expected.lines)
    for i, row in enumerate(expected.inequalities):
        assert (p.vertices_of_facet(i).tolist(), p.rays_of_facet(i).tolist()) == expected.tight[row]
    for i in range(p.num_vertices):
        assert p.facets_of_vertex(i).tolist() == [f for f, row in enumerate(expected.inequalities) if i in expected.tight[row][0]]
    for i in range(p.num_rays):
        assert p.facets_of_ray(i).tolist() == [f for f, row in enumerate(expected.inequalities) if i in expected.tight[row][1]]


FAMILIES = ["general", "cone", "duplicates", "equations", "flat", "slabs", "cut off"]


def system(family, r, d):
    """a x <= b, c x = e; small integers and fractions."""
    m = r.randint(0, 7 if d < 4 else 6)

    def row():
        return [Fraction(r.randint(-2, 2), r.choice([1, 1, 1, 2, 3])) for _ in range(d)]
    a, b, c, e = [row() for _ in range(m)], [Fraction(r.randint(-1, 3)) for _ in range(m)], [], []
    if family == "cone":
        b = [Fraction(0)] * m
    if family == "duplicates" and m > 1:
        i, factor = r.randrange(m - 1), Fraction(r.randint(1, 3), 2)
        a[-1], b[-1] = [factor * x for x in a[i]], factor * b[i]
    if family == "equations":
        c, e = [row() for _ in range(r.randint(1, 2))], [Fraction(r.randint(-1, 2)) for _ in range(2)]
        e = e[:len(c)]
    if family == "flat" and m > 1:  # an equation as two inequalities
        a[-1], b[-1] = [-x for x in a[0]], -b[0]
    if family == "slabs":
        a, b = [x for row in a[:3] for x in (row, [-y for y in row])], [x for right in b[:3] for x in (right, right)]
    if family == "cut off":
        unit = [[Fraction(int(i == j)) for j in range(d)] for i in range(d)]
        a, b = a[:3] + unit + [[-x for x in row] for row in unit], b[:3] + [Fraction(1)] * (2 * d)
    return a, b, c, e


@pytest.mark.parametrize("family, d", [(family, d) for family in FAMILIES for d in range(5)])
def test_random_systems(family, d):
    r = random.Random(f"{family} {d}")
    for _ in range(ROUNDS if d < 4 else max(ROUNDS // 5, 1)):
        a, b, c, e = system(family, r, d)
        p, expected = made_of(a, b, c, e, d), by_brute_force(a, b, c, e, d)
        assert_is(p, expected, d)
        assert p.row_kinds.tolist() == expected.kinds
        assert p.redundant_rows.tolist() == [i for i, kind in enumerate(expected.kinds) if kind in (1, 3) and expected.vertices]
        back = Polyhedron.from_generators(p.vertex_fractions, p.ray_integers, p.line_integers)
        assert back == p and back.hash == p.hash and hash(back) == hash(p)
        assert_is(back, expected, d)
        if expected.vertices:
            assert p.f_vector == faces_by_brute_force(expected, d)
            assert_adjacent(p, expected, d)
        if p.is_bounded and p.affine_dimension == d and d > 0:
            assert p.volume_fraction == volume_by_brute_force(expected, d)


def assert_adjacent(p, expected, d):
    """Two vertices are joined if what holds with equality at both is a line; two facets if what they share has two dimensions less."""
    of_all = [row[:d] for row in expected.equations]
    edges = []
    for i, j in itertools.combinations(range(p.num_vertices), 2):
        both = [row[:d] for row in expected.inequalities if {i, j} <= set(expected.tight[row][0])]
        if rank(both + of_all, d) == d - len(expected.lines) - 1:
            edges.append((i, j))
    assert tuples(p.adjacent_vertices) == edges
    ridges = []
    for f, g in itertools.combinations(range(p.num_inequalities), 2):
        on, rays = ([x for x in expected.tight[expected.inequalities[f]][kind] if x in expected.tight[expected.inequalities[g]][kind]] for kind in (0, 1))
        points = [(*expected.vertices[i], 1) for i in on] + [(*expected.rays[i], 0) for i in rays] + [(*x, 0) for x in expected.lines]
        if on and rank(points, d + 1) == p.affine_dimension - 1:
            ridges.append((f, g))
    assert tuples(p.adjacent_facets) == ridges


@pytest.mark.parametrize("d", range(1, 5))
def test_random_generators(d):
    r = random.Random(d)
    for _ in range(ROUNDS):
        def rows(most):
            return [[Fraction(r.randint(-2, 2), r.choice([1, 1, 2])) for _ in range(d)] for _ in range(r.randint(0, most))]
        vertices, rays, lines = rows(6), rows(r.choice([0, 0, 3])), rows(r.choice([0, 0, 0, 1]))
        p = Polyhedron.from_generators(matrix(vertices, d), matrix(rays, d), matrix(lines, d))
        a, b = [x[:d] for x in tuples(p.inequality_integers)], [x[d] for x in tuples(p.inequality_integers)]
        c, e = [x[:d] for x in tuples(p.equation_integers)], [x[d] for x in tuples(p.equation_integers)]
        assert_is(p, by_brute_force(a, b, c, e, d), d)
        for x in vertices or ([[0] * d] if rays or lines else []):
            assert all(dot(row, x) <= right for row, right in zip(a, b)) and all(dot(row, x) == right for row, right in zip(c, e))
            assert p.contains(x)
        for x in rays:
            assert all(dot(row, x) <= 0 for row in a) and all(dot(row, x) == 0 for row in c)
        for x in lines:
            assert all(dot(row, x) == 0 for row in a + c)
        if not p.num_lines:  # what is extreme was given
            assert set(tuples(p.vertex_fractions)) <= {tuple(x) for x in vertices or [[0] * d]}
            assert set(tuples(p.ray_integers)) <= {primitive(x) for x in rays}
        assert len(p.row_kinds) == len(vertices) + len(rays)
        kept = [i for i in range(len(vertices) + len(rays)) if i not in p.redundant_rows]
        left = Polyhedron.from_generators(matrix([vertices[i] for i in kept if i < len(vertices)], d),
                                          matrix([rays[i - len(vertices)] for i in kept if i >= len(vertices)], d), matrix(lines, d))
        assert left == p


def corners(d):
    return np.array(list(itertools.product([0, 1], repeat=d)))


def cross(d):
    return np.r_[np.eye(d, dtype=int), -np.eye(d, dtype=int)]


def test_known_polytopes():
    for d in range(1, 7):
        cube, dual = Polyhedron.from_generators(corners(d)), Polyhedron.from_generators(cross(d))
        assert (cube.num_inequalities, dual.num_inequalities) == (2 * d, 2 ** d)
        assert cube.volume_fraction == 1 and dual.volume_fraction == Fraction(2 ** d, int(np.prod(range(1, d + 1))))
        assert dual.polar() == Polyhedron(cross(d), np.ones(2 * d, int)) and dual.polar().polar() == dual
        assert len(cube.adjacent_vertices) == d * 2 ** (d - 1) and cube.f_vector[0] == 2 ** d
    permutations = np.array(list(itertools.permutations(range(5))))
    p = Polyhedron.from_generators(permutations)
    assert (p.dimension, p.affine_dimension, p.num_inequalities, p.num_vertices) == (5, 4, 30, 120) and p.volume == 0
    assert p.f_vector == (120, 240, 150, 30) and p.equation_integers.tolist() == [[1, 1, 1, 1, 1, 10]]
    moments = Polyhedron.from_generators([[t ** k for k in range(1, 7)] for t in range(10)])
    assert moments.num_inequalities == 50  # of the cyclic polytope C(10, 6)
    assert len(moments.adjacent_vertices) == 45


def test_the_smallest_sets():
    point, nothing = Polyhedron(np.zeros((0, 0)), []), Polyhedron(np.zeros((1, 0)), [-1])
    assert (point.num_vertices, point.affine_dimension, point.volume_fraction) == (1, 0, 1) and point == Polyhedron.space(0)
    assert nothing.is_empty and nothing.volume == 0 and nothing == Polyhedron.empty(0) and nothing.affine_dimension == -1
    assert nothing.bounding_box is None and nothing.integer_bounding_box is None and nothing.f_vector == ()
    space = Polyhedron.space(3)
    assert space.num_lines == 3 and space.num_vertices == 1 and not space.is_bounded and space.volume == np.inf and space.volume_fraction is None
    assert space.bounding_box.tolist() == [[-np.inf] * 3, [np.inf] * 3] and space.contains([1e300, 0, -1])
    assert Polyhedron.empty(2).equations.tolist() == [[0, 0, 1]] and Polyhedron.empty(2).polar() == Polyhedron.space(2)
    assert Polyhedron.from_generators([[1, 2, 3]]).equations.shape == (3, 4)
    assert Polyhedron.from_generators(np.zeros((0, 3))) == Polyhedron.empty(3)
    assert Polyhedron.from_generators(rays=[[1, 0]]).vertices.tolist() == [[0, 0]]
    assert Polyhedron.from_generators([], [[1, 0]], []) == Polyhedron.from_generators(rays=[[1, 0]])


def test_an_equation_among_the_inequalities():
    """Flat sets: where a point is found first and the rest inside, nothing is inside."""
    a = np.array([[1, 1, 1], [-1, -1, -1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]])
    p = Polyhedron(a, [1, -1, 0, 0, 0])
    assert p.vertices.tolist() == [[0, 0, 1], [0, 1, 0], [1, 0, 0]] and p.row_kinds.tolist() == [2, 2, 0, 0, 0]
    assert p.equations.tolist() == [[1, 1, 1, 1]] and p == Polyhedron(a[2:], [0, 0, 0], equations=([[1, 1, 1]], [1]))
    segment = Polyhedron([[1, 0], [-1, 0], [0, 1], [0, -1]], [0, 0, 1, 0])
    assert segment.vertices.tolist() == [[0, 0], [0, 1]] and segment.adjacent_vertices.tolist() == [[0, 1]]
    # A variable more that has to be 0 leaves the vertices as they are.
    wider = Polyhedron(np.c_[np.zeros(5, int), a], [1, -1, 0, 0, 0], (np.eye(1, 4, dtype=int), [0]))
    assert wider.vertices[:, 1:].tolist() == p.vertices.tolist() and not wider.vertices[:, 0].any()


def test_decimals_in_an_equation():
    """Rounded twice with opposite signs, decimals are opposite doubles, and the set is flat; as text they are what they say."""
    weights = [[0.00106131548486069, -0.016634209829441304, 1.0], [-0.00106131548486069, 0.016634209829441304, -1.0]]
    box = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]]
    right = [1.007487377909021, -1.007487377909021, 21, -20.995, 64.005, -63.995]
    p = Polyhedron(np.r_[weights, box], right)
    assert (p.affine_dimension, p.num_vertices) == (2, 4)
    text = Polyhedron([[repr(x) for x in row] for row in [*weights, *box]], [repr(x) for x in right])
    assert (text.affine_dimension, text.num_vertices) == (2, 4) and text != p
    np.testing.assert_allclose(text.vertices, p.vertices, rtol=1e-14)
    # 0.1 + 0.2 is not 0.3 in binary: no point in doubles, one in decimals.
    assert Polyhedron([[1.0], [-1.0]], [0.3, -(0.1 + 0.2)]).is_empty
    assert Polyhedron([[1], [-1]], ["0.3", "-0.3"]).vertex_fractions.tolist() == [[Fraction(3, 10)]]


@pytest.mark.parametrize("scale", [Fraction(1), Fraction(10) ** 150, Fraction(1, 10 ** 150), Fraction(10) ** 300 + 7, Fraction(1, 10 ** 330)])
def test_huge_and_tiny_numbers(scale):
    r = random.Random(7)
    for _ in range(5):
        a, b, _, _ = system("cut off", r, 3)
        plain = made_of(a, b, [], [], 3)
        scaled = made_of(a, [scale * x for x in b], [], [], 3)
        assert tuples(scaled.vertex_fractions) == [tuple(scale * x for x in row) for row in tuples(plain.vertex_fractions)]
        assert made_of([[scale * x for x in row] for row in a], [scale * x for x in b], [], [], 3) == plain
        assert pickle.loads(pickle.dumps(scaled)) == scaled


def test_doubles_of_what_is_beyond_them():
    large = 10 ** 400
    p = Polyhedron.from_generators([[0, 0]], [[large, 1], [1, 0]])
    assert p.ray_integers.dtype == object and p.ray_integers[1].tolist() == [large, 1]
    assert np.isfinite(p.rays).all() and p.rays[1].tolist() == [float(Fraction(x, 2 ** 329)) for x in (large, 1)]  # large has 1329 bits
    assert np.isfinite(p.inequalities[:, :2]).all()
    far = Polyhedron.from_generators([[large], [1]])
    assert far.vertices.tolist() == [[1], [np.inf]] and far.vertex_integers.tolist() == [[1, 1], [large, 1]]
    assert far.bounding_box.tolist() == [[1], [np.inf]] and far.integer_bounding_box.tolist() == [[1], [large]]
    with np.errstate(all="raise"):
        tiny = Polyhedron([[2.0 ** 1000], [-1]], [2.0 ** -1000, 0])
    assert tiny.vertex_fractions.tolist() == [[0], [Fraction(1, 2 ** 2000)]] and tiny.vertices.tolist() == [[0], [0]]


def test_rounded_results_are_the_nearest_doubles():
    r = np.random.default_rng(3)
    p = Polyhedron(np.r_[r.standard_normal((12, 3)), np.eye(3), -np.eye(3)], np.ones(18))
    assert p.vertices.dtype == np.float64 and p.vertex_integers.dtype == object
    assert p.vertices.tolist() == [[float(x) for x in row] for row in p.vertex_fractions.tolist()]
    assert p.vertex_fractions.tolist() == [[Fraction(x, row[-1]) for x in row[:-1]] for row in p.vertex_integers.tolist()]
    assert p.inequalities.tolist() == [[float(x) for x in row] for row in p.inequality_integers.tolist()]
    assert p.volume == float(p.volume_fraction)
    assert p.bounding_box.tolist() == [[float(x) for x in row] for row in p.bounding_box_fractions.tolist()]
    for array in (p.vertices, p.vertex_integers, p.vertex_fractions, p.inequalities, p.adjacent_facets, p.row_kinds, p.bounding_box, p.integer_bounding_box):
        assert not array.flags.writeable
    assert p.vertices is p.vertices  # kept


def test_optima_are_those_of_the_vertices():
    r = random.Random(5)
    for _ in range(ROUNDS):
        a, b, c, e = system(r.choice(FAMILIES), r, 3)
        p = made_of(a, b, c, e, 3)
        f = [Fraction(r.randint(-2, 2)) for _ in range(3)]
        for found, sign in ((p.maximize(f), 1), (p.minimize(f), -1)):
            values = [sign * dot(f, x) for x in tuples(p.vertex_fractions)]
            directions = [sign * dot(f, x) for x in tuples(p.ray_integers)]
            if not values:
                assert found.state == "empty" and np.isnan(found.value) and found.value_fraction is None
            elif any(x > 0 for x in directions) or any(dot(f, x) for x in tuples(p.line_integers)):
                assert found.state == "unbounded" and found.value == sign * np.inf and found.value_fraction is None and not len(found.vertices)
            else:
                assert found.state == "attained" and found.value_fraction == sign * max(values) and found.value == float(found.value_fraction)
                assert found.vertices.tolist() == [i for i, value in enumerate(values) if value == max(values)]
                assert found.rays.tolist() == [i for i, value in enumerate(directions) if value == 0]


def test_bounding_boxes():
    p = Polyhedron.from_generators([["-1/3", 0], ["7/2", "1/2"]], [[0, 1]])
    assert p.bounding_box_fractions.tolist() == [[Fraction(-1, 3), 0], [Fraction(7, 2), np.inf]]
    assert p.integer_bounding_box.tolist() == [[-1, 0], [4, np.inf]] and p.integer_bounding_box.dtype == object
    assert p.intersection(Polyhedron([[0, 1]], [1])).integer_bounding_box.dtype == np.int64


def points_of(p, r, count):
    """Rational points of a polyhedron, and others nearby."""
    found = []
    for _ in range(count):
        chosen = [r.choice(tuples(p.vertex_fractions)) for _ in range(3)]
        weights = [r.randint(0, 3) for _ in chosen]
        weights[0] += 1
        x = [sum(w * y[i] for w, y in zip(weights, chosen)) / Fraction(sum(weights)) for i in range(p.dimension)]
        for direction in (*tuples(p.ray_integers), *tuples(p.line_integers)):
            factor = r.randint(0, 2)
            x = [y + factor * z for y, z in zip(x, direction)]
        found.append([y + r.choice([0, 0, 0, Fraction(1, 3)]) for y in x])
    return found


def satisfies(p, x):
    d = p.dimension
    return (all(dot(row[:d], x) <= row[d] for row in tuples(p.inequality_integers)) and
            all(dot(row[:d], x) == row[d] for row in tuples(p.equation_integers)))


def test_operations_by_their_points():
    r = random.Random(11)
    for _ in range(ROUNDS):
        d = r.randint(1, 3)
        p, q = (made_of(*system(r.choice(FAMILIES), r, d), d) for _ in range(2))
        both, union, total, pair = p.intersection(q), p.convex_union(q), p.minkowski_sum(q), p.product(q)
        assert both == q.intersection(p) and union == q.convex_union(p) and total == q.minkowski_sum(p)
        assert p.includes(both) and q.includes(both) and union.includes(p) and union.includes(q)
        assert p.includes(q) == (p.convex_union(q) == p) == (p.intersection(q) == q)
        assert pair.dimension == 2 * d and pair.is_empty == (p.is_empty or q.is_empty) == total.is_empty
        assert both.row_kinds.shape == (0,)
        for x in points_of(p, r, 3) if not p.is_empty else []:
            assert p.contains(x) == satisfies(p, x)
            assert both.contains(x) == (p.contains(x) and q.contains(x))
            for y in points_of(q, r, 2) if not q.is_empty else []:
                if p.contains(x) and q.contains(y):
                    assert total.contains([s + t for s, t in zip(x, y)]) and union.contains([(s + t) / 2 for s, t in zip(x, y)])
                assert pair.contains([*x, *y]) == (p.contains(x) and q.contains(y))
        difference = Polyhedron.from_generators(matrix(total.vertex_fractions.tolist(), d), total.ray_integers, total.line_integers)
        assert difference == total


def test_images_and_preimages():
    r = random.Random(13)
    for _ in range(ROUNDS):
        d, n = r.randint(0, 3), r.randint(0, 3)
        p = made_of(*system(r.choice(FAMILIES), r, d), d)
        m = matrix([[r.randint(-2, 2) for _ in range(d)] for _ in range(n)], d)
        t = matrix([[r.randint(-2, 2) for _ in range(n)]], n)[0]
        image = p.image(m, t)
        assert image.dimension == n and image.is_empty == p.is_empty
        assert image == Polyhedron.from_generators(p.vertex_fractions @ m.T + t if d else matrix([t] * p.num_vertices, n),
                                                   p.ray_integers @ m.T if d else np.zeros((0, n)), p.line_integers @ m.T if d else np.zeros((0, n)))
        k = matrix([[r.randint(-2, 2) for _ in range(n)] for _ in range(d)], n)
        s = matrix([[r.randint(-2, 2) for _ in range(d)]], d)[0]
        preimage = p.preimage(k, s)
        assert preimage.dimension == n
        for y in (matrix([[r.randint(-2, 2) for _ in range(n)]], n)[0] for _ in range(5)):
            assert preimage.contains(y) == p.contains(k @ y + s if n else s)
        axes = r.sample(range(d), r.randint(0, d))
        assert p.projection(axes) == p.image(matrix([[int(i == axis) for i in range(d)] for axis in axes], d))


def test_polars():
    r = random.Random(17)
    for _ in range(ROUNDS):
        d = r.randint(1, 3)
        p = made_of(*system(r.choice(FAMILIES), r, d), d)
        polar = p.polar()
        assert polar == Polyhedron(matrix([*p.vertex_fractions.tolist(), *p.ray_integers.tolist()], d), [1] * p.num_vertices + [0] * p.num_rays,
                                   (p.line_integers, [0] * p.num_lines))
        origin = Polyhedron.from_generators([[0] * d])
        assert polar.polar() == p.convex_union(origin)


SQUARE = delone.Polyhedron.from_generators([[0, 0], [1, 0], [0, 1], [1, 1]])


def test_queries_of_all_shapes():
    assert SQUARE.contains([0.5, 1]) and isinstance(SQUARE.contains([0.5, 1]), np.bool_)
    assert SQUARE.contains([[0, 0], [2, 0]]).tolist() == [True, False]
    assert SQUARE.contains(np.zeros((2, 3, 2))).shape == (2, 3) and SQUARE.contains(np.zeros((0, 2))).shape == (0,)
    assert SQUARE.contains(["1/3", Fraction(1, 3)])
    assert not SQUARE.contains([1 + 2.0 ** -52, 0])
    assert Polyhedron.space(0).contains([]) and not Polyhedron.empty(0).contains([])


def test_they_are_compared_as_sets():
    assert SQUARE == Polyhedron(cross(2), [1, 1, 0, 0]) and SQUARE != Polyhedron(cross(2), [1, 1, 0, 1])
    assert SQUARE != "square" and (SQUARE == 1) is False and SQUARE != None  # noqa: E711
    assert len({SQUARE, Polyhedron(cross(2), [1, 1, 0, 0]), SQUARE.product(SQUARE)}) == 2
    assert len(SQUARE.hash) == 32 and int(SQUARE.hash, 16) >= 0


@pytest.mark.parametrize("m, d", [(4, 1), (6, 2), (8, 3), (9, 4), (3, 3), (70, 2), (9, 7)])
@pytest.mark.parametrize("kind", ["integers", "halves", "doubles"])
def test_many_at_once(kind, m, d):
    r = np.random.default_rng([m, d])
    n = 60 if d < 7 else 5
    a = r.standard_normal((n, m, d)) if kind == "doubles" else r.integers(-2, 3, (n, m, d)) / (2 if kind == "halves" else 1)
    b = r.random((n, m)) if kind == "doubles" else r.integers(-1, 4, (n, m))
    if kind == "halves" and m > 3:
        a[:, 0], b[:, 0] = -a[:, 1], -b[:, 1]  # flat ones
    found = delone.polyhedra_vertices(a, b)
    assert len(found) == n and repr(found).startswith(f"<delone.PolyhedraVertices: {n} polyhedra, ")
    for one, matrix, bounds in zip(found, a, b):
        p = Polyhedron(matrix, bounds)
        assert one.affine_dimension == p.affine_dimension
        for ours, theirs in zip(one[1:], (p.vertices, p.rays, p.lines)):
            np.testing.assert_array_equal(ours, theirs)
    for threads in (1, 3):
        again = delone.polyhedra_vertices(a, b, threads=threads)
        assert all((getattr(again, name) == getattr(found, name)).all() for name in delone.PolyhedraVertices.__slots__)


def test_many_of_one_matrix():
    boxes = delone.polyhedra_vertices(np.r_[np.eye(2), -np.eye(2)], [[1, 1, 0, 0], [2, 3, -2, 0], [1, 1, -2, 0]])
    assert boxes.affine_dimensions.tolist() == [2, 1, -1] and [len(each.vertices) for each in boxes] == [4, 2, 0]
    assert boxes[-1] is not None and boxes[1:][0].vertices.tolist() == [[2, 0], [2, 3]] and not boxes.vertices.flags.writeable
    with pytest.raises(IndexError, match="polyhedron 3 of 3"):
        boxes[3]
    assert len(delone.polyhedra_vertices(np.zeros((0, 3, 2)), np.zeros((0, 3)))) == 0


def test_projections_by_flags():
    p = Polyhedron(np.r_[np.eye(3, dtype=int), -np.eye(3, dtype=int)], [1, 2, 3, 4, 5, 6])
    for flags in ([True, False, True], (True, False, True), np.array([True, False, True])):
        assert p.projection(flags) == p.projection([0, 2])
    assert p.projection([False] * 3).dimension == 0
    assert p.projection([1]).vertices.tolist() == [[-5.0], [2.0]]


def test_of_intersections_and_hulls():
    box = np.r_[np.c_[np.eye(3), [-1, -1, 0]], np.c_[-np.eye(3), [-1, -1, 0]]]
    flat = delone.HalfspaceIntersection(box)
    assert flat.state == "flat"
    assert flat.to_polyhedron().vertices.tolist() == [[-1, -1, 0], [-1, 1, 0], [1, -1, 0], [1, 1, 0]]
    open_box = delone.HalfspaceIntersection(box[:4] * 0.1)
    assert open_box.to_polyhedron(threads=2) == Polyhedron(box[:4, :3] * 0.1, -(box[:4, 3] * 0.1))
    points = np.random.default_rng(3).random((20, 3))
    hull = delone.ConvexHull(points)
    assert hull.to_polyhedron() == Polyhedron.from_generators(points)
    assert hull.to_polyhedron().num_inequalities == hull.num_facets
    with pytest.raises(delone.TimeLimitError):
        delone.ConvexHull(np.random.default_rng(4).standard_normal((200, 8))).to_polyhedron(time_limit=0.01)


def test_a_point_in_a_polyhedron():
    triangle = Polyhedron.from_generators([[0, 0], [2, 0], [0, 2]])
    assert [1, "1"] in triangle and (Fraction(1, 3), 0) in triangle and np.array([2.0, 0.0]) in triangle
    assert [1, "1.0000000000000000000001"] not in triangle
    for bad in ([1, 1, 1], [[1, 1]], 3):
        with pytest.raises((ValueError, TypeError)):
            bad in triangle  # pylint: disable=pointless-statement


def arrangement_cells(polyhedra, box):
    """The cells into which the planes of all facets divide a box."""
    cells = [box]
    for row in {tuple(map(int, row)) for p in polyhedra for row in p.inequality_integers}:
        a, b = list(row[:-1]), row[-1]
        sides = [Polyhedron([a], [b]), Polyhedron([[-x for x in a]], [-b])]
        cells = [part for cell in cells for part in (cell.intersection(side) for side in sides) if part.affine_dimension == part.dimension]
    return cells


@pytest.mark.parametrize("d", [1, 2, 3])
def test_unions_against_the_cells_of_an_arrangement(d):
    random = np.random.default_rng(d)
    for _ in range(6 if d < 3 else 2):
        count = int(random.integers(2, 7 - d))
        polyhedra = [Polyhedron.from_generators(random.integers(0, 6, (int(random.integers(1, d + 4)), d))) for _ in range(count)]
        polyhedra += [polyhedra[0], Polyhedron.empty(d)]
        box = Polyhedron.from_generators(list(itertools.product((0, 6), repeat=d)))
        full = [i for i, p in enumerate(polyhedra) if p.affine_dimension == d]  # others do not divide cells
        inner = [(cell.volume_fraction, [sum(x) / len(cell.vertex_fractions) for x in zip(*cell.vertex_fractions.tolist())])
                 for cell in arrangement_cells(polyhedra, box)]
        assert sum(volume for volume, _ in inner) == 6**d
        union = delone.union_volume(polyhedra, threads=2)
        assert isinstance(union, Fraction) and union == sum(volume for volume, x in inner if any(x in polyhedra[i] for i in full))
        found = delone.intersections(polyhedra)
        expected = {}
        for members in (m for size in range(2, len(full) + 1) for m in itertools.combinations(full, size)):
            if volume := sum(volume for volume, x in inner if all(x in polyhedra[i] for i in members)):
                expected[members] = volume
        assert [part.members for part in found] == list(expected)
        assert [part.polyhedron.volume_fraction for part in found] == list(expected.values())
        assert [part.members for part in delone.intersections(polyhedra, 2)] == [members for members in expected if len(members) == 2]


def test_unions_of_what_is_no_list_of_polyhedra():
    square = Polyhedron.from_generators([[0, 0], [1, 0], [0, 1], [1, 1]])
    assert delone.union_volume([]) == 0 and delone.intersections(iter([square])) == []
    assert delone.union_volume([square, Polyhedron.space(2)]) is None
    with pytest.raises(TypeError, match="polyhedra: 1 is"):
        delone.union_volume([square, [[0, 1]]])
    with pytest.raises(TypeError, match="sequence"):
        delone.intersections(3)
    with pytest.raises(ValueError, match="at least 2"):
        delone.intersections([square], 1)
    with pytest.raises(delone.Error, match="polyhedron 1 has dimension 3"):
        delone.union_volume([square, Polyhedron.space(3)])


LIMITED = """
import sys
import numpy as np
import delone
x = np.random.default_rng(5).standard_normal((90, 9))
x = np.rint(1000 * x / np.linalg.norm(x, axis=1, keepdims=True)).astype(int)

def most_bytes():
    return next(1024 * int(line.split()[1]) for line in open("/proc/self/status") if line.startswith("VmHWM"))

limit = most_bytes() + int(sys.argv[1])
try:
    delone.Polyhedron.from_generators(x, memory_limit=limit, threads=1)
except delone.OutOfMemoryError as error:
    print(most_bytes() <= limit, error)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
@pytest.mark.parametrize("megabytes", [8, 20, 40, 60, 90])
def test_a_limit_of_memory_is_kept(megabytes):
    """The whole takes some 150 MB. What is allocated between two looks at the memory fits into what is kept free."""
    made = subprocess.run([sys.executable, "-c", LIMITED, f"{megabytes}_000_000"], capture_output=True, text=True, check=True)
    assert made.stdout.startswith("True stopped at the limit of"), made.stdout + made.stderr


def test_limits_tell_how_large_the_intermediate_polyhedron_is():
    x = np.random.default_rng(5).standard_normal((90, 9))
    with pytest.raises(delone.TimeLimitError, match=r"limit of 0.1 seconds .*; \d+ vertices and rays of an intermediate polyhedron, of \d+ of 90 rows"):
        Polyhedron.from_generators(np.rint(1000 * x / np.linalg.norm(x, axis=1, keepdims=True)).astype(int), time_limit=0.1)
