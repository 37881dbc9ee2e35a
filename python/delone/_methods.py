# SPDX-License-Identifier: BSD-3-Clause
"""The methods that compiled classes have in Python: pictures, tables, meshes of other programs, and what needs NumPy only."""
from __future__ import annotations

from . import _core, _export, _frames, _html, _plot
from ._transform import transform


def _methods_of(kind: str):
    """The modules have functions of the same name for each kind of result."""
    methods = {"plot": getattr(_plot, kind), "_repr_html_": getattr(_html, kind), "to_frame": getattr(_frames, kind, None)}
    methods.update({name: _export.method(getattr(_export, kind), name) for name in _export.TARGETS})
    return {name: method for name, method in methods.items() if method}


def attach() -> None:
    for owner, kind in ((_core.Triangulation, "triangulation"), (_core.ConvexHull, "convex_hull"), (_core.Diagram, "diagram"),
                        (_core.HalfspaceIntersection, "intersection")):
        for name, method in _methods_of(kind).items():
            method.__name__, method.__qualname__, method.__module__ = name, f"{owner.__name__}.{name}", "delone"
            setattr(owner, name, method)
    _core.Triangulation.transform = property(transform)
