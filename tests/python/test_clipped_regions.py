# SPDX-License-Identifier: BSD-3-Clause
"""Regions as polygons and polyhedra: against intersections of halfspaces, region by region, and against volumes."""
import itertools

import numpy as np
import pytest

import delone


def lattice(d, side, share, seed):
    points = np.array(list(itertools.product(range(side), repeat=d)), float)
    random = np.random.default_rng(seed)
    return random.permutation(points[random.random(len(points)) < share])


def box_rows(low, high):
    d = len(low)
    return np.concatenate([np.c_[-np.eye(d), low], np.c_[np.eye(d), -np.asarray(high, float)]])


def bisectors(points, weights, i, furthest):
    others = np.delete(np.arange(len(points)), i)
    a = 2 * (points[others] - points[i])
    b = (points[i] ** 2).sum() - (points[others] ** 2).sum(axis=1) - weights[i] + weights[others]
    rows = np.c_[a, b]
    return -rows if furthest else rows


def measure(region):
    """The volume of an entry, from one of its corners."""
    if isinstance(region, np.ndarray):
        x, y = (region - region[:1]).T if len(region) else np.empty((2, 0))
        return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    corners, faces = region
    return sum(np.linalg.det(corners[[face[0], face[i], face[i + 1]]] - corners[0]) for face in faces for i in range(1, len(face) - 1)) / 6


def expect_consistent(v, regions, box=None, rtol=1e-9):
    d, faces = v.dimension, np.split(regions.face_vertices, regions.face_offsets[1:-1]) if len(regions.face_offsets) > 1 else []
    assert len(regions) == v.num_regions and len(regions.neighbors) == (len(regions.face_vertices) if d == 2 else len(faces))
    assert set(regions.face_vertices.tolist()) == set(range(len(regions.vertices)))
    sides = {}  # the region that has a face, or an edge in the plane
    for r, (first, last) in enumerate(zip(regions.region_offsets, regions.region_offsets[1:])):
        assert last - first in ((0, 1) if d == 2 else (0, *range(4, 200)))
        edges = set()
        for f in range(first, last):
            face = faces[f].tolist()
            assert len(face) > 2 and len(set(face)) == len(face)
            for place, edge in enumerate(zip(face, face[1:] + face[:1])):
                assert edge not in edges
                edges.add(edge)
                if d == 2:
                    assert edge not in sides
                    sides[edge] = r, regions.neighbors[regions.face_offsets[f] + place]
            if d == 3:
                start = face.index(min(face))
                key = tuple(face[start:] + face[:start])
                assert key not in sides
                sides[key] = r, regions.neighbors[f]
        assert d == 2 or edges == {(b, a) for a, b in edges}
    for key, (region, neighbor) in sides.items():
        other = key[::-1] if d == 2 else (key[0], *key[:0:-1])
        assert sides.get(other, (-1, region)) == (neighbor, region)
    volumes = np.array([measure(region) for region in regions])
    if box is not None:
        scale = np.prod(np.subtract(box[1], box[0]))
        np.testing.assert_allclose(volumes, v.region_volumes(box), rtol=rtol, atol=1e-12 * scale)
        assert v.num_regions == 0 or np.isclose(volumes.sum(), scale)
    return volumes


