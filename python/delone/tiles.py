# SPDX-License-Identifier: BSD-3-Clause
"""Triangulations of more points than memory holds: a folder of parts, which together are the triangulation of all points.

`make_tiles` makes such a folder from a file or an array, `Tiles` reads it part by part. The cells, and their canonical hash, are those of
`delone.Delaunay` or `delone.Regular` of all points at once.
"""
from __future__ import annotations

import os
import re
from fractions import Fraction
from typing import Iterator, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _core

__all__ = ["Forecast", "Part", "PartIndex", "Report", "Tiles", "make_tiles"]


class Forecast(NamedTuple):
    """What tiles will cost, from a sample of the points: how many points and tiles there are, cells per point, the points of other tiles that
    a tile inserts divided by its own (above 1 tiles do not pay), and the memory of a tile at its peak, in bytes."""

    num_points: int
    num_tiles: int
    cells_per_point: float
    foreign_share: float
    bytes_per_tile: int


class PartIndex(NamedTuple):
    """What the index of a folder says of one part: its file, the global number of its first cell, how many cells, rows of the input and
    vertices it has, how many points of other tiles its tile had to insert, and in how many rounds."""

    file: str
    first_cell: int
    num_cells: int
    num_points: int
    num_vertices: int
    num_foreign: int
    num_rounds: int


class Part(NamedTuple):
    """One part: the cells whose lexicographically smallest vertex is in its tile. v points, m cells, t rows in the tile; the arrays are
    read-only.

    number : int
        Of the part, from 0.
    first_cell : int
        Cell i of the part is cell ``first_cell + i`` of the triangulation.
    points : (v, d) float64
        The vertices of the cells, those of other tiles included.
    weights : (v,) float64, or None
        Their weights.
    rows : (v,) int64
        The row of the input of each; of equal rows the first.
    cells : (m, k+1) int32
        Vertices as rows of `points`; positively oriented if k = d. ``rows[cells]`` are rows of the input.
    neighbors : (m, k+1) int64
        The cell across the facet opposite each vertex, by its number in the triangulation, be it in this part or in another; -1 beyond
        the convex hull.
    own_rows : (t,) int64
        The rows of the input in the tile, increasing. Every row is in one tile.
    vertex_of_row : (t,) int64
        For each of them the row whose vertex it shares: of equal rows the first; -1 for hidden points.
    """

    number: int
    first_cell: int
    points: np.ndarray
    weights: Optional[np.ndarray]
    rows: np.ndarray
    cells: np.ndarray
    neighbors: np.ndarray
    own_rows: np.ndarray
    vertex_of_row: np.ndarray


class Report(NamedTuple):
    """What `Tiles.check` has found.

    ok : whether there is no violation. level, name : the highest level that was examined, by its number and name: the one that failed, or
    the last. violation : the first violation, as text; empty if there is none. cells, points : the cells, by their numbers in the
    triangulation, and rows of the input that it is about. ties : facets between two cells on one sphere.
    """

    ok: bool
    level: int
    name: str
    violation: str
    cells: Tuple[int, ...]
    points: Tuple[int, ...]
    ties: int

    def __bool__(self) -> bool:
        return self.ok


