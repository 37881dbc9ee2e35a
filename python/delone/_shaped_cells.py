# SPDX-License-Identifier: BSD-3-Clause
"""Cells as wanted: Lloyd's relaxation, weights that give cells prescribed volumes, and round containers."""
from __future__ import annotations

import numpy as np

from . import _core


def lloyd(points, *, box=None, halfspaces=None, lattice=None, steps=10, threads=0) -> np.ndarray:
    """Move each point to the centroid of its Voronoi cell, again and again.

    Cells become rounder and more equal from step to step (Lloyd 1982, doi:10.1109/TIT.1982.1056489).

    Parameters
    ----------
    points : (n, d) array_like
        The points.
    box : (low, high), optional
        Two arrays (d,): the cells are those in this box. Give it, or a lattice.
    halfspaces : (m, d+1) array_like, optional
        Rows [A, b] of halfspaces A x + b <= 0, which clip the cells in the box as well.
    lattice : float or array_like, optional
        As for `PeriodicDelaunay`, d vectors: the set is periodic, and no cell is cut. Points that leave the box are not wrapped.
    steps : int, optional
        How many times all points move.
    threads : int, optional
        Number of threads; 0 chooses.

    Returns
    -------
    (n, d) ndarray of float64
        The points after the last step. A point without a cell (a duplicate of an earlier one, or one whose cell is outside of the box) stays.

    Raises
    ------
    ValueError
        If not exactly one of box and lattice is given, the lattice has fewer than d vectors, or `steps` is negative.
    InputError
        If the points, the box, halfspaces or the lattice are not as wanted.

    See Also
    --------
    prescribed_volumes : Weights for cells of given volumes.

    Notes
    -----
    The sum over all cells of the second moments about their points never grows. Cost: that of a triangulation with `Delaunay.site_cells`
    for each step.

    Examples
    --------
    >>> import delone
    >>> delone.lloyd([[0.25, 0], [1, 0]], box=([0, -1], [2, 1]), steps=60).round(6).tolist()
    [[0.5, 0.0], [1.5, 0.0]]
    """
    region = _Region(points, box, halfspaces, lattice, threads)
    if steps < 0:
        raise ValueError(f"steps: at least 0, not {steps}")
    points = region.points
    for _ in range(steps):
        centroids = region.cells(points).centroids
        points = np.where(np.isnan(centroids), points, centroids)
    return points


def prescribed_volumes(points, volumes=None, *, box=None, halfspaces=None, lattice=None, tolerance=1e-9, max_steps=100, threads=0):
    """Find weights for which the cells of the power diagram have given volumes: semi-discrete optimal transport.

    The cells then are the cheapest way, in squared distance, to assign the points of the box to the sites.

    Parameters
    ----------
    points : (n, d) array_like
        The sites, which must be distinct, and each must have a Voronoi cell in the box.
    volumes : (n,) array_like, optional
        The volumes wanted, positive. Their sum may differ from the volume of the box by 1e-9 of it; they are then scaled to that volume. By
        default all are equal.
    box : (low, high), optional
        Two arrays (d,): the cells are those in this box. Give it, or a lattice.
    halfspaces : (m, d+1) array_like, optional
        Rows [A, b] of halfspaces A x + b <= 0, which clip the cells in the box as well.
    lattice : float or array_like, optional
        As for `PeriodicRegular`, d vectors: the set is periodic.
    tolerance : float, optional
        The largest relative error of a volume.
    max_steps : int, optional
        The largest number of steps of Newton's method.
    threads : int, optional
        Number of threads; 0 chooses.

    Returns
    -------
    weights : (n,) ndarray of float64
        The weights, with mean 0.
    cells : SiteCells
        The cells, with neighbors.

    Raises
    ------
    ValueError
        If not exactly one of box and lattice is given, the lattice has fewer than d vectors, there are not n positive volumes, their sum is
        not that of the box, or a row has no cell to begin with.
    InputError
        If the points, the box, halfspaces or the lattice are not as wanted.
    Error
        If the volumes are not within the tolerance after `max_steps` steps, or cannot be improved any more.

    See Also
    --------
    lloyd : Moves points instead.
    Regular.site_cells : The cells of given weights.

    Notes
    -----
    Damped Newton's method (Kitagawa, Merigot and Thibert 2019, doi:10.4171/JEMS/889). The derivative of the volume of cell i with respect to
    the weight of its neighbor j is minus the area of their face over twice their distance. A step is halved until no cell has less than half of
    the least volume, wanted or initial, and the error has fallen enough for the size of the step. Empty cells are recognized exactly. The linear
    systems are solved by conjugate gradients. Cost: some ten to twenty triangulations with `Regular.site_cells`.

    Examples
    --------
    >>> import delone
    >>> weights, cells = delone.prescribed_volumes([[0, 0], [1, 0]], [3, 1], box=([-1, -0.5], [3, 0.5]))
    >>> weights.round(9).tolist(), cells.volumes.round(9).tolist()
    ([1.5, -1.5], [3.0, 1.0])
    """
    region = _Region(points, box, halfspaces, lattice, threads)
    points, n = region.points, len(region.points)
    if n == 0:
        raise ValueError("points: at least one")
    weights = np.zeros(n)
    cells = region.cells(points, weights)
    without = np.flatnonzero(~(cells.volumes > 0))
    if len(without):
        raise ValueError(f"row {without[0]} has no cell: it is a duplicate, or its Voronoi cell is outside of the box")
    total = cells.volumes.sum()
    if volumes is None:
        volumes = np.full(n, total / n)
    volumes = _core._doubles(volumes, "volumes")
    if volumes.shape != (n,):
        raise ValueError(f"volumes: an array of shape {volumes.shape}, not ({n},)")
    if not (np.isfinite(volumes).all() and (volumes > 0).all()):
        raise ValueError(f"volumes: row {np.flatnonzero(~(np.isfinite(volumes) & (volumes > 0)))[0]} is not a positive number")
    if not abs(volumes.sum() - total) <= 1e-9 * total:
        raise ValueError(f"volumes: their sum is {volumes.sum():.12g}, not that of the box, {total:.12g}")
    volumes = volumes * (total / volumes.sum())
    least = min(cells.volumes.min(), volumes.min()) / 2
    error = volumes - cells.volumes
    for _ in range(max_steps):
        if (np.abs(error) <= tolerance * volumes).all():
            return weights - weights.mean(), cells
        step = _solve(_Laplacian(cells), error, relative=min(1e-3, 0.1 * np.abs(error / volumes).max()))
        size, share = np.linalg.norm(error), 1.0
        while share > 1e-12:
            moved = weights + share * step
            trial = region.cells(points, moved)
            changed = volumes - trial.volumes
            if trial.volumes.min() >= least and np.linalg.norm(changed) <= (1 - share / 2) * size:
                break
            share /= 2
        else:
            break
        weights, cells, error = moved, trial, changed
    if (np.abs(error) <= tolerance * volumes).all():
        return weights - weights.mean(), cells
    raise _core.Error(f"prescribed_volumes: a volume is still off by {np.abs(error / volumes).max():.3g} of itself")


