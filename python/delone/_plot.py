# SPDX-License-Identifier: BSD-3-Clause
"""Pictures with Matplotlib, which is imported when the first one is drawn: the methods `plot` of triangulations, hulls, intersections
and diagrams."""
from __future__ import annotations

import itertools

import numpy as np

from . import _core

INK, SOFT = "#1f3a5f", "#9fb4c7"  # of lines and points; of faces
FEW = 1000  # so many points are drawn as dots, if nobody says otherwise
MANY = 20_000  # from so many shapes on, files of vector graphics hold them as an image
LIGHT = np.array([-0.3, -0.5, 0.8]) / np.linalg.norm([-0.3, -0.5, 0.8])


def pyplot():
    """Matplotlib's pyplot. ImportError that says what to install."""
    try:
        import matplotlib.pyplot
    except ImportError as error:
        raise ImportError("pictures are drawn by Matplotlib: install it, for example by `pip install matplotlib`, or as the package "
                          "python3-matplotlib of Debian and Ubuntu") from error
    return matplotlib.pyplot


class Canvas:
    """The axes of one picture: given ones, or new ones, and the coordinates that are drawn on them."""

    def __init__(self, ax, product, axes, needed="points and edges"):
        d = product.dimension
        if axes is None:
            if d not in (2, 3):
                raise ValueError(f"plot: dimension is {d}, and a picture has 2 or 3; axes=(0, 1) draws {needed} in two of the "
                                 "coordinates, axes=(0, 1, 2) in three" if d > 1 else f"plot: dimension is {d}, and a picture has 2 or 3")
            self.axes = tuple(range(d))
        else:
            self.axes = tuple(axes)
            if len(self.axes) not in (2, 3) or len(set(self.axes)) != len(self.axes) or not all(
                    isinstance(axis, (int, np.integer)) and 0 <= axis < d for axis in self.axes):
                raise ValueError(f"axes: two or three different coordinates from 0 to {d - 1}, not {_core._represented(axes)}")
        self.in_space = len(self.axes) == 3
        plt = pyplot()
        self.is_new = ax is None
        if self.is_new:
            ax = plt.figure().add_subplot(projection="3d" if self.in_space else None)
            labels = product.columns or [f"x{axis}" if axes is not None else "" for axis in range(d)]
            for name, axis in zip("xyz", self.axes):
                getattr(ax, f"set_{name}label")(str(labels[axis]))
        elif self.in_space and ax.name != "3d":
            raise ValueError("ax: three dimensions need axes that have them, such as figure.add_subplot(projection='3d'); or choose two "
                             "coordinates by axes=(0, 1)")
        elif not self.in_space and ax.name == "3d":
            raise ValueError("ax: two dimensions need axes that have two, not projection='3d'")
        self.ax = ax

    def of(self, coordinates) -> np.ndarray:
        """The coordinates that are drawn, of points (..., d)."""
        return coordinates if self.axes == tuple(range(coordinates.shape[-1])) else coordinates[..., list(self.axes)]

    def add(self, collection):
        """Adds it without looking at its extent; see fit()."""
        if self.in_space:
            self.ax.add_collection3d(collection)
        else:
            self.ax.add_collection(collection, autolim=False)
        return collection

    def lines(self, segments, **keywords):
        """Segments (s, 2, drawn coordinates) as one collection."""
        if self.in_space:
            from mpl_toolkits.mplot3d.art3d import Line3DCollection as Lines
        else:
            from matplotlib.collections import LineCollection as Lines
        keywords = _with_defaults(keywords, colors=INK, linewidths=_width(len(segments)), rasterized=len(segments) > MANY)
        return self.add(Lines(segments, **keywords))

    def faces(self, polygons, **keywords):
        """Polygons as one collection: an array (f, corners, drawn coordinates), or a list of arrays."""
        if self.in_space:
            from mpl_toolkits.mplot3d.art3d import Poly3DCollection as Polygons
        else:
            from matplotlib.collections import PolyCollection as Polygons
        keywords.setdefault("rasterized", len(polygons) > MANY)
        return self.add(Polygons(polygons, **keywords))

    def dots(self, points, **keywords):
        return self.ax.plot(*self.of(points).T, ".", color=INK, markersize=4 if len(points) <= FEW else 1, **keywords)

    def colored_dots(self, points, values, keywords):
        keywords = {"s": 12 if len(points) <= FEW else 2, **keywords}
        return self.ax.scatter(*self.of(points).T, c=values, rasterized=len(points) > MANY, **keywords)

    def fit(self, low, high, exactly=False):
        """Makes room for a box, in drawn coordinates, besides what there is; with `exactly`, new axes show it and no more."""
        if not (np.isfinite(low).all() and np.isfinite(high).all()):
            return
        if self.in_space:
            self.ax.auto_scale_xyz(*np.stack([low, high]).T)
            if self.is_new and (high > low).all():
                self.ax.set_box_aspect(high - low)
            return
        self.ax.update_datalim([low, high])
        self.ax.autoscale_view()
        if self.is_new:
            self.ax.set_aspect("equal")
            if exactly and (high > low).all():
                self.ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))


