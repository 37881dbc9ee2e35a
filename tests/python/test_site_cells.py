# SPDX-License-Identifier: BSD-3-Clause
"""Cells of sites from Python: arrays, their shapes, and what is refused. tests/property/site_cells_test.cpp has the numbers."""
import numpy as np
import pytest

import delone

FCC = np.array([[0, 0, 0], [0, 2, 2], [2, 0, 2], [2, 2, 0]])


def test_arrays_agree_with_the_diagram():
    points = np.random.default_rng(1).random((300, 3))
    points[299] = points[4]
    t = delone.Delaunay(points)
    cells = t.site_cells(neighbors=True)
    volumes = delone.Voronoi(t).region_volumes(at="points")
    np.testing.assert_allclose(cells.volumes[:299], volumes[:299], rtol=1e-9)
    assert cells.volumes[299] == 0 and cells.num_faces[299] == 0 and np.isnan(cells.centroids[299]).all() and len(cells.neighbors_of(299)) == 0
    bounded = np.isfinite(cells.volumes)
    assert (np.isnan(cells.centroids).any(axis=1) == ~bounded | (cells.volumes == 0)).all()
    assert cells.num_faces.sum() == len(cells.neighbors) == cells.neighbor_offsets[-1]
    rows = np.repeat(np.arange(300), np.diff(cells.neighbor_offsets))
    np.testing.assert_allclose(cells.distances, np.linalg.norm(points[rows] - points[cells.neighbors], axis=1), rtol=1e-15)
    volumes = np.bincount(rows, cells.face_areas * cells.distances / 6, 300)
    np.testing.assert_allclose(volumes[bounded], cells.volumes[bounded], rtol=1e-12)
    assert (cells.num_edges >= 2).all() and cells.neighbors.dtype == np.int32
    with pytest.raises(ValueError):
        cells.volumes[0] = 1


def test_boxes_and_halfspaces():
    points = np.random.default_rng(2).random((200, 2))
    t = delone.Regular(points, np.random.default_rng(3).random(200) * 0.01)
    box = ([0, 0], [1, 1])
    cells = t.site_cells(box=box, neighbors=True, faces="proper")
    assert abs(cells.volumes.sum() - 1) < 1e-13
    np.testing.assert_allclose(np.nansum(cells.volumes[:, None] * cells.centroids, axis=0), [0.5, 0.5], rtol=1e-12)
    walls = cells.face_areas[cells.neighbors == -1].sum()
    assert abs(walls - 4) < 1e-12 and cells.num_edges is None
    half = t.site_cells(box=box, halfspaces=[[1, 1, -1]])
    assert abs(half.volumes.sum() - 0.5) < 1e-13 and half.neighbors is None
    assert repr(half) == "<delone.SiteCells: 200 rows>"


def test_ties_have_proper_faces():
    t = delone.Delaunay(np.stack(np.meshgrid(*3 * [np.arange(3.0)]), axis=-1).reshape(-1, 3))
    assert t.site_cells(faces="proper").num_faces[13] == 6
    assert t.site_cells().num_faces[13] > 6


@pytest.mark.parametrize("points, box, halfspaces, volumes", [
    ([[0.0], [2.0]], ([-2], [4]), [[1, -1]], [3, 0]),
    ([[1.0, 0.0]], ([-1, -1], [3, 3]), [[-1, 0.5, 0.5000000000000001], [0.8, 0, -1e-16]], [0]),
    ([[0, 1, 1], [0, 2, 0]], ([-1, -1, 0.5], [3, 3, 0.500000000001]), [[0.5, 0.5, 1e-16, -0.25000000000000006]], [3.125e-12, 0]),
    ([[0, 2], [1 + 2**-52, 2 + 2**-51], [2, 1 + 2**-52], [1, 2], [0, 1 + 2**-52]], ([-1, 0], [3, 1]), None, [0, 0, 2, 0, 2]),
])
def test_proper_faces_too_small_for_doubles(points, box, halfspaces, volumes):
    cells = delone.Delaunay(points).site_cells(box=box, halfspaces=halfspaces, faces="proper", neighbors=True)
    np.testing.assert_allclose(cells.volumes, volumes, rtol=1e-4, atol=1e-15)
    assert len(cells.face_areas) == cells.num_faces.sum()


def test_polygons():
    points = np.random.default_rng(5).random((200, 3))
    cells = delone.Delaunay(points).site_cells(vertices=True)
    assert cells.vertices.shape == (cells.vertex_offsets[-1], 3) and len(cells.face_vertices) == cells.face_vertex_offsets[-1] == cells.num_edges.sum()
    for row in range(200):
        vertices, faces = cells.polygons_of(row)
        assert len(faces) == cells.num_faces[row] and (min(map(min, faces)) == -1) == np.isinf(cells.volumes[row])
        if np.isfinite(cells.volumes[row]) and cells.volumes[row] < 1:
            triangles = vertices[[(f[0], a, b) for f in faces for a, b in zip(f[1:], f[2:])]] - points[row]
            assert abs(np.linalg.det(triangles).sum() / 6 - cells.volumes[row]) < 1e-9
    with pytest.raises(ValueError):
        cells.vertices[0] = 1
    with pytest.raises(IndexError):
        cells.polygons_of(200)
    with pytest.raises(ValueError, match="vertices=True"):
        delone.Delaunay(points).site_cells(neighbors=True).polygons_of(0)


