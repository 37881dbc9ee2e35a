# SPDX-License-Identifier: BSD-3-Clause
"""Exact Delaunay and regular triangulations, convex hulls, intersections of halfspaces, Voronoi and power diagrams.

Arrays go in and come out as NumPy arrays. Results are exact functions of the input: flat, duplicate and cospherical points are
ordinary input, and no tolerance decides anything unless one is given. `delone.spatial` and `delone.interpolate` have the names and
arguments of those in scipy; `patch_scipy` makes existing programs use them. `delone.tiles` is for more points than memory holds.
"""
import importlib

from ._core import (CancelledError, ConvexHull, Delaunay, Error, FurthestSite, HalfspaceIntersection, InputError, LinearInterpolator,
                    NaturalNeighborInterpolator, OutOfMemoryError, PowerDiagram, Regular, TrimResult, Voronoi, __version__,
                    natural_neighbors)
from ._convex_hulls import ConvexHulls, convex_hulls
from ._core import LowerHull
from ._data import ComplexData, Data, HullData, IntersectionData, VoronoiData
from ._files import CheckReport, check, generate, lower_hull, read
from ._locations import Locations
from ._patch import patch_scipy, scipy_is_patched, unpatch_scipy
from ._transform import transform as _transform

__all__ = ["CancelledError", "ConvexHull", "ConvexHulls", "Delaunay", "Error", "FurthestSite", "HalfspaceIntersection", "InputError",
           "LinearInterpolator", "Locations", "NaturalNeighborInterpolator", "OutOfMemoryError", "PowerDiagram", "Regular",
           "TrimResult", "Voronoi", "__version__", "convex_hulls", "natural_neighbors", "patch_scipy", "scipy_is_patched",
           "unpatch_scipy"]
__all__ += ["CheckReport", "ComplexData", "Data", "HullData", "IntersectionData", "LowerHull", "VoronoiData", "check", "generate",
            "lower_hull", "read"]

for _type in (CheckReport, ComplexData, Data, HullData, IntersectionData, LowerHull, VoronoiData, check, generate, lower_hull, read):
    _type.__module__ = "delone"
for _type in (ConvexHull, ConvexHulls, Delaunay, FurthestSite, HalfspaceIntersection, LinearInterpolator, NaturalNeighborInterpolator,
              PowerDiagram, Regular, TrimResult, Voronoi, natural_neighbors):
    _type.__module__ = "delone"
del _type
convex_hulls.__module__ = "delone"
Delaunay.__base__.transform = property(_transform)


def __getattr__(name):
    if name in ("interpolate", "spatial", "tiles"):
        return importlib.import_module("." + name, __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
