# SPDX-License-Identifier: BSD-3-Clause
"""The shape of an alpha complex: polygons, closed surfaces and the optimal alpha value, against the cells by brute force."""
import itertools

import numpy as np
import pytest

import delone


def lattice(d, side, share, seed):
    """Some of the points of a lattice: shapes that touch in points and edges, and holes."""
    points = np.array(list(itertools.product(range(side), repeat=d)), float)
    random = np.random.default_rng(seed)
    return random.permutation(points[random.random(len(points)) < share])


def pieces(cells, corners):
    """The number of the piece of each cell: cells are joined that share `corners` corners."""
    number = list(range(len(cells)))
    cells_of = {}
    for i, cell in enumerate(cells.tolist()):
        for face in itertools.combinations(sorted(cell), corners):
            cells_of.setdefault(face, []).append(i)

    def root(i):
        while number[i] != i:
            i = number[i]
        return i
    for first, *others in cells_of.values():
        for other in others:
            a, b = sorted((root(first), root(other)))
            number[b] = a
    return np.array([root(i) for i in range(len(cells))], int)


def twice_area(ring):
    return np.sum(ring[:, 0] * np.roll(ring[:, 1], -1) - ring[:, 1] * np.roll(ring[:, 0], -1))


def is_inside(ring, point):
    """By crossings of a ray to the right; for points that are on no edge."""
    inside = False
    for (x0, y0), (x1, y1) in zip(ring, np.roll(ring, -1, axis=0)):
        if (y0 > point[1]) != (y1 > point[1]):
            inside ^= bool(((x1 - x0) * (point[1] - y0) - (y1 - y0) * (point[0] - x0) > 0) == (y1 > y0))
    return inside


def expect_polygons(points, complex):
    polygons = complex.polygons()
    edges = [(a, b) for rings in polygons for ring in rings for a, b in zip(ring.tolist(), np.roll(ring, -1).tolist())]
    assert len(set(edges)) == len(edges) and set(edges) == {tuple(edge) for edge in complex.boundary.tolist()}
    piece = pieces(complex.cells, 2)
    areas = np.array([twice_area(points[cell]) for cell in complex.cells])
    of_pieces = sorted(areas[piece == i].sum() for i in set(piece.tolist()))
    np.testing.assert_allclose(sorted(sum(twice_area(points[ring]) for ring in rings) for rings in polygons), of_pieces, rtol=1e-12)
    for rings in polygons:
        outer, *holes = rings
        assert twice_area(points[outer]) > 0 and all(twice_area(points[hole]) < 0 for hole in holes)
        for ring in rings:
            assert len(ring) > 2 and len(set(ring.tolist())) == len(ring) and ring[0] == ring.min() and not ring.flags.writeable
        assert holes == sorted(holes, key=lambda ring: ring.tolist())
    assert [rings[0].tolist() for rings in polygons] == sorted(rings[0].tolist() for rings in polygons)
    for cell in complex.cells:  # each is in one polygon, and in none of its holes
        center = points[cell].mean(axis=0)
        assert sum(is_inside(points[outer], center) and not any(is_inside(points[hole], center) for hole in holes) for outer, *holes in polygons) == 1
    return polygons


@pytest.mark.parametrize("seed", range(12))
def test_polygons_of_lattices(seed):
    points = lattice(2, 9, [0.5, 0.7, 0.9][seed % 3], seed)
    t = delone.Delaunay(points)
    for squared in (0.5, 0.625, 1, 1.25, 2.5, np.inf):
        expect_polygons(points, t.alpha_complex(squared_radius=squared))


@pytest.mark.parametrize("seed", range(4))
def test_polygons_of_random_and_weighted_points(seed):
    random = np.random.default_rng(seed)
    points = random.random((300, 2))
    for t in (delone.Delaunay(points), delone.Regular(points, random.random(300) * 0.002)):
        for squared in np.quantile(t.alpha_values(2), [0.1, 0.5, 0.8, 1]):
            expect_polygons(points, t.alpha_complex(squared_radius=squared))


def test_a_polygon_that_touches_itself():
    # Two wedges with their tips at the origin, joined by an arc above them.
    angle = np.linspace(np.arctan2(0.4, 1), np.pi - np.arctan2(0.4, 1), 9)
    arc = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    wedge = np.array([[0.5, 0.2], [0.5, -0.2], [1, -0.4]])
    points = np.concatenate([[[0, 0]], wedge, wedge * [-1, 1], np.hypot(1, 0.4) * arc, 1.6 * arc])
    (outer, hole), = expect_polygons(points, delone.Delaunay(points).alpha_complex(0.45))
    assert set(outer.tolist()) & set(hole.tolist()) == {0}