class Colors:
    """Values and how Matplotlib is to color by them."""

    def __init__(self, values, values_at, places, cmap, norm, vmin, vmax, colorbar):
        """`places`: names and numbers of what values can belong to; of equal numbers the first one counts, unless `values_at` says."""
        if norm is not None and (vmin is not None or vmax is not None):
            raise ValueError("norm: has limits of its own; leave out vmin and vmax")
        self.cmap, self.norm, self.vmin, self.vmax, self.colorbar = cmap, norm, vmin, vmax, colorbar
        self.values = self.place = None
        if values_at is not None and values_at not in places:
            raise ValueError(f"values_at: {' or '.join(map(repr, places))}, not {_core._represented(values_at)}")
        if values is None:
            return
        self.values = np.ma.asanyarray(values) if np.ma.isMaskedArray(values) else np.asarray(values)
        if self.values.dtype.kind not in "fiub":
            self.values = self.values.astype(float)
        for name, count in places.items():
            if self.values.shape == (count,) and values_at in (None, name):
                self.place = name
                return
        wanted = " or ".join(f"{name} ({count})" for name, count in places.items() if values_at in (None, name))
        raise ValueError(f"values: one number for each of the {wanted}, not an array of shape {self.values.shape}")

    def keywords(self):
        """For functions of Matplotlib that take values."""
        return {"cmap": self.cmap, "norm": self.norm, "vmin": self.vmin, "vmax": self.vmax}

    def paint(self, collection, values):
        """Gives a collection its colors."""
        collection.set_array(np.ma.masked_invalid(values))
        collection.set_cmap(self.cmap)
        collection.set_norm(self.norm)
        if self.norm is None:
            collection.set_clim(self.vmin, self.vmax)
        collection.autoscale_None()
        return collection

    def finish(self, canvas, mappable):
        """Draws the color bar, if there are values and nobody has said no."""
        if mappable is None or self.colorbar is False:
            return
        label = self.colorbar if isinstance(self.colorbar, str) else ""
        canvas.ax.figure.colorbar(mappable, ax=canvas.ax, label=label, **({"pad": 0.1} if canvas.in_space else {}))


def _with_defaults(keywords, **defaults):
    """The keywords, with those of the defaults that have not been given, under none of their names."""
    aliases = {"colors": ("color", "edgecolor", "edgecolors", "ec"), "linewidths": ("linewidth", "lw"), "edgecolors": ("edgecolor", "ec", "color"),
               "facecolors": ("facecolor", "fc", "color")}
    return {**{name: value for name, value in defaults.items() if not any(alias in keywords for alias in aliases.get(name, ()))}, **keywords}


def _width(count):
    """Of lines, by how many there are."""
    return float(np.clip(20 / np.sqrt(max(count, 1)), 0.15, 0.8))


def _chosen(selection, count, name):
    """A selection, None for all, a mask or numbers, as a mask."""
    if selection is None:
        return np.ones(count, dtype=bool)
    selection = np.asarray(selection)
    if selection.dtype == bool and selection.shape == (count,):
        return selection
    if selection.ndim != 1 or selection.dtype.kind not in "iu" and len(selection) or len(selection) and not 0 <= selection.min() <= selection.max() < count:
        raise ValueError(f"{name}: a mask of {count}, or numbers from 0 to {count - 1}")
    mask = np.zeros(count, dtype=bool)
    mask[selection.astype(np.intp)] = True
    return mask


def _shaded(normals, color=SOFT):
    """Colors of faces with these normals, of any length, lit from above."""
    from matplotlib.colors import to_rgb
    lengths = np.linalg.norm(normals, axis=1)
    lit = (normals @ LIGHT) / np.where(lengths > 0, lengths, 1)
    return np.clip(np.array(to_rgb(color)) * (0.75 + 0.35 * lit)[:, None], 0, 1)


def _box_of(points):
    finite = points[np.isfinite(points).all(axis=1)]
    return (finite.min(axis=0), finite.max(axis=0)) if len(finite) else (np.full(points.shape[1], np.nan),) * 2


