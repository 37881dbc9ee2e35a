# SPDX-License-Identifier: BSD-3-Clause
"""Triangulations of more points than memory holds: a folder of parts, which together are the triangulation of all points.

`make_tiles` makes such a folder from a file or an array, `Tiles` reads it part by part. The cells, and their canonical hash,
are those of `delone.Delaunay` or `delone.Regular` of all points at once, or with a lattice those of `delone.PeriodicDelaunay` or
`delone.PeriodicRegular`.
"""
from __future__ import annotations

import os
import re
import warnings
from fractions import Fraction
from typing import Iterator, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _core, _lattice

__all__ = ["Forecast", "Part", "PartIndex", "Report", "Tiles", "make_tiles"]


class Forecast(NamedTuple):
    """Predicted cost of tiles, from a sample of the points.

    Parameters
    ----------
    num_points : int
        The number of points.
    num_tiles : int
        The number of tiles.
    cells_per_point : float
        Cells per point of the sample.
    foreign_share : float
        Points of other tiles that a tile inserts, divided by its own. Above 1 tiles do not pay.
    bytes_per_tile : int
        The memory of a tile at its peak.

    Examples
    --------
    >>> import delone.tiles
    >>> delone.tiles.Forecast(10**9, 40, 6.7, 0.04, 8 * 10**9).num_tiles
    40
    """

    num_points: int
    num_tiles: int
    cells_per_point: float
    foreign_share: float
    bytes_per_tile: int


class PartIndex(NamedTuple):
    """Entry of one part in the index of a folder.

    Parameters
    ----------
    file : str
        The name of its file.
    first_cell : int
        The number of its first cell in the triangulation.
    num_cells : int
        The number of its cells.
    num_points : int
        The number of input rows in its tile.
    num_vertices : int
        The number of distinct points of its tile that are not hidden.
    num_foreign : int
        The number of points of other tiles that its tile inserted.
    num_rounds : int
        The number of rounds in which it inserted them.
    num_bytes : int
        The size of its file.
    crc32 : int
        The checksum of its file, as of `zlib.crc32`.
    num_seam_bytes : int
        The size of the file of its seams.
    seam_crc32 : int
        The checksum of that file.

    Examples
    --------
    >>> import delone.tiles, tempfile
    >>> tiles = delone.tiles.make_tiles(delone.generate("uniform", 1000, 2), tempfile.mkdtemp(), tiles=2)
    >>> tiles.parts[0].first_cell
    0
    """

    file: str
    first_cell: int
    num_cells: int
    num_points: int
    num_vertices: int
    num_foreign: int
    num_rounds: int
    num_bytes: int
    crc32: int
    num_seam_bytes: int
    seam_crc32: int


