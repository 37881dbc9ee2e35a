# SPDX-License-Identifier: BSD-3-Clause
"""The methods that compiled classes have in Python: pictures, tables, files, meshes of other programs, and what needs NumPy only."""
from __future__ import annotations

import types

from . import _clipped_regions, _core, _density, _export, _files, _frames, _html, _periodic_faces, _plot, _polyhedra, _site_cells, _viewer
from ._transform import transform

OF = {
    _core.Triangulation: {"plot": _plot.triangulation, "_repr_html_": _html.triangulation, "to_frame": _frames.triangulation,
                          "to_html": _viewer.triangulation, "save": _files.save, "to_data": _files.to_data,
                          **_export.methods(_export.triangulation)},
    _core.Delaunay: {"site_cells": _site_cells.site_cells, "dtfe_densities": _density.dtfe_densities},
    _core.Regular: {"site_cells": _site_cells.site_cells},
    _core.PeriodicTriangulation: {"save": _files.save, "to_data": _files.to_data, "site_cells": _site_cells.periodic_site_cells,
                                 "faces": _periodic_faces.periodic_faces},
    _core.PeriodicDelaunay: {"dtfe_densities": _density.dtfe_densities},
    _core.ConvexHull: {"plot": _plot.convex_hull, "_repr_html_": _html.convex_hull, "to_frame": _frames.convex_hull,
                       "to_html": _viewer.convex_hull, "save": _files.save, "to_data": _files.to_data, **_export.methods(_export.convex_hull)},
    _core.LowerHull: {"plot": _plot.lower_hull, "_repr_html_": _html.lower_hull, "to_frame": _frames.lower_hull, "save": _files.save,
                      "to_data": _files.to_data, **_export.methods(_export.lower_hull)},
    _core.AlphaComplex: {"plot": _plot.alpha_complex, "_repr_html_": _html.alpha_complex, "to_html": _viewer.alpha_complex,
                         "save": _files.save_alpha, "to_data": _files.alpha_to_data, **_export.methods(_export.alpha_complex)},
    _core.Diagram: {"plot": _plot.diagram, "_repr_html_": _html.diagram, "to_frame": _frames.diagram, "to_html": _viewer.diagram,
                    "save": _files.save_diagram, "to_data": _files.to_data, "clipped_regions": _clipped_regions.clipped_regions,
                    **_export.methods(_export.diagram)},
    _core.HalfspaceIntersection: {"plot": _plot.intersection, "_repr_html_": _html.intersection, "to_frame": _frames.intersection,
                                  "to_html": _viewer.intersection, "save": _files.save, "to_data": _files.to_data,
                                  **_export.methods(_export.intersection)},
    _core.Polyhedron: {"_repr_html_": _html.polyhedron, "save": _polyhedra.save},
}


def attach() -> None:
    """Once, when the module is imported."""
    for owner, methods in OF.items():
        for name, function in methods.items():
            method = types.FunctionType(function.__code__, function.__globals__, name, function.__defaults__, function.__closure__)
            method.__kwdefaults__, method.__doc__ = function.__kwdefaults__, function.__doc__
            method.__qualname__, method.__module__ = f"{owner.__name__}.{name}", "delone"
            setattr(owner, name, method)
    _core.Triangulation.transform = property(transform)
