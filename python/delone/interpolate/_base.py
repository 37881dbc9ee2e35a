# SPDX-License-Identifier: BSD-3-Clause
"""What the interpolators share: coordinates as scipy takes them, the triangulation, the values, and where queries lie."""
from __future__ import annotations

import sys

import numpy as np

import delone
from delone import spatial
from delone.spatial import _tolerance
from delone.spatial._base import refuse_state_of_scipy

# scipy's tolerance in barycentric coordinates.
TOLERANCE = 100 * sys.float_info.epsilon


class GradientEstimationWarning(Warning):
    """The gradients of a CloughTocher2DInterpolator did not converge.

    Parameters
    ----------
    *args : object
        The message.
    """

    def __init__(self, *args):  # for inspect.signature()
        super().__init__(*args)


def refuse_masked(name, *arrays) -> None:
    """ValueError for masked values, which are none."""
    if any(np.ma.is_masked(each) for each in arrays):
        raise ValueError(f"{name}: masked values are not numbers")


def coordinates(points, ndim: int | None = None) -> np.ndarray:
    """(…, d) of an array of that shape, or of a tuple of d arrays that broadcast against each other. Of an array of numbers (n,)
    points in one dimension, or one point of `ndim`."""
    if isinstance(points, tuple) and len(points) == 1:
        points, = points
    refuse_masked("points", *points if isinstance(points, tuple) else (points,))
    if isinstance(points, tuple):
        return np.stack(np.broadcast_arrays(*points), axis=-1).astype(np.float64, copy=False)
    points = np.asanyarray(points)
    return points.reshape(-1, 1 if ndim is None else ndim) if points.ndim == 1 else points


def triangulation_of(points):
    """(the triangulation itself, its points) if it is one of ours; (None, points) for coordinates."""
    if isinstance(points, (spatial.Delaunay, delone.Delaunay)):
        return points, points.points
    if any(kind.__module__.startswith("scipy.spatial") for kind in type(points).__mro__):
        raise TypeError("points: a triangulation of scipy. Make it with delone.spatial.Delaunay, or pass its points")
    return None, points


class Interpolator:
    """Points, perhaps scaled, and their triangulation."""

    _own = "_core"  # an attribute that scipy's class has not

    def __init__(self, points, rescale: bool):
        self.tri, points = triangulation_of(points)
        if self.tri is not None and rescale:
            raise ValueError("Rescaling is not supported when passing a Delaunay triangulation as ``points``.")
        points = np.ascontiguousarray(coordinates(points), dtype=np.float64)
        if points.ndim != 2:
            raise ValueError("invalid shape for input data points")
        if points.shape[1] < 2:
            raise ValueError("input data must be at least 2-D")
        self.scale = self.offset = None
        if rescale:  # to a unit cube centered at 0
            self.offset, self.scale = points.mean(axis=0), np.ptp(points, axis=0)
            self.scale[~(self.scale > 0)] = 1.0
            points = (points - self.offset) / self.scale
        self.points = points

    def __setstate__(self, state):
        refuse_state_of_scipy(self, state, self._own)
        self.__dict__.update(state)

    def _queries(self, args) -> tuple[np.ndarray, tuple]:
        """Queries as contiguous (q, d) float64, scaled like the points, and the shape of the answers."""
        xi = coordinates(args, ndim=self.points.shape[1])
        if xi.shape[-1] != self.points.shape[1]:
            raise ValueError("number of dimensions in xi does not match x")
        queries = np.ascontiguousarray(xi.reshape(-1, xi.shape[-1]), dtype=np.float64)
        return queries if self.scale is None else (queries - self.offset) / self.scale, xi.shape[:-1]


