# SPDX-License-Identifier: BSD-3-Clause
"""Pictures with Matplotlib, which is imported when the first one is drawn: the methods `plot` of triangulations, alpha complexes, hulls,
intersections and diagrams."""
from __future__ import annotations

import itertools

import numpy as np

from . import _core
from ._canvas import FEW, INK, MANY, SOFT, Canvas, Colors, width_of_lines, with_defaults
from ._clipping import as_box, bounded_part, edges_of_diagram, faces_of_regions, polygons_of_regions

LIGHT = np.array([-0.3, -0.5, 0.8]) / np.linalg.norm([-0.3, -0.5, 0.8])


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


def _not_with_axes(**arguments):
    """Raises ValueError for one that is given: with axes nothing is drawn that it could be about."""
    for name, value in arguments.items():
        if value is not None:
            raise ValueError(f"{name}: not together with axes")


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
        canvas.lines(x[pairs], **with_defaults(keywords, colors=SOFT, zorder=1))
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
    """Draw the triangulation with Matplotlib.

    In 2D the edges, or with values the triangles in colors; in 3D the hull facets, or the border of the chosen cells.

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        Where to draw. By default new axes with equal scales, in 3D with ``projection="3d"``.
    values : (n,) or (m,) array_like, optional
        A number for each point, or for each cell. Triangles show the linear interpolation of values of points, faces in 3D the
        mean of their corners.
    values_at : {'points', 'cells'}, optional
        What the values belong to, if there are as many points as cells.
    cells : (m,) array_like of bool, or array_like of int, optional
        The cells to draw, such as those of small radius, or ``trim(...).kept``.
    axes : sequence of int, optional
        Draw points and edges in these two or three coordinates; values are those of the points.
    points : bool, optional
        Whether to draw the vertices as dots. By default if there are at most 1000.
    shading : {'gouraud', 'flat'}
        Whether values of points are interpolated in a triangle, or averaged over its corners.
    cmap : str or matplotlib.colors.Colormap, optional
        The colors of values.
    norm : matplotlib.colors.Normalize, optional
        The scale of values.
    vmin : float, optional
        The value of the first color.
    vmax : float, optional
        The value of the last color.
    colorbar : bool or str, optional
        Whether to draw a color bar beside values, or its label. By default there is one.
    **keywords : dict
        Arguments of the LineCollection, PolyCollection or Poly3DCollection that is drawn.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    ValueError
        If the dimension is not 2 or 3 and `axes` is not given, or arguments do not suit each other.
    ImportError
        If Matplotlib is missing.

    Notes
    -----
    Draws one collection; 10^5 triangles take about a second.
    """
    canvas = Canvas(ax, self, axes)
    x, corners, k = self.points, self.cells, self.affine_dimension
    places = {"points": len(x), "cells": len(corners)} if axes is None else {"points": len(x)}
    colors = Colors(values, values_at, places, cmap, norm, vmin, vmax, colorbar, self._index)
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
            known = np.asarray(colors.values, dtype=float)
            has_all = chosen & np.isfinite(known)[corners].all(axis=1)  # triangles with a missing value are left out
            if has_all.any():
                known = np.where(np.isfinite(known), known, known[corners[has_all][0, 0]])
                mappable = canvas.ax.tripcolor(Triangulation(*x.T, corners[has_all]), known, shading="gouraud", rasterized=len(corners) > MANY,
                                               **colors.keywords(), **keywords)
        elif colors.values is not None or cells is not None or any(name.startswith(("face", "fc")) for name in keywords):
            look = {} if colors.values is None else {"edgecolors": "face", "linewidths": 0.2}
            look = look or {"facecolors": SOFT, "edgecolors": INK, "linewidths": width_of_lines(3 * len(corners))}
            mappable = canvas.faces(x[corners[chosen]], **with_defaults(keywords, **look))
        else:
            canvas.lines(x[_edges_of_triangles(corners, self.neighbors, chosen)], **keywords)
    else:
        if k == 3:
            facets, owners, opposite = boundary_of_cells(corners, self.neighbors, chosen)
        else:
            facets, owners, opposite = corners[chosen], np.flatnonzero(chosen), None
        faces = x[facets]
        look = {"edgecolors": INK, "linewidths": 0.5 * width_of_lines(len(faces))}
        if colors.values is None:
            normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
            if opposite is not None:
                normals *= -np.sign((normals * (x[opposite] - faces[:, 0])).sum(axis=1))[:, None]
            look["facecolors"] = _shaded(normals)
        mappable = canvas.faces(faces, **with_defaults(keywords, **look))
    if colors.values is None:
        mappable = None
    elif colors.place == "cells" or shading == "flat" or canvas.in_space:
        if colors.place == "points" and mappable is not None:
            shown = facets if canvas.in_space else corners[chosen]
            colors.paint(mappable, colors.values[shown].mean(axis=1))
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
    """Draw the hull with Matplotlib.

    In 2D the polygon and the points; in 3D the facets, with their ridges as lines.

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        Where to draw. By default new axes with equal scales, in 3D with ``projection="3d"``.
    values : (n,), (f,) or (m,) array_like, optional
        A number for each point, facet or cell. Values of points color the dots in 2D; in 3D faces have the mean of their
        corners.
    values_at : {'points', 'facets', 'cells'}, optional
        What the values belong to. By default the first that has as many entries.
    axes : sequence of int, optional
        Draw points and edges in these two or three coordinates.
    points : bool, optional
        Whether to draw all points as dots. By default if there are at most 1000.
    cmap : str or matplotlib.colors.Colormap, optional
        The colors of values.
    norm : matplotlib.colors.Normalize, optional
        The scale of values.
    vmin : float, optional
        The value of the first color.
    vmax : float, optional
        The value of the last color.
    colorbar : bool or str, optional
        Whether to draw a color bar beside values, or its label. By default there is one.
    **keywords : dict
        Arguments of the PolyCollection, LineCollection (values of facets in 2D) or Poly3DCollection that is drawn.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    ValueError
        If the dimension is not 2 or 3 and `axes` is not given, or arguments do not suit each other.
    ImportError
        If Matplotlib is missing.
    """
    canvas = Canvas(ax, self, axes)
    x, corners, k = self.points, self.cells, self.affine_dimension
    places = {"points": len(x)} if axes is not None else {"points": len(x), "facets": self.num_facets, "cells": len(corners)}
    colors = Colors(values, values_at, places, cmap, norm, vmin, vmax, colorbar, self._index)
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
            mappable = colors.paint(canvas.lines(x[corners], **with_defaults(keywords, linewidths=2, colors=None)), of_cells)
        else:
            following = dict(corners.tolist())
            around = [corners[0, 0].item()]
            while len(around) < len(corners):
                around.append(following[around[-1]])
            canvas.faces([x[around]], **with_defaults(keywords, facecolors=SOFT + "60", edgecolors=INK, linewidths=1))
        if colors.place == "points":
            mappable = canvas.colored_dots(x, colors.values, colors.keywords())
    else:
        by_cells = colors.place == "cells"
        faces = x[corners] if by_cells else facets_of_hull(self)
        if colors.place == "points":
            offsets, rows_of_facets = self.facets
            of_faces = np.add.reduceat(np.asarray(colors.values, dtype=float)[rows_of_facets], offsets[:-1]) / np.diff(offsets)
        look = {"edgecolors": "none"} if by_cells else {"edgecolors": INK, "linewidths": 0.5 * width_of_lines(len(faces))}
        if colors.values is None:
            look["facecolors"] = _shaded(self.equations[:, :3])
        found = canvas.faces(faces, **with_defaults(keywords, **look))
        if colors.values is not None:
            mappable = colors.paint(found, of_faces)
    if colors.place != "points" or k > 2:
        dots = _dots_too(x, points, rows)
        if len(dots):
            canvas.dots(dots)
    canvas.fit(*_box_of(x[self.vertices]))
    colors.finish(canvas, mappable)
    return canvas.ax


