# SPDX-License-Identifier: BSD-3-Clause
"""The density of particles by the Delaunay tessellation field estimator: at the particles, and on regular grids."""
from __future__ import annotations

import operator

import numpy as np

from . import _core
from ._clipping import checked_box


def dtfe_densities(self, masses=None) -> np.ndarray:
    """The density at each point, by the Delaunay tessellation field estimator (DTFE).

    Parameters
    ----------
    masses : (n,) array_like, optional
        The mass of each point, any finite number; 1 by default. Masses at one point add up.

    Returns
    -------
    (n,) ndarray of float64
        (k+1) m / W for a point of mass m, where W is the volume of all cells that have it as a vertex; NaN for removed rows.

    Raises
    ------
    ValueError
        If `masses` has another shape.
    InputError
        If a mass is not finite; `rows` tells which.
    Error
        If points have weights, or k is larger than 12.

    See Also
    --------
    dtfe_density : The density on a grid.
    LinearInterpolator : With these as values, the density anywhere.

    Notes
    -----
    The function that is linear in each cell and has these values is continuous. Its integral is the sum of the masses, in a periodic set over
    one period. Without a lattice, densities at the convex hull are too high, since cells end there. The volume of each cell is off by at most
    2^-50 of W. Results are the same to the last bit for every number of threads. If the points span only a k-flat, densities are masses per
    k-volume. From W. E. Schaap and R. van de Weygaert, "Continuous fields and discrete samples", A&A 363 (2000), L29.

    Examples
    --------
    >>> import delone
    >>> delone.Delaunay([[0, 0], [1, 0], [0, 1], [1, 1], [0.5, 0.5]]).dtfe_densities()
    array([6., 6., 6., 6., 3.])
    >>> delone.PeriodicDelaunay([[0.25, 0.5]], 0.5).dtfe_densities(masses=[2])
    array([8.])
    """
    return self._dtfe_densities(_masses_of(self, masses))


def dtfe_density(points, shape, *, masses=None, box=None, lattice=None, samples=1, threads=0) -> np.ndarray:
    """The density of particles on a regular grid, by the Delaunay tessellation field estimator (DTFE).

    Parameters
    ----------
    points : (n, d) array_like, Delaunay or PeriodicDelaunay
        The particles, or their triangulation.
    shape : int or (d,) array_like of int
        Into how many equal parts each side of the grid is divided.
    masses : (n,) array_like, optional
        The mass of each particle, any finite number; 1 by default.
    box : (low, high), optional
        Two arrays (d,): the grid divides this box. By default it is the smallest one with all points. In a periodic set it is the one
        that the lattice vectors span from the origin of coordinates; they need not be orthogonal.
    lattice : float or array_like, optional
        As for `PeriodicDelaunay`: the set is periodic. Not with a triangulation.
    samples : int, optional
        Each part of the grid gets the mean of the density at the centers of ``samples**d`` equal parts of it; by default the value at its center.
    threads : int, optional
        Number of threads; 0 chooses. A triangulation has its own.

    Returns
    -------
    ndarray of float64
        The densities, an array of the given shape with d axes; 0 outside of the convex hull of the points.

    Raises
    ------
    ValueError
        If an argument has another shape, `samples` is less than 1, a lattice has fewer than d vectors and there is no box, or a lattice comes with a
        triangulation.
    InputError
        If the points, masses, lattice or box are not as wanted.
    Error
        If points have weights, or they span a flat of more than 12 dimensions.

    See Also
    --------
    Delaunay.dtfe_densities : The densities at the particles.
    LinearInterpolator : With these as values, the density anywhere.

    Notes
    -----
    The density is linear in each cell, see `Delaunay.dtfe_densities`. A mean of samples is not the integral over a part: the sum of all densities
    times the volume of a part tends to the mass as the square of the step between samples. Cost: the triangulation, and a query for each sample.

    Examples
    --------
    >>> import delone
    >>> import numpy as np
    >>> points = delone.generate("uniform", 1000, 2, seed=1)
    >>> density = delone.dtfe_density(points, (64, 64), lattice=1.0, samples=4)
    >>> density.shape, bool(abs(density.mean() - 1000) < 10)
    ((64, 64), True)
    """
    if isinstance(points, (_core.Triangulation, _core.PeriodicTriangulation)):
        if lattice is not None:
            raise ValueError("lattice: a triangulation has its own, or none")
        triangulation = points
    elif lattice is not None:
        triangulation = _core.PeriodicDelaunay(points, lattice, threads=threads)
    else:
        triangulation = _core.Delaunay(points, threads=threads)
    d = triangulation.dimension
    shape = _shape_of(shape, d)
    if not hasattr(samples, "__index__") or samples < 1:
        raise ValueError(f"samples: an integer of at least 1, not {samples!r}")
    origin, sides = _grid_of(triangulation, box, d)
    densities = triangulation._dtfe_densities(_masses_of(triangulation, masses))
    return triangulation._density_on_grid(densities, origin, sides, shape, operator.index(samples)).reshape(shape)


def _masses_of(triangulation, masses):
    n = len(triangulation.points)
    if masses is None:
        return np.empty(0)
    masses = _core._doubles(masses, "masses")
    if masses.shape != (n,):
        raise ValueError(f"masses: an array of shape {masses.shape}, not ({n},)")
    return masses


def _shape_of(shape, d):
    try:
        parts = [operator.index(each) for each in (shape if np.iterable(shape) else [shape] * d)]
    except TypeError:
        parts = []
    if len(parts) != d or not all(1 <= part < 2**31 for part in parts):
        raise ValueError(f"shape: {d} integers from 1 to 2**31 - 1, not {shape!r}")
    return parts


def _grid_of(triangulation, box, d):
    """The origin of the grid, and its sides as rows."""
    if box is not None:
        low, high = checked_box(box, d)
        return low, np.diag(high - low)
    if isinstance(triangulation, _core.PeriodicTriangulation):
        if len(triangulation.lattice) < d:
            raise ValueError("box: give one, as the set is not periodic along all directions")
        return np.zeros(d), triangulation.lattice
    points = triangulation.points
    points = points[~np.isnan(points[:, 0])]  # removed rows
    if len(points) == 0:
        raise ValueError("box: give one, as there are no points")
    low = points.min(axis=0)
    return low, np.diag(points.max(axis=0) - low)