class OnTriangulation(Interpolator):
    """Values at the vertices of a triangulation, real or complex, and a constant outside.

    A subclass computes what it needs of ``_columns``, (n, c) float64 with real and imaginary parts side by side, in ``_prepare()``,
    and values at queries in ``_evaluate(queries, factor)``, (q, c), with tolerances that are `factor` times the usual ones.

    Queries take the value at a point that is no farther from them than the rounding of the points, in a simplex thicker than that, if there
    is one; see `delone.Delaunay.find_simplex` with its tolerance. Of those that remain outside, those in scipy's tolerance count as inside.
    """

    _own = "_tri"

    def __init__(self, points, values, fill_value, rescale: bool):
        super().__init__(points, rescale)
        if self.tri is None:
            self.tri = spatial.Delaunay(self.points)
        self._tri = self.tri if isinstance(self.tri, spatial.Delaunay) else spatial.Delaunay._of(self.tri)
        if self._tri.furthest_site:
            raise ValueError("points: a furthest-site triangulation does not interpolate")
        self._distance = _tolerance.of_queries(self.points)
        self._given_fill = fill_value
        self.values = values

    @property
    def values(self) -> np.ndarray:
        """The values, (npoints, c): those of one point in a row.

        May be assigned: the triangulation is kept.
        """
        return self._values

    @values.setter
    def values(self, values) -> None:
        refuse_masked("values", values)
        values = np.asarray(values)
        if values.ndim == 0 or len(values) != len(self.points):
            raise ValueError("different number of values and points")
        self.values_shape = values.shape[1:]
        self.is_complex = values.dtype.kind == "c"
        self.fill_value = (complex if self.is_complex else float)(self._given_fill)
        kind = np.complex128 if self.is_complex else np.float64
        self._values = np.array(values.reshape(len(values), int(np.prod(self.values_shape))), dtype=kind, order="C")
        self._are_finite = bool(np.isfinite(self._values).all())
        self._prepare()

    @property
    def _columns(self) -> np.ndarray:
        return self._values.view(np.float64)

    @property
    def _fill(self) -> np.ndarray:
        return np.full(self._values.shape[1], self.fill_value, dtype=self._values.dtype).view(np.float64)

    def __call__(self, *args, simplex_tolerance=1.0):
        """Evaluate the interpolant at queries.

        Parameters
        ----------
        *args : (..., ndim) array_like, or ndim array_like
            The queries: one array, or ndim arrays of coordinates that broadcast against each other.
        simplex_tolerance : float, default 1.0
            Factor of the tolerances, > 0. Queries with barycentric coordinates in [-t, 1+t] of a simplex, t = 100 eps times this,
            count as inside it, and so do queries within the rounding of the points, times this.

        Returns
        -------
        ndarray
            The values: the shape of the queries, followed by that of one value.

        Raises
        ------
        RuntimeError
            If points were added to the triangulation since.
        ValueError
            If queries have another number of coordinates.
        """
        if not simplex_tolerance > 0:
            raise ValueError("simplex_tolerance must be positive")
        self._require_unchanged()
        queries, shape = self._queries(args)
        finite = np.isfinite(queries)
        if finite.all():
            result = self._evaluate(queries, float(simplex_tolerance))
        else:
            finite = finite.all(axis=1)
            result = np.tile(self._fill, (len(queries), 1))
            result[finite] = self._evaluate(queries[finite], float(simplex_tolerance))
        return np.ascontiguousarray(result).view(self._values.dtype).reshape(shape + self.values_shape)

    def _require_unchanged(self) -> None:
        if self._tri.npoints != len(self._values):
            raise RuntimeError("points were added to the triangulation since the interpolator was made")

    def _outside(self, result: np.ndarray, queries: np.ndarray, factor: float, all_are: bool = False) -> np.ndarray:
        """The numbers of the queries that are not within the tolerance of the hull. Their rows of the result are NaN, and so are those
        of others where values are NaN, unless `all_are`: then no others are."""
        unsure = np.flatnonzero(np.isnan(result[:, :1]))
        if not len(unsure) or all_are:
            return unsure
        unsure = unsure[np.isnan(result[unsure]).all(axis=1)]
        if not len(unsure):
            return unsure
        return unsure[self._tri._core.find_simplex(queries[unsure], tolerance=self._distance * factor) < 0]

    def _beyond(self, queries: np.ndarray, factor: float) -> tuple[np.ndarray, np.ndarray]:
        """For queries outside of the hull, the simplices (q,) that they are in as far as scipy's rule goes, else −1, and their
        barycentric coordinates (q, k+1)."""
        found = self._tri.find_simplex(queries, tol=TOLERANCE * factor)
        weights = np.full((len(queries), self._tri.affine_dimension + 1), np.nan)
        inside = np.flatnonzero(found >= 0)
        if len(inside):
            maps = self._tri.transform[found[inside]]
            first = np.einsum("qij,qj->qi", maps[:, :-1], queries[inside] - maps[:, -1])
            weights[inside] = np.concatenate([first, 1 - first.sum(axis=1, keepdims=True)], axis=1)
        return found, weights
