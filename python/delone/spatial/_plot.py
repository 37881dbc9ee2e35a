# SPDX-License-Identifier: BSD-3-Clause
"""Pictures in the plane, with Matplotlib, which is imported when the first one is made."""
from __future__ import annotations

import numpy as np

from .._canvas import pyplot


def _axes(ax, points, what):
    """The axes to draw on, new ones if there are none; their limits are the bounding box of the points and a tenth more."""
    if points.shape[1] != 2:
        raise ValueError(f"{what} is not 2-D")
    if ax is None:
        ax = pyplot().figure().gca()
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.1 * (high - low)
    if (margin > 0).all():
        ax.set_xlim(low[0] - margin[0], high[0] + margin[0])
        ax.set_ylim(low[1] - margin[1], high[1] + margin[1])
    return ax


def delaunay_plot_2d(tri, ax=None):
    """Draw the points and edges of a triangulation of the plane.

    Parameters
    ----------
    tri : Delaunay
        The triangulation.
    ax : matplotlib.axes.Axes, optional
        The axes to draw on. By default those of a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Raises
    ------
    ValueError
        If the points are not in the plane.
    ImportError
        If Matplotlib is missing.
    """
    ax = _axes(ax, tri.points, "Delaunay triangulation")
    x, y = tri.points.T
    ax.plot(x, y, "o")
    if tri.simplices.shape[1] == 3:
        ax.triplot(x, y, tri.simplices.copy())
    elif tri.simplices.shape[1] == 2:
        ax.plot(x[tri.simplices.T], y[tri.simplices.T], "C1-")
    return ax.figure


def convex_hull_plot_2d(hull, ax=None):
    """Draw the points and the boundary of a convex hull in the plane.

    Parameters
    ----------
    hull : ConvexHull
        The hull.
    ax : matplotlib.axes.Axes, optional
        The axes to draw on. By default those of a new figure.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Raises
    ------
    ValueError
        If the points are not in the plane.
    ImportError
        If Matplotlib is missing.
    """
    from matplotlib.collections import LineCollection
    ax = _axes(ax, hull.points, "Convex hull")
    ax.plot(hull.points[:, 0], hull.points[:, 1], "o")
    boundary = hull.points[hull.simplices] if hull.simplices.shape[1] == 2 else hull.points[hull.vertices][None]
    ax.add_collection(LineCollection(list(boundary), colors="k", linestyle="solid"))
    return ax.figure


def voronoi_plot_2d(vor, ax=None, *, show_points=True, show_vertices=True, line_colors="k", line_width=1.0, line_alpha=1.0,
                    point_size=None):
    """Draw the points, vertices and ridges of a Voronoi diagram of the plane.

    Unbounded ridges are dashed.

    Parameters
    ----------
    vor : Voronoi
        The diagram.
    ax : matplotlib.axes.Axes, optional
        The axes to draw on. By default those of a new figure.
    show_points : bool, default True
        Whether to draw the points.
    show_vertices : bool, default True
        Whether to draw the vertices.
    line_colors : color, default 'k'
        The color of the ridges.
    line_width : float, default 1.0
        The width of the ridges.
    line_alpha : float, default 1.0
        The opacity of the ridges.
    point_size : float, optional
        The size of the points.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Raises
    ------
    ValueError
        If the points are not in the plane.
    ImportError
        If Matplotlib is missing.
    """
    from matplotlib.collections import LineCollection
    points = vor.points
    ax = _axes(ax, points, "Voronoi diagram")
    if show_points:
        ax.plot(points[:, 0], points[:, 1], ".", markersize=point_size)
    if show_vertices:
        ax.plot(vor.vertices[:, 0], vor.vertices[:, 1], "o")

    far = np.ptp(points, axis=0).max()
    outward = {frozenset(pair): direction for pair, direction in zip(vor._ray_points.tolist(), vor._ray_directions)}
    bounded, unbounded = [], []
    for pair, ends in zip(vor.ridge_points.tolist(), vor.ridge_vertices):
        start = vor.vertices[[end for end in ends if end >= 0]]
        if len(start) == 2:
            bounded.append(start)
        elif -1 in ends:
            unbounded.append([start[0], start[0] + far * outward[frozenset(pair)]])
        else:  # all points are on one line: the ridge is the bisector of two of them
            along = points[pair[1]] - points[pair[0]]
            normal = np.array([-along[1], along[0]]) / np.linalg.norm(along)
            unbounded.append([start[0] - far * normal, start[0] + far * normal])
    look = {"colors": line_colors, "lw": line_width, "alpha": line_alpha}
    ax.add_collection(LineCollection(bounded, linestyle="solid", **look))
    ax.add_collection(LineCollection(unbounded, linestyle="dashed", **look))
    return ax.figure
