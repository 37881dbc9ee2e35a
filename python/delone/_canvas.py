# SPDX-License-Identifier: BSD-3-Clause
"""The axes of a picture and the colors of values, with Matplotlib, which is imported when the first picture is drawn."""
from __future__ import annotations

import numpy as np

from . import _core
from ._data import values_of
from ._frames import require_index

INK, SOFT = "#1f3a5f", "#9fb4c7"  # of lines and points; of faces
FEW = 1000  # so many points are drawn as dots, if nobody says otherwise
MANY = 20_000  # from so many shapes on, files of vector graphics hold them as an image


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
            self.axes = tuple(axes) if np.iterable(axes) else ()
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
        elif not hasattr(ax, "add_collection"):
            raise TypeError(f"ax: Axes of Matplotlib, not {type(ax).__name__}")
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
        keywords = with_defaults(keywords, colors=INK, linewidths=width_of_lines(len(segments)), rasterized=len(segments) > MANY)
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

    def __init__(self, values, values_at, places, cmap, norm, vmin, vmax, colorbar, index=None):
        """`places`: names and numbers of what values can belong to; of equal numbers the first one counts, unless `values_at` says.
        `index`: that of the points, see _frames.index()."""
        if norm is not None and (vmin is not None or vmax is not None):
            raise ValueError("norm: has limits of its own; leave out vmin and vmax")
        self.cmap, self.norm, self.vmin, self.vmax, self.colorbar = cmap, norm, vmin, vmax, colorbar
        self.values = self.place = None
        if values_at is not None and values_at not in places:
            raise ValueError(f"values_at: {' or '.join(map(repr, places))}, not {_core._represented(values_at)}")
        if values is None:
            return
        self.values = values_of(values, "values")
        for name, count in places.items():
            if self.values.shape == (count,) and values_at in (None, name):
                self.place = name
                if name == "points":
                    require_index(values, index, "values")
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


def with_defaults(keywords, **defaults):
    """The keywords, with those of the defaults that have not been given, under none of their names."""
    aliases = {"colors": ("color", "edgecolor", "edgecolors", "ec"), "linewidths": ("linewidth", "lw"), "edgecolors": ("edgecolor", "ec", "color"),
               "facecolors": ("facecolor", "fc", "color")}
    return {**{name: value for name, value in defaults.items() if not any(alias in keywords for alias in aliases.get(name, ()))}, **keywords}


def width_of_lines(count):
    """Of lines, by how many there are."""
    return float(np.clip(20 / np.sqrt(max(count, 1)), 0.15, 0.8))
