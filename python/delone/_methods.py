# SPDX-License-Identifier: BSD-3-Clause
"""The methods that compiled classes have in Python: pictures, tables, meshes of other programs, and what needs NumPy only."""
from __future__ import annotations

from . import _core, _export, _frames, _html, _plot, _viewer
from ._transform import transform

OF = {
    _core.Triangulation: {"plot": _plot.triangulation, "_repr_html_": _html.triangulation, "to_frame": _frames.triangulation,
                          "mesh": _export.triangulation, "to_html": _viewer.triangulation},
    _core.ConvexHull: {"plot": _plot.convex_hull, "_repr_html_": _html.convex_hull, "to_frame": _frames.convex_hull, "mesh": _export.convex_hull,
                       "to_html": _viewer.convex_hull},
    _core.Diagram: {"plot": _plot.diagram, "_repr_html_": _html.diagram, "to_frame": _frames.diagram, "mesh": _export.diagram,
                    "to_html": _viewer.diagram},
    _core.HalfspaceIntersection: {"plot": _plot.intersection, "_repr_html_": _html.intersection, "mesh": _export.intersection,
                                 "to_html": _viewer.intersection},
}


def attach() -> None:
    """Once, when the module is imported."""
    for owner, methods in OF.items():
        mesh = methods.pop("mesh")
        methods.update({name: _export.method(mesh, name) for name in _export.TARGETS})
        for name, method in methods.items():
            method.__name__, method.__qualname__, method.__module__ = name, f"{owner.__name__}.{name}", "delone"
            setattr(owner, name, method)
    _core.Triangulation.transform = property(transform)
