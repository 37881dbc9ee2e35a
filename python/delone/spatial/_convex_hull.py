# SPDX-License-Identifier: BSD-3-Clause
"""scipy.spatial.ConvexHull, exact."""
from __future__ import annotations

from functools import cached_property

import numpy as np

import delone
from delone import _core

from . import _geometry, _options, _tolerance
from ._base import OfPoints, as_points, qhull_error, refuse_state_of_scipy


class ConvexHull(OfPoints):
    """Convex hull in any dimension, with the interface of `scipy.spatial.ConvexHull`.

    Parameters
    ----------
    points : (npoints, ndim) array_like
        The points, finite numbers. Duplicates are merged.
    incremental : bool, default False
        Allow `add_points`.
    qhull_options : str, optional
        Qhull's options, see docs/from-qhull.md.
    tolerance : float or (ndim,) array_like, optional
        The hull is the exact hull of a subset of the points; all others are at most this far outside, see `delone.ConvexHull`.
        0 is exact. One number for each axis bounds how far they are outside along that axis. By default Qhull's round-off in each
        column, about 1e-14 of its numbers, see docs/from-scipy.md; that of the first points if others are added without `restart`.
        Not in scipy.
    flat : {'error', 'result'}, optional
        For flat input, points that span less than the space: raise QhullError as in scipy, or compute the hull within the flat. With 'result' points in one
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
    simplices : (nsimplex, ndim) ndarray of int32
        The simplices of the boundary, as rows of points: counterclockwise in the plane, increasing from 3 dimensions on. Their
        vertices are extreme points, whatever else lies on the boundary. For flat input k columns.
    nsimplex : int
        The number of simplices.
    neighbors : (nsimplex, ndim) ndarray of int32
        The simplex opposite each vertex.
    tolerance : float
        The tolerance, given or computed; the largest of those of the axes. Not in scipy.
    axis_tolerances : (ndim,) ndarray of float64
        How far points may be outside along each axis. Not in scipy.

    Raises
    ------
    QhullError
        If the input is flat, exactly or within the tolerance, and `flat` is 'error', or a coordinate is infinite.
    ValueError
        If a coordinate is NaN, an option has no meaning here, or an argument is out of range.

    See Also
    --------
    delone.ConvexHull : The interface of delone, with more answers.

    Notes
    -----
    Results cannot be assigned; arrays are the caller's to change, and changes affect nothing else.

    Examples
    --------
    >>> from delone.spatial import ConvexHull
    >>> hull = ConvexHull([[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]])
    >>> hull.vertices
    array([0, 1, 2, 3], dtype=int32)
    >>> hull.volume, hull.area
    (4.0, 8.0)
    """

    _derived = ("simplices", "neighbors", "nsimplex", "affine_dimension", "volume", "area", "_shown", "vertices", "equations", "coplanar",
                "good", "_extreme", "_rows")
    _read_only = OfPoints._read_only | {"tolerance", "axis_tolerances"}

    def __init__(self, points, incremental=False, qhull_options=None, *, tolerance=None, flat=None):
        points = as_points(points)
        self._set(_options=_options.parse(qhull_options, kind="hull", incremental=incremental), _wanted_tolerance=tolerance)
        if self._options.good_row is not None and self._options.good_row >= len(points):
            raise ValueError(f"Qhull option {_core._represented(f'QG{self._options.good_row}')}: there are {len(points)} points")
        self._start(points, incremental, flat)

    def _without_good_row(self, rows):
        good = self._options.good_row
        return rows if good is None else np.delete(rows, good, axis=0)

    def _rebuild(self, points):
        points = self._without_good_row(points)
        if self._wanted_tolerance is None:
            box = (self.min_bound, self.max_bound) if points is self.__dict__.get("_points") else None
            rounding = _tolerance.Rounding(points, self._options, box)
            core, rows = self._hull_of(points, np.array(rounding.of_hull()))
            of_flats = rounding.of_flats()
            vertices = core.vertices if rows is None else rows[core.vertices]
            if core.affine_dimension == self.ndim and _core._may_be_flat(points[vertices], of_flats):
                within = self._hull_of(points, np.array(of_flats))
                if within[0].affine_dimension < self.ndim:
                    core, rows = within
        else:
            core, rows = self._hull_of(points, self._wanted_tolerance)
        self._set(tolerance=core.tolerance, axis_tolerances=np.array(core.axis_tolerances), _core=core, _core_rows=rows)

    def _hull_of(self, points, tolerance):
        # A hull to which points can be added has all of them, as has one that tells of others; else extreme ones suffice.
        if self._incremental or self._options.keep_coplanar:
            return delone.ConvexHull(points, tolerance=tolerance), None
        return delone.ConvexHull.of_extreme_points(points, tolerance=tolerance)

    def _dimension_of_span(self):
        return delone.ConvexHull.of_extreme_points(self._points)[0].affine_dimension

    def _what_flattens(self):
        is_given = self._wanted_tolerance is not None or self._options.sets_tolerance
        return f"{'the tolerance of' if is_given else 'the rounding'} {self.tolerance:.2g}"

    def _extend(self, rows):
        self._core.insert_range(rows)

    def __getstate__(self):
        state = super().__getstate__()
        if self._core_rows is not None:  # made again from the points, with the same numbers of simplices
            del state["_core"], state["_core_rows"]
        return state

    def __setstate__(self, state):
        refuse_state_of_scipy(self, state, "_options")
        self.__dict__.update(state)
        if "_core" not in state:
            self._rebuild(self._points)
        self._update()

    def _num_rows(self):
        return self._core.num_points + (self._options.good_row is not None)

    def _update(self):
        core, rows = self._core, self._core_rows
        if rows is None or self._options.good_row is not None:
            every = self._without_good_row(np.arange(self.npoints, dtype=np.intc))
            rows = every if rows is None else every[rows]
        extreme = core.vertices
        sorted_rows = np.sort(rows[extreme])
        shown = core
        if self._core_rows is None and np.count_nonzero(np.bincount(core.cells.ravel())) > len(extreme):
            # Other points of the boundary are vertices of its simplices, too: the hull of the extreme points has the same boundary.
            shown, of_extreme = delone.ConvexHull.of_extreme_points(core.points[extreme])
            rows = rows[extreme][of_extreme]
        simplices, neighbors = _geometry.listed(rows[shown.cells], shown.neighbors, self.ndim)
        self._take_over(simplices=simplices, neighbors=neighbors, nsimplex=len(simplices), affine_dimension=core.affine_dimension,
                        _extreme=sorted_rows, _shown=shown, _rows=rows)

    @cached_property
    def volume(self) -> float:
        """The ndim-dimensional volume; the area in the plane. 0 for flat input."""
        return float(self._core.volume) if self.affine_dimension == self.ndim else 0.0

    @cached_property
    def area(self) -> float:
        """The (ndim-1)-dimensional volume of the boundary; the perimeter in the plane.

        For flat input its limit: twice the volume of the flat hull if k = ndim-1, else 0.
        """
        if self.affine_dimension == self.ndim:
            return float(self._core.area)
        return 2.0 * float(self._core.volume) if self.affine_dimension == self.ndim - 1 else 0.0

    def _listed(self) -> tuple[np.ndarray, np.ndarray]:
        """simplices and neighbors, new arrays."""
        return _geometry.listed(self._rows[self._shown.cells], self._shown.neighbors, self.ndim)

    @cached_property
    def vertices(self) -> np.ndarray:
        """The extreme points, exactly, (nvertices,) int32: counterclockwise in the plane, increasing otherwise."""
        if self.ndim == 2 and self.affine_dimension == 2:
            following = dict(self._listed()[0].tolist())
            around = [min(following)]
            while len(around) < len(following):
                around.append(following[around[-1]])
            return np.array(around, dtype=np.intc)
        return self._extreme.copy()

    @cached_property
    def equations(self) -> np.ndarray:
        """Unit outward normal n and offset b of the hyperplane of each simplex, (nsimplex, ndim+1) float64.

        n . x + b <= 0 inside up to rounding. Equal rows for all simplices of one facet. Raises QhullError for flat input.
        """
        if self.affine_dimension < self.ndim:
            raise qhull_error(f"equations: the hull lies in a flat of dimension {self.affine_dimension} in {self.ndim} dimensions")
        return self._shown.equations[self._shown.facet_of_cell]

    @cached_property
    def coplanar(self) -> np.ndarray:
        """Points near the boundary that are not extreme, (ncoplanar, 3) int32.

        Only with option Qc, otherwise empty: the points on the boundary or within the tolerance of it, and duplicates of vertices;
        each with a simplex and the nearest of its vertices.
        """
        if not self._options.keep_coplanar or self.affine_dimension < 1:
            return np.empty((0, 3), np.intc)
        kinds = self._core.point_kinds[self._core.vertex_of_point]
        rest = self._without_good_row(np.arange(self.npoints))
        simplices = self._listed()[0]
        chosen = ~np.isin(rest, simplices)
        rest, kinds = rest[chosen], kinds[chosen]
        cell = np.array(self._shown.locate(self._points[rest]).cell)
        near = kinds < 2  # on the boundary, or outside within the tolerance
        if self.affine_dimension == self.ndim and self.tolerance > 0:  # or inside within the tolerance: O(points · facets)
            normals, offsets = self._shown.equations[:, :-1], self._shown.equations[:, -1]
            within = np.linalg.norm(normals * self.axis_tolerances, axis=1)
            first = np.unique(self._shown.facet_of_cell, return_index=True)[1]
            step = max(1, 1_000_000 // len(offsets))
            inside = np.flatnonzero(~near)
            for part in (inside[begin:begin + step] for begin in range(0, len(inside), step)):
                distances = self._points[rest[part]] @ normals.T + offsets
                near[part] = (distances >= -within).any(axis=1)
                cell[part] = first[distances.argmax(axis=1)]
        rest, cell = rest[near], cell[near]
        corners = simplices[cell]
        distances = np.linalg.norm(self._points[corners] - self._points[rest][:, None, :], axis=2)
        nearest = np.take_along_axis(corners, distances.argmin(axis=1)[:, None], axis=1)[:, 0]
        return np.stack([rest, cell, nearest], axis=1).astype(np.intc)

    @cached_property
    def good(self):
        """Whether each simplex is strictly visible from point n, (nsimplex,) bool.

        Only with option QGn, which leaves point n out of the hull; otherwise None.
        """
        if self._options.good_row is None:
            return None
        seen = self._shown.visible_facets(self._points[self._options.good_row])
        return np.isin(self._shown.facet_of_cell, seen) == self._options.good_visible
