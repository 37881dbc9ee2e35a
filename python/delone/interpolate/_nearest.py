# SPDX-License-Identifier: BSD-3-Clause
"""scipy.interpolate.NearestNDInterpolator, with exact nearest points."""
from __future__ import annotations

import numpy as np

import delone

from ._base import Interpolator, refuse_masked

# Triangulations of more dimensions cost more than comparing all points.
_LARGEST_TRIANGULATED = 4


class NearestNDInterpolator(Interpolator):
    """Value at the nearest point, with the interface of `scipy.interpolate.NearestNDInterpolator`.

    Parameters
    ----------
    x : (npoints, ndim) array_like, tuple of (npoints,) array_like, or triangulation
        Where the values are. A `delone.spatial.Delaunay` or a `delone.Delaunay` is used as it is.
    y : (npoints, ...) array_like
        The values, of any type.
    rescale : bool, default False
        Measure distances with points scaled to a unit cube. Not with a triangulation.
    tree_options : dict, optional
        Options of scipy's tree; without effect.

    Attributes
    ----------
    points : (npoints, ndim) ndarray of float64
        The (scaled) points.
    values : (npoints, ...) ndarray
        The values.

    Raises
    ------
    ValueError
        If the numbers of values and points differ, points are not finite, or `tree_options` has a boxsize.

    Notes
    -----
    The nearest point is exact in up to 4 dimensions, or with a triangulation; of several, the first one counts. Cost: that of
    `delone.Delaunay`, and a walk per query; in more than 4 dimensions O(npoints) per query.

    Examples
    --------
    >>> from delone.interpolate import NearestNDInterpolator
    >>> f = NearestNDInterpolator([[0, 0], [1, 0], [0, 1]], [5, 6, 7])
    >>> f([[0.9, 0.2], [-3, 8]])
    array([6, 7])
    """

    def __init__(self, x, y, rescale=False, tree_options=None):
        if (tree_options or {}).get("boxsize") is not None:
            raise ValueError("tree_options: boxsize, a periodic space, is not there")
        super().__init__(x, rescale)
        refuse_masked("values", y)
        self.values = np.asarray(y)
        if self.values.ndim == 0 or len(self.values) != len(self.points):
            raise ValueError("different number of values and points")
        self._core = getattr(self.tri, "_core", self.tri)
        if self._core is None and self.points.shape[1] <= _LARGEST_TRIANGULATED:
            self._core = delone.Delaunay(self.points)
        elif not np.isfinite(self.points).all():
            raise ValueError("points are not finite")

    def __call__(self, *args, eps=0, p=2, distance_upper_bound=np.inf, workers=1):
        """Evaluate the interpolant at queries.

        Parameters
        ----------
        *args : (..., ndim) array_like, or ndim array_like
            The queries: one array, or ndim arrays of coordinates that broadcast against each other.
        eps : float, default 0
            Without effect.
        p : float, default 2
            The norm; only 2 is supported.
        distance_upper_bound : float, default inf
            The value is NaN if no point is nearer than this.
        workers : int, default 1
            Without effect.

        Returns
        -------
        ndarray
            The values: the shape of the queries, followed by that of one value.

        Raises
        ------
        ValueError
            If queries are not finite or have another number of coordinates, or `p` is not 2.
        """
        if p != 2:
            raise ValueError("p: nearest points are those in the Euclidean norm, 2")
        queries, shape = self._queries(args)
        if not np.isfinite(queries).all():
            raise ValueError("'x' must be finite, check for nan or inf values")
        rows, distances = self._nearest(queries) if self._core is None else self._core.nearest(queries)
        result = self.values[rows]
        far = ~(distances < distance_upper_bound)
        if far.any():
            result = result.astype(np.result_type(result.dtype, np.float64), copy=False)
            result[far] = np.nan
        return result.reshape(shape + self.values.shape[1:])

    def _nearest(self, queries: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """By comparing all points, a block of queries at a time."""
        rows, squares = np.empty(len(queries), np.intp), np.empty(len(queries))
        step = max(1, 1_000_000 // len(self.points))
        for begin in range(0, len(queries), step):
            block = queries[begin:begin + step]
            distances = np.zeros((len(block), len(self.points)))
            for axis in range(block.shape[1]):
                distances += (block[:, axis, None] - self.points[None, :, axis])**2
            rows[begin:begin + step] = distances.argmin(axis=1)
            squares[begin:begin + step] = distances.min(axis=1)
        return rows, np.sqrt(squares)