class Tiles:
    """A folder of tiles that is finished: ``Tiles(folder)``. A sequence of its parts, each read from its file on access.

    Only the index is kept in memory. `delone.Error` if there is none, or if a file of the folder is damaged.

        for part in Tiles("out"):
            volume += ...part.points[part.cells]...
    """

    __slots__ = ("_folder", "_index", "_parts")

    def __init__(self, folder):
        self._folder = os.fspath(folder)
        self._index = _core._read_tiles_index(os.fsencode(self._folder))
        self._parts = tuple(PartIndex(**part) for part in self._index["parts"])

    @property
    def folder(self) -> str:
        """The path of the folder."""
        return self._folder

    @property
    def dimension(self) -> int:
        """The number of coordinates of a point, d."""
        return self._index["dimension"]

    @property
    def affine_dimension(self) -> int:
        """The dimension k of the smallest flat that contains all points: k <= d, 0 for one distinct point, -1 for none."""
        return self._index["affine_dimension"]

    @property
    def weighted(self) -> bool:
        """Whether the points have weights: the triangulation is then regular."""
        return self._index["weighted"]

    @property
    def num_points(self) -> int:
        """The number of rows of the input."""
        return self._index["num_points"]

    @property
    def num_vertices(self) -> int:
        """The number of vertices: distinct points that are not hidden."""
        return self._index["num_vertices"]

    @property
    def num_duplicates(self) -> int:
        """The number of rows that are equal to an earlier one."""
        return self._index["num_duplicates"]

    @property
    def num_hidden(self) -> int:
        """The number of points that are no vertices because of their weights."""
        return self._index["num_hidden"]

    @property
    def num_cells(self) -> int:
        """The number of cells of all parts."""
        return self._index["num_cells"]

    @property
    def num_hull_facets(self) -> int:
        """The number of facets on the convex hull."""
        return self._index["num_hull_facets"]

    @property
    def hash(self) -> str:
        """The canonical hash, 32 hexadecimal digits: that of the triangulation of all points at once, for any number of tiles."""
        return self._index["hash"]

    @property
    def parts(self) -> Tuple[PartIndex, ...]:
        """What the index says of each part. Nothing is read for it."""
        return self._parts

    def __len__(self) -> int:
        return len(self._parts)

    def __getitem__(self, i: int) -> Part:
        """Reads part i, in memory for this part."""
        if not -len(self) <= i < len(self):
            raise IndexError(f"part {i} of {len(self)}")
        i = range(len(self))[i]
        first_cell = self._parts[i].first_cell
        return Part(number=i, first_cell=first_cell, **_core._read_tile(os.fsencode(self._folder), i, first_cell))

    def __iter__(self) -> Iterator[Part]:
        return (self[i] for i in range(len(self)))

    def check(self, level: int = 6, *, points=None, weights=None, canonical: bool = False, threads: int = 0, progress=None) -> Report:
        """Examines all parts and their seams, exactly: a Report, which is true if there is no violation.

        level : the highest level to examine: 1 storage, 2 incidence, 3 sphere, 4 volume, 5 local convexity, 6 completeness
        points, weights : (n, d) and (n,) floats
            The input, which then is compared at level 6. Coordinates of duplicates and hidden points are not in the folder.
        canonical : whether to require also the choice among ties that delone makes
        threads, progress : as for `delone.Delaunay`

        All levels prove that the cells are the Delaunay or regular triangulation of their vertices, and that every row is in one part; with
        `points` that vertices are these points, and duplicates equal to theirs. Takes memory for three parts, and scratch files in
        the folder, which has to be writable. A part that cannot be read is a violation of level 1. ValueError for a level below 1, and
        for points or weights of another shape than those of the input.
        """
        if points is None and weights is not None:
            raise ValueError("weights: those of which points?")
        rows = None if points is None else _rows_of(points, weights)
        found = _core._check_tiles(os.fsencode(self._folder), rows, level=min(level, 6), canonical=canonical, threads=threads, progress=progress)
        return Report(**{**found, "cells": tuple(found["cells"]), "points": tuple(found["points"])})

    def __repr__(self) -> str:
        kind = "regular" if self.weighted else "Delaunay"
        return (f"<delone.tiles.Tiles: {kind}, {self.num_points} points in dimension {self.dimension}, {self.num_cells} cells in "
                f"{len(self)} parts>")


