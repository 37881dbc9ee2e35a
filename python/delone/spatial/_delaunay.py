# SPDX-License-Identifier: BSD-3-Clause
"""scipy.spatial.Delaunay, exact."""
from __future__ import annotations

import math
import sys
import warnings
from functools import cached_property

import numpy as np

import delone
from delone import _core

from . import _geometry, _options
from ._base import OfPoints, as_points, qhull_error


# A transform is left out (NaN) if fewer than about three of its digits would mean anything; the rule of scipy.
SMALLEST_RECIPROCAL_CONDITION = 1000 * sys.float_info.epsilon


# How far beyond a facet, in barycentric coordinates, a point still counts as inside; that of scipy.
DEFAULT_TOLERANCE = 100 * sys.float_info.epsilon


# Queries from which on those outside of the bounding box are sorted out first: of few, one walk is as fast.
MANY_QUERIES = 64

# The most facets of the convex hull, and numbers for all pairs of a facet and a point, for which half-spaces are kept; the most
# facets for which many queries are compared with them.
MOST_FACETS, MOST_PRODUCTS, FEW_FACETS = 1024, 1_000_000, 128


def _reach(tol: float, dimension: int, diameter: float) -> float:
    """A bound on the distance from a simplex of at most this diameter to points that it accepts: a combination of its vertices.
    Setting negative coordinates to 0 moves it by at most twice their sum times the diameter."""
    return 2.1 * (dimension + 1) * tol * min(diameter, 1e300) + 1e-300


class _Search:
    """What the search for accepting simplices needs: which simplices are thin, the largest diameter of those that are not thin,
    and half-spaces outside of which no point is near the hull."""

    def __init__(self, transform: np.ndarray, core, neighbors: np.ndarray):
        self.is_thin = np.isnan(transform[:, 0, 0])
        self.has_thin = bool(self.is_thin.any())
        points = core.points
        self.diameter = 0.0
        with np.errstate(over="ignore"):
            for begin in range(0, len(transform), 100_000):
                corners = points[core.cells[begin:begin + 100_000][~self.is_thin[begin:begin + 100_000]]]
                if len(corners):  # the diagonal of the bounding box
                    self.diameter = max(self.diameter, float(np.sqrt(np.square(np.ptp(corners, axis=1)).sum(axis=1)).max()))
        broad = math.sqrt(DEFAULT_TOLERANCE) if self.has_thin else DEFAULT_TOLERANCE
        self._default_reach = _reach(broad, points.shape[1], self.diameter)
        self._normals = self._offsets = None
        simplex, opposite = np.nonzero((neighbors == -1) & ~self.is_thin[:, None])
        if 0 < len(simplex) <= MOST_FACETS and len(simplex) * len(points) <= MOST_PRODUCTS:
            self._keep_half_spaces(transform[simplex, :-1], opposite, points)

    def _keep_half_spaces(self, maps: np.ndarray, opposite: np.ndarray, points: np.ndarray) -> None:
        """Those of the facets of simplices, with the gradients of their barycentric coordinates as normals. The offset of each is
        such that all points are within it, however the normal was rounded."""
        with np.errstate(all="ignore"):
            gradients = np.concatenate([maps, -maps.sum(axis=1, keepdims=True)], axis=1)[np.arange(len(maps)), opposite]
            normals = -gradients / np.linalg.norm(gradients, axis=1, keepdims=True)
            offsets = (points @ normals.T).max(axis=0)
            self._rounding = 1e-14 * points.shape[1] * float(np.abs(points).max())
        if np.isfinite(normals).all() and self._rounding < 1e280:
            self._normals, self._offsets = normals, offsets

    def near(self, queries: np.ndarray, reach: float) -> np.ndarray:
        """The numbers of all queries, near the bounding box, that may be within this distance of the hull, and perhaps of others."""
        if self._normals is None or len(self._normals) > FEW_FACETS and len(queries) >= MANY_QUERIES:
            return np.arange(len(queries))
        beyond = queries @ self._normals.T
        beyond -= self._offsets
        return np.flatnonzero(beyond.max(axis=1) <= reach + self._rounding)

    def is_far(self, query: np.ndarray) -> bool:
        """Whether no simplex accepts the query, of numbers below 2**900, within the default tolerance; False if half-spaces do not
        tell."""
        return self._normals is not None and (self._normals @ query - self._offsets).max() > self._default_reach + self._rounding