def test_polygons_do_not_depend_on_the_order_of_points_or_threads():
    points = lattice(2, 12, 0.7, 5)
    expected = delone.Delaunay(points).alpha_complex(0.75).polygons()
    for threads in (1, 3):
        again = delone.Delaunay(points, order="as_given", seed=7, threads=threads).alpha_complex(0.75).polygons()
        assert [[ring.tolist() for ring in rings] for rings in again] == [[ring.tolist() for ring in rings] for rings in expected]


def test_few_flat_and_duplicate_points():
    for points in (np.empty((0, 2)), [[1, 2]], [[0, 0], [1, 1], [2, 2], [1, 1]]):
        complex = delone.Delaunay(points).alpha_complex(np.inf)
        assert complex.polygons() == []
        components, bodies, neighbors = complex.boundary_components()
        assert len(components) == len(neighbors) == len(complex.boundary) and len(bodies) == (len(points) > 2)
    assert components.tolist() == [0, 0] and sorted(neighbors.ravel().tolist()) == [0, 1]  # a segment has two ends
    doubled = np.repeat(lattice(2, 5, 0.8, 1), 2, axis=0)
    rows = np.concatenate(sum(expect_polygons(doubled, delone.Delaunay(doubled).alpha_complex(1)), []))
    assert len(rows) and (rows % 2 == 0).all()
    with pytest.raises(delone.Error, match="plane"):
        delone.Delaunay(np.eye(4)[:, :3]).alpha_complex(1).polygons()
    t = delone.Delaunay(lattice(2, 4, 1, 0))
    complex = t.alpha_complex(1)
    t.insert_range([[0.5, 0.5]])
    for ask in (complex.polygons, complex.boundary_components):
        with pytest.raises(RuntimeError, match="added"):
            ask()


def expect_closed(points, complex, k):
    components, bodies, neighbors = complex.boundary_components()
    boundary = complex.boundary
    assert neighbors.shape == boundary.shape and components.shape == (len(boundary),)
    for f, (facet, across) in enumerate(zip(boundary.tolist(), neighbors.tolist())):
        for i, g in enumerate(across):
            face = set(facet) - {facet[i]}
            mine = [j for j in range(k) if set(boundary[g].tolist()) - {int(boundary[g, j])} == face and neighbors[g, j] == f]
            assert len(mine) == 1 and g != f and components[g] == components[f]
    # By brute force: facets that share a face are joined by a chain of cells around it.
    piece = pieces(complex.cells, k)
    place = {int(number): i for i, number in enumerate(complex.cell_numbers)}
    body = [piece[place[int(c)]] for c in complex.boundary_cells]
    assert all(len({body[f] for f in np.flatnonzero(components == c)}) == 1 for c in range(len(bodies)))
    assert len(set(bodies.tolist())) == len(set(piece.tolist())) == len({body[f] for f in range(len(boundary))})
    for c in range(len(bodies)):
        part = set(np.flatnonzero(components == c).tolist())
        reached, todo = set(), [min(part)]
        while todo:
            f = todo.pop()
            if f not in reached:
                reached.add(f)
                todo.extend(neighbors[f].tolist())
        assert reached == part
    return components, bodies, neighbors


def volumes(points, complex, components):
    parts = np.linalg.det(points[complex.boundary]) / 6
    return np.bincount(components, weights=parts)


@pytest.mark.parametrize("d, seed", [(2, 0), (2, 1), (3, 0), (3, 1), (3, 2), (4, 0)])
def test_boundaries_are_closed(d, seed):
    for points in (lattice(d, {2: 8, 3: 5, 4: 3}[d], 0.7, seed), np.random.default_rng(seed).random((60 * d, d))):
        t = delone.Delaunay(points)
        for squared in np.quantile(t.alpha_values(d), [0.2, 0.6, 1]):
            expect_closed(points, t.alpha_complex(squared_radius=squared), d)


TIP = np.array([[0, 0, 0], [1, 0.2, 0.2], [1, -0.2, 0.2], [1, 0, -0.2]])
WEDGE = np.array([[0, 0, 0], [0, 0, 1], [1, 0.2, 0.5], [1, -0.2, 0.5]])
SHELL = np.array([p for p in itertools.product(range(5), repeat=3) if p != (2, 2, 2)], float)


