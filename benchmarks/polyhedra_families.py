# SPDX-License-Identifier: BSD-3-Clause
"""Polyhedra of many kinds as files of cddlib and lrs, in four sets. The methods were chosen by NAMED. HELD_OUT has other families, dimensions
and seeds, by which later changes were tuned as well. UNSEEN has others again: conversions were complete when they were first measured by these, and the choice
of methods was tuned by them afterwards. LATER has few dimensions, where there is a choice; nothing was tuned by it.

A member is a function without arguments that returns an H (inequalities) or V (generators) with rows of integers, homogeneous coordinate first:
b + a·x ≥ 0 and (1, v), (0, r), as these programs have them."""
import itertools
import math
import pathlib
from typing import NamedTuple

import numpy as np


class H(NamedTuple):
    rows: list
    equations: tuple = ()  # numbers of rows


class V(NamedTuple):
    rows: list
    equations: tuple = ()  # numbers of the rows that are lines


def write(description, path):
    """Writes an .ine or .ext file."""
    kind = "H" if isinstance(description, H) else "V"
    lines = [pathlib.Path(path).stem, f"{kind}-representation"]
    if description.equations:
        lines.append(f"linearity {len(description.equations)} " + " ".join(str(i + 1) for i in description.equations))
    lines += ["begin", f"{len(description.rows)} {len(description.rows[0])} integer"]
    lines += [" ".join(str(int(x)) for x in row) for row in description.rows] + ["end", ""]
    pathlib.Path(path).write_text("\n".join(lines), encoding="ascii")


def points(rows):
    return V([[1, *row] for row in rows])


def sphere(n, d, seed, size=1000):
    x = np.random.default_rng(seed).standard_normal((n, d))
    return points(np.rint(size * x / np.linalg.norm(x, axis=1, keepdims=True)).astype(int))


def gauss(n, d, seed, size=1000):
    return points(np.rint(size * np.random.default_rng(seed).standard_normal((n, d))).astype(int))


def tangents(n, d, seed, size=1000):
    """Halfspaces that touch a sphere, nearly."""
    return H([[size, *row[1:]] for row in sphere(n, d, seed, size).rows])


def lattice_points(n, d, largest, seed):
    random = np.random.default_rng(seed)
    found = set()
    while len(found) < n:
        found.add(tuple(random.integers(0, largest + 1, d).tolist()))
    return points(sorted(found))


def cube(d):
    return H([[1, *(s * int(i == j) for j in range(d))] for i in range(d) for s in (1, -1)])


def cross(d):
    return H([[1, *signs] for signs in itertools.product((1, -1), repeat=d)])


def klee_minty(d):
    rows = []
    for i in range(d):
        rows.append([0, *(int(j == i) for j in range(d))])
        rows.append([5 ** (i + 1), *(-2 ** (i - j + 1) if j < i else -int(j == i) for j in range(d))])
    return H(rows)


def permutahedron(n):
    return points(itertools.permutations(range(n)))


def cuts(nodes, edges):
    found = set()
    for side in itertools.product((0, 1), repeat=nodes - 1):
        side = (0, *side)
        found.add(tuple(int(side[i] != side[j]) for i, j in edges))
    return points(sorted(found))


def complete_graph(n):
    return list(itertools.combinations(range(n), 2))


def random_graph(n, m, seed):
    edges = complete_graph(n)
    chosen = np.random.default_rng(seed).choice(len(edges), m, replace=False)
    return [edges[i] for i in sorted(chosen)]


def simplices(sizes):
    """The product of simplices of these dimensions."""
    corners = [[tuple(int(i == j) for j in range(d)) for i in range(d + 1)] for d in sizes]
    return points(sum(chosen, ()) for chosen in itertools.product(*corners))


def cyclic(n, d, first=1):
    return points([t ** i for i in range(1, d + 1)] for t in range(first, first + n))


