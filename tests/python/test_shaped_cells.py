# SPDX-License-Identifier: BSD-3-Clause
"""Lloyd's relaxation and prescribed volumes: what must hold of the cells, degenerate sites, and what is refused."""
import sys

import numpy as np
import pytest

import delone


@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_volumes_are_as_wanted(d):
    random = np.random.default_rng(d)
    n = [0, 20, 300, 300, 60][d]
    points = random.random((n, d))
    volumes = random.random(n) + 0.05
    volumes /= volumes.sum()
    for where in ({"box": ([0] * d, [1] * d)}, {"lattice": 1.0}):
        weights, cells = delone.prescribed_volumes(points, volumes, **where)
        np.testing.assert_allclose(cells.volumes, volumes, rtol=1e-9)
        assert abs(weights.mean()) < 1e-12
        again = delone.Regular(points, weights).site_cells(**where) if "box" in where else delone.PeriodicRegular(points, weights, 1.0).site_cells()
        np.testing.assert_allclose(again.volumes, volumes, rtol=1e-9)


def test_one_axis_is_the_quantile_function():
    """On a line the cells are consecutive intervals, whose ends are sums of the volumes."""
    points = np.array([[0.7], [0.1], [0.2], [0.95]])
    volumes = np.array([0.1, 0.4, 0.3, 0.2])
    weights, cells = delone.prescribed_volumes(points, volumes, box=([0], [1]))
    np.testing.assert_allclose(cells.centroids[:, 0], [0.75, 0.2, 0.55, 0.9], atol=1e-9)
    # Bisectors of neighbors 1, 2, 0, 3 are at the ends.
    for a, b, end in ((1, 2, 0.4), (2, 0, 0.7), (0, 3, 0.8)):
        x, y = points[a, 0], points[b, 0]
        assert (end - x) ** 2 - weights[a] == pytest.approx((end - y) ** 2 - weights[b], abs=1e-9)


def test_lattices_crystals_and_halfspaces():
    grid = np.stack(np.meshgrid(*3 * [np.arange(4.0)], indexing="ij"), axis=-1).reshape(-1, 3) + 0.5
    weights, cells = delone.prescribed_volumes(grid, box=([0] * 3, [4] * 3))
    assert np.abs(weights).max() < 1e-12
    volumes = np.where(np.arange(64) % 2 == 0, 1.5, 0.5)
    _, cells = delone.prescribed_volumes(grid, volumes, box=([0] * 3, [4] * 3))
    np.testing.assert_allclose(cells.volumes, volumes, rtol=1e-9)
    _, cells = delone.prescribed_volumes(grid, volumes, lattice=4.0)
    np.testing.assert_allclose(cells.volumes, volumes, rtol=1e-9)
    _, cells = delone.prescribed_volumes([[0.2, 0.2], [0.3, 0.6], [0.6, 0.1]], box=([0, 0], [1, 1]), halfspaces=[[1, 1, -1]])
    np.testing.assert_allclose(cells.volumes, 1 / 6, rtol=1e-9)
    _, cells = delone.prescribed_volumes([[0.5, 0.5, 0.5]], lattice=2.0)
    assert cells.volumes == pytest.approx(8)


def test_without_scipy(monkeypatch):
    points = np.random.default_rng(5).random((100, 2))
    expected, _ = delone.prescribed_volumes(points, box=([0, 0], [1, 1]))
    monkeypatch.setitem(sys.modules, "scipy.sparse", None)
    weights, _ = delone.prescribed_volumes(points, box=([0, 0], [1, 1]))
    np.testing.assert_allclose(weights, expected, atol=1e-8)


