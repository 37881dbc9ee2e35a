# SPDX-License-Identifier: BSD-3-Clause
"""Polyhedra by brute force in fractions: what tests of delone.Polyhedron compare it with. It shares no code and no method with it: vertices
and rays are the solutions of all systems of so many rows, and facets are sets of them of the right rank."""
import itertools
from fractions import Fraction
from math import gcd, lcm
from typing import NamedTuple


def echelon(rows, width):
    """The reduced echelon form without zero rows, and its pivots."""
    rows, pivots = [[Fraction(x) for x in row] for row in rows], []
    for column in range(width):
        at = len(pivots)
        pivot = next((i for i in range(at, len(rows)) if rows[i][column] != 0), None)
        if pivot is None:
            continue
        rows[at], rows[pivot] = rows[pivot], rows[at]
        rows[at] = [x / rows[at][column] for x in rows[at]]
        for i in range(len(rows)):
            if i != at and rows[i][column] != 0:
                factor = rows[i][column]
                rows[i] = [x - factor * y for x, y in zip(rows[i], rows[at])]
        pivots.append(column)
    return rows[:len(pivots)], pivots


def rank(rows, width):
    return len(echelon(rows, width)[1])


def kernel(rows, width):
    reduced, pivots = echelon(rows, width)
    vectors = []
    for free in (i for i in range(width) if i not in pivots):
        vector = [Fraction(int(i == free)) for i in range(width)]
        for row, pivot in zip(reduced, pivots):
            vector[pivot] = -row[free]
        vectors.append(vector)
    return vectors