def ball_halfspaces(center, radius, count=200) -> np.ndarray:
    """Make halfspaces whose intersection is nearly a ball: their boundaries touch it all around.

    With a box they make a round container for cells of sites.

    Parameters
    ----------
    center : (d,) array_like
        The center, 2 or 3 numbers.
    radius : float
        The radius, positive.
    count : int, optional
        The number of halfspaces, at least 2 d.

    Returns
    -------
    (count, d+1) ndarray of float64
        Rows [A, b] of A x + b <= 0, with A of length 1. They contain the ball; in space the volume exceeds that of the ball by some 3.2/count of it.

    Raises
    ------
    ValueError
        If the center has not 2 or 3 finite numbers, the radius is not positive and finite, or there are fewer than 2 d.

    See Also
    --------
    cylinder_halfspaces : Of a cylinder.

    Examples
    --------
    >>> import delone
    >>> points = delone.generate("uniform", 100, 3, seed=1)
    >>> ball = delone.ball_halfspaces([0.5, 0.5, 0.5], 0.5)
    >>> volume = delone.Delaunay(points).site_cells(box=([0] * 3, [1] * 3), halfspaces=ball).volumes.sum()
    >>> bool(0.5236 < volume < 0.54)
    True
    """
    center = _core._doubles(center, "center")
    if center.shape not in ((2,), (3,)):
        raise ValueError(f"center: an array of shape {center.shape}, not (2,) or (3,)")
    _require_finite(center, "center")
    _require_round(radius, count, 2 * len(center))
    if len(center) == 2:
        normals = _directions(count)
    else:  # at equal heights, turned by the golden angle: a share of the sphere for each
        height = (2 * np.arange(count) + 1) / count - 1
        angle = np.arange(count) * (np.pi * (3 - 5**0.5))
        across = np.sqrt(1 - height**2)
        normals = np.stack([across * np.cos(angle), across * np.sin(angle), height], axis=1)
    return _tangents(normals, center, radius)


