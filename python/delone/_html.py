# SPDX-License-Identifier: BSD-3-Clause
"""What notebooks show of a result: the figures that matter, and a small picture (SVG) of a sample. Neither Matplotlib nor a pass over all
points is needed, so that it is fast."""
from __future__ import annotations

import itertools

import numpy as np

from ._clipping import corners_of_regions, polygons_of_regions

CORNERS = 2100  # of all shapes in a picture: about 15 kB
SIZE, MARGIN = 260, 8  # of the picture, in pixels
TURN = np.array([[0.82, -0.57, 0.0], [0.26, 0.38, 0.89]])  # a view from above: three coordinates to two


def safely(describe):
    """The method `_repr_html_`. It never raises: without HTML notebooks show what repr() says."""

    def _repr_html_(self):
        """A small picture and the main figures, for notebooks."""
        try:
            with np.errstate(all="ignore"):
                return describe(self)
        except Exception:  # an object that another thread changes, memory that runs out, …
            return None
    return _repr_html_


def page(name, figures, picture, drawn):
    """A table beside a picture. `figures`: names and numbers, of which None are left out."""
    rows = "".join(f"<tr><th style='text-align:left;font-weight:normal'>{label}</th><td style='text-align:right'>{_shown(value)}</td></tr>"
                   for label, value in figures if value is not None)
    caption = f"<div style='font-size:85%;opacity:.7'>{drawn}</div>" if drawn else ""
    return (f"<div style='display:flex;gap:1.5em;align-items:center'>{picture}<div><b>delone.{name}</b><table>{rows}</table>{caption}</div></div>")


def _shown(value):
    if isinstance(value, (int, np.integer)):
        return f"{value:,}".replace(",", " ")
    return f"{value:.6g}" if isinstance(value, float) else str(value)


class Picture:
    """Shapes in a square, by the first coordinates of what they are: two as they are, three seen from above."""

    def __init__(self, low, high):
        self.low, self.high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
        seen = 3 if len(self.low) == 3 else 2
        corners = self._flat(np.array(list(itertools.product(*zip(self.low[:seen], self.high[:seen])))))
        self.first, last = corners.min(axis=0), corners.max(axis=0)
        extent = (last - self.first).max()
        self.scale = (SIZE - 2 * MARGIN) / extent if extent > 0 else 1.0
        self.offset = (SIZE - (last - self.first) * self.scale) / 2
        self.parts = []

    @staticmethod
    def _flat(x):
        """Two coordinates of points (…, d)."""
        if x.shape[-1] == 1:
            return np.concatenate([x, np.zeros_like(x)], axis=-1)
        return x[..., :3] @ TURN.T if x.shape[-1] == 3 else x[..., :2]

    def pixels(self, x):
        flat = (self._flat(x) - self.first) * self.scale + self.offset
        flat[..., 1] = SIZE - flat[..., 1]
        return np.clip(np.nan_to_num(flat), -SIZE, 2 * SIZE).round().astype(int)

    def shapes(self, polygons, is_closed, **look):
        """Polygons or lines, (s, corners, d) or a list of arrays, as one path."""
        if isinstance(polygons, np.ndarray):
            corners = self.pixels(polygons)
            steps = np.diff(corners, axis=1).reshape(len(corners), -1)
            ends = "z" if is_closed else ""
            path = "".join(f"M{x} {y}l{' '.join(map(str, rest))}{ends}" for (x, y), rest in zip(corners[:, 0].tolist(), steps.tolist()))
        else:
            path = "".join("M" + " ".join(map(str, self.pixels(polygon).ravel().tolist())) + ("z" if is_closed else "") for polygon in polygons)
        self.parts.append(f"<path d='{path}' {_attributes(look)}/>")

    def dots(self, x, **look):
        path = "".join(f"M{a} {b}h0" for a, b in self.pixels(x).tolist())
        self.parts.append(f"<path d='{path}' stroke-linecap='round' {_attributes({'stroke_width': 3, **look})}/>")

    def __str__(self):
        return f"<svg width='{SIZE}' height='{SIZE}' viewBox='0 0 {SIZE} {SIZE}' fill='none'>{''.join(self.parts)}</svg>"


def _attributes(look):
    return " ".join(f"{name.replace('_', '-')}='{value}'" for name, value in look.items())


EDGE = {"stroke": "#5b7fa6", "stroke_width": 0.7}
BORDER = {"stroke": "#c8553d", "stroke_width": 1}
FACE = {"fill": "#9fb4c7", "fill_opacity": 0.35, "stroke_linejoin": "round"}
DOTS = {"stroke": "#1f3a5f"}


def _drawn(count, of, what):
    """Says so if only some are drawn."""
    return f"{_shown(count)} of {_shown(of)} {what} drawn" if count < of else f"all {what} drawn"