def _pairs_of(cells):
    """The edges of simplices, each once, as increasing pairs of rows."""
    if cells.shape[1] < 2 or not len(cells):
        return np.empty((0, 2), dtype=np.intp)
    pairs = np.concatenate([cells[:, list(pair)] for pair in itertools.combinations(range(cells.shape[1]), 2)])
    return np.unique(np.sort(pairs, axis=1), axis=0)


def _dots_too(points, is_wanted, rows):
    """The points to draw as dots, of some rows."""
    if is_wanted is False or is_wanted is None and len(rows) > FEW:
        return points[:0]
    return points[rows]


def _projected(canvas, colors, points, pairs, rows, dots, keywords):
    """Points and edges in some of the coordinates."""
    x = canvas.of(points)
    if len(pairs):
        canvas.lines(x[pairs], **_with_defaults(keywords, colors=SOFT, zorder=1))
    mappable = None
    if colors.values is not None:
        mappable = canvas.colored_dots(points[rows], colors.values[rows], colors.keywords())
    elif dots is not False:
        canvas.dots(points[rows])
    canvas.fit(*_box_of(x[rows]))
    colors.finish(canvas, mappable)
    return canvas.ax


def boundary_of_cells(cells, neighbors, chosen):
    """The facets between chosen cells and others, or none: (facets, their cells, the vertices of these opposite to them)."""
    beyond = ~np.append(chosen, False)[neighbors]  # neighbor −1 is the last entry: not chosen
    cell, opposite = np.nonzero(chosen[:, None] & beyond)
    width = cells.shape[1]
    facets = cells[cell][np.arange(width) != opposite[:, None]].reshape(-1, width - 1)
    return facets, cell, cells[cell, opposite]


def _edges_of_triangles(cells, neighbors, chosen):
    """The edges of chosen triangles, each once."""
    cell, opposite = np.nonzero(chosen[:, None] & ((neighbors < np.arange(len(cells))[:, None]) | ~np.append(chosen, False)[neighbors]))
    return np.stack([cells[cell, (opposite + 1) % 3], cells[cell, (opposite + 2) % 3]], axis=1)


def triangulation(self, ax=None, *, values=None, values_at=None, cells=None, axes=None, points=None, shading="gouraud", cmap=None, norm=None,
                  vmin=None, vmax=None, colorbar=None, **keywords):
    """Draws the triangulation with Matplotlib, and returns the Axes.

    In 2D the edges, or the triangles in colors; in 3D the hull facets, or the border of the chosen cells. The colors stand for values.

    ax : Matplotlib Axes
        Where to draw. New ones, if not given: with equal scales, and in 3D with projection="3d". ValueError for 2D Axes and 3D points.
    values : (n,) or (m,) numbers
        One for each point, or for each cell. Of points, triangles show the linear interpolation, faces in 3D the mean of their corners.
    values_at : "points" or "cells"
        Which of both, if there are as many points as cells.
    cells : (m,) bool, or numbers of cells
        Draws only these: for example those of small radius, an alpha shape, or ``trim(…).kept``.
    axes : two or three coordinates
        Draws points and edges in these coordinates, of points in any dimension; values are those of the points.
    points : bool
        Whether the vertices are dots; by default, if there are at most 1000.
    shading : "gouraud" or "flat"
        Of values at points in 2D: interpolated, or the mean of the corners.
    cmap, norm, vmin, vmax : as everywhere in Matplotlib
    colorbar : bool or str
        Whether a color bar is drawn beside values, and its label; by default it is.
    keywords : of the collection that is drawn: LineCollection, PolyCollection, or Poly3DCollection in 3D

    ValueError in other dimensions than 2 and 3, without `axes`. ImportError without Matplotlib. Cost: one collection; 10^5 triangles take
    about a second.
    """
    canvas = Canvas(ax, self, axes)
    x, corners, k = self.points, self.cells, self.affine_dimension
    places = {"points": len(x), "cells": len(corners)} if axes is None else {"points": len(x)}
    colors = Colors(values, values_at, places, cmap, norm, vmin, vmax, colorbar)
    if shading not in ("gouraud", "flat"):
        raise ValueError(f"shading: 'gouraud' or 'flat', not {_core._represented(shading)}")
    chosen = _chosen(cells, len(corners), "cells")
    rows = np.flatnonzero(self.vertex_of_point == np.arange(len(x))) if cells is None else np.unique(corners[chosen])
    if axes is not None or k < 2:
        if colors.place == "cells":
            raise ValueError("values: one for each point, where the cells are segments")
        return _projected(canvas, colors, x, _pairs_of(corners[chosen]), rows, points, keywords)

    low, high = _box_of(x[rows])
    mappable = None
    if k == 2 and not canvas.in_space:
        if colors.place == "points" and shading == "gouraud" and chosen.any():
            from matplotlib.tri import Triangulation
            mappable = canvas.ax.tripcolor(Triangulation(*x.T, corners[chosen]), np.ma.filled(np.ma.asarray(colors.values, dtype=float), np.nan),
                                           shading="gouraud", rasterized=len(corners) > MANY, **colors.keywords(), **keywords)
        elif colors.values is not None or cells is not None or any(name.startswith(("face", "fc")) for name in keywords):
            look = {} if colors.values is None else {"edgecolors": "face", "linewidths": 0.2}
            look = look or {"facecolors": SOFT, "edgecolors": INK, "linewidths": _width(3 * len(corners))}
            mappable = canvas.faces(x[corners[chosen]], **_with_defaults(keywords, **look))
        else:
            canvas.lines(x[_edges_of_triangles(corners, self.neighbors, chosen)], **keywords)
    else:
        if k == 3:
            facets, owners, opposite = boundary_of_cells(corners, self.neighbors, chosen)
        else:
            facets, owners, opposite = corners[chosen], np.flatnonzero(chosen), None
        faces = x[facets]
        look = {"edgecolors": INK, "linewidths": 0.5 * _width(len(faces))}
        if colors.values is None:
            normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
            if opposite is not None:
                normals *= -np.sign((normals * (x[opposite] - faces[:, 0])).sum(axis=1))[:, None]
            look["facecolors"] = _shaded(normals)
        mappable = canvas.faces(faces, **_with_defaults(keywords, **look))
    if colors.values is None:
        mappable = None
    elif colors.place == "cells" or shading == "flat" or canvas.in_space:
        if colors.place == "points":
            shown = facets if canvas.in_space else corners[chosen]
            colors.paint(mappable, np.ma.asarray(colors.values)[shown].mean(axis=1))
        else:
            colors.paint(mappable, colors.values[owners] if canvas.in_space else colors.values[chosen])
    dots = _dots_too(x, points, rows) if mappable is None or points else x[:0]
    if len(dots):
        canvas.dots(dots)
    canvas.fit(low, high)
    colors.finish(canvas, mappable)
    return canvas.ax