def dual_cyclic(n, d):
    """Around the origin, which is inside the cyclic polytope of n points on both sides of 0 in even dimensions, moved by their mean."""
    rows = [[(2 * t - n - 1) ** i for i in range(1, d + 1)] for t in range(1, n + 1)]
    mean = [sum(column) for column in zip(*rows)]
    return H([[1, *(n * x - m for x, m in zip(row, mean))] for row in rows])


def birkhoff_inequalities(n):
    rows, equations = [], []
    for i in range(n):
        for of_row in (True, False):
            equations.append(len(rows))
            rows.append([-1, *(int((j if of_row else k) == i) for j in range(n) for k in range(n))])
    rows += [[0, *(int(i == j) for j in range(n * n))] for i in range(n * n)]
    return H(rows, tuple(equations))


def birkhoff_vertices(n):
    return points([int(p[i] == j) for i in range(n) for j in range(n)] for p in itertools.permutations(range(n)))


def transportation(sources, sinks):
    m, n = len(sources), len(sinks)
    rows = [[-s, *(int(j == i) for j in range(m) for k in range(n))] for i, s in enumerate(sources)]
    rows += [[-t, *(int(k == i) for j in range(m) for k in range(n))] for i, t in enumerate(sinks)]
    return H(rows + [[0, *(int(i == j) for j in range(m * n))] for i in range(m * n)], tuple(range(m + n)))


def order_polytope(n, share, seed):
    random = np.random.default_rng(seed)
    rows = []
    for i, j in itertools.combinations(range(n), 2):
        if random.random() < share:
            rows.append([0, *((k == j) - (k == i) for k in range(n))])
    for i in range(n):
        rows += [[0, *(int(k == i) for k in range(n))], [1, *(-int(k == i) for k in range(n))]]
    return H(rows)


def truncated_cube(d, corners, seed):
    """[0, 3]^d without some of its corners."""
    random = np.random.default_rng(seed)
    rows = [[0, *(int(k == i) for k in range(d))] for i in range(d)] + [[3, *(-int(k == i) for k in range(d))] for i in range(d)]
    for corner in random.choice(2 ** d, corners, replace=False):
        signs = [1 - 2 * (int(corner) >> i & 1) for i in range(d)]
        rows.append([3 * sum(s < 0 for s in signs) - 2, *signs])
    return H(rows)


def few_facets(n, k, seed, size=9):
    """{x ≥ 0, A x = b} with k random equations: of dimension n−k, its Gale diagram a random one."""
    random = np.random.default_rng(seed)
    a = random.integers(1, size + 1, (k, n))
    b = a.sum(axis=1)
    return H([[-int(b[i]), *a[i].tolist()] for i in range(k)] + [[0, *(int(i == j) for j in range(n))] for i in range(n)], tuple(range(k)))


def packing(d, m, seed):
    """Σ of some x[i] ≤ 1 or 2, x ≥ 0: 0/1 facets."""
    random = np.random.default_rng(seed)
    rows = [[0, *(int(i == j) for j in range(d))] for i in range(d)]
    for _ in range(m):
        row = random.integers(0, 2, d)
        rows.append([int(random.integers(1, 3)), *(-row).tolist()])
    return H(rows + [[2, *(-int(i == j) for j in range(d))] for i in range(d)])


def arrangement_cone(d, m, size, seed):
    """The region of an arrangement of planes through 0 that a random vector is in."""
    random = np.random.default_rng(seed)
    inside = random.integers(-50, 51, d)
    rows = random.integers(-size, size + 1, (3 * m, d))
    rows = rows[rows @ inside != 0][:m]
    return H([[0, *(row if row @ inside > 0 else -row).tolist()] for row in rows])


def zonotope(d, k, seed, size=3):
    """Of all sums of k vectors."""
    vectors = np.random.default_rng(seed).integers(-size, size + 1, (k, d))
    return points(sorted({tuple((np.array(s) @ vectors).tolist()) for s in itertools.product((0, 1), repeat=k)}))


def hypersimplex(n, k):
    return points([int(i in chosen) for i in range(n)] for chosen in itertools.combinations(range(n), k))


def half_cube(d):
    return points(x for x in itertools.product((0, 1), repeat=d) if sum(x) % 2 == 0)


