# SPDX-License-Identifier: BSD-3-Clause
"""The arrays of scipy that the library itself has not, in NumPy: lifted points, hyperplanes on the paraboloid, hull facets.

These are rounded numbers; nothing combinatorial is decided with them.
"""
from __future__ import annotations

import numpy as np

from delone import _core


def bounds(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The least and the largest coordinates of points (n, d), (d,) each."""
    return _core._bounds(points)


def paraboloid(points: np.ndarray, scaled: bool, at_infinity: bool) -> tuple[float, float]:
    """(scale, shift) of the last coordinate of lifted points. Scaled, it covers [0, the largest |coordinate|], including, with
    `at_infinity`, a point that is a tenth higher than the highest lifted point."""
    if not scaled:
        return 1.0, 0.0
    with np.errstate(all="ignore"):
        heights = (points**2).sum(axis=1)
        lowest, highest = heights.min(), heights.max() * (1.1 if at_infinity else 1.0)
        scale = np.abs(points).max() / (highest - lowest)
    return (float(scale), float(-lowest * scale)) if np.isfinite(scale) and scale > 0 else (1.0, 0.0)


def lift(points: np.ndarray, scale: float, shift: float) -> np.ndarray:
    """(…, d+1): the points with their height on the paraboloid."""
    return np.concatenate([points, ((points**2).sum(axis=-1) * scale + shift)[..., None]], axis=-1)


def hyperplanes(points: np.ndarray, simplices: np.ndarray, scale: float, shift: float, upper: bool = False) -> np.ndarray:
    """(m, d+2): unit normal and offset of the hyperplane of each lifted simplex, downward, or upward for `upper`."""
    with np.errstate(all="ignore"):
        lifted = lift(points, scale, shift)
        equations = _core._hyperplanes(points, simplices, lifted[:, -1])
        for i in np.flatnonzero(~np.isfinite(equations).all(axis=1)):  # nearly vertical, or numbers beyond the range
            last = lifted[simplices[i, -1]]
            edges = lifted[simplices[i, :-1]] - last
            normal = np.linalg.svd(edges)[2][-1] if np.isfinite(edges).all() else np.full(len(last), np.nan)
            normal *= -1 if normal[-1] > 0 else 1
            equations[i] = *normal, -normal @ last
    return -equations if upper else equations


def listed(cells: np.ndarray, neighbors: np.ndarray, ndim: int) -> tuple[np.ndarray, np.ndarray]:
    """New arrays of cells and their neighbors, (m, k): as they are in the plane, with increasing vertices otherwise, so that two
    cells or facets with the same vertices are equal."""
    return (np.array(cells), np.array(neighbors)) if ndim == 2 else _core._increasing(cells, neighbors)


def boundary_facets(simplices: np.ndarray, neighbors: np.ndarray) -> np.ndarray:
    """(f, k): the facets without a neighbor, in the order of simplices and of their opposite vertices."""
    cell, opposite = np.nonzero(neighbors == -1)
    keep = np.arange(simplices.shape[1]) != opposite[:, None]
    return simplices[cell][keep].reshape(len(cell), simplices.shape[1] - 1)