def convex_hull(self, ax=None, *, values=None, values_at=None, axes=None, points=None, cmap=None, norm=None, vmin=None, vmax=None, colorbar=None,
                **keywords):
    """Draws the hull with Matplotlib, and returns the Axes.

    In 2D the polygon and the points; in 3D the facets, with their ridges as lines.

    ax, axes, cmap, norm, vmin, vmax, colorbar : as for `Delaunay.plot`
    values : (n,), (f,) or (m,) numbers
        One for each point, each facet, or each cell. In 2D points are dots in these colors, in 3D faces have the mean of their corners.
    values_at : "points", "facets" or "cells"
        Which of these, if there are as many of one as of the other; otherwise the first that fits.
    points : bool
        Whether all points are drawn, as dots; by default, if there are at most 1000.
    keywords : of the collection that is drawn: PolyCollection, LineCollection for values of facets in 2D, or Poly3DCollection

    ValueError in other dimensions than 2 and 3, without `axes`. ImportError without Matplotlib.
    """
    canvas = Canvas(ax, self, axes)
    x, corners, k = self.points, self.cells, self.affine_dimension
    places = {"points": len(x)} if axes is not None else {"points": len(x), "facets": self.num_facets, "cells": len(corners)}
    colors = Colors(values, values_at, places, cmap, norm, vmin, vmax, colorbar)
    rows = np.arange(len(x))
    if axes is not None or k < 2:
        if colors.place not in (None, "points"):
            raise ValueError("values: one for each point, where facets are points")
        pairs = _pairs_of(corners) if k > 1 else corners.reshape(1, 2) if k == 1 else np.empty((0, 2), dtype=np.intp)
        return _projected(canvas, colors, x, pairs, rows, points, keywords)
    of_faces, mappable = colors.values, None
    if k == 2:
        if colors.place in ("facets", "cells"):
            of_cells = colors.values if colors.place == "cells" else colors.values[self.facet_of_cell]
            mappable = colors.paint(canvas.lines(x[corners], **_with_defaults(keywords, linewidths=2, colors=None)), of_cells)
        else:
            following = dict(corners.tolist())
            around = [corners[0, 0].item()]
            while len(around) < len(corners):
                around.append(following[around[-1]])
            canvas.faces([x[around]], **_with_defaults(keywords, facecolors=SOFT + "60", edgecolors=INK, linewidths=1))
        if colors.place == "points":
            mappable = canvas.colored_dots(x, colors.values, colors.keywords())
    else:
        by_cells = colors.place == "cells"
        faces = x[corners] if by_cells else facets_of_hull(self)
        if colors.place == "points":
            offsets, rows_of_facets = self.facets
            of_faces = np.add.reduceat(np.asarray(colors.values, dtype=float)[rows_of_facets], offsets[:-1]) / np.diff(offsets)
        look = {"edgecolors": "none"} if by_cells else {"edgecolors": INK, "linewidths": 0.5 * _width(len(faces))}
        if colors.values is None:
            look["facecolors"] = _shaded(self.equations[:, :3])
        found = canvas.faces(faces, **_with_defaults(keywords, **look))
        if colors.values is not None:
            mappable = colors.paint(found, of_faces)
    if colors.place != "points" or k > 2:
        dots = _dots_too(x, points, rows)
        if len(dots):
            canvas.dots(dots)
    canvas.fit(*_box_of(x[self.vertices]))
    colors.finish(canvas, mappable)
    return canvas.ax