def expect_halfspaces(v, weights, regions, rows):
    """Each region is the intersection of its bisectors and `rows`, exactly so if all of these are integers."""
    points = v.points[v.region_points]
    weights = weights[v.region_points]
    for r, region in enumerate(regions):
        own = np.concatenate([bisectors(points, weights, r, isinstance(v, delone.FurthestVoronoi)), rows])
        expected = delone.HalfspaceIntersection(own)
        corners, faces = (region, [region] if len(region) else []) if v.dimension == 2 else region
        if expected.state != "full":
            assert len(corners) == 0 and len(faces) == 0
            continue
        assert sorted(corners.tolist()) == sorted(expected.vertices.tolist())
        assert (len(corners) if v.dimension == 2 else len(faces)) == expected.num_facets


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("seed", range(4))
def test_lattices_in_boxes_through_vertices_and_points(d, seed):
    points = lattice(d, 5 if d == 2 else 3, 0.7, seed)
    points = np.concatenate([points, points[:2]])
    weights = np.random.default_rng(seed).integers(0, 3, len(points)).astype(float)
    weights[-2:] = weights[:2]
    for v, of in ((delone.Voronoi(points), 0 * weights), (delone.PowerDiagram(points, weights), weights),
                  (delone.FurthestVoronoi(points), 0 * weights)):
        for low, high in ((-1, 6), (0, 2), (0.5, 1.5), (1, 1.25), (5, 7)):
            box = np.full(d, low, float), np.full(d, high, float)
            regions = v.clipped_regions(box)
            expect_consistent(v, regions, box)
            expect_halfspaces(v, of, regions, box_rows(*box))


@pytest.mark.parametrize("d", [2, 3])
@pytest.mark.parametrize("seed", range(3))
def test_lattices_in_polytopes(d, seed):
    points = lattice(d, 4 if d == 2 else 3, 0.8, seed)
    v = delone.Voronoi(points)
    shapes = [np.array([*np.c_[-np.eye(d), np.zeros(d)], [*np.ones(d), -3]]),  # a simplex
              np.array([[*signs, -3 - sum(signs)] for signs in itertools.product((-2, 2), repeat=d)], float),
              np.array([*box_rows(np.zeros(d), np.ones(d)), [*np.ones(d), -1], [*np.ones(d), -1.5]]),
              np.array([*box_rows(np.zeros(d), np.ones(d)), [*np.ones(d), 0]]),  # a point
              np.array([*box_rows(np.zeros(d), np.ones(d)), [*np.ones(d), 1]])]  # nothing
    for rows in shapes:
        regions = v.clipped_regions(halfspaces=rows)
        volumes = expect_consistent(v, regions)
        expect_halfspaces(v, np.zeros(len(points)), regions, rows)
        polytope = delone.HalfspaceIntersection(rows)
        assert np.isclose(volumes.sum(), polytope.volume if polytope.state == "full" else 0)
        for exponent in (-900, 900):  # a factor changes no halfspace
            again = v.clipped_regions(halfspaces=rows * 2.0**exponent)
            assert all((getattr(again, name) == getattr(regions, name)).all() for name in regions.__slots__)
    both = v.clipped_regions((np.zeros(d), np.ones(d)), halfspaces=[[1, *np.zeros(d - 1), -0.5]])
    assert np.isclose(expect_consistent(v, both).sum(), 0.5)


@pytest.mark.parametrize("d, n", [(2, 300), (3, 120)])
def test_random_points(d, n):
    random = np.random.default_rng(d)
    points = random.random((n, d))
    for v in (delone.Voronoi(points), delone.PowerDiagram(points, random.random(n) * 0.01), delone.FurthestVoronoi(points),
              delone.Voronoi(points, tolerance=0.05)):
        box = v.bounding_box()
        expect_consistent(v, v.clipped_regions(), box)
        box = np.full(d, 0.3), np.full(d, 0.6)
        regions = v.clipped_regions(box)
        expect_consistent(v, regions, box)
        hull = delone.ConvexHull(random.random((30, d)))
        inside = v.clipped_regions(halfspaces=hull.equations)
        assert np.isclose(expect_consistent(v, inside).sum(), hull.volume)
    v = delone.Voronoi(points)
    regions = v.clipped_regions()
    kept = {tuple(vertex) for vertex in regions.vertices.tolist()}
    box = v.bounding_box()
    assert {tuple(vertex) for vertex in v.vertices.tolist() if (box[0] < vertex).all() and (vertex < box[1]).all()} <= kept
    rows = {frozenset(pair) for pair in v.point_region[v.ridge_points].tolist()}
    owner = np.repeat(np.arange(n), np.diff(regions.region_offsets)) if d == 3 else np.repeat(np.arange(n), np.diff(regions.face_offsets))
    assert {frozenset(pair) for pair in zip(owner.tolist(), regions.neighbors.tolist()) if pair[1] >= 0} <= rows


