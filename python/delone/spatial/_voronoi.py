# SPDX-License-Identifier: BSD-3-Clause
"""scipy.spatial.Voronoi, exact."""
from __future__ import annotations

from functools import cached_property

import numpy as np

import delone
from delone import _core

from . import _options, _tolerance
from ._base import OfPoints, as_points


class Voronoi(OfPoints):
    """Voronoi diagram in any dimension, with the arguments and attributes of `scipy.spatial.Voronoi`.

    Parameters
    ----------
    points : (npoints, ndim) finite floats
        The points. Duplicates share a region.
    furthest_site : bool
        The diagram of the furthest instead of the nearest points.
    incremental : bool
        Allow `add_points`.
    qhull_options : str, optional
        Qhull's options, see docs/from-qhull.md; ValueError for one that has no meaning here. Default "Qbb Qc Qz".
    tolerance : float, keyword only
        Vertices within this distance of one that stands for them are one, and ridges of less width are left out, see
        `delone.Voronoi`. By default Qhull's round-off, about 1e-14 of the extent, see docs/from-scipy.md; 0 is exact.
        ValueError if it is negative, not finite, or larger than the extent. (Not in scipy.)
    flat : "error" or "result", keyword only
        Flat input, points that span less than the space: QhullError as in scipy, or a diagram within its flat; so are points in one
        dimension, else a ValueError. Default "error", with option QJ "result". (Not in scipy.)

    Attributes
    ----------
    points, ndim, npoints, min_bound, max_bound
        The points, d, their number, and their bounding box.
    vertices : (nvertices, ndim) float64
        The distinct Voronoi vertices, each coordinate the double nearest to the exact one.
    affine_dimension : int
        k, of the smallest flat that contains all points (not in scipy).
    ridge_points : (nridges, 2) int32
        The points on both sides of each ridge. As in scipy, ridges with fewer than k vertices, infinity counted as one, are left
        out; `delone.Voronoi` has them all.
    ridge_vertices : list of lists of int
        The vertices of each ridge, −1 first if it is unbounded; in cyclic order in 3 dimensions.
    regions : list of lists of int
        The vertices of each region, −1 first if it is unbounded; in cyclic order in the plane. With option Qz, which the default
        has, the last one is empty, as in scipy. So are those of points that are not the furthest anywhere.
    point_region : (npoints,) int64
        The region of each point. Duplicates have −1 if the options leave out Qc.
    ridge_dict : dict
        The vertices of the ridge between two points.
    furthest_site : bool
    tolerance : float
        The one that was given or computed (not in scipy).

    Results cannot be assigned; an array is the caller's to change, and changes nothing else.
    """

    _derived = ("vertices", "ridge_points", "ridge_vertices", "regions", "point_region", "ridge_dict", "affine_dimension", "tolerance",
                "_num_hidden", "_listed_ridges", "_ridges", "_regions", "_ray_points", "_ray_directions")
    _read_only = OfPoints._read_only | {"tolerance"}

    def __init__(self, points, furthest_site=False, incremental=False, qhull_options=None, *, tolerance=None, flat=None):
        points = as_points(points)
        self._options = _options.parse(qhull_options, kind="voronoi", furthest_site=furthest_site, incremental=incremental)
        self._set(furthest_site=self._options.furthest)
        self._wanted_tolerance = tolerance
        self._start(points, incremental, flat)

    def _rebuild(self, points):
        self._core = (delone.FurthestSite if self._options.furthest else delone.Delaunay)(points)

    def _extend(self, rows):
        self._core.insert_range(rows)

    def _update(self):
        tolerance = self._wanted_tolerance
        tolerance = _tolerance.of_qhull(self._points, self._options) if tolerance is None else tolerance
        diagram = delone.Voronoi(self._core, tolerance)
        point_region = diagram.point_region.astype(np.intp)
        hidden = np.flatnonzero(point_region == -1)
        point_region[hidden] = diagram.num_regions + np.arange(len(hidden))
        if not self._options.keep_coplanar:
            point_region[self._core.duplicates[:, 0]] = -1
        # As in scipy, where infinity counts as one vertex, ridges with fewer than k vertices are left out: the cones at one vertex,
        # and the like, that are dual to edges of the convex hull with few cells about them.
        counts = np.diff(diagram.ridge_offsets)
        listed = np.flatnonzero(counts >= self._core.affine_dimension)
        self._take_over(affine_dimension=self._core.affine_dimension, vertices=np.array(diagram.vertices), point_region=point_region,
                        ridge_points=diagram.ridge_points[listed], tolerance=tolerance, _num_hidden=len(hidden), _listed_ridges=listed,
                        _ridges=(diagram.ridge_vertices, diagram.ridge_offsets), _regions=(diagram.region_vertices, diagram.region_offsets),
                        _ray_points=diagram.ray_points, _ray_directions=diagram.ray_directions)
        if not self._incremental:
            del self._core

    @cached_property
    def ridge_vertices(self) -> list[list[int]]:
        ridges = _core._lists(*self._ridges)
        return [ridges[i] for i in self._listed_ridges.tolist()]

    @cached_property
    def regions(self) -> list[list[int]]:
        regions = _core._lists(*self._regions)
        regions = [[] if region == [-1] else region for region in regions] + [[] for _ in range(self._num_hidden)]
        return regions + [[]] if self._options.at_infinity else regions

    @cached_property
    def ridge_dict(self) -> dict[tuple[int, int], list[int]]:
        return dict(zip(map(tuple, self.ridge_points.tolist()), self.ridge_vertices))