def facets_of_hull(hull):
    """The facets of a hull of k = 3 in space as polygons, their corners in cyclic order."""
    offsets, rows = hull.facets
    facet = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    corners = hull.points[rows]
    center = np.add.reduceat(corners, offsets[:-1]) / np.diff(offsets)[:, None]
    normal = hull.equations[:, :3]
    aside = np.cross(normal, corners[offsets[:-1]] - center)
    along = np.cross(aside, normal)
    spokes = corners - center[facet]
    angle = np.arctan2((spokes * aside[facet]).sum(axis=1), (spokes * along[facet]).sum(axis=1))
    return np.split(corners[np.lexsort((angle, facet))], offsets[1:-1])


# Diagrams and intersections are cut off at a box.

def cut(starts, directions, length, low, high):
    """What is inside the box of the segments starts + t · directions, 0 ≤ t ≤ length: (s, 2, d)."""
    if not len(starts):
        return np.empty((0, 2, len(low)))
    with np.errstate(all="ignore"):
        at_low, at_high = (low - starts) / directions, (high - starts) / directions
        enter, leave = np.fmin(at_low, at_high), np.fmax(at_low, at_high)
        parallel = directions == 0
        is_beside = (parallel & ((starts < low) | (starts > high))).any(axis=1)
        enter[parallel], leave[parallel] = 0, length
        first, last = np.maximum(enter.max(axis=1), 0), np.minimum(leave.min(axis=1), length)
        kept = ~is_beside & (first < last) & np.isfinite(starts).all(axis=1) & np.isfinite(directions).all(axis=1)
    starts, directions = starts[kept], directions[kept]
    return np.stack([starts + first[kept, None] * directions, starts + last[kept, None] * directions], axis=1)


def cut_polygon(polygon, low, high):
    """The part of a convex polygon in the plane that is inside the box; no corners, if there is none."""
    for axis, bound, side in ((0, low[0], 1), (0, high[0], -1), (1, low[1], 1), (1, high[1], -1)):
        if not len(polygon):
            break
        depth = side * (polygon[:, axis] - bound)
        after, depth_after = np.roll(polygon, -1, axis=0), np.roll(depth, -1)
        crosses = (depth >= 0) != (depth_after >= 0)
        with np.errstate(all="ignore"):
            crossing = polygon + (depth / (depth - depth_after))[:, None] * (after - polygon)
        crossing[:, axis] = bound
        polygon = np.stack([polygon, crossing], axis=1).reshape(-1, 2)[np.stack([depth >= 0, crosses], axis=1).ravel()]
    return polygon


def edges_of_diagram(diagram, low, high):
    """The edges of a diagram with k = 1 or 2 in the plane, or of the bounded ridges of one with k = 2 or 3 in space, cut off at the box:
    (bounded ones, unbounded ones), each (s, 2, d)."""
    v, d, k = diagram.vertices, diagram.dimension, diagram.affine_dimension
    none = np.empty((0, 2, d))
    if k < 1 or k == 1 and d == 3:
        return none, none
    if k == 1:
        along = np.subtract(*diagram.points[diagram.region_points[:2]])
        normal = np.broadcast_to(np.array([-along[1], along[0]]) / np.linalg.norm(along), v.shape)
        return none, np.concatenate([cut(v, normal, np.inf, low, high), cut(v, -normal, np.inf, low, high)])
    if k == 2:
        ends = diagram.ridge_vertices.reshape(-1, 2)
        ends = ends[ends[:, 0] >= 0]
    else:
        items, offsets = diagram.ridge_vertices, diagram.ridge_offsets
        following = np.roll(items, -1)
        following[offsets[1:] - 1] = items[offsets[:-1]]  # ridges are cycles
        ends = np.unique(np.sort(np.stack([items, following], axis=1)[(items >= 0) & (following >= 0)], axis=1), axis=0)
    start = v[ends[:, 0]]
    return (cut(start, v[ends[:, 1]] - start, 1, low, high), cut(v[diagram.ray_vertices], diagram.ray_directions, np.inf, low, high))