class Part(NamedTuple):
    """Part of a triangulation: the cells whose lexicographically smallest vertex is in its tile.

    There are v points, m cells, and t rows in the tile. The arrays are read-only.

    Parameters
    ----------
    number : int
        The number of the part, from 0.
    first_cell : int
        Cell i of the part is cell ``first_cell + i`` of the triangulation.
    points : (v, d) ndarray of float64
        The vertices of the cells, those of other tiles included.
    weights : (v,) ndarray of float64 or None
        Their weights.
    rows : (v,) ndarray of int64
        The input row of each point; of equal rows the first.
    cells : (m, k+1) ndarray of int32
        The cells as rows of `points`, positively oriented if k = d; ``rows[cells]`` are input rows.
    neighbors : (m, k+1) ndarray of int64
        The cell opposite each vertex, by its number in the triangulation, in this part or another; -1 outside the convex hull.
    own_rows : (t,) ndarray of int64
        The input rows in the tile, increasing. Every row is in one tile.
    vertex_of_row : (t,) ndarray of int64
        The row of the vertex of each of them: of equal rows the first; -1 for hidden points.
    cell_offsets : (m, k+1, r) ndarray of int32 or None
        By how many lattice vectors each vertex is translated, in a periodic set: vertex i of cell c is
        ``points[cells[c, i]] + cell_offsets[c, i] @ tiles.lattice``. The `points` are in the box of the lattice.
    neighbor_offsets : (m, k+1, r) ndarray of int32 or None
        The same for neighbors.

    Examples
    --------
    >>> import delone.tiles, tempfile
    >>> tiles = delone.tiles.make_tiles(delone.generate("grid", 100, 2), tempfile.mkdtemp(), tiles=2)
    >>> sum(len(part.cells) for part in tiles) == tiles.num_cells
    True
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
    cell_offsets: Optional[np.ndarray] = None
    neighbor_offsets: Optional[np.ndarray] = None


class Report(NamedTuple):
    """Report of `Tiles.check`; true if there is no violation.

    Parameters
    ----------
    ok : bool
        Whether there is no violation.
    level : int
        The highest level examined: the failing one, or the last one requested.
    name : str
        The name of that level.
    violation : str
        The first violation; empty if there is none.
    cells : tuple of int
        The cells that the violation concerns, by their numbers in the triangulation.
    points : tuple of int
        The input rows that it concerns.
    ties : int
        The number of facets between two cells on one sphere.

    Examples
    --------
    >>> import delone.tiles, tempfile
    >>> tiles = delone.tiles.make_tiles(delone.generate("uniform", 1000, 2), tempfile.mkdtemp(), tiles=2)
    >>> tiles.check().name
    'completeness'
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
    """Finished folder of tiles; a sequence of its parts.

    Each part is read from its file on access; only the index is kept in memory.

    Parameters
    ----------
    folder : str or os.PathLike
        The folder that `make_tiles` has made.

    Raises
    ------
    delone.Error
        If there is no index, or a file of the folder is damaged.

    See Also
    --------
    make_tiles : Make a folder of tiles.

    Examples
    --------
    >>> import delone.tiles, tempfile
    >>> folder = tempfile.mkdtemp()
    >>> points = delone.generate("uniform", 1000, 3)
    >>> tiles = delone.tiles.make_tiles(points, folder, tiles=2)
    >>> delone.tiles.Tiles(folder).hash == delone.Delaunay(points).hash
    True
    >>> sum(len(part.cells) for part in tiles) == tiles.num_cells
    True
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
        """The number d of coordinates of a point."""
        return self._index["dimension"]

    @property
    def affine_dimension(self) -> int:
        """The dimension k <= d of the smallest flat that contains all points; 0 for one distinct point, -1 for none."""
        return self._index["affine_dimension"]

    @property
    def weighted(self) -> bool:
        """Whether the points have weights: the triangulation is then regular."""
        return self._index["weighted"]

    @property
    def lattice(self) -> Optional[np.ndarray]:
        """The lattice vectors of a periodic set, (r, d) float64; None for others."""
        numbers = self._index["lattice"]
        return np.array(numbers).reshape(-1, self.dimension) if numbers else None

    @property
    def unit(self) -> Optional[float]:
        """The number that coordinates of a periodic set are multiples of; None for others, and without one."""
        return self._index["unit"] or None

    @property
    def num_points(self) -> int:
        """The number of input rows."""
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
        """The number of points that are not vertices because of their weights."""
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
        """The entries of the index, a tuple of `PartIndex`; reads no file."""
        return self._parts

    def __len__(self) -> int:
        return len(self._parts)

    def __getitem__(self, i: int) -> Part:
        """Reads part i, in memory for this part."""
        if not -len(self) <= i < len(self):
            raise IndexError(f"part {i} of {len(self)}")
        i = range(len(self))[i]
        first_cell = self._parts[i].first_cell
        arrays = _core._read_tile(os.fsencode(self._folder), i, first_cell)
        if (lattice := self.lattice) is not None:
            for name in ("cell_offsets", "neighbor_offsets"):
                arrays[name] = arrays[name].reshape(*arrays["cells"].shape, len(lattice))
        return Part(number=i, first_cell=first_cell, **arrays)

    def __iter__(self) -> Iterator[Part]:
        return (self[i] for i in range(len(self)))

    def check(self, level: int = 6, *, points=None, weights=None, canonical: bool = False, threads: int = 0, progress=None) -> Report:
        """Examine all parts and their seams exactly.

        All levels prove that the cells are the Delaunay or regular triangulation of their vertices, and that every row is in one
        part; with `points` also that the vertices are these points, and duplicates equal to theirs.

        Parameters
        ----------
        level : int, default 6
            The highest level to examine: 1 storage, 2 incidence, 3 sphere, 4 volume, 5 local convexity, 6 completeness.
        points : (n, d) array_like, optional
            The input, to compare with at level 6. The folder does not hold the coordinates of duplicates and hidden points.
            Not for periodic sets.
        weights : (n,) array_like, optional
            The weights of the input.
        canonical : bool, default False
            Also require that ties are broken as delone breaks them.
        threads : int, default 0
            The most threads to use; 0: one per core if the work is large enough to gain by it.
        progress : bool or callable, optional
            As for `delone.Delaunay`.

        Returns
        -------
        Report
            The report; true if there is no violation. A part that cannot be read is a violation of level 1.

        Raises
        ------
        ValueError
            If the level is below 1, or points or weights have another shape than the input.
        delone.Error
            If the index cannot be read, or scratch files cannot be written into the folder.

        Notes
        -----
        Needs the memory of three parts, for a periodic set that of all parts.

        Examples
        --------
        >>> import delone.tiles, tempfile
        >>> points = delone.generate("uniform", 1000, 2)
        >>> bool(delone.tiles.make_tiles(points, tempfile.mkdtemp(), tiles=2).check(points=points))
        True
        """
        if points is None and weights is not None:
            raise ValueError("weights: those of which points?")
        rows = None if points is None else _rows_of(points, weights)
        found = _core._check_tiles(os.fsencode(self._folder), rows, level=min(level, 6), canonical=canonical, threads=threads, progress=progress)
        return Report(**{**found, "cells": tuple(found["cells"]), "points": tuple(found["points"])})

    def __repr__(self) -> str:
        kind = ("regular" if self.weighted else "Delaunay") if self.lattice is None else "periodic regular" if self.weighted else "periodic Delaunay"
        return (f"<delone.tiles.Tiles: {kind}, {self.num_points} points in dimension {self.dimension}, {self.num_cells} cells in "
                f"{len(self)} parts>")


def make_tiles(points, folder, *, weights=None, lattice=None, axes=None, unit=None, columns=None, format=None, raw=None, memory=None, tiles=None, threads=0, resume=True,
               vtu=False, forecast=None, damage=None, progress=None) -> Tiles:
    """Triangulate the points of a file or an array in tiles.

    Makes the Delaunay triangulation, or with weights the regular one, as a folder of parts.

    Parameters
    ----------
    points : str, os.PathLike or (n, d) array_like
        The points. Files .npy, .csv, .tsv, .txt, .xyz and .pts are read in pieces, .off, .ply, .pdb and .las at once.
    folder : str or os.PathLike
        The folder. It is created, or must be empty, or hold the work of an earlier call with the same arguments.
    weights : (n,) array_like, str or int, optional
        The weights; for a file the name or number (from 0) of their column.
    lattice : float, (d,) or (r, d) array_like, or ase.cell.Cell, optional
        As for `delone.PeriodicDelaunay`: the set is periodic. For a file, a single length is not enough, as it does not tell the dimension.
    axes : sequence of int or of bool, optional
        The lattice vectors in whose directions it is periodic, as for `delone.PeriodicDelaunay`.
    unit : float, optional
        Coordinates of a periodic set are multiples of this number, as for `delone.PeriodicDelaunay`.
    columns : sequence of str or int, optional
        The columns of a file with the coordinates, by name or number. By default all others.
    format : str, optional
        The format of a file. By default its extension tells it.
    raw : int, optional
        The file consists of little-endian float64, this many in a row, the weight included.
    memory : int or str, optional
        The most memory to use, above 0, in bytes or as "2G" or "500MB", the program and its arrays included. K, M, G, T and
        KiB, ... are powers of 1024; KB, ... are powers of 1000. By default three quarters of what is free.
    tiles : int, optional
        The number of tiles. By default as few as the memory allows. It does not change the triangulation.
    threads : int, default 0
        The most threads to use; 0: one per core if the work is large enough to gain by it.
    resume : bool, default True
        Continue from what an earlier call has left in the folder; of a finished folder make only those files again that are
        damaged or missing. Otherwise its tiles are removed first.
    vtu : bool, default False
        Also write tiles.pvtu and a .vtu for each part, for ParaView (d <= 3). Not with a lattice.
    forecast : callable, optional
        Called once with a `Forecast`, before the first tile; returning a false value other than None cancels the call.
    damage : callable, optional
        Called with a tuple of str before files of an earlier call are made again because they are damaged or missing: what is
        wrong with each. Returning a false value other than None cancels the call. By default a RuntimeWarning says it.
    progress : bool or callable, optional
        As for `delone.Delaunay`.

    Returns
    -------
    Tiles
        The finished folder.

    Raises
    ------
    delone.Error
        If a file cannot be read or written; the message gives the reason of the system.
    delone.InputError
        If values are not finite, or the folder holds anything else.
    delone.OutOfMemoryError
        If this many `tiles` need more than `memory`.
    delone.CancelledError
        If a function cancels the call.

    See Also
    --------
    Tiles : Read the folder.

    Notes
    -----
    After Ctrl-C, a full disk, or the end of the process only the tile in work is lost: the same call continues. Tiles also
    insert the points of other tiles that they need, a few percent in 2D and 3D. In high dimensions and for points on a surface
    these are many, and tiles cost several times as much as one triangulation (docs/tiles.md).

    Examples
    --------
    >>> import delone.tiles, tempfile
    >>> points = delone.generate("uniform", 1000, 3)
    >>> tiles = delone.tiles.make_tiles(points, tempfile.mkdtemp(), tiles=3)
    >>> len(tiles), tiles.num_points
    (3, 1000)
    >>> tiles = delone.tiles.make_tiles(points, tempfile.mkdtemp(), tiles=3, lattice=1.0)
    >>> tiles.hash == delone.PeriodicDelaunay(points, 1.0).hash
    True
    """
    if forecast is not None and not callable(forecast):
        raise TypeError("forecast: a function of a Forecast, or None")
    if damage is not None and not callable(damage):
        raise TypeError("damage: a function of a tuple of str, or None")
    tell = None if forecast is None else lambda found: forecast(Forecast(*found))
    how = dict(memory=_bytes_of(memory), tiles=0 if tiles is None else _positive(tiles, "tiles"), threads=threads, resume=bool(resume),
               vtu=bool(vtu), forecast=tell, damage=damage or _warn_of_damage, progress=progress, format=format or "", columns=0 if raw is None else _positive(raw, "raw"),
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
        dimension = None
    else:
        if columns is not None or format is not None or raw is not None:
            raise ValueError("columns, format and raw are for files")
        given = _rows_of(points, weights)
        dimension = given.shape[1] - (weights is not None)
    rows, unit = _lattice_of(lattice, axes, unit, dimension)
    how.update(lattice=rows.ravel().tolist(), dimension=rows.shape[1], unit=unit)
    _core._make_tiles(given, os.fsencode(folder), **how)
    return Tiles(folder)


def _lattice_of(lattice, axes, unit, dimension: Optional[int]) -> Tuple[np.ndarray, float]:
    """The lattice vectors of points of a dimension, or of a file if it is None, and the unit; 0 for none.

    Without a lattice there are no vectors, of dimension 0.
    """
    if lattice is None:
        for name, value in (("axes", axes), ("unit", unit)):
            if value is not None:
                raise ValueError(f"{name}: give a lattice, too")
        return np.empty((0, 0)), 0.0
    if unit is not None and not 0 < float(unit) < float("inf"):
        raise ValueError("unit: a finite number above 0, or None")
    if dimension is None:
        shape = np.shape(getattr(lattice, "cell", lattice))
        if not shape:
            raise ValueError("lattice: for a file give a length per axis, or vectors")
        dimension = shape[-1]
    return _lattice.vectors(lattice, axes, dimension), 0.0 if unit is None else float(unit)


def _warn_of_damage(files: Tuple[str, ...]) -> None:
    for file in files:
        warnings.warn(f"{file}; made again", RuntimeWarning, stacklevel=3)


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