def test_polygons_in_a_ball():
    points = np.random.default_rng(6).random((100, 3))
    ball = delone.ball_halfspaces([0.5] * 3, 0.5, count=60)
    cells = delone.Delaunay(points).site_cells(vertices=True, box=([-1] * 3, [2] * 3), halfspaces=ball)
    vertices = np.repeat(np.arange(100), np.diff(cells.vertex_offsets))
    assert (cells.vertices @ ball[:, :3].T + ball[:, 3] < 1e-14).all()
    for row in range(100):
        corners, faces = cells.polygons_of(row)
        assert len(corners) == (vertices == row).sum() and (len(faces) > 0) == (cells.volumes[row] > 0)
        if faces:
            triangles = corners[[(f[0], a, b) for f in faces for a, b in zip(f[1:], f[2:])]] - points[row]
            assert abs(np.linalg.det(triangles).sum() / 6 - cells.volumes[row]) < 1e-14
        for face, neighbor in zip(faces, cells.neighbors_of(row)):
            assert (neighbor < 0) == (np.abs(corners[face] @ ball[:, :3].T + ball[:, 3]).max(axis=0) < 1e-14).any()


def test_polygons_of_a_periodic_set_are_those_among_copies():
    vectors = np.array([[1, 0, 0], [0.25, 1, 0], [-0.375, 0.3125, 1]])
    points = np.random.default_rng(7).integers(0, 2**20, (30, 3)) / 2**20 @ vectors
    steps = np.stack(np.meshgrid(*3 * [[0, -2, -1, 1, 2]], indexing="ij"), axis=-1).reshape(-1, 3)
    found = delone.PeriodicDelaunay(points, vectors).site_cells(vertices=True)
    expected = delone.Delaunay((points + (steps @ vectors)[:, None]).reshape(-1, 3)).site_cells(vertices=True)
    for row in range(30):
        of_copy = expected.polygons_of(row)[0]
        np.testing.assert_allclose(found.polygons_of(row)[0], of_copy, rtol=0, atol=1e-11)
        assert sorted(map(len, found.polygons_of(row)[1])) == sorted(map(len, expected.polygons_of(row)[1]))


@pytest.mark.parametrize("basis, numbers, angles", [
    ([[0, 0, 0]], [6, 6], [4 * np.pi / 6]), ([[0, 0, 0], [2, 2, 2]], [14, 8], [0.445364, 1.236773]), (FCC, [12, 12], [4 * np.pi / 12]),
    (np.r_[FCC, FCC + 1], [16, 4], [0.124174, 2.769072])])
def test_coordination_of_crystals(basis, numbers, angles):
    t = delone.PeriodicDelaunay(np.array(basis) / 4, 1.0)
    for weight in "solid_angle", "area":
        for tolerance, expected in zip((0, 0.5), numbers):
            assert (delone.coordination(t, weight=weight, tolerance=tolerance)[0] == expected).all()
    np.testing.assert_allclose(np.unique(delone.coordination(t)[1].round(9)), angles, atol=1e-6)


def test_solid_angles_are_shares_of_all_directions():
    random = np.random.default_rng(8)
    t = delone.PeriodicDelaunay(random.random((100, 3)), 1.0)
    numbers, weights, cells = delone.coordination(t)
    np.testing.assert_allclose(np.add.reduceat(weights, cells.neighbor_offsets[:-1]), 4 * np.pi, rtol=1e-12)
    assert (numbers == cells.num_faces).all()
    # Seen from the middle of a cell, a face takes the directions along which its plane is met first.
    first = slice(*cells.neighbor_offsets[:2])
    to = t.points[cells.neighbors[first]] + cells.neighbor_lattice[first] - t.points[0]
    rays = random.standard_normal((200_000, 3))
    met = np.bincount(np.argmax(rays @ to.T / (to**2).sum(axis=1), axis=1), minlength=len(to)) / len(rays)
    np.testing.assert_allclose(weights[first] / (4 * np.pi), met, atol=0.005)
    np.testing.assert_array_equal(delone.coordination(t, weight="area")[1], cells.face_areas)
    # Sites of light weight may be outside of their cells, which then are seen from both sides.
    power = delone.PeriodicRegular(t.points, random.random(100) * 0.03, 1.0)
    _, weights, cells = delone.coordination(power)
    rows = np.repeat(np.arange(100), np.diff(cells.neighbor_offsets))
    turns = np.bincount(rows, weights, 100)[cells.num_faces > 0] / (4 * np.pi)
    np.testing.assert_allclose(turns, turns.round(), atol=1e-9)
    assert set(turns.round()) == {0, 1}