def cylinder_halfspaces(start, end, radius, count=60) -> np.ndarray:
    """Make halfspaces whose intersection is nearly a cylinder: a prism around it.

    With a box they make a container for cells of sites.

    Parameters
    ----------
    start, end : (3,) array_like
        The ends of the axis, centers of the two flat sides.
    radius : float
        The radius, positive.
    count : int, optional
        How many sides the prism has around the axis, at least 3.

    Returns
    -------
    (count+2, 4) ndarray of float64
        Rows [A, b] of A x + b <= 0, with A of length 1; the last two are those of the flat sides. They contain the cylinder. The volume exceeds that
        of the cylinder by some 3.3/count² of it.

    Raises
    ------
    ValueError
        If the ends are not two different points of space, the radius is not positive and finite, or `count` is less than 3.

    See Also
    --------
    ball_halfspaces : Of a ball.

    Examples
    --------
    >>> import delone
    >>> delone.cylinder_halfspaces([0, 0, 0], [0, 0, 2], 1, count=4).round(9)[-2:].tolist()
    [[0.0, 0.0, -1.0, 0.0], [0.0, 0.0, 1.0, -2.0]]
    """
    start, end = _core._doubles(start, "start"), _core._doubles(end, "end")
    for name, point in (("start", start), ("end", end)):
        if point.shape != (3,):
            raise ValueError(f"{name}: an array of shape {point.shape}, not (3,)")
        _require_finite(point, name)
    axis = end / 2 - start / 2
    if not axis.any():
        raise ValueError("start and end: two different points")
    _require_round(radius, count, 3)
    axis /= np.abs(axis).max()
    axis /= np.linalg.norm(axis)
    first = np.cross(axis, np.eye(3)[np.abs(axis).argmin()])
    first /= np.linalg.norm(first)
    sides = _tangents(_directions(count) @ np.stack([first, np.cross(axis, first)]), start, radius)
    return np.concatenate([sides, [np.append(0 - axis, axis @ start), np.append(axis, 0 - axis @ end)]])


def _require_finite(point, name):
    if not np.isfinite(point).all():
        raise ValueError(f"{name}: finite numbers, not {point.tolist()}")


def _require_round(radius, count, least):
    if not (np.isfinite(radius) and radius > 0):
        raise ValueError(f"radius: a positive number, not {radius}")
    if count < least:
        raise ValueError(f"count: at least {least}, not {count}")


def _directions(count):
    angle = np.arange(count) * (2 * np.pi / count)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _tangents(normals, center, radius):
    return np.concatenate([normals, -(normals @ center + radius)[:, None]], axis=1)


class _Region:
    """Where cells are: in a box, or in a periodic set."""

    def __init__(self, points, box, halfspaces, lattice, threads):
        if (box is None) == (lattice is None):
            raise ValueError("give one of box and lattice")
        if lattice is not None and halfspaces is not None:
            raise ValueError("halfspaces clip cells only in a box")
        self.points = np.array(_core._doubles(points, "points"))
        if self.points.ndim != 2:
            raise ValueError(f"points: an array of shape {self.points.shape}, not (n, d)")
        self._box, self._halfspaces, self._lattice, self._threads = box, halfspaces, lattice, threads

    def cells(self, points, weights=None):
        """The cells of points, with neighbors if they have weights."""
        arguments = (points,) if weights is None else (points, weights)
        if self._lattice is None:
            kind = _core.Delaunay if weights is None else _core.Regular
            return kind(*arguments, threads=self._threads).site_cells(neighbors=weights is not None, box=self._box, halfspaces=self._halfspaces)
        kind = _core.PeriodicDelaunay if weights is None else _core.PeriodicRegular
        periodic = kind(*arguments, self._lattice, threads=self._threads)
        if periodic.rank != points.shape[1]:
            raise ValueError(f"lattice: {periodic.rank} vectors, not {points.shape[1]}")
        return periodic.site_cells(neighbors=weights is not None)


class _Laplacian:
    """The derivative of volumes with respect to weights: sum over the neighbors j of i of (x_i - x_j) area/(2 distance)."""

    def __init__(self, cells):
        n, owner = len(cells), np.repeat(np.arange(len(cells)), np.diff(cells.neighbor_offsets))
        counts = (cells.neighbors >= 0) & (cells.neighbors != owner)
        self._from, self._to = owner[counts], cells.neighbors[counts]
        # Half from each side: areas of the two sides of a face may differ in the last digit.
        self._values = cells.face_areas[counts] / (4 * cells.distances[counts])
        self.diagonal = np.bincount(self._from, self._values, n) + np.bincount(self._to, self._values, n)
        try:  # a tenth of the time
            from scipy.sparse import coo_array
        except ImportError:
            self._sparse = None
        else:
            one_way = coo_array((self._values, (self._from, self._to)), shape=(n, n)).tocsr()
            self._sparse = (one_way + one_way.T).tocsr()

    def __call__(self, x):
        if self._sparse is not None:
            return self.diagonal * x - self._sparse @ x
        n = len(x)
        flow = self._values * (x[self._from] - x[self._to])
        return np.bincount(self._from, flow, n) - np.bincount(self._to, flow, n)


def _solve(matrix, right, relative):
    """Conjugate gradients, preconditioned by the diagonal. The matrix is singular; its kernel has the constants."""
    inverse = 1 / np.where(matrix.diagonal > 0, matrix.diagonal, 1)
    x, rest = np.zeros(len(right)), right - right.mean()
    goal = relative * np.linalg.norm(rest)
    direction, last = np.zeros_like(rest), 1.0
    for _ in range(20 * int(len(right) ** 0.5) + 200):
        if np.linalg.norm(rest) <= goal:
            break
        better = inverse * rest
        now = rest @ better
        direction = better + now / last * direction
        image = matrix(direction)
        along = direction @ image
        if not along > 0:
            break
        x += now / along * direction
        rest -= now / along * image
        last = now
    return x - x.mean()