def polygons_of_regions(diagram, chosen, low, high):
    """The regions with the numbers `chosen` of a diagram in the plane, cut off at the box: a list of arrays, empty ones of regions
    outside."""
    v, k = diagram.vertices, diagram.affine_dimension
    whole = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
    if k < 1:
        return [whole for _ in chosen]
    offsets = diagram.region_offsets
    counts = np.diff(offsets)[chosen]
    ids = diagram.region_vertices[np.repeat(offsets[chosen] - np.append(0, np.cumsum(counts)[:-1]), counts) + np.arange(counts.sum())] \
        if len(chosen) else np.empty(0, dtype=np.intp)
    ends = np.cumsum(counts)
    inside = np.append(((v >= low) & (v <= high)).all(axis=1), False)[ids]
    parts = np.split(ids, ends[:-1]) if len(chosen) else []
    to_do = np.flatnonzero((counts < 3) | ~np.logical_and.reduceat(inside, ends - counts)) if inside.size and (counts > 0).all() else range(len(chosen))
    is_simple = np.ones(len(chosen), dtype=bool)
    is_simple[to_do] = False
    corners = np.split(v[ids], ends[:-1]) if len(chosen) else []
    polygons = [corners[i] if is_simple[i] else None for i in range(len(chosen))]
    rays_of = {}
    if k == 2:
        for ray, sites in enumerate(diagram.point_region[diagram.ray_points].tolist()):
            for region in sites:
                rays_of.setdefault(region, []).append(ray)
    for i in np.flatnonzero(~is_simple):
        region = int(chosen[i])
        outline = _strip if k == 1 else _outline
        polygons[i] = cut_polygon(outline(diagram, region, parts[i], rays_of.get(region, ()), low, high), low, high)
    return polygons


def _outline(diagram, region, ids, rays, low, high):
    """The corners of a region, with points far outside of the box on its rays and between them."""
    ids = ids[ids >= 0]
    corners = diagram.vertices[ids]
    corners = corners[np.isfinite(corners).all(axis=1)]
    if not len(rays) or not len(corners):
        return corners
    start, direction = diagram.ray_vertices[list(rays)], diagram.ray_directions[list(rays)]
    if len(rays) != 2:
        order = [0]
    elif start[0] != start[1]:
        order = [0, 1] if start[0] == ids[-1] else [1, 0]
    else:  # the region is to the left of the ray that the outline leaves by
        order = [0, 1] if direction[0, 0] * direction[1, 1] - direction[0, 1] * direction[1, 0] > 0 else [1, 0]
    start, direction = diagram.vertices[start[order]], direction[order]
    center = (np.asarray(low) + high) / 2
    far = 4 * (np.linalg.norm(np.subtract(high, low)) + np.linalg.norm(start - center, axis=1).max())
    between = direction.sum(axis=0)
    length = np.linalg.norm(between)
    between = between / length if length > 1e-9 else np.array([-direction[0, 1], direction[0, 0]])
    return np.concatenate([corners, (start + far * direction)[:1], start[:1] + far * between, (start + far * direction)[1:]])


def _strip(diagram, region, ids, rays, low, high):
    """A region of points on a line, as a quadrilateral that reaches beyond the box."""
    sites = diagram.points[diagram.region_points]
    along = sites[1] - sites[0]
    along = along / np.linalg.norm(along)
    normal = np.array([-along[1], along[0]])
    origin = sites[region]
    far = 4 * (np.linalg.norm(np.subtract(high, low)) + np.linalg.norm(origin - low))
    at = (diagram.vertices[ids[ids >= 0]] - origin) @ along
    first, last = max(at[at < 0], default=-far), min(at[at > 0], default=far)
    return np.array([origin + t * along + s * normal for t, s in ((first, -far), (last, -far), (last, far), (first, far))])


def _as_box(box, product_box):
    if box is None:
        return product_box()
    low, high = (np.array(_core._doubles(corner, "box")) for corner in box)
    wanted = np.shape(product_box()[0])
    if low.shape != wanted or high.shape != wanted or not (low < high).all() or not np.isfinite([low, high]).all():
        raise ValueError(f"box: (low, high), each of {wanted[0]} finite numbers, low < high")
    return low, high