def test_nearly_cospherical_points():
    # Distinct vertices nearer to each other than coordinates tell.
    angle = np.random.default_rng(1).random(12) * 7
    for d in (2, 3):
        points = np.c_[np.cos(angle), np.sin(angle), np.linspace(-1, 1, 12) ** 3][:, :d]
        points = np.concatenate([points, -points, 1e8 + np.eye(d)])
        v = delone.Voronoi(points)
        for box in (v.bounding_box(), (np.full(d, -2.0), np.full(d, 2.0))):
            expect_consistent(v, v.clipped_regions(box), box)
        small = np.full(d, -1e-12), np.full(d, 1e-12)  # corners are known to 1e-16, for the volumes relative to their sites
        expect_consistent(v, v.clipped_regions(small), small, rtol=0.05)


def test_flat_few_and_no_points():
    v = delone.Voronoi([[0, 0, 3], [2, 0, 3], [6, 0, 3], [2, 0, 3]])
    box = (np.zeros(3), np.array([6.0, 2, 5]))
    np.testing.assert_allclose(expect_consistent(v, v.clipped_regions(box), box), [10, 30, 20], rtol=1e-14)
    one = delone.Voronoi([[1, 2]]).clipped_regions()
    assert one[0].tolist() == [[0, 1], [2, 1], [2, 3], [0, 3]] and one.neighbors.tolist() == [-1] * 4
    none = delone.Voronoi(np.empty((0, 2))).clipped_regions()
    assert len(none) == 0 and none.vertices.shape == (0, 2) and list(none) == []
    hidden = delone.PowerDiagram([[0, 0], [1, 0], [0, 1], [1, 1], [0.5, 0.5]], [0, 0, 0, 0, -5]).clipped_regions(([0, 0], [1, 1]))
    assert len(hidden) == 4 and sorted(map(len, hidden)) == [4] * 4
    regions = delone.Voronoi([[0, 0], [2, 0]]).clipped_regions(([3, 0], [4, 1]))
    assert [len(polygon) for polygon in regions] == [0, 4] and regions[-1].tolist() == regions[1].tolist() and len(regions[:1]) == 1
    assert "2 regions, 4 vertices, 1 faces" in repr(regions) and not regions.vertices.flags.writeable
    with pytest.raises(IndexError):
        regions[2]


def test_regions_that_ties_leave_flat():
    # The power of the point in the middle is least nowhere, and equal to the least at the center only, or on the bisector.
    for points, weights in (([[-1, -1], [1, -1], [-1, 1], [1, 1], [0, 0]], [0, 0, 0, 0, -2]), ([[-1, 0], [1, 0], [0, 0]], [0, 0, -1])):
        v = delone.PowerDiagram(points, weights)
        box = (np.full(2, 0.0), np.full(2, 3.0))
        expect_consistent(v, v.clipped_regions(box), box)


@pytest.mark.parametrize("arguments, error, message", [
    ({"box": [0, 1]}, ValueError, "box"), ({"box": ([0, 0], [0, 1])}, delone.InputError, "box"),
    ({"halfspaces": [[1, 0]]}, ValueError, "halfspaces"), ({"halfspaces": [[1, 0, 0]]}, ValueError, "unbounded"),
    ({"box": ([0, 0], [1, 1]), "halfspaces": [[0, 0, 1]]}, delone.InputError, "halfspace 0"),
    ({"box": ([0, 0], [1, 1]), "halfspaces": [[1, 0, 1], [1, np.nan, 1]]}, delone.InputError, "halfspace 1"),
])
def test_wrong_arguments(arguments, error, message):
    with pytest.raises(error, match=message):
        delone.Voronoi([[0, 0], [1, 0], [0, 1]]).clipped_regions(**arguments)


def test_other_dimensions():
    for d in (1, 4):
        with pytest.raises(delone.Error, match="dimensions 2 and 3"):
            delone.Voronoi(np.random.default_rng(0).random((9, d))).clipped_regions()