@pytest.mark.parametrize("points, squared, signs, num_bodies", [
    (TIP, 0.5, [1], 1),
    (np.concatenate([TIP, TIP[1:] * [-1, 1, 1]]), 0.5, [1, 1], 2),  # two that touch in a point
    (np.concatenate([WEDGE, WEDGE[2:] * [-1, 1, 1]]), 0.5, [1, 1], 2),  # in an edge
    (SHELL, 0.75, [-1, 1], 1),  # a cavity
    (np.concatenate([SHELL, SHELL + [10, 0, 0]]), 0.75, [-1, -1, 1, 1], 2),
])
def test_bodies_that_touch_and_have_cavities(points, squared, signs, num_bodies):
    complex = delone.Delaunay(points).alpha_complex(squared_radius=squared)
    components, bodies, _ = expect_closed(points, complex, 3)
    volumes = np.bincount(components, weights=np.linalg.det(points[complex.boundary] - points[complex.boundary[0, 0]]) / 6)
    assert sorted(np.sign(volumes)) == signs and len(set(bodies.tolist())) == num_bodies
    corners = points[complex.cells]
    assert np.isclose(volumes.sum(), np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6)
    # Triangles that are neighbors pass their edge in opposite directions.
    edges = sorted((c, a, b) for c, facet in zip(components.tolist(), complex.boundary.tolist()) for a, b in zip(facet, facet[1:] + facet[:1]))
    assert edges == sorted((c, b, a) for c, a, b in edges)


def optimal_by_definition(t, most):
    faces, values = t.alpha_filtration()[-1]
    vertices = set(t.cells.ravel().tolist())
    for value in np.unique(values):
        cells = t.cells[values <= value]
        if set(cells.ravel().tolist()) == vertices and (most is None or len(set(pieces(cells, cells.shape[1] - 1).tolist())) <= most):
            return value
    raise AssertionError


@pytest.mark.parametrize("seed", range(6))
def test_optimal_alpha_value_by_definition(seed):
    random = np.random.default_rng(seed)
    clusters = np.concatenate([random.normal(center, 0.3, (25, 2)) for center in ([0, 0], [4, 0], [0, 5])])
    for t in (delone.Delaunay(clusters), delone.Delaunay(lattice(2, 7, 0.6, seed)), delone.Delaunay(lattice(3, 4, 0.5, seed)),
              delone.Delaunay(random.random((40, 1))), delone.Regular(clusters, random.random(75) * 0.2)):
        for most in (None, 1, 2, 3, 10):
            assert t.optimal_alpha_value(most) == optimal_by_definition(t, most)
        assert t.optimal_alpha_value() == t.optimal_alpha_value(num_components=1)
        assert len(t.alpha_complex(squared_radius=t.optimal_alpha_value()).boundary_components()[1]) >= 1


def test_optimal_alpha_value_of_few_points():
    assert delone.Delaunay(np.empty((0, 2))).optimal_alpha_value() == -np.inf
    assert delone.Delaunay([[1, 2], [1, 2]]).optimal_alpha_value() == 0
    assert delone.Regular([[1, 2]], [4]).optimal_alpha_value(None) == -4
    assert delone.Delaunay([[0, 0, 0], [0, 0, 2], [0, 0, 8]]).optimal_alpha_value() == 9
    grid = delone.Delaunay(lattice(3, 4, 1, 0))
    assert grid.optimal_alpha_value() == 0.75 and len(grid.alpha_complex(squared_radius=0.75)) == len(grid)
    for wrong in (0, -1):
        with pytest.raises(ValueError, match="num_components"):
            grid.optimal_alpha_value(wrong)
    with pytest.raises(delone.Error):
        delone.FurthestSite(np.eye(3)).optimal_alpha_value()


def test_polygons_are_valid_for_shapely():
    shapely = pytest.importorskip("shapely.geometry")
    for seed in range(6):
        points = lattice(2, 12, 0.75, seed)
        complex = delone.Delaunay(points).alpha_complex(0.8)
        shape = shapely.MultiPolygon([(points[outer], [points[hole] for hole in holes]) for outer, *holes in complex.polygons()])
        assert shape.is_valid and shape.area == pytest.approx(sum(twice_area(points[cell]) for cell in complex.cells) / 2)