def lower_hull(self, ax=None, *, values=None, axes=None, points=None, cmap=None, norm=None, vmin=None, vmax=None, colorbar=None, **keywords):
    """Draw the cells over the compositions, the phase diagram, with Matplotlib.

    For compositions in the plane or in space the edges of the cells; for one number the hull itself, heights over compositions.

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        Where to draw. By default new axes with equal scales, in 3D with ``projection="3d"``.
    values : (n,) array_like, optional
        A number for each point, such as ``height_above(points)``: the colors of the dots.
    axes : sequence of int, optional
        Draw these two or three coordinates instead of the composition; the last one of all is the height.
    points : bool, optional
        Whether to draw the points as dots. By default they are drawn.
    cmap : str or matplotlib.colors.Colormap, optional
        The colors of values.
    norm : matplotlib.colors.Normalize, optional
        The scale of values.
    vmin : float, optional
        The value of the first color.
    vmax : float, optional
        The value of the last color.
    colorbar : bool or str, optional
        Whether to draw a color bar beside values, or its label. By default there is one.
    **keywords : dict
        Arguments of the LineCollection or Line3DCollection that is drawn.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    ValueError
        If compositions have more than three numbers and `axes` is not given, or arguments do not suit each other.
    ImportError
        If Matplotlib is missing.
    """
    if axes is None:
        if self.dimension > 4:
            raise ValueError(f"plot: compositions of {self.dimension - 1} numbers, and a picture has 2 or 3; axes=(0, 1) draws points and edges in "
                             "two of the coordinates, axes=(0, 1, 2) in three")
        axes = tuple(range(max(2, self.dimension - 1)))
    canvas = Canvas(ax, self, axes)
    x = self.points
    colors = Colors(values, None, {"points": len(x)}, cmap, norm, vmin, vmax, colorbar, self._index)
    return _projected(canvas, colors, x, _pairs_of(self.cells), np.arange(len(x)), points, keywords)


