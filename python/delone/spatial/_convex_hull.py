# SPDX-License-Identifier: BSD-3-Clause
"""scipy.spatial.ConvexHull, exact."""
from __future__ import annotations

from functools import cached_property

import numpy as np

import delone
from delone import _core

from . import _geometry, _options, _tolerance
from ._base import OfPoints, as_points, qhull_error


class ConvexHull(OfPoints):
    """Convex hull in any dimension, with the arguments and attributes of `scipy.spatial.ConvexHull`.

    Parameters
    ----------
    points : (npoints, ndim) finite floats
        The points. Duplicates are merged.
    incremental : bool
        Allow `add_points`.
    qhull_options : str, optional
        Qhull's options, see docs/from-qhull.md; ValueError for one that has no meaning here.
    tolerance : float, keyword only
        The hull is the exact one of a subset of the points; all others are at most this far outside, see `delone.ConvexHull`. By
        default Qhull's round-off, about 1e-14 of the extent, see docs/from-scipy.md; that of the first points, if others are added
        without ``restart``. 0 is exact. ValueError if it is negative, not finite, or larger than the extent. (Not in scipy.)
    flat : "error" or "result", keyword only
        Flat input, points that span less than the space: QhullError as in scipy, or the hull within its flat; so are points in one
        dimension, else a ValueError. Default "error", with option QJ "result". (Not in scipy.)

    Attributes
    ----------
    points, ndim, npoints, min_bound, max_bound
        The points, d, their number, and their bounding box.
    vertices : (nvertices,) int32
        The extreme points, exactly: counterclockwise in the plane, increasing otherwise.
    simplices : (nsimplex, ndim) int32
        Rows of points, the simplices of the boundary, increasing from 3 dimensions on; counterclockwise in the plane. Their
        vertices are extreme points, whatever else lies on the boundary. For flat input of affine dimension k, k columns.
    neighbors : (nsimplex, ndim) int32
        The simplex opposite each vertex.
    affine_dimension : int
        k, of the smallest flat that contains all points (not in scipy).
    volume, area : float
        The ndim-dimensional volume and the (ndim−1)-dimensional volume of the boundary; in the plane, area and perimeter. Of
        flat input the volume is 0, and the area twice that of the flat hull if k = ndim−1, else 0: the limits.
    coplanar : (ncoplanar, 3) int32
        With option Qc: the points of the boundary, or within the tolerance of it, that are not extreme, and the duplicates of vertices,
        each with a simplex and the nearest of its vertices.
    good : (nsimplex,) bool or None
        With option QGn: whether each simplex is strictly visible from point n, which is left out of the hull.
    tolerance : float
        The one that was given or computed (not in scipy).

    Results cannot be assigned; an array is the caller's to change, and changes nothing else.
    """

    _derived = ("simplices", "neighbors", "nsimplex", "affine_dimension", "volume", "area", "_shown", "vertices", "equations", "coplanar",
                "good", "_extreme", "_rows")
    _read_only = OfPoints._read_only | {"tolerance"}

    def __init__(self, points, incremental=False, qhull_options=None, *, tolerance=None, flat=None):
        points = as_points(points)
        self._options = _options.parse(qhull_options, kind="hull", incremental=incremental)
        if self._options.good_row is not None and self._options.good_row >= len(points):
            raise ValueError(f"Qhull option {_core._represented(f'QG{self._options.good_row}')}: there are {len(points)} points")
        self._wanted_tolerance = tolerance
        self._start(points, incremental, flat)

    def _without_good_row(self, rows):
        good = self._options.good_row
        return rows if good is None else np.delete(rows, good, axis=0)

    def _rebuild(self, points):
        points = self._without_good_row(points)
        tolerance = self._wanted_tolerance
        if tolerance is None:
            box = (self.min_bound, self.max_bound) if points is self.__dict__.get("_points") else None
            tolerance = _tolerance.of_qhull(points, self._options, box)
        # A hull to which points can be added has all of them, as has one that tells of others; else extreme ones suffice.
        if self._incremental or self._options.keep_coplanar:
            core, rows = delone.ConvexHull(points, tolerance=tolerance), None
        else:
            core, rows = delone.ConvexHull.of_extreme_points(points, tolerance=tolerance)
        self._set(tolerance=tolerance, _core=core, _core_rows=rows)

    def _extend(self, rows):
        self._core.insert_range(rows)

    def __getstate__(self):
        state = super().__getstate__()
        if self._core_rows is not None:  # made again from the points, with the same numbers of simplices
            del state["_core"], state["_core_rows"]
        return state

    def __setstate__(self, state):
        self.__dict__.update(state)
        if "_core" not in state:
            self._rebuild(self._points)
        self._update()

    def _num_rows(self):
        return self._core.num_points + (self._options.good_row is not None)

    def _update(self):
        rows = self._without_good_row(np.arange(self.npoints, dtype=np.intc))
        core = self._core
        if self._core_rows is not None:
            rows = rows[self._core_rows]
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
        return float(self._core.volume) if self.affine_dimension == self.ndim else 0.0

    @cached_property
    def area(self) -> float:
        if self.affine_dimension == self.ndim:
            return float(self._core.area)
        return 2.0 * float(self._core.volume) if self.affine_dimension == self.ndim - 1 else 0.0

    def _listed(self) -> tuple[np.ndarray, np.ndarray]:
        """simplices and neighbors, new arrays."""
        return _geometry.listed(self._rows[self._shown.cells], self._shown.neighbors, self.ndim)

    @cached_property
    def vertices(self) -> np.ndarray:
        if self.ndim == 2 and self.affine_dimension == 2:
            following = dict(self._listed()[0].tolist())
            around = [min(following)]
            while len(around) < len(following):
                around.append(following[around[-1]])
            return np.array(around, dtype=np.intc)
        return self._extreme.copy()

    @cached_property
    def equations(self) -> np.ndarray:
        """(nsimplex, ndim+1): unit outward normal n and offset b of the hyperplane of each simplex, n·x + b ≤ 0 inside up to rounding;
        the same row for all simplices of one facet. Raises QhullError for flat input."""
        if self.affine_dimension < self.ndim:
            raise qhull_error(f"equations: the points span a flat of dimension {self.affine_dimension} in {self.ndim} dimensions")
        return self._shown.equations[self._shown.facet_of_cell]

    @cached_property
    def coplanar(self) -> np.ndarray:
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
            first = np.unique(self._shown.facet_of_cell, return_index=True)[1]
            step = max(1, 1_000_000 // len(offsets))
            inside = np.flatnonzero(~near)
            for part in (inside[begin:begin + step] for begin in range(0, len(inside), step)):
                distances = self._points[rest[part]] @ normals.T + offsets
                near[part] = distances.max(axis=1) >= -self.tolerance
                cell[part] = first[distances.argmax(axis=1)]
        rest, cell = rest[near], cell[near]
        corners = simplices[cell]
        distances = np.linalg.norm(self._points[corners] - self._points[rest][:, None, :], axis=2)
        nearest = np.take_along_axis(corners, distances.argmin(axis=1)[:, None], axis=1)[:, 0]
        return np.stack([rest, cell, nearest], axis=1).astype(np.intc)

    @cached_property
    def good(self):
        if self._options.good_row is None:
            return None
        seen = self._shown.visible_facets(self._points[self._options.good_row])
        return np.isin(self._shown.facet_of_cell, seen) == self._options.good_visible