def diagram(self, ax=None, *, values=None, values_at=None, regions=None, axes=None, box=None, points=None, cmap=None, norm=None, vmin=None,
            vmax=None, colorbar=None, **keywords):
    """Draws the diagram with Matplotlib, and returns the Axes. What is unbounded is cut off at a box.

    In 2D the edges and the sites, with values the regions in colors; in 3D the surface of the bounded regions that are inside the box.

    ax, cmap, norm, vmin, vmax, colorbar : as for `Delaunay.plot`
    values : (n,) or (regions,) numbers
        One for each point, or for each region.
    values_at : "points" or "regions"
        Which of both, if hidden points or duplicates do not tell; both agree unless there are any.
    regions : (regions,) bool, or numbers of regions
        Fills only these.
    axes : two or three coordinates
        Draws the points and, between sites with a common ridge, lines, in these coordinates; values are those of the points.
    box : (low, high), each (d,)
        By default ``bounding_box()``.
    points : bool
        Whether the sites are dots; by default, if there are at most 1000.
    keywords : of the collection that is drawn: LineCollection, PolyCollection with values or regions, Poly3DCollection in 3D

    ValueError in other dimensions than 2 and 3, without `axes`. ImportError without Matplotlib.
    """
    canvas = Canvas(ax, self, axes, "points and lines between neighbors")
    x, k = self.points, self.affine_dimension
    places = {"points": len(x)} if axes is not None else {"points": len(x), "regions": self.num_regions}
    colors = Colors(values, values_at, places, cmap, norm, vmin, vmax, colorbar)
    sites = self.region_points
    if axes is not None:
        return _projected(canvas, colors, x, self.ridge_points, sites, points, keywords)
    mask = _chosen(regions, self.num_regions, "regions")
    of_regions = colors.values[sites] if colors.place == "points" else colors.values
    if not len(x):
        return canvas.ax
    low, high = _as_box(box, self.bounding_box)
    mappable = None
    if not canvas.in_space:
        is_filled = colors.values is not None or regions is not None or any(name.startswith(("face", "fc")) for name in keywords)
        if is_filled:
            chosen = np.flatnonzero(mask)
            polygons = polygons_of_regions(self, chosen, low, high)
            shown = np.array([len(polygon) > 2 for polygon in polygons], dtype=bool)
            found = canvas.faces([polygon for polygon in polygons if len(polygon) > 2],
                                 **_with_defaults(keywords, facecolors=SOFT, edgecolors=INK, linewidths=_width(3 * len(polygons))))
            if colors.values is not None:
                mappable = colors.paint(found, of_regions[chosen[shown]])
        if not is_filled or regions is not None:
            canvas.lines(np.concatenate(edges_of_diagram(self, low, high)), **({} if is_filled else keywords))
    else:
        inside = np.append(((self.vertices >= low) & (self.vertices <= high)).all(axis=1), False)
        counts = np.diff(self.region_offsets)
        is_closed = np.zeros(self.num_regions, dtype=bool)
        if (counts > 0).any():
            nonempty = np.flatnonzero(counts > 0)
            is_closed[nonempty] = np.logical_and.reduceat(inside[self.region_vertices], self.region_offsets[nonempty])
        if regions is None:
            mask = mask & is_closed
        elif not self.is_bounded[mask].all():
            raise ValueError("regions: in 3D only bounded ones are drawn, see is_bounded")
        polygons, owners = _faces_of_regions(self, mask)
        if polygons:
            look = {"edgecolors": INK, "linewidths": _width(len(polygons)), "facecolors": SOFT if regions is not None else SOFT + "90"}
            if colors.values is not None:
                del look["facecolors"]
            found = canvas.faces(polygons, **_with_defaults(keywords, **look))
            if colors.values is not None:
                mappable = colors.paint(found, of_regions[owners])
        elif k == 2:
            canvas.lines(np.concatenate(edges_of_diagram(self, low, high)), **keywords)
    dots = _dots_too(x, points, sites) if mappable is None or points else x[:0]
    if len(dots):
        canvas.dots(dots)
    canvas.fit(low, high, exactly=True)
    colors.finish(canvas, mappable)
    return canvas.ax


def _faces_of_regions(diagram, chosen):
    """In space: the polygons between chosen regions and others, and the regions that they belong to; in a plane the regions."""
    v = diagram.vertices
    if diagram.affine_dimension == 2:
        numbers = np.flatnonzero(chosen)
        return [v[diagram.region(i)] for i in numbers], numbers
    if diagram.affine_dimension < 2:
        return [], np.empty(0, dtype=np.intp)
    sides = diagram.point_region[diagram.ridge_points]
    is_chosen = chosen[sides]
    ridges = np.flatnonzero(is_chosen[:, 0] != is_chosen[:, 1])
    owners = np.where(is_chosen[ridges, 0], sides[ridges, 0], sides[ridges, 1])
    return [v[diagram.ridge(i)] for i in ridges.tolist()], owners