def make_tiles(points, folder, *, weights=None, columns=None, format=None, raw=None, memory=None, tiles=None, threads=0, resume=True,
               vtu=False, hdf5=False, forecast=None, progress=None) -> Tiles:
    """Makes the Delaunay triangulation of the points of a file or an array in tiles, and returns the folder as Tiles; with weights the
    regular triangulation.

    points : a path, or an array (n, d)
        Files are read in pieces: .npy, .csv, .tsv, .txt, .xyz, .pts; .off and .ply at once.
    folder : a path
        It is created, or has to be empty, or to hold what an earlier call with the same arguments has left.
    weights : the weights, (n,) floats; of a file the column that has them, by its name or number from 0
    columns : of a file, the columns with the coordinates, by name or number; all others, if not given
    format : of a file, if not told by its extension
    raw : int
        The file holds nothing but little-endian float64, so many per row, the weight included.
    memory : int, or text as "2G" or "500MB"
        The most memory to use, in bytes, the program and its arrays included; K, M, G and T are powers of 1024, as are KiB, …; KB, … powers
        of 1000. Three quarters of what is free, if not given.
    tiles : int
        The number of tiles; as few as the memory allows, if not given. Neither it nor the threads change the triangulation.
    threads : at most this many; 0: as many as there are cores, where they gain
    resume : whether to go on with what an earlier call has left in the folder. Otherwise its tiles are removed first.
    vtu, hdf5 : whether to write tiles.pvtu and a .vtu per part, for ParaView (d <= 3), and tiles.h5
    forecast : a function that is called once, before the first tile, with a Forecast; it stops the work as a progress function does
    progress : as for `delone.Delaunay`

    Ctrl-C, a full disk, or the end of the process lose the tile in work, no finished one: the same call goes on. Points of other tiles
    that a tile needs are inserted in both, a few percent in 2D and 3D. In high dimensions and for points on a surface they are many, and
    tiles cost several times as much (docs/tiles.md). delone.Error with the reason of the system if a file cannot be read or
    written; InputError for values that are not finite, and for a folder with anything else in it; OutOfMemoryError if so many
    `tiles` take more than `memory`.
    """
    if forecast is not None and not callable(forecast):
        raise TypeError("forecast: a function of a Forecast, or None")
    tell = None if forecast is None else lambda found: forecast(Forecast(*found))
    how = dict(memory=_bytes_of(memory), tiles=0 if tiles is None else _positive(tiles, "tiles"), threads=threads, resume=bool(resume),
               vtu=bool(vtu), hdf5=bool(hdf5), forecast=tell, progress=progress, format=format or "", columns=0 if raw is None else _positive(raw, "raw"),
               coordinates=[] if columns is None else [str(each) for each in columns], weights="", weighted=weights is not None)
    if isinstance(points, (str, bytes, os.PathLike)):
        if raw is not None:
            if format is not None:
                raise ValueError("raw: a format of its own; leave format out")
            how["format"] = "raw"
        if weights is not None:
            if not isinstance(weights, (str, int, np.integer)) or isinstance(weights, bool):
                raise TypeError("weights: of a file its column with the weights, a name or a number")
            how["weights"] = str(weights)
        given = os.fsencode(points)
    else:
        if columns is not None or format is not None or raw is not None:
            raise ValueError("columns, format and raw are for files")
        given = _rows_of(points, weights)
    _core._make_tiles(given, os.fsencode(folder), **how)
    return Tiles(folder)


def _rows_of(points, weights) -> np.ndarray:
    """Points, with their weights as a last column."""
    rows = _core._doubles(points, "points")
    if rows.ndim != 2 or rows.shape[1] < 1:
        raise ValueError(f"points: an array of shape (n, d), d at least 1, not {rows.shape}")
    if weights is None:
        return rows
    column = _core._doubles(weights, "weights")
    if column.shape != rows.shape[:1]:
        raise ValueError(f"weights: an array of shape {rows.shape[:1]}, not {column.shape}")
    return np.column_stack([rows, column])


def _positive(value, name: str) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not 1 <= value < 2**31:
        raise ValueError(f"{name}: a whole number of at least 1, not {_core._represented(value)}")
    return int(value)


_SIZE = re.compile(r"([0-9]+\.?[0-9]*|\.[0-9]+) ?(?:([KMGT])(I?B)?|B)?", re.IGNORECASE | re.ASCII)


def _bytes_of(memory: Union[int, str, None]) -> int:
    """0 for None."""
    if memory is None:
        return 0
    size = None
    if isinstance(memory, str) and len(memory) < 40:
        if found := _SIZE.fullmatch(memory.strip()):
            number, unit, rest = found.groups()
            base = 1000 if (rest or "").upper() == "B" else 1024
            size = Fraction(number) * base ** ("KMGT".index(unit.upper()) + 1 if unit else 0)
    elif isinstance(memory, (int, np.integer)) and not isinstance(memory, bool):
        size = Fraction(int(memory))
    if size is None or size.denominator != 1 or not 0 < size < 2**63:
        raise ValueError(f"memory: a whole number of bytes above 0, or a size as '2G' or '500MB', not {_core._represented(memory)}")
    return int(size)
