# SPDX-License-Identifier: BSD-3-Clause
"""Geometry in integers, slow and sure: the oracle on lattices, where ties are many."""
from fractions import Fraction


def determinant(matrix):
    """The exact determinant of a square matrix of integers or fractions."""
    rows = [[Fraction(x) for x in row] for row in matrix]
    result = Fraction(1)
    for i in range(len(rows)):
        pivot = next((j for j in range(i, len(rows)) if rows[j][i]), None)
        if pivot is None:
            return Fraction(0)
        if pivot != i:
            rows[i], rows[pivot], result = rows[pivot], rows[i], -result
        result *= rows[i][i]
        for j in range(i + 1, len(rows)):
            factor = rows[j][i] / rows[i][i]
            rows[j] = [x - factor * y for x, y in zip(rows[j], rows[i])]
    return result


def exact(point):
    return [Fraction(float(x)) for x in point]


def orientation(simplex):
    """det of the edges from the first of d+1 points: positive if they are positively oriented."""
    first, *rest = map(exact, simplex)
    return determinant([[x - y for x, y in zip(point, first)] for point in rest])


def weights(simplex, query):
    """The barycentric coordinates of a query with respect to d+1 points in d dimensions, times the simplex's orientation squared."""
    whole = orientation(simplex)
    return [orientation([*simplex[:i], query, *simplex[i + 1:]]) * whole for i in range(len(simplex))]


def in_sphere(simplex, query, heights=None):
    """Negative if the query is inside the sphere of d+1 points, 0 if it is on it. `heights`: the weights of the simplex's points and
    of the query, which are subtracted from |x|²."""
    heights = heights if heights is not None else [0] * (len(simplex) + 1)
    lifted = [[*exact(point), sum(x * x for x in exact(point)) - Fraction(float(weight))]
              for point, weight in zip([*simplex, query], heights)]
    last = lifted.pop()
    d = len(last) - 1
    sign = determinant([[x - y for x, y in zip(point, last)] for point in lifted])
    return -sign * orientation(simplex) * (-1) ** d


def squared_distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(exact(a), exact(b)))
