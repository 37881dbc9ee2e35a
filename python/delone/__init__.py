# SPDX-License-Identifier: BSD-3-Clause
"""Exact Delaunay and regular triangulations, convex hulls, intersections of halfspaces, polyhedra, Voronoi and power diagrams.

Arguments and results are NumPy arrays. Results are exact functions of the input: flat, duplicate and cospherical points are
ordinary input, and no tolerance decides anything unless one is given. `delone.spatial` and `delone.interpolate` have the names
and arguments of their scipy counterparts; `patch_scipy` makes existing programs use them. `delone.tiles` is for more points
than memory holds.

In docstrings n is the number of input rows, d the number of coordinates, k <= d the dimension of the smallest flat that
contains all points, and m the number of cells. Rows and cells are numbered from 0; -1 stands for none.
"""
import importlib as _importlib

from ._core import (AlphaComplex, CancelledError, ConvexHull, Delaunay, Error, Faces, Forecast, FurthestSite, FurthestVoronoi, HalfspaceIntersection, InputError,
                    LinearInterpolator, LowerHull, NaturalNeighborInterpolator, OutOfMemoryError, PeriodicDelaunay, PeriodicLinearInterpolator,
                    PeriodicNaturalNeighborInterpolator, PeriodicRegular, Polyhedron, PowerDiagram, Regular, TimeLimitError, TrimResult,
                    Voronoi, __version__, estimate, forecast, natural_neighbors)
from ._changes import Changes
from ._clipped_regions import ClippedRegions
from ._convex_hulls import ConvexHulls, convex_hulls
from ._data import ComplexData, Data, HullData, IntersectionData, VoronoiData
from ._density import dtfe_density
from ._files import CheckReport, check, generate, lower_hull, read, write_points
from ._locations import Locations
from ._methods import attach as _attach
from ._missing import attach as _attach_missing
from ._neighbor_changes import NeighborChanges, changed_neighbors
from ._patch import patch_scipy, scipy_is_patched, unpatch_scipy
from ._periodic_faces import PeriodicFaces
from ._polyhedra import Optimum, PolyhedraIntersection, PolyhedraVertices, intersections, polyhedra_vertices, read_polyhedron, union_volume
from ._shaped_cells import ball_halfspaces, cylinder_halfspaces, lloyd, prescribed_volumes
from ._site_cells import SiteCells, coordination

__all__ = ["AlphaComplex", "CancelledError", "Changes", "CheckReport", "ClippedRegions", "ComplexData", "ConvexHull", "ConvexHulls", "Data", "Delaunay", "Error", "Faces",
           "Forecast", "FurthestSite", "FurthestVoronoi", "HalfspaceIntersection", "HullData", "InputError", "IntersectionData", "LinearInterpolator", "Locations",
           "LowerHull", "NaturalNeighborInterpolator", "NeighborChanges", "Optimum", "OutOfMemoryError", "PeriodicDelaunay", "PeriodicFaces", "PeriodicLinearInterpolator",
           "PeriodicNaturalNeighborInterpolator", "PeriodicRegular", "PolyhedraIntersection", "PolyhedraVertices", "Polyhedron", "PowerDiagram", "Regular", "SiteCells", "TimeLimitError",
           "TrimResult", "Voronoi", "VoronoiData", "__version__", "ball_halfspaces", "changed_neighbors", "check", "convex_hulls", "coordination", "cylinder_halfspaces", "dtfe_density", "estimate", "forecast",
           "generate", "intersections", "lloyd", "lower_hull", "natural_neighbors",
           "patch_scipy", "polyhedra_vertices", "prescribed_volumes", "read", "read_polyhedron", "scipy_is_patched", "union_volume", "unpatch_scipy", "write_points"]

for _name in __all__:
    if getattr(globals()[_name], "__module__", "").startswith(("delone._core", "delone._changes", "delone._clipped_regions", "delone._convex_hulls", "delone._data", "delone._density", "delone._files", "delone._neighbor_changes", "delone._periodic_faces", "delone._polyhedra", "delone._shaped_cells", "delone._site_cells")):
        globals()[_name].__module__ = "delone"
del _name
_attach()
_attach_missing()


def __getattr__(name):
    if name in ("interpolate", "spatial", "tiles"):
        return _importlib.import_module("." + name, __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
