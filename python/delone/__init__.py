# SPDX-License-Identifier: BSD-3-Clause
"""Exact Delaunay and regular triangulations, convex hulls, intersections of halfspaces, Voronoi and power diagrams.

Arrays go in and come out as NumPy arrays. Results are exact functions of the input: flat, duplicate and cospherical points are
ordinary input, and no tolerance decides anything unless one is given. `delone.spatial` and `delone.interpolate` have the names and
arguments of those in scipy; `patch_scipy` makes existing programs use them. `delone.tiles` is for more points than memory holds.
"""
import importlib

from ._core import AlphaComplex, Faces
from ._core import (CancelledError, ConvexHull, Delaunay, Error, FurthestSite, HalfspaceIntersection, InputError, LinearInterpolator,
                    NaturalNeighborInterpolator, OutOfMemoryError, PowerDiagram, Regular, TrimResult, Voronoi, __version__,
                    natural_neighbors)
from ._core import Forecast, TimeLimitError, estimate, forecast
from ._convex_hulls import ConvexHulls, convex_hulls
from ._locations import Locations
from ._methods import attach as _attach
from ._patch import patch_scipy, scipy_is_patched, unpatch_scipy

__all__ = ["AlphaComplex", "CancelledError", "ConvexHull", "ConvexHulls", "Delaunay", "Error", "Faces", "Forecast", "FurthestSite", "HalfspaceIntersection", "InputError",
           "LinearInterpolator", "Locations", "NaturalNeighborInterpolator", "OutOfMemoryError", "PowerDiagram", "Regular",
           "TimeLimitError", "TrimResult", "Voronoi", "__version__", "convex_hulls", "estimate", "forecast", "natural_neighbors", "patch_scipy", "scipy_is_patched",
           "unpatch_scipy"]

for _type in (AlphaComplex, Faces, ConvexHull, ConvexHulls, Delaunay, FurthestSite, HalfspaceIntersection, LinearInterpolator, NaturalNeighborInterpolator,
              PowerDiagram, Regular, TrimResult, Voronoi, natural_neighbors, Forecast, estimate, forecast):
    _type.__module__ = "delone"
del _type
convex_hulls.__module__ = "delone"
_attach()


def __getattr__(name):
    if name in ("interpolate", "spatial", "tiles"):
        return importlib.import_module("." + name, __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
