# SPDX-License-Identifier: BSD-3-Clause
"""Densities of particles: at the points, anywhere, and on grids."""
import itertools
import math

import delone
import numpy as np
import pytest


def volumes_of(points, cells, offsets=0.0):
    corners = points[cells] + offsets
    return abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / math.factorial(points.shape[1])


@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_is_mass_over_the_volume_of_cells(d):
    points = delone.generate("clusters", 300, d, seed=d)
    masses = np.random.default_rng(d).random(300) + 0.5
    t = delone.Delaunay(points)
    volumes = volumes_of(points, t.cells)
    stars = np.bincount(t.cells.ravel(), np.repeat(volumes, d + 1), len(points))
    densities = t.dtfe_densities(masses)
    np.testing.assert_allclose(densities, (d + 1) * masses / stars, rtol=1e-9)
    assert math.isclose((densities[t.cells].mean(axis=1) * volumes).sum(), masses.sum(), rel_tol=1e-12)


@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_mass_of_a_period_is_conserved(d):
    points = delone.generate("uniform", 200, d, seed=d)
    masses = np.random.default_rng(d).random(200)
    lattice = np.eye(d) + 0.25 * np.eye(d, k=1)
    t = delone.PeriodicDelaunay(points, lattice)
    volumes = volumes_of(t.points, t.cells, t.cell_offsets @ t.lattice)
    assert math.isclose((t.dtfe_densities(masses)[t.cells].mean(axis=1) * volumes).sum(), masses.sum(), rel_tol=1e-12)


def test_grids_are_means_of_the_interpolator():
    points = delone.generate("uniform", 100, 2, seed=1)
    masses = np.arange(100.0)
    t = delone.PeriodicDelaunay(points, [[1, 0], [0.5, 1]])
    field = delone.dtfe_density(t, (3, 4), masses=masses, samples=2)
    function = delone.PeriodicLinearInterpolator(t, t.dtfe_densities(masses))
    for i, j in itertools.product(range(3), range(4)):
        places = [[(i + (a + 0.5) / 2) / 3, (j + (b + 0.5) / 2) / 4] for a, b in itertools.product(range(2), repeat=2)]
        assert math.isclose(field[i, j], function(places @ t.lattice).mean(), rel_tol=1e-12)
    np.testing.assert_array_equal(field, delone.dtfe_density(points, (3, 4), masses=masses, samples=2, lattice=t.lattice))


def test_the_default_box_is_that_of_the_rows_that_are_left():
    points = delone.generate("uniform", 20, 2, seed=1)
    t = delone.Delaunay(points)
    t.remove([3])
    rest = np.delete(points, 3, axis=0)
    np.testing.assert_allclose(delone.dtfe_density(t, 3), delone.dtfe_density(delone.Delaunay(rest), 3), rtol=1e-12)


def test_open_sets_have_nothing_outside():
    corner = [[0, 0], [1, 0], [0, 1]]
    np.testing.assert_array_equal(delone.dtfe_density(corner, (4, 2), box=([0, 0], [2, 1])), [[6, 6], [6, 0], [0, 0], [0, 0]])
    assert delone.dtfe_density(corner, 2).shape == (2, 2)
    assert delone.dtfe_density(np.empty((0, 2)), 2, box=([0, 0], [1, 1])).tolist() == [[0, 0], [0, 0]]


def test_one_particle_in_a_periodic_box():
    for d in (1, 2, 3):
        t = delone.PeriodicDelaunay(np.full((1, d), 0.3), 2.0)
        np.testing.assert_allclose(delone.dtfe_density(t, 3, masses=[5]), np.full(d * [3], 5 / 2**d), rtol=1e-14)


def test_refusals():
    points = delone.generate("uniform", 20, 2, seed=1)
    t = delone.Delaunay(points)
    with pytest.raises(ValueError, match=r"masses: an array of shape \(19,\), not \(20,\)"):
        t.dtfe_densities(np.ones(19))
    with pytest.raises(delone.InputError, match="mass of point 3 is not finite"):
        t.dtfe_densities([1, 1, 1, np.inf] + 16 * [1])
    for bad in ((3,), (3, 3, 3), (0, 3), 0, None, (3.5, 2), 2**70, "ab"):
        with pytest.raises(ValueError, match="shape: 2 integers"):
            delone.dtfe_density(t, bad)
    for bad in (0, 1.5, None):
        with pytest.raises(ValueError, match="samples: an integer of at least 1"):
            delone.dtfe_density(t, 3, samples=bad)
    for bad in (5, ([0, 0], [np.inf, 1]), ([0, np.nan], [1, 1]), ([1, 1], [0, 0]), ([0, 0], [1, 1], [2, 2])):
        with pytest.raises(ValueError, match="box"):
            delone.dtfe_density(t, 3, box=bad)
    with pytest.raises(ValueError, match="lattice: a triangulation"):
        delone.dtfe_density(t, 3, lattice=1.0)
    with pytest.raises(ValueError, match="not periodic along all directions"):
        delone.dtfe_density(delone.PeriodicDelaunay(points, 1.0, axes=[0]), 3)
    with pytest.raises(ValueError, match="no points"):
        delone.dtfe_density(np.empty((0, 2)), 3)
    with pytest.raises(delone.Error, match="Delaunay triangulation"):
        delone.dtfe_density(delone.FurthestSite(points), 3)