def roots_d(d):
    return points([s * (k == i) + t * (k == j) for k in range(d)] for i, j in itertools.combinations(range(d), 2) for s in (1, -1) for t in (1, -1))


def metric(n):
    edges = {edge: i for i, edge in enumerate(complete_graph(n))}
    rows = []
    for i, j, k in itertools.combinations(range(n), 3):
        at = [edges[i, j], edges[i, k], edges[j, k]]
        for one in range(3):
            rows.append([0, *((1 if e in at else 0) - 2 * (e == at[one]) for e in range(len(edges)))])
        rows.append([2, *(-int(e in at) for e in range(len(edges)))])
    return H(rows)


def cross_times_cube(c, d):
    return H([[1, *signs, *[0] * d] for signs in itertools.product((1, -1), repeat=c)] + [[row[0], *[0] * c, *row[1:]] for row in cube(d).rows])


def network(substances, reactions, seed):
    """Steady states of a random network: S v = 0, v ≥ 0."""
    random = np.random.default_rng(seed)
    columns = []
    for _ in range(reactions):
        column = [0] * substances
        inner = random.choice(substances, int(random.integers(1, 4)), replace=False)
        for at, s in enumerate(inner):
            column[s] = int(random.integers(1, 3)) * (1 if at % 2 else -1) * (1 if random.random() < .5 or len(inner) > 1 else -1)
        columns.append(column)
    rows = [[0, *(columns[r][s] for r in range(reactions))] for s in range(substances)]
    return H(rows + [[0, *(int(i == j) for j in range(reactions))] for i in range(reactions)], tuple(range(substances)))


def epigraph(d, m, seed):
    """Above m tangents of a paraboloid of R^d."""
    p = np.random.default_rng(seed).integers(-100, 101, (m, d - 1))
    return H([[int(row @ row), *(-2 * row).tolist(), 1] for row in p])


def large_numbers(n, d, digits, seed):
    random = np.random.default_rng(seed)
    rows = []
    for _ in range(n):
        x = random.standard_normal(d)
        x /= np.linalg.norm(x)
        rows.append([10 ** digits, *(int(round(t * 10 ** 15)) * 10 ** (digits - 15) + int(random.integers(0, 10 ** 9)) for t in x)])
    return H(rows)


def spanning_trees(nodes):
    """Vertices are the spanning trees of the complete graph, as sets of edges."""
    edges = complete_graph(nodes)

    def is_tree(chosen):
        root = list(range(nodes))
        for i, j in chosen:
            if root[i] == root[j]:
                return False
            root = [root[i] if r == root[j] else r for r in root]
        return True
    return points([int(e in chosen) for e in edges] for chosen in itertools.combinations(edges, nodes - 1) if is_tree(chosen))


def matchings(nodes, share, seed):
    """Fractional matchings of a random graph: x ≥ 0, and the edges at each node sum to at most 1."""
    edges = random_graph(nodes, share, seed)
    return H([[0, *(int(i == j) for j in range(len(edges)))] for i in range(len(edges))]
             + [[1, *(-int(node in edge) for edge in edges)] for node in range(nodes)])


def independent_sets(nodes, m, seed):
    """Of a random graph with m edges."""
    edges = random_graph(nodes, m, seed)
    return points(x for x in itertools.product((0, 1), repeat=nodes) if not any(x[i] and x[j] for i, j in edges))