def bounded_part(intersection, box):
    """An intersection cut off at a box, (low, high), or at one of its own if it is unbounded: (it, the numbers of the facets that are left,
    their corners, the box)."""
    if intersection.state != "full":
        raise ValueError(f"plot: the intersection is {intersection.state}, there is nothing to draw")
    d, rows = intersection.dimension, intersection.facet_halfspaces

    def own_box():
        corners = intersection.vertices if intersection.num_vertices else intersection.interior_point[None]
        size = np.ptp(corners, axis=0).max() or max(1.0, float(np.abs(corners).max()))
        margin = 0 if intersection.is_bounded else 0.75 * size
        return corners.min(axis=0) - margin, corners.max(axis=0) + margin

    low, high = _as_box(box, own_box)
    numbers = np.arange(len(rows))
    if box is not None or not intersection.is_bounded:
        sides = np.concatenate([np.c_[-np.eye(d), low], np.c_[np.eye(d), -high]])
        intersection = _core.HalfspaceIntersection(np.concatenate([intersection.halfspaces[rows], sides]))
        if intersection.state != "full":
            raise ValueError("box: no point of its interior is in the interior of the intersection")
        numbers = intersection.facet_halfspaces
    polygons = np.split(intersection.vertices[intersection.facet_vertices], intersection.facet_offsets[1:-1]) if len(numbers) else []
    return intersection, numbers[numbers < len(rows)], [polygons[i] for i in np.flatnonzero(numbers < len(rows))], (low, high)


def intersection(self, ax=None, *, values=None, values_at=None, axes=None, box=None, cmap=None, norm=None, vmin=None, vmax=None, colorbar=None,
                 **keywords):
    """Draws the intersection with Matplotlib, and returns the Axes. What is unbounded is cut off at a box.

    In 2D the polygon, in 3D the facets.

    ax, cmap, norm, vmin, vmax, colorbar : as for `Delaunay.plot`
    values : (m,) or (f,) numbers
        One for each halfspace, or for each facet: the colors of the facets.
    values_at : "halfspaces" or "facets"
        Which of both, if all halfspaces are facets; both agree then.
    axes : two or three coordinates
        Draws vertices and bounded edges in these coordinates.
    box : (low, high), each (d,)
        By default somewhat larger than that of the vertices, if the intersection is unbounded.
    keywords : of the collection that is drawn: PolyCollection, LineCollection for values in 2D, or Poly3DCollection

    ValueError in other dimensions than 2 and 3, without `axes`, and if the intersection is flat or empty. ImportError without Matplotlib.
    """
    canvas = Canvas(ax, self, axes, "vertices and edges")
    rows = self.facet_halfspaces
    if axes is not None:
        if values is not None:
            raise ValueError("values: not together with axes, which draws no facets")
        v = self.vertices
        return _projected(canvas, Colors(None, None, {}, *[None] * 5), v, self.edges, np.arange(len(v)), None, keywords)
    colors = Colors(values, values_at, {"halfspaces": self.num_halfspaces, "facets": len(rows)}, cmap, norm, vmin, vmax, colorbar)
    of_facets = colors.values[rows] if colors.place == "halfspaces" else colors.values
    shown, numbers, drawn, (low, high) = bounded_part(self, box)
    mappable = None
    if not canvas.in_space:
        v = shown.vertices
        center = v.mean(axis=0)
        outline = v[np.argsort(np.arctan2(*(v - center).T[::-1]))]
        look = {"facecolors": SOFT + "60", "edgecolors": "none"}
        canvas.faces([outline], **_with_defaults({} if colors.values is not None else keywords, **look))
        look = {"linewidths": 1} if colors.values is None else _with_defaults(keywords, linewidths=2, colors=None)
        lines = canvas.lines(np.array(drawn).reshape(-1, 2, 2), **look)
        if colors.values is not None:
            mappable = colors.paint(lines, of_facets[numbers])
    elif drawn:
        look = {"edgecolors": INK, "linewidths": _width(len(drawn)) * 1.5}
        if colors.values is None:
            look["facecolors"] = _shaded(self.halfspaces[rows[numbers], :3])
        found = canvas.faces(drawn, **_with_defaults(keywords, **look))
        if colors.values is not None:
            mappable = colors.paint(found, of_facets[numbers])
    canvas.fit(*(_box_of(shown.vertices) if box is None else (low, high)))
    colors.finish(canvas, mappable)
    return canvas.ax