def _common(self):
    flat = self.affine_dimension if self.affine_dimension != self.dimension else None
    return [("points", self.num_points), ("dimension", self.dimension), ("affine dimension", flat)]


def _seen(d):
    return f"; 2 of {d} coordinates" if d > 3 else ""


@safely
def triangulation(self):
    hidden = self.num_points - self.num_duplicates - self.num_vertices
    figures = [*_common(self), ("vertices", self.num_vertices), ("duplicates", self.num_duplicates), ("hidden", hidden or None), ("cells", self.num_cells)]
    k = self.affine_dimension
    cells, facets, box = self._sample(CORNERS // (3 if k < 3 else 8 if k == 3 else k + 6))
    picture = Picture(*box)
    are_points = cells.shape[1] == 1 < self.affine_dimension
    if are_points:
        picture.dots(cells[:, 0], **{**DOTS, "stroke_width": 2})
    elif len(cells) and cells.shape[1] > 3:  # all edges of a cell in one line, if possible: that of five is one, of four nearly
        order = [0, 1, 2, 3, 0, 2] if cells.shape[1] == 4 else [*range(cells.shape[1]), 0]
        picture.shapes(cells[:, order], False, **EDGE)
    elif len(cells):
        picture.shapes(cells, True, **EDGE, **FACE)
    if len(facets) and facets.shape[1] > 1:
        picture.shapes(facets, facets.shape[1] > 2, **BORDER)
    if 0 < len(cells) <= 60 and not are_points:
        picture.dots(cells.reshape(-1, self.dimension), **DOTS)
    drawn = _drawn(len(cells), self.num_points, "points") if are_points else _drawn(len(cells), self.num_cells, "cells")
    return page(type(self).__name__, figures, picture, drawn + _seen(self.dimension))


@safely
def alpha_complex(self):
    """The cells, of space the boundary."""
    whole = self.triangulation
    points, k = whole.points, whole.affine_dimension
    boundary, singular = self.boundary, len(self.singular_facets)
    figures = [*_common(whole), ("radius", self.radius if self.radius == self.radius else None), ("cells", len(self)),
               ("boundary facets", len(boundary)), ("singular facets", singular or None)]
    of = len(boundary) if k == 3 else len(self)
    if not of:
        return page("AlphaComplex", figures, "", "")
    step = of // (CORNERS // max(3, k)) + 1
    shapes = points[boundary[::step] if k == 3 else whole.cells[self.cell_numbers[::step]]]
    corners = shapes.reshape(-1, whole.dimension)
    picture, width = Picture(corners.min(axis=0), corners.max(axis=0)), shapes.shape[1]
    if width > 1:
        picture.shapes(shapes if width < 4 else shapes[:, [*range(width), 0]], width == 3, **EDGE, **(FACE if width == 3 else {}))
    if k == 2:
        picture.shapes(points[boundary[::len(boundary) // (CORNERS // 2) + 1]], False, **BORDER)
    if len(shapes) <= 60:
        picture.dots(corners, **DOTS)
    return page("AlphaComplex", figures, picture, _drawn(len(shapes), of, "boundary facets" if k == 3 else "cells") + _seen(whole.dimension))


@safely
def convex_hull(self):
    figures = [*_common(self), ("vertices", self.num_vertices), ("facets", self.num_facets), ("ridges", self.num_ridges),
               ("duplicates", self.num_duplicates or None), ("tolerance", self.tolerance or None)]
    if self.num_cells <= 10_000:
        figures += [("volume", self.volume), ("area", self.area)]
    cells, _ = self._sample(CORNERS // max(3, self.affine_dimension))
    if not len(cells):
        return page("ConvexHull", figures, "", "")
    corners = cells.reshape(-1, self.dimension)
    picture = Picture(corners.min(axis=0), corners.max(axis=0))
    look = {**EDGE, **FACE} if cells.shape[1] > 2 else {**BORDER}
    picture.shapes(cells, cells.shape[1] > 2, **look)
    if len(cells) <= 60:
        picture.dots(corners, **DOTS)
    return page("ConvexHull", figures, picture, _drawn(len(cells), self.num_cells, "cells") + _seen(self.dimension))


@safely
def lower_hull(self):
    """The cells over the compositions; of one number the hull itself."""
    figures = [("points", self.num_points), ("dimension", self.dimension), ("side", self.side), ("vertices", len(self.vertices)),
               ("cells", self.num_cells), ("tolerance", self.tolerance or None)]
    seen = self.points[:, :max(2, self.dimension - 1)]
    width = self.cells.shape[1]
    if not self.num_cells or width < 2:
        return page("LowerHull", figures, "", "")
    cells = seen[self.cells[::self.num_cells // (CORNERS // width) + 1]]
    corners = cells.reshape(-1, seen.shape[1])
    picture = Picture(corners.min(axis=0), corners.max(axis=0))
    picture.shapes(cells if width < 4 else cells[:, [*range(width), 0]], width == 3, **EDGE, **(FACE if width == 3 else {}))
    if len(cells) <= 60:
        picture.dots(corners, **DOTS)
    return page("LowerHull", figures, picture, _drawn(len(cells), self.num_cells, "cells") + _seen(seen.shape[1]))


@safely
def diagram(self):
    figures = [*_common(self), ("regions", self.num_regions), ("vertices", self.num_vertices), ("ridges", self.num_ridges), ("rays", self.num_rays),
               ("tolerance", self.tolerance or None)]
    if not self.num_regions:
        return page(type(self).__name__, figures, "", "")
    low, high = self.bounding_box()
    picture = Picture(low, high)
    step = self.num_regions // (CORNERS // 9) + 1
    sites = self.points[self.region_points[::step]]
    shown = ""
    k, d = self.affine_dimension, self.dimension
    if d == 2 and k == 2:
        numbers = np.arange(0, self.num_regions, step)
        if step == 1:
            polygons = [polygon for polygon in polygons_of_regions(self, numbers, low, high) if len(polygon) > 2]
        else:
            polygons = [polygon for polygon, is_inside in zip(*corners_of_regions(self, numbers, low, high)) if is_inside]
        picture.shapes(polygons, True, **EDGE, **FACE)
        shown = _drawn(len(polygons) if step > 1 else len(numbers), self.num_regions, "regions")
    elif d == 3 and k == 3:
        inside = ((self.vertices >= low) & (self.vertices <= high)).all(axis=1) if self.num_vertices < 200_000 else None
        step_of_ridges = self.num_ridges // (CORNERS // 3) + 1
        numbers = [i for i in range(0, self.num_ridges, step_of_ridges) if self.ridge_vertices[self.ridge_offsets[i]] >= 0]
        ridges = [self.ridge(i) for i in numbers]
        polygons = [self.vertices[ridge] for ridge in ridges if (inside[ridge].all() if inside is not None
                    else ((self.vertices[ridge] >= low) & (self.vertices[ridge] <= high)).all())]
        picture.shapes(polygons[:CORNERS // 6], True, **EDGE)
        shown = _drawn(min(len(polygons), CORNERS // 6), self.num_ridges, "ridges")
    picture.dots(sites, **{**DOTS, "stroke_width": 3 if len(sites) < 100 else 2})
    return page(type(self).__name__, figures, picture, shown + _seen(self.dimension))


@safely
def intersection(self):
    figures = [("halfspaces", self.num_halfspaces), ("dimension", self.dimension), ("rank", self.rank if self.rank != self.dimension else None),
               ("state", self.state if self.state != "full" else None)]
    if self.state != "full":
        return page("HalfspaceIntersection", figures, "", "")
    figures += [("bounded", "yes" if self.is_bounded else "no"), ("vertices", self.num_vertices), ("facets", self.num_facets)]
    if self.is_bounded and self.dimension <= 3 and self.num_vertices <= 1000:
        figures.append(("volume", self.volume))
    edges, num_edges = self._sample(CORNERS // 3)
    if not len(edges):
        return page("HalfspaceIntersection", figures, "", "")
    ends = edges.reshape(-1, self.dimension)
    picture = Picture(ends.min(axis=0), ends.max(axis=0))
    picture.shapes(edges, False, **EDGE)
    if len(edges) <= 60:
        picture.dots(ends, **DOTS)
    return page("HalfspaceIntersection", figures, picture, _drawn(len(edges), num_edges, "edges") + _seen(self.dimension))


@safely
def polyhedron(self):
    flat = self.affine_dimension if self.affine_dimension != self.dimension else None
    figures = [("dimension", self.dimension), ("affine dimension", flat), ("vertices", self.num_vertices), ("rays", self.num_rays or None),
               ("lines", self.num_lines or None), ("facets", self.num_inequalities)]
    if self.is_empty:
        return page("Polyhedron", [("dimension", self.dimension), ("state", "empty")], "", "")
    if self.is_bounded and self.dimension <= 3 and self.num_vertices <= 1000:
        figures.append(("volume", self.volume))
    if self.num_vertices > 2000 or not len(self.adjacent_vertices):
        return page("Polyhedron", figures, "", "")
    edges = self.vertices[self.adjacent_vertices]
    drawn = edges[::-(-len(edges) // (CORNERS // 3))]
    picture = Picture(self.vertices.min(axis=0), self.vertices.max(axis=0))
    picture.shapes(drawn, False, **EDGE)
    if len(drawn) <= 60:
        picture.dots(drawn.reshape(-1, self.dimension), **DOTS)
    return page("Polyhedron", figures, picture, _drawn(len(drawn), len(edges), "edges") + _seen(self.dimension))