def test_lloyd_goes_to_centroids():
    random = np.random.default_rng(7)
    points = random.random((60, 2))
    for where in ({"box": ([0, 0], [1, 1])}, {"lattice": 1.0}):
        moments = []
        for _ in range(5):
            cells = delone.Delaunay(points).site_cells(**where) if "box" in where else delone.PeriodicDelaunay(points, 1.0).site_cells()
            moved = delone.lloyd(points, steps=1, **where)
            np.testing.assert_allclose(moved, cells.centroids)
            moments.append((cells.volumes * ((moved - points) ** 2).sum(axis=1)).sum())
            points = moved
        assert moments[-1] < moments[0] / 2
    np.testing.assert_array_equal(delone.lloyd(points, lattice=1.0, steps=0), points)
    twice = [[0.2, 0.2], [0.2, 0.2], [0.8, 0.8]]
    np.testing.assert_array_equal(delone.lloyd(twice, box=([0, 0], [1, 1]), steps=1)[1], [0.2, 0.2])


@pytest.mark.parametrize("arguments, message", [
    ({}, "give one of box and lattice"),
    ({"box": ([0, 0], [1, 1]), "lattice": 1.0}, "give one of box and lattice"),
    ({"lattice": [[1.0, 0]]}, "lattice"),
    ({"lattice": 1.0, "halfspaces": [[1, 1, 1]]}, "halfspaces"),
    ({"box": ([0, 0], [1, 1]), "volumes": [1, 2]}, r"shape \(2,\), not \(3,\)"),
    ({"box": ([0, 0], [1, 1]), "volumes": [0.5, 0.5, 0]}, "row 2 is not a positive number"),
    ({"box": ([0, 0], [1, 1]), "volumes": [0.5, 0.5, 1]}, "their sum is 2, not that of the box, 1"),
    ({"box": ([0, 0], [0.15, 0.15])}, "row 1 has no cell"),
])
def test_refusals(arguments, message):
    with pytest.raises(ValueError, match=message):
        delone.prescribed_volumes([[0.1, 0.1], [0.9, 0.2], [0.5, 0.7]], **arguments)


def test_more_refusals():
    with pytest.raises(ValueError, match="row 1 has no cell"):
        delone.prescribed_volumes([[0.1, 0.1], [0.1, 0.1]], box=([0, 0], [1, 1]))
    with pytest.raises(ValueError, match="steps"):
        delone.lloyd([[0.1, 0.1]], box=([0, 0], [1, 1]), steps=-1)
    with pytest.raises(ValueError, match="at least one"):
        delone.prescribed_volumes(np.zeros((0, 2)), box=([0, 0], [1, 1]))
    with pytest.raises(delone.Error, match="still off"):
        delone.prescribed_volumes(np.random.default_rng(1).random((50, 2)), box=([0, 0], [1, 1]), max_steps=1)


def test_round_containers():
    points = np.random.default_rng(9).random((200, 3)) * 2 - 1
    t = delone.Delaunay(points)
    for halfspaces, volume in ((delone.ball_halfspaces([0, 0, 0], 1), 4 / 3 * np.pi),
                               (delone.cylinder_halfspaces([-1, -1, -1], [1, 1, 1], 0.4), 0.16 * np.pi * 12**0.5)):
        np.testing.assert_allclose(np.linalg.norm(halfspaces[:, :3], axis=1), 1)
        inside = t.site_cells(box=([-2] * 3, [2] * 3), halfspaces=halfspaces).volumes.sum()
        assert volume < inside < 1.03 * volume
    disc = delone.ball_halfspaces([3, 4], 2, count=100)
    np.testing.assert_allclose((disc[:, :2] @ [3, 4] + disc[:, 2]), -2)
    for length in (1e-200, 1e200, 1.7e308):
        ends = delone.cylinder_halfspaces([0, 0, -length], [0, 0, length], length)[-2:]
        assert ends.tolist() == [[0, 0, -1, -length], [0, 0, 1, -length]]
    for call in (lambda: delone.ball_halfspaces([0, 0, 0], 0), lambda: delone.ball_halfspaces([0], 1), lambda: delone.ball_halfspaces([np.nan, 0], 1), lambda: delone.ball_halfspaces([0, 0], 1, count=3),
                 lambda: delone.cylinder_halfspaces([0, 0, 0], [0, 0, 0], 1), lambda: delone.cylinder_halfspaces([0, 0], [0, 1], 1),
                 lambda: delone.cylinder_halfspaces([0, 0, 0], [0, 0, 1], np.nan)):
        with pytest.raises(ValueError):
            call()