def primitive(row):
    """The integers without a common divisor that are a positive multiple."""
    row = [Fraction(x) for x in row]
    scale = lcm(*(x.denominator for x in row)) if row else 1
    integers = [int(x * scale) for x in row]
    common = gcd(*integers) if integers else 0
    return tuple(x // common for x in integers) if common else tuple(integers)


def reduced_by(row, rows, pivots):
    """The row with zeros at the pivots of an echelon form, primitive."""
    row = [Fraction(x) for x in row]
    for other, pivot in zip(rows, pivots):
        factor = row[pivot]
        row = [x - factor * y for x, y in zip(row, other)]
    return primitive(row)


def dot(a, x):
    return sum((p * q for p, q in zip(a, x)), Fraction(0))


class Expected(NamedTuple):
    vertices: list  # tuples of fractions, sorted
    rays: list  # tuples of integers, sorted
    lines: list
    inequalities: list  # (a, b)
    equations: list
    kinds: list  # of the inequalities that were given
    tight: dict  # inequality → the numbers of its vertices, and of its rays


def vertices_of(a, b, c, e, d):
    """The solutions of all systems of d independent rows, all equations among them."""
    found = set()
    for chosen in itertools.combinations(range(len(a)), max(d - rank(c, d), 0)):
        system = [[*row, right] for row, right in zip(c, e)] + [[*a[i], b[i]] for i in chosen]
        reduced, pivots = echelon(system, d + 1)
        if pivots != list(range(d)):
            continue
        x = tuple(row[d] for row in reduced)
        if all(dot(row, x) <= right for row, right in zip(a, b)):
            found.add(x)
    return sorted(found)


def rays_of(a, c, d):
    """The directions of all systems of d-1 independent rows, as far as they stay within."""
    found = set()
    for chosen in itertools.combinations(range(len(a)), max(d - 1 - rank(c, d), 0)):
        for vector in (kernel([*c, *(a[i] for i in chosen)], d) if d else []):
            if len(kernel([*c, *(a[i] for i in chosen)], d)) == 1:
                for direction in (vector, [-x for x in vector]):
                    if all(dot(row, direction) <= 0 for row in a):
                        found.add(primitive(direction))
    return sorted(found)


def by_brute_force(a, b, c, e, d):
    """Both descriptions of {x : a x <= b, c x = e}, canonical."""
    lines, line_pivots = echelon(kernel([*a, *c], d), d)
    section = [[Fraction(int(i == pivot)) for i in range(d)] for pivot in line_pivots]  # no line is left in it
    pointed, zeros = [*c, *section], [*e, *(0 for _ in section)]
    vertices = vertices_of(a, b, pointed, zeros, d)
    if not vertices:
        return Expected([], [], [], [], [(0,) * d + (1,)], [3] * len(a), {})
    rays = rays_of(a, pointed, d)
    generators = [(*x, Fraction(1)) for x in vertices] + [(*map(Fraction, x), Fraction(0)) for x in [*rays, *lines]]
    equations, equation_pivots = echelon([(*row[:d], -row[d]) for row in kernel(generators, d + 1)], d + 1)
    whole = rank(generators, d + 1)
    inequalities, kinds, tight = [], [], {}
    for row, right in zip(a, b):
        on = [i for i, x in enumerate(generators) if dot(row, x) == right * x[d]]
        if len(on) == len(generators):
            kinds.append(3 if not any(row) else 2)
            continue
        if rank([generators[i] for i in on], d + 1) < whole - 1 or not any(i < len(vertices) for i in on):
            kinds.append(3)
            continue
        facet = reduced_by((*row, right), equations, equation_pivots)
        kinds.append(int(facet in inequalities))
        if facet not in inequalities:
            inequalities.append(facet)
            tight[facet] = ([i for i in on if i < len(vertices)],
                            [i - len(vertices) for i in on if len(vertices) <= i < len(vertices) + len(rays)])
    return Expected(vertices, rays, [primitive(x) for x in lines], sorted(inequalities), [primitive(x) for x in equations], kinds, tight)


def faces_by_brute_force(expected, d):
    """f_0, …: all intersections of facets that have a vertex, and the dimensions of what is in them."""
    homogeneous = [(*x, 1) for x in expected.vertices] + [(*x, 0) for x in expected.rays]
    lines = [(*x, 0) for x in expected.lines]
    v = len(expected.vertices)
    facets = [frozenset(on) | {v + i for i in rays} for on, rays in expected.tight.values()]
    faces = {frozenset(range(len(homogeneous)))}
    for facet in facets:
        faces |= {face & facet for face in faces}
    counts = [0] * (rank(homogeneous + lines, d + 1) - 1)
    for face in faces:
        dimension = rank([homogeneous[i] for i in face] + lines, d + 1) - 1
        if dimension < len(counts) and any(i < v for i in face):
            counts[dimension] += 1
    return tuple(counts)


def determinant(rows):
    rows, result = [list(row) for row in rows], Fraction(1)
    for i in range(len(rows)):
        pivot = next((j for j in range(i, len(rows)) if rows[j][i] != 0), None)
        if pivot is None:
            return Fraction(0)
        if pivot != i:
            rows[i], rows[pivot], result = rows[pivot], rows[i], -result
        result *= rows[i][i]
        for j in range(i + 1, len(rows)):
            factor = rows[j][i] / rows[i][i]
            rows[j] = [x - factor * y for x, y in zip(rows[j], rows[i])]
    return result


def volume_by_brute_force(expected, d):
    """Of a full polytope: simplices from the first vertex of each face to the facets of the face that do not have it."""
    facets = [frozenset(on) for on, _ in expected.tight.values()]
    points = [(*x, Fraction(1)) for x in expected.vertices]

    def simplices(face, dimension):
        if dimension == 0:
            yield tuple(face)
            return
        apex = min(face)
        below = {face & facet for facet in facets if apex not in face & facet}
        for each in below:
            if rank([points[i] for i in each], d + 1) == dimension:
                yield from ((apex, *simplex) for simplex in simplices(each, dimension - 1))

    factorial = Fraction(1)
    for i in range(2, d + 1):
        factorial *= i
    return sum(abs(determinant([points[i] for i in simplex])) for simplex in simplices(frozenset(range(len(points))), d)) / factorial