class Delaunay(OfPoints):
    """Delaunay triangulation in any dimension, with the interface of `scipy.spatial.Delaunay`.

    Exact: a function of the set of points, with ties broken consistently; see docs/degeneracy.md.

    Parameters
    ----------
    points : (npoints, ndim) array_like
        The points, finite numbers. Duplicates are merged.
    furthest_site : bool, default False
        Compute the dual of the furthest-site Voronoi diagram: the upper hull of the lifted points.
    incremental : bool, default False
        Allow `add_points`.
    qhull_options : str, optional
        Qhull's options, see docs/from-qhull.md. Default "Qbb Qc Qz".
    flat : {'error', 'result'}, optional
        For flat input, points that span less than the space: raise QhullError as in scipy, or triangulate within the flat. With 'result' points in one
        dimension are allowed, too. Default 'error', with option QJ 'result'. Not in scipy.

    Attributes
    ----------
    ndim : int
        The number of coordinates.
    npoints : int
        The number of points.
    min_bound : (ndim,) ndarray of float64
        The lower corner of the bounding box.
    max_bound : (ndim,) ndarray of float64
        The upper corner of the bounding box.
    affine_dimension : int
        The dimension k of the smallest flat that contains all points. Not in scipy.
    simplices : (nsimplex, ndim+1) ndarray of int32
        Rows of points: counterclockwise in the plane, increasing otherwise. For flat input k+1 columns.
    nsimplex : int
        The number of simplices.
    neighbors : (nsimplex, ndim+1) ndarray of int32
        The simplex opposite each vertex; -1 on the boundary.
    furthest_site : bool
        Whether it is a furthest-site triangulation.

    Raises
    ------
    QhullError
        If the input is flat and `flat` is 'error', or a coordinate is infinite.
    ValueError
        If a coordinate is NaN, an option has no meaning here, or an argument is out of range.

    See Also
    --------
    delone.Delaunay : The interface of delone, with more answers.

    Notes
    -----
    Results cannot be assigned; arrays are the caller's to change, and changes affect nothing else.
    Cost: that of `delone.Delaunay`. The properties are computed on first use.

    Examples
    --------
    >>> from delone.spatial import Delaunay
    >>> tri = Delaunay([[0, 0], [1, 0], [0, 1], [1, 1]])
    >>> len(tri.simplices)
    2
    >>> tri.find_simplex([[0.1, 0.2], [2, 2]]) >= 0
    array([ True, False])
    """

    _derived = ("simplices", "neighbors", "nsimplex", "affine_dimension", "convex_hull", "coplanar", "good", "_paraboloid",
                "transform", "equations", "vertex_to_simplex", "vertex_neighbor_vertices", "_search", "_box", "_own", "_is_unsure")

    def __init__(self, points, furthest_site=False, incremental=False, qhull_options=None, *, flat=None):
        points = as_points(points)
        self._options = _options.parse(qhull_options, kind="delaunay", furthest_site=furthest_site, incremental=incremental)
        self._set(furthest_site=self._options.furthest)
        self._start(points, incremental, flat)

    @classmethod
    def _of(cls, core):
        """The `delone.Delaunay` core with these attributes; the object refers to it."""
        if core.num_points != core.num_rows:
            raise ValueError("points: rows were removed from the triangulation; compact_ids() makes one without gaps")
        self = cls.__new__(cls)
        self._options, self._flat, self._core = _options.parse(None, kind="delaunay"), "result", core
        self._set(furthest_site=False)
        self._set_points(core.points)
        self._update()
        return self

    def _rebuild(self, points):
        self._core = (delone.FurthestSite if self._options.furthest else delone.Delaunay)(points)

    def _extend(self, rows):
        self._core.insert_range(rows)

    def _update(self):
        simplices, neighbors = self._listed()
        self._take_over(simplices=simplices, neighbors=neighbors, nsimplex=len(simplices), affine_dimension=self._core.affine_dimension)

    def _listed(self) -> tuple[np.ndarray, np.ndarray]:
        """simplices and neighbors, new arrays."""
        return _geometry.listed(self._core.cells, self._core.neighbors, self.ndim)

    def _need_full_dimension(self, what: str) -> None:
        if self.affine_dimension < self.ndim:
            raise qhull_error(f"{what}: the points span a flat of dimension {self.affine_dimension} in {self.ndim} dimensions")

    @cached_property
    def good(self) -> np.ndarray:
        """Ones, (nsimplex,) int32."""
        return np.ones(self.nsimplex, np.intc)

    @cached_property
    def coplanar(self) -> np.ndarray:
        """Duplicate rows, (ncoplanar, 3) int32: the row, a simplex, and the vertex at the same place.

        Empty if the options leave out Qc.
        """
        duplicates = self._core.duplicates
        if not self._options.keep_coplanar:
            duplicates = duplicates[:0]
        row, vertex = duplicates.T
        return np.stack([row, self._core.cell_of_point[row], vertex], axis=1).astype(np.intc)

    @cached_property
    def _paraboloid(self) -> tuple[float, float]:
        return _geometry.paraboloid(self._points, self._options.scaled, self._options.at_infinity)

    @property
    def paraboloid_scale(self) -> float:
        """The factor of the last coordinate of lifted points."""
        return self._paraboloid[0]

    @property
    def paraboloid_shift(self) -> float:
        """The number added to the last coordinate of lifted points."""
        return self._paraboloid[1]

    @cached_property
    def transform(self) -> np.ndarray:
        """Affine maps to barycentric coordinates, (nsimplex, ndim+1, ndim) float64.

        All but the last barycentric coordinate of x in simplex i are ``transform[i, :ndim] @ (x - transform[i, ndim])``. NaN for
        simplices so thin that fewer than three digits would be right. Raises QhullError for flat input.
        """
        self._need_full_dimension("transform")
        transform, condition = _core._transforms(self._core.points, self._own[0])
        with np.errstate(invalid="ignore"):
            transform[~(condition * SMALLEST_RECIPROCAL_CONDITION <= 1)] = np.nan
        return transform

    @cached_property
    def equations(self) -> np.ndarray:
        """Hyperplanes of the simplices on the paraboloid, (nsimplex, ndim+2) float64.

        Unit normal, downward (upward for furthest sites), and offset. Raises QhullError for flat input.
        """
        self._need_full_dimension("equations")
        return _geometry.hyperplanes(self._core.points, self._core.cells, *self._paraboloid, upper=self._options.furthest)

    @cached_property
    def vertex_to_simplex(self) -> np.ndarray:
        """A simplex with each point, or the earlier one it equals, as a vertex, (npoints,) int32; -1 if there is none."""
        found = np.array(self._core.cell_of_point)
        if not self._options.keep_coplanar:
            found[self._core.duplicates[:, 0]] = -1
        return found

    @cached_property
    def vertex_neighbor_vertices(self) -> tuple[np.ndarray, np.ndarray]:
        """Neighbors of each point, (indptr, indices) int32.

        The points joined to point p by an edge are ``indices[indptr[p]:indptr[p+1]]``, increasing.
        """
        indptr, indices = self._core.vertex_neighbors
        return np.array(indptr, np.intc), np.array(indices)

    @property
    def convex_hull(self) -> np.ndarray:
        """Facets of simplices without a neighbor, (nfaces, ndim) int32.

        Every facet of a simplex counts, so points within hull facets appear.
        """
        return _geometry.boundary_facets(*self._listed())

    @property
    def vertices(self) -> np.ndarray:
        """Old name of `simplices`; deprecated."""
        warnings.warn("Delaunay attribute 'vertices' is deprecated in favour of 'simplices'", DeprecationWarning, stacklevel=2)
        return self.simplices

    def find_simplex(self, xi, bruteforce=False, tol=None):
        """Find the simplex that contains each point.

        Parameters
        ----------
        xi : (..., ndim) array_like
            The points.
        bruteforce : bool, default False
            Without effect.
        tol : float, optional
            The tolerance of barycentric coordinates, >= 0. Default 100 eps, about 2.2e-14.

        Returns
        -------
        (...) ndarray of int32
            The simplices; -1 outside, and for NaN.

        Raises
        ------
        ValueError
            If points have another number of coordinates, or `tol` is negative or not finite.

        Notes
        -----
        Exact for points in a simplex with a finite `transform`: no point inside is missed, and a point on a face of several
        simplices gets one of them. Otherwise, outside or in a simplex so thin that its transform is NaN, a point gets a simplex with
        a finite transform that accepts it, if any: its barycentric coordinates are in [-tol, 1+tol], or from -sqrt(tol) on across
        facets to simplices whose transform is NaN. This is scipy's rule, so every point that scipy finds is found. If none accepts
        it, a point in a thin simplex gets that one. Cost: a walk per point; for points outside and in thin simplices a search.

        Examples
        --------
        >>> from delone.spatial import Delaunay
        >>> Delaunay([[0, 0], [1, 0], [0, 1]]).find_simplex([[0.2, 0.2], [1, 1]])
        array([ 0, -1], dtype=int32)
        """
        if tol is None:  # most single queries are in a simplex that needs no more
            found = self._core._find_one(xi)
            if found >= 0 and not self._is_unsure[found] or found == -1 and (not self._is_full or self._search.is_far(xi)):
                return np.array(found, np.intc)
        if type(xi) is not np.ndarray or xi.dtype != np.float64:
            xi = np.asanyarray(xi)
        if xi.ndim == 0 or xi.shape[-1] != self.ndim:
            raise ValueError("wrong dimensionality in xi")
        tol = DEFAULT_TOLERANCE if tol is None else float(tol)
        if not 0 <= tol < math.inf:
            raise ValueError(f"tol: a finite number >= 0, not {tol}")
        if xi.ndim == 1:
            return np.array(self._find_one(xi, tol), np.intc)
        queries = xi if xi.ndim == 2 else xi.reshape(-1, self.ndim)
        in_box = None
        if len(queries) >= MANY_QUERIES and queries.dtype == np.float64 and self._is_full:
            inside = self._in_box(queries, tol)
            in_box = None if inside.all() else np.flatnonzero(inside)
        if in_box is None:
            found = self._find_many(queries, tol)
        else:
            found = np.full(len(queries), -1, np.intc)
            found[in_box] = self._find_many(queries[in_box], tol)
        return found if xi.ndim == 2 else found.reshape(xi.shape[:-1])

    def _find_one(self, query: np.ndarray, tol: float) -> int:
        try:
            found = int(self._core.find_simplex(query))
        except delone.InputError:
            if np.isfinite(np.asarray(query, dtype=np.float64)).all():
                raise
            return -1
        if not self._is_full or found < 0 and not all(a <= x <= b for x, a, b in zip(query.tolist(), *self._box_of(tol))):
            return found
        if found < 0 or self._search.is_thin[found]:
            return int(self._find_accepting(np.asarray(query[None], dtype=np.float64), np.array([found], np.intc), tol)[0])
        return found

    def _find_many(self, queries: np.ndarray, tol: float) -> np.ndarray:
        finite = None
        try:
            found = self._core.find_simplex(queries)
        except delone.InputError:
            queries = np.asarray(queries, dtype=np.float64)
            finite = np.isfinite(queries).all(axis=1)
            found = np.full(len(queries), -1, np.intc)
            found[finite] = self._core.find_simplex(queries[finite])
        if self._is_full:
            unsure = (found < 0) | self._search.is_thin[found]
            if finite is not None:
                unsure &= finite
            if unsure.any():
                queries = np.asarray(queries, dtype=np.float64)
                if len(queries) < MANY_QUERIES:
                    unsure &= self._in_box(queries, tol)
                    if not unsure.any():
                        return found
                found[unsure] = self._find_accepting(queries[unsure], found[unsure], tol)
        return found

    @cached_property
    def _is_unsure(self) -> bytes:
        """For each simplex whether points in it may get another one."""
        return self._search.is_thin.tobytes() if self._is_full else bytes(self.nsimplex)

    @property
    def _is_full(self) -> bool:
        return self.affine_dimension == self.ndim > 0

    @cached_property
    def _own(self) -> tuple[np.ndarray, np.ndarray]:
        """`simplices` and `neighbors`, whatever the caller does to those arrays."""
        return self._listed()

    @cached_property
    def _box(self) -> tuple[list[float], list[float]]:
        """The bounding box, whatever the caller does to `min_bound` and `max_bound`."""
        lower, upper = _geometry.bounds(self._core.points)
        return lower.tolist(), upper.tolist()

    def _box_of(self, tol: float) -> tuple[list[float], list[float]]:
        """The box outside of which no simplex accepts a point."""
        lower, upper = self._box
        reach = _reach(max(tol, math.sqrt(tol)), self.ndim, math.dist(lower, upper))
        return [a - reach for a in lower], [b + reach for b in upper]

    def _in_box(self, queries: np.ndarray, tol: float) -> np.ndarray:
        lower, upper = self._box_of(tol)
        if len(queries) < MANY_QUERIES:
            return ((queries >= lower) & (queries <= upper)).all(axis=1)
        inside = np.ones(len(queries), bool)
        for x, a, b in zip(queries.T, lower, upper):
            inside &= x >= a
            inside &= x <= b
        return inside

    @cached_property
    def _search(self) -> _Search:
        return _Search(self.transform, self._core, self._own[1])

    def _find_accepting(self, queries: np.ndarray, found: np.ndarray, tol: float) -> np.ndarray:
        search = self._search
        broad = math.sqrt(tol) if search.has_thin else tol
        reach = _reach(max(broad, tol), self.ndim, search.diameter)
        near = search.near(queries, reach)
        if len(near):
            accepting = self._core._find_accepting(queries[near], self.transform, self._own[1], tol, broad, min(reach, 1e300))
            found = found.copy()
            found[near] = np.where(accepting >= 0, accepting, found[near])
        return found

    def plane_distance(self, xi):
        """Compute the signed distances of lifted points from the hyperplanes of all simplices.

        Parameters
        ----------
        xi : (..., ndim) array_like
            The points.

        Returns
        -------
        (..., nsimplex) ndarray of float64
            The distances.

        Raises
        ------
        ValueError
            If points have another number of coordinates.
        QhullError
            If the triangulated points are flat.
        """
        xi = np.asarray(xi, dtype=np.float64)
        if xi.shape[-1] != self.ndim:
            raise ValueError("xi has different dimensionality than triangulation")
        return self.lift_points(xi) @ self.equations[:, :-1].T + self.equations[:, -1]

    def lift_points(self, x):
        """Lift points to the paraboloid.

        Parameters
        ----------
        x : (..., ndim) array_like
            The points.

        Returns
        -------
        (..., ndim+1) ndarray of float64
            The points, with their (scaled) height as the last coordinate.
        """
        return _geometry.lift(np.asarray(x, dtype=np.float64), *self._paraboloid)


def tsearch(tri, xi):
    """Find the simplex that contains each point.

    Parameters
    ----------
    tri : Delaunay
        The triangulation.
    xi : (..., ndim) array_like
        The points.

    Returns
    -------
    (...) ndarray of int32
        ``tri.find_simplex(xi)``.

    Examples
    --------
    >>> from delone.spatial import Delaunay, tsearch
    >>> tsearch(Delaunay([[0, 0], [1, 0], [0, 1]]), [[0.2, 0.2]])
    array([0], dtype=int32)
    """
    return tri.find_simplex(xi)