def test_coordination_of_open_sets():
    points = np.random.default_rng(9).random((300, 3))
    t = delone.Regular(np.r_[points, points[:1]], np.zeros(301))
    numbers, weights, cells = delone.coordination(t, tolerance=0.1)
    unbounded = np.isinf(cells.volumes)
    assert ((numbers == -1) == unbounded).all() and numbers[300] == 0 and unbounded.any() and not unbounded.all()
    assert (np.isnan(weights) == np.repeat(unbounded, cells.num_faces)).all()
    assert delone.coordination(delone.Delaunay(np.eye(4)[:, :3]))[0].tolist() == [-1] * 4
    for arguments in {"weight": "volume"}, {"tolerance": 1}, {"tolerance": -0.1}, {"tolerance": np.nan}:
        with pytest.raises(ValueError):
            delone.coordination(t, **arguments)
    with pytest.raises(ValueError, match="three dimensions"):
        delone.coordination(delone.Delaunay(points[:, :2]))


def test_threads_and_edits_do_not_matter():
    points = np.random.default_rng(4).random((5000, 3))
    one, two = delone.Delaunay(points, threads=1), delone.Delaunay(points[:4000], threads=2)
    two.insert_range(points[4000:])
    np.testing.assert_allclose(one.site_cells().volumes, two.site_cells().volumes, rtol=1e-13)
    two.remove([7])
    cells = two.site_cells()
    assert cells.volumes[7] == 0 and len(cells) == 5000


@pytest.mark.parametrize("arguments, error", [
    ({"faces": "all"}, ValueError), ({"box": [0, 1]}, ValueError), ({"box": ([0, 0], [1, 0])}, delone.InputError),
    ({"box": ([0], [1])}, delone.InputError), ({"halfspaces": [[1, 0, 0]]}, delone.InputError),
    ({"box": ([0, 0], [1, 1]), "halfspaces": [[1, 0]]}, ValueError), ({"box": ([0, 0], [1, 1]), "halfspaces": [[0, 0, 1]]}, delone.InputError)])
def test_what_is_refused(arguments, error):
    with pytest.raises(error):
        delone.Delaunay([[0, 0], [1, 0], [0, 1]]).site_cells(**arguments)
    assert not hasattr(delone.FurthestSite([[0, 0], [1, 0], [0, 1]]), "site_cells")
    with pytest.raises(ValueError):
        delone.Delaunay([[0, 0], [1, 0], [0, 1]]).site_cells().neighbors_of(0)


def test_cells_of_periodic_sets():
    random = np.random.default_rng(6)
    points = random.integers(0, 2**20, (200, 3)) / 2**20
    vectors = np.array([[1, 0, 0], [0.25, 1, 0], [-0.375, 0.3125, 1]])
    steps = random.integers(-2, 3, (200, 3))
    for t in (delone.PeriodicDelaunay(points + steps @ vectors, vectors, threads=1),
              delone.PeriodicRegular(points + steps @ vectors, random.random(200) * 0.01, vectors)):
        cells = t.site_cells(neighbors=True)
        assert abs(cells.volumes.sum() - 1) < 1e-12
        assert cells.neighbor_lattice.shape == (len(cells.neighbors), 3) and cells.neighbor_lattice.dtype == np.int32
        rows = np.repeat(np.arange(200), np.diff(cells.neighbor_offsets))
        apart = t.points[cells.neighbors] + cells.neighbor_lattice @ t.lattice - t.points[rows]
        np.testing.assert_allclose(cells.distances, np.linalg.norm(apart, axis=1), rtol=1e-12)
        has_cell = cells.volumes > 0
        assert (has_cell == (t.vertex_of_point == np.arange(200))).all()
        assert (np.linalg.norm(cells.centroids - t.points, axis=1)[has_cell] < 0.5).all()
        with pytest.raises(ValueError):
            cells.neighbor_lattice[0] = 1


def test_cells_of_slabs_and_refusals():
    points = np.random.default_rng(7).random((50, 2))
    t = delone.PeriodicDelaunay(points, 1.0, axes=[0])
    cells = t.site_cells(neighbors=True, faces="proper")
    assert np.isinf(cells.volumes).any() and cells.neighbor_lattice.shape == (len(cells.neighbors), 1)
    assert t.site_cells().neighbor_lattice is None and delone.Delaunay(points).site_cells(neighbors=True).neighbor_lattice is None
    with pytest.raises(ValueError, match="faces"):
        t.site_cells(faces="all")
    with pytest.raises(TypeError, match="box"):
        t.site_cells(box=([0, 0], [1, 1]))