def alpha_complex(self, ax=None, *, values=None, values_at=None, points=None, shading="gouraud", cmap=None, norm=None, vmin=None, vmax=None,
                  colorbar=None, **keywords):
    """Draw the cells of the complex with Matplotlib, in 3D their surface.

    The same as ``triangulation.plot(cells=cell_numbers)``.

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        Where to draw. By default new axes with equal scales, in 3D with ``projection="3d"``.
    values : (n,) or (m,) array_like, optional
        A number for each point, or for each cell of the triangulation.
    values_at : {'points', 'cells'}, optional
        What the values belong to, if there are as many points as cells.
    points : bool, optional
        Whether to draw the vertices as dots. By default if there are at most 1000.
    shading : {'gouraud', 'flat'}
        Whether values of points are interpolated in a triangle, or averaged over its corners.
    cmap : str or matplotlib.colors.Colormap, optional
        The colors of values.
    norm : matplotlib.colors.Normalize, optional
        The scale of values.
    vmin : float, optional
        The value of the first color.
    vmax : float, optional
        The value of the last color.
    colorbar : bool or str, optional
        Whether to draw a color bar beside values, or its label. By default there is one.
    **keywords : dict
        Arguments of the collection that is drawn, see `Delaunay.plot`.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    ValueError
        If the dimension is not 2 or 3 and `axes` is not given, or arguments do not suit each other.
    ImportError
        If Matplotlib is missing.
    RuntimeError
        If points have been added to the triangulation since.
    """
    return self.triangulation.plot(ax, values=values, values_at=values_at, cells=self.cell_numbers, points=points, shading=shading, cmap=cmap,
                                   norm=norm, vmin=vmin, vmax=vmax, colorbar=colorbar, **keywords)


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


def diagram(self, ax=None, *, values=None, values_at=None, regions=None, axes=None, box=None, points=None, cmap=None, norm=None, vmin=None,
            vmax=None, colorbar=None, **keywords):
    """Draw the diagram with Matplotlib, clipped to a box.

    In 2D the edges and the sites, with values the regions in colors; in 3D the surfaces of the bounded regions inside the box.

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        Where to draw. By default new axes with equal scales, in 3D with ``projection="3d"``.
    values : (n,) or (regions,) array_like, optional
        A number for each point, or for each region.
    values_at : {'points', 'regions'}, optional
        What the values belong to, if their number does not tell.
    regions : (regions,) array_like of bool, or array_like of int, optional
        The regions to fill.
    axes : sequence of int, optional
        Draw the points, and lines between sites with a common ridge, in these two or three coordinates; values are those of
        the points. Excludes `regions` and `box`.
    box : (low, high), optional
        The box, two arrays (d,). By default ``bounding_box()``.
    points : bool, optional
        Whether to draw the sites as dots. By default if there are at most 1000.
    cmap : str or matplotlib.colors.Colormap, optional
        The colors of values.
    norm : matplotlib.colors.Normalize, optional
        The scale of values.
    vmin : float, optional
        The value of the first color.
    vmax : float, optional
        The value of the last color.
    colorbar : bool or str, optional
        Whether to draw a color bar beside values, or its label. By default there is one.
    **keywords : dict
        Arguments of the LineCollection, PolyCollection (values or regions) or Poly3DCollection that is drawn.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    ValueError
        If the dimension is not 2 or 3 and `axes` is not given, or arguments do not suit each other.
    ImportError
        If Matplotlib is missing.
    """
    canvas = Canvas(ax, self, axes, "points and lines between neighbors")
    x, k = self.points, self.affine_dimension
    places = {"points": len(x)} if axes is not None else {"points": len(x), "regions": self.num_regions}
    colors = Colors(values, values_at, places, cmap, norm, vmin, vmax, colorbar, self._index)
    sites = self.region_points
    if axes is not None:
        _not_with_axes(regions=regions, box=box)
        return _projected(canvas, colors, x, self.ridge_points, sites, points, keywords)
    mask = _chosen(regions, self.num_regions, "regions")
    of_regions = colors.values[sites] if colors.place == "points" else colors.values
    if not len(x):
        return canvas.ax
    low, high = as_box(box, self.bounding_box)
    mappable = None
    if not canvas.in_space:
        is_filled = colors.values is not None or regions is not None or any(name.startswith(("face", "fc")) for name in keywords)
        if is_filled:
            chosen = np.flatnonzero(mask)
            polygons = polygons_of_regions(self, chosen, low, high)
            shown = np.array([len(polygon) > 2 for polygon in polygons], dtype=bool)
            found = canvas.faces([polygon for polygon in polygons if len(polygon) > 2],
                                 **with_defaults(keywords, facecolors=SOFT, edgecolors=INK, linewidths=width_of_lines(3 * len(polygons))))
            if colors.values is not None:
                mappable = colors.paint(found, of_regions[chosen[shown]])
        if not is_filled or regions is not None:
            canvas.lines(edges_of_diagram(self, low, high), **({} if is_filled else keywords))
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
        polygons, owners = faces_of_regions(self, mask)
        if polygons:
            look = {"edgecolors": INK, "linewidths": width_of_lines(len(polygons)), "facecolors": SOFT if regions is not None else SOFT + "90"}
            if colors.values is not None:
                del look["facecolors"]
            found = canvas.faces(polygons, **with_defaults(keywords, **look))
            if colors.values is not None:
                mappable = colors.paint(found, of_regions[owners])
        elif k == 2:
            canvas.lines(edges_of_diagram(self, low, high), **keywords)
    dots = _dots_too(x, points, sites) if mappable is None or points else x[:0]
    if len(dots):
        canvas.dots(dots)
    canvas.fit(low, high, exactly=True)
    colors.finish(canvas, mappable)
    return canvas.ax