def associahedron(n):
    """Sums over intervals of x[0..n−1] are at least those of 1, 3, 6, …; the sum of all is given."""
    rows = [[-(n * (n + 1) // 2), *[1] * n]]
    for i, j in itertools.combinations(range(n + 1), 2):
        if j - i < n:
            rows.append([-((j - i) * (j - i + 1) // 2), *(int(i <= k < j) for k in range(n))])
    return H(rows, (0,))


def knapsack(d, largest, seed):
    """0/1 points below a random plane."""
    weights = np.random.default_rng(seed).integers(1, largest + 1, d)
    return points(x for x in itertools.product((0, 1), repeat=d) if 2 * (np.array(x) @ weights) <= weights.sum())


def pyramid(description, times):
    """Apex over apex."""
    rows = [list(row) for row in description.rows]
    for _ in range(times):
        width = len(rows[0])
        rows = [[*row, 0] for row in rows] + [[1, *[0] * (width - 1), 1]]
    return V(rows)


def bounded_sums(n, d, seed):
    """Σ |x[i]| w[i] ≤ 1 for n random sign vectors and weights: boxes cut askew."""
    random = np.random.default_rng(seed)
    rows = [[20, *(random.integers(1, 10, d) * random.choice((-1, 1), d)).tolist()] for _ in range(n)]
    return H(rows + [[3, *(s * int(i == j) for j in range(d))] for i in range(d) for s in (1, -1)])


def torus(n, d, seed):
    """Points of a product of circles, in even dimensions."""
    angles = np.random.default_rng(seed).uniform(0, 2 * np.pi, (n, d // 2))
    return points(np.rint(1000 * np.concatenate([np.cos(angles), np.sin(angles)], axis=1)).astype(int))


def rays_in_orthant(n, d, largest, seed):
    """A cone of random rays of non-negative integers, many of them zero."""
    random = np.random.default_rng(seed)
    rows = random.integers(0, largest + 1, (n, d)) * random.integers(0, 2, (n, d))
    return V([[1, *[0] * d]] + [[0, *row.tolist()] for row in rows if row.any()])


NAMED = {
    "ccp6": lambda: cuts(6, complete_graph(6)), "cross8": lambda: cross(8), "cross10": lambda: cross(10), "cross12": lambda: cross(12),
    "cube12": lambda: cube(12), "km16": lambda: klee_minty(16), "perm6": lambda: permutahedron(6), "perm7": lambda: permutahedron(7),
    "01-100-8": lambda: lattice_points(100, 8, 1, 1), "01-60-10": lambda: lattice_points(60, 10, 1, 1), "01-40-14": lambda: lattice_points(40, 14, 1, 1),
    "simplices5-5": lambda: simplices((5, 5)), "cyclic20-10": lambda: cyclic(20, 10), "cyclic30-8": lambda: cyclic(30, 8),
    "sphere200-6": lambda: sphere(200, 6, 1), "sphere500-5": lambda: sphere(500, 5, 1), "sphere60-9": lambda: sphere(60, 9, 1)}

HELD_OUT = {
    "birkhoff5": lambda: birkhoff_inequalities(5), "birkhoff5-v": lambda: birkhoff_vertices(5), "birkhoff6": lambda: birkhoff_inequalities(6),
    "order12": lambda: order_polytope(12, .12, 5), "order16": lambda: order_polytope(16, .3, 6),
    "cuts8-13": lambda: cuts(8, random_graph(8, 13, 7)), "cuts9-12": lambda: cuts(9, random_graph(9, 12, 8)),
    "simplices3-3-3": lambda: simplices((3, 3, 3)), "simplices2-2-2-2": lambda: simplices((2, 2, 2, 2)),
    "truncated9": lambda: truncated_cube(9, 60, 9), "truncated12": lambda: truncated_cube(12, 20, 10),
    "few20-6": lambda: few_facets(20, 6, 11), "few24-16": lambda: few_facets(24, 16, 12), "few18-3": lambda: few_facets(18, 3, 13),
    "transport4-5": lambda: transportation((11, 7, 9, 13), (8, 8, 8, 8, 8)), "transport3-7": lambda: transportation((15, 17, 10), (6, 6, 6, 6, 6, 6, 6)),
    "packing10": lambda: packing(10, 20, 14), "packing14": lambda: packing(14, 30, 15),
    "arrangement6": lambda: arrangement_cone(6, 400, 3, 16), "arrangement8": lambda: arrangement_cone(8, 60, 9, 17),
    "zonotope4": lambda: zonotope(4, 12, 18), "zonotope6": lambda: zonotope(6, 10, 19),
    "hypersimplex9-4": lambda: hypersimplex(9, 4), "halfcube9": lambda: half_cube(9), "roots9": lambda: roots_d(9),
    "metric5": lambda: metric(5), "metric6": lambda: metric(6), "cross6-cube6": lambda: cross_times_cube(6, 6),
    "network14-28": lambda: network(14, 28, 20), "network18-40": lambda: network(18, 40, 21),
    "epigraph4": lambda: epigraph(4, 1000, 22), "epigraph6": lambda: epigraph(6, 120, 23),
    "gauss2000-4": lambda: gauss(2000, 4, 24), "gauss100-7": lambda: gauss(100, 7, 25), "sphere2000-3": lambda: sphere(2000, 3, 26),
    "sphere800-4": lambda: sphere(800, 4, 27, 10 ** 6), "sphere36-10": lambda: sphere(36, 10, 28), "sphere22-13": lambda: sphere(22, 13, 29),
    "tangents150-5": lambda: tangents(150, 5, 30), "tangents40-8": lambda: tangents(40, 8, 31), "tangents3000-3": lambda: tangents(3000, 3, 32),
    "cyclic18-12": lambda: cyclic(18, 12, -9), "cyclic60-5": lambda: cyclic(60, 5, -30), "dualcyclic18-8": lambda: dual_cyclic(18, 8),
    "lattice60-7": lambda: lattice_points(60, 7, 3, 33), "lattice200-5": lambda: lattice_points(200, 5, 4, 34), "01-48-11": lambda: lattice_points(48, 11, 1, 35),
    "01-200-9": lambda: lattice_points(200, 9, 1, 36), "01-30-16": lambda: lattice_points(30, 16, 1, 37), "large30-5": lambda: large_numbers(30, 5, 30, 38)}

UNSEEN = {
    "trees5": lambda: spanning_trees(5), "matchings9": lambda: matchings(9, 15, 101), "matchings11": lambda: matchings(11, 18, 102),
    "independent12": lambda: independent_sets(12, 30, 103), "independent10": lambda: independent_sets(10, 16, 104),
    "associahedron7": lambda: associahedron(7), "associahedron8": lambda: associahedron(8),
    "knapsack7": lambda: knapsack(7, 9, 105), "knapsack8": lambda: knapsack(8, 30, 106),
    "pyramid3-6": lambda: pyramid(sphere(70, 6, 107), 3), "pyramid2-4": lambda: pyramid(gauss(400, 4, 108), 2),
    "sums5": lambda: bounded_sums(120, 5, 109), "sums7": lambda: bounded_sums(40, 7, 110), "sums3": lambda: bounded_sums(1500, 3, 111),
    "torus4": lambda: torus(300, 4, 112), "torus6": lambda: torus(90, 6, 113), "torus8": lambda: torus(40, 8, 114),
    "rays5": lambda: rays_in_orthant(300, 5, 20, 115), "rays7": lambda: rays_in_orthant(70, 7, 9, 116), "rays9": lambda: rays_in_orthant(40, 9, 3, 117)}

LATER = {
    "sphere150-5": lambda: sphere(150, 5, 201), "sphere90-6": lambda: sphere(90, 6, 202), "gauss1500-3": lambda: gauss(1500, 3, 203),
    "gauss600-6": lambda: gauss(600, 6, 204), "tangents400-4": lambda: tangents(400, 4, 205), "tangents100-6": lambda: tangents(100, 6, 206),
    "torus200-4": lambda: torus(200, 4, 207), "zonotope5": lambda: zonotope(5, 9, 208), "zonotope3": lambda: zonotope(3, 14, 209),
    "lattice300-4": lambda: lattice_points(300, 4, 6, 210), "lattice500-3": lambda: lattice_points(500, 3, 9, 211),
    "epigraph5": lambda: epigraph(5, 200, 212), "sums4": lambda: bounded_sums(200, 4, 213), "cyclic80-4": lambda: cyclic(80, 4, -40),
    "cyclic26-6": lambda: cyclic(26, 6, -13), "rays6": lambda: rays_in_orthant(120, 6, 30, 214)}

SETS = {"named": NAMED, "held-out": HELD_OUT, "unseen": UNSEEN, "later": LATER}