def intersection(self, ax=None, *, values=None, values_at=None, axes=None, box=None, cmap=None, norm=None, vmin=None, vmax=None, colorbar=None,
                 **keywords):
    """Draw the intersection with Matplotlib, clipped to a box if it is unbounded.

    In 2D the polygon, in 3D the facets.

    Parameters
    ----------
    ax : matplotlib.axes.Axes, optional
        Where to draw. By default new axes with equal scales, in 3D with ``projection="3d"``.
    values : (m,) or (f,) array_like, optional
        A number for each halfspace, or for each facet: the colors of the facets.
    values_at : {'halfspaces', 'facets'}, optional
        What the values belong to, if all halfspaces are facets.
    axes : sequence of int, optional
        Draw vertices and bounded edges in these two or three coordinates. Excludes `values` and `box`.
    box : (low, high), optional
        The box, two arrays (d,). By default somewhat larger than that of the vertices if the intersection is unbounded.
    cmap : str or matplotlib.colors.Colormap, optional
        The colors of values.
    norm : matplotlib.colors.Normalize, optional
        The scale of values.
    vmin : float, optional
        The value of the first color.
    vmax : float, optional
        The value of the last color.
    colorbar : bool or str, optional
        Whether to draw a color bar beside values, or its label. By default there is one.
    **keywords : dict
        Arguments of the PolyCollection, LineCollection (values in 2D) or Poly3DCollection that is drawn.

    Returns
    -------
    matplotlib.axes.Axes
        The axes.

    Raises
    ------
    ValueError
        If the dimension is not 2 or 3 and `axes` is not given, or arguments do not suit each other, or if the intersection is flat or empty.
    ImportError
        If Matplotlib is missing.
    """
    canvas = Canvas(ax, self, axes, "vertices and edges")
    rows = self.facet_halfspaces
    if axes is not None:
        _not_with_axes(values=values, values_at=values_at, box=box, cmap=cmap, norm=norm, vmin=vmin, vmax=vmax, colorbar=colorbar)
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
        canvas.faces([outline], **with_defaults({} if colors.values is not None else keywords, **look))
        look = {"linewidths": 1} if colors.values is None else with_defaults(keywords, linewidths=2, colors=None)
        lines = canvas.lines(np.array(drawn).reshape(-1, 2, 2), **look)
        if colors.values is not None:
            mappable = colors.paint(lines, of_facets[numbers])
    elif drawn:
        look = {"edgecolors": INK, "linewidths": width_of_lines(len(drawn)) * 1.5}
        if colors.values is None:
            look["facecolors"] = _shaded(self.halfspaces[rows[numbers], :3])
        found = canvas.faces(drawn, **with_defaults(keywords, **look))
        if colors.values is not None:
            mappable = colors.paint(found, of_facets[numbers])
    canvas.fit(*(_box_of(shown.vertices) if box is None else (low, high)))
    colors.finish(canvas, mappable)
    return canvas.ax
