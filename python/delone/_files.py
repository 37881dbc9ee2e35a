# SPDX-License-Identifier: BSD-3-Clause
"""Files, checks and point sets, as the command has them."""
from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._clipping import checked_box
from ._data import ComplexData, Data, from_core, names, text, whole
from ._frames import columns_of, framed

_formats_of_results = ("npz", "json", "off")
_max_stream_bytes = 1 << 32
_levels = {"complex": 6, "hull": 5, "diagram": 5, "intersection": 3}


def read(path, *, format: Optional[str] = None, columns: Optional[Sequence[Union[str, int]]] = None, threads: int = 0,
         frame: bool = False) -> Any:
    """Reads points or a result, by the readers of the command.

    Of npz, json and off files whatever they hold: a `ComplexData`, `HullData`, `IntersectionData` or `VoronoiData` with its arrays; an
    off file without faces holds points. Of npy, csv, tsv, txt, xyz, pts, ply and qhull files the points, an (n, d) float64 array. Of a
    folder of tiles a `delone.tiles.Tiles`.

    path : str or os.PathLike
        "-" is standard input. What gzip has compressed is read as if it were not, as in "a.csv.gz".
    format : str
        The format; by default the extension of the path.
    columns : names, numbers from 0, or ranges as "2-5", both ends included
        The columns of points to read, in this order; the file then holds points. A str is a name before it is a number.
    threads : int
        At most so many read text; 0: as many as there are cores, where that pays.
    frame : bool
        Return points as a pandas DataFrame with the column names of the file. Raises ImportError without pandas, and
        TypeError if the file holds a result instead of points.

    Numbers are read as the nearest float64. Arrays of results have the shapes that they must have; `check` examines what they say.
    Errors: Error for a file that cannot be read, InputError, a ValueError, for one that is no such file and for NaN and infinities in
    points; both name the file, and the line, row or member. Cost: O(size of the file), in memory.
    """
    name = os.fspath(path)
    if isinstance(name, bytes):
        name = os.fsdecode(name)
    if os.path.isdir(name):
        from .tiles import Tiles
        return Tiles(name)
    threads = whole(threads, "threads")
    wanted = _format_of(name, format)
    chosen = None if columns is None else _columns(columns)
    if chosen is None and wanted in _formats_of_results:
        data = from_core(*_core._read(os.fsencode(name), wanted, _max_stream_bytes))
        if wanted != "off" or len(data.cells):
            if frame:
                raise TypeError(f"frame: {name} holds no points, but {type(data).__name__}")
            return data
        points, found = np.array(data.points), data.columns
    else:
        points, found = _core._read_points(os.fsencode(name), format or "", chosen or [], threads, _max_stream_bytes)
    return framed(points, found) if frame else points


def _format_of(name: str, format: Optional[str]) -> str:
    """The format in lower case: that of the extension, without .gz, if it is not named."""
    if format is not None:
        return text(format, "format").lower()
    stem, extension = os.path.splitext(name)
    return (os.path.splitext(stem)[1] if extension.lower() == ".gz" else extension)[1:].lower()


def _columns(columns: Any) -> List[str]:
    """Names as they are, numbers as ranges, which name nothing else."""
    if isinstance(columns, (str, bytes)) or not isinstance(columns, Iterable):
        raise TypeError("columns: a sequence of names or numbers")
    chosen = []
    for column in columns:
        number = None if isinstance(column, str) else whole(column, "columns")
        chosen.append(column if number is None else f"{number}-{number}")
    if not chosen:
        raise ValueError("columns: at least one")
    return chosen


def write_points(points: npt.ArrayLike, path, format: Optional[str] = None, *, columns: Optional[Sequence[str]] = None) -> None:
    """Writes points, (n, d) or a pandas DataFrame, for `read`, or for other programs.

    path : str or os.PathLike
        The file; "-" is standard output.
    format : str
        npy, csv, tsv, txt, xyz, pts, off or qhull; by default the extension of the path.
    columns : d str
        The names of the coordinates, for csv and tsv; by default those of the DataFrame.

    The file appears whole or not at all, and numbers are read as the same ones. Errors: InputError for NaN and infinities, Error where the
    file cannot be written, ValueError for another number of names. Cost: O(n d).
    """
    if isinstance(columns, str):
        raise TypeError("columns: a sequence of names")
    if isinstance(points, (str, bytes, os.PathLike)):
        raise TypeError(f"points: an array or a DataFrame, not {type(points).__name__}; write_points(points, path)")
    if not isinstance(path, (str, bytes, os.PathLike)):
        raise TypeError(f"path: a str or an os.PathLike, not {type(path).__name__}; write_points(points, path)")
    labels = list(columns if columns is not None else columns_of(points) or ())
    if labels and len(labels) != np.shape(points)[-1]:
        raise ValueError(f"columns: {len(labels)} names for {np.shape(points)[-1]} coordinates")
    _core._write_points(points, ["" if label is None else str(label) for label in labels], os.fsencode(path), text(format or "", "format"))


def save(self, path, format: Optional[str] = None, *, qhull: Optional[str] = None) -> None:
    """Writes a file, as the option -o of the command: for `read`, or for other programs.

    path : str or os.PathLike
        The file; "-" is standard output, for formats that are text.
    format : str
        By default the extension of the path. Of triangulations and hulls: npz, json (all arrays), off, vtu (ParaView), ply, stl, obj
        (surfaces), msh (Gmsh), svg (plane), txt (cells), npy (cells), html (as `to_html`). Of diagrams: npz, json, svg, vtu, html. Of intersections: npz,
        json, off, html.
    qhull : str
        Writes what Qhull prints for these options instead, as "o Fv".

    The file appears whole or not at all. npz and json keep the names of columns that the points came with. Errors: Error where the file
    cannot be written, or the format cannot hold this dimension; ValueError for an unknown output of Qhull.
    """
    called = names(self)
    self._save(*_destination(path, format, qhull), called)


def save_diagram(self, path, format: Optional[str] = None, *, box: Optional[npt.ArrayLike] = None, qhull: Optional[str] = None) -> None:
    called, to = names(self), _destination(path, format, qhull)
    if box is not None and (qhull is not None or _format_of(os.fsdecode(path), format) not in ("svg", "vtu")):
        raise ValueError("box: only svg and vtu hold what is cut off at a box")
    if self._is_furthest and qhull is None:
        raise ValueError("a diagram of furthest sites, which no file can hold: save the FurthestSite triangulation")
    self._save(*to, called, checked_box(box, self.dimension))


def _destination(path, format: Optional[str], qhull: Optional[str]) -> Tuple[bytes, str, Optional[str]]:
    if qhull is not None and format is not None:
        raise ValueError("format and qhull exclude each other")
    return os.fsencode(path), text(format or "", "format"), None if qhull is None else text(qhull, "qhull")


save_diagram.__doc__ = save.__doc__.replace("""    qhull : str
""", """    box : (low, high), each of d numbers
        svg and vtu hold what it leaves of the regions; by default `bounding_box()`. Unbounded regions end at it.
    qhull : str
""").replace("for an unknown output of Qhull.", "for an unknown output of Qhull, a box that another format\n"
                                                        "    would not hold, and a diagram of furthest sites.")


def to_data(self) -> Data:
    """A copy as plain arrays, with the names that files have: a `ComplexData`, `HullData`, `IntersectionData` or `VoronoiData`."""
    kind, members = self._data()
    if kind == "diagram" and self._is_furthest:
        members["furthest_site"] = True
    return from_core(kind, members, None if kind == "intersection" else names(self))


def alpha_to_data(self) -> ComplexData:
    """A copy as plain arrays, with the names that files have: a `ComplexData` of all points and the cells of the complex. RuntimeError if
    points have been added to the triangulation since."""
    whole = self.triangulation
    weights = whole.weights if isinstance(whole, _core.Regular) else None
    number = np.full(whole.num_cells + 1, -1, dtype=self.cells.dtype)  # of each cell within the complex; the last entry is beyond the hull
    number[self.cell_numbers] = np.arange(len(self))
    return ComplexData(whole.points, self.cells, number[whole.neighbors[self.cell_numbers]], weights=weights, column_names=names(whole) or None)


def save_alpha(self, path, format: Optional[str] = None) -> None:
    """Writes a file of all points and the cells of the complex: for `read`, or for other programs.

    path : str or os.PathLike
        The file; "-" is standard output, for formats that are text.
    format : str
        By default the extension of the path: those of `Delaunay.save` but html.

    The file appears whole or not at all. Errors: Error where the file cannot be written, or the format cannot hold this dimension;
    RuntimeError if points have been added to the triangulation since.
    """
    self.to_data().save(path, None if format is None else text(format, "format"))


class CheckReport(NamedTuple):
    """What `check` has found. True if it is right.

    ok : whether there is no violation. level, name : the highest level that was examined, by its number and name: the one that failed, or
    the last that was wanted. violation : the first violation, as text that names rows of arrays; empty if there is none. cells, points,
    vertices, halfspaces : the rows that it is about. ties : of triangulations the facets between two cells on one sphere (level 5), of
    hulls the ridges between two cells in one hyperplane (level 3).
    """

    ok: bool
    level: int
    name: str
    violation: str
    cells: Tuple[int, ...]
    points: Tuple[int, ...]
    vertices: Tuple[int, ...]
    halfspaces: Tuple[int, ...]
    ties: int

    def __bool__(self) -> bool:
        return self.ok


def _data_to_check(what: Any, cells: Optional[npt.ArrayLike], neighbors: Optional[npt.ArrayLike],
                   weights: Optional[npt.ArrayLike]) -> Tuple[str, Dict[str, Any], bool, bool]:
    """Kind and members; whether cells are sets of vertices, and whether they are furthest-site."""
    if cells is not None:
        data = ComplexData(what, cells, neighbors, weights=weights)
        return data._kind, data._members, False, False
    if neighbors is not None or weights is not None:
        raise TypeError("neighbors and weights are those of cells")
    if isinstance(what, _core.LowerHull):
        raise TypeError("a LowerHull is part of a hull: check the ConvexHull of its points")
    if isinstance(what, Data) and what._members.get("furthest_site") or isinstance(what, _core.Diagram) and what._is_furthest:
        raise TypeError("a diagram of furthest sites: check its FurthestSite triangulation")
    if isinstance(what, Data):
        return what._kind, what._members, False, False
    if isinstance(what, (_core.Triangulation, _core.ConvexHull, _core.HalfspaceIntersection, _core.Diagram)):
        return (*what._data(), False, isinstance(what, _core.FurthestSite))
    if hasattr(what, "points") and hasattr(what, "simplices"):  # as scipy.spatial.Delaunay has them
        if np.shape(what.simplices)[1:] != (np.shape(what.points)[-1] + 1,):
            raise TypeError(f"a {type(what).__name__} whose simplices are no cells of a triangulation; check a delone.ConvexHull of its points")
        data = ComplexData(what.points, what.simplices, getattr(what, "neighbors", None))
        return data._kind, data._members, True, bool(getattr(what, "furthest_site", False))
    raise TypeError(f"a result of delone, one with points and simplices, or points and cells; not {type(what).__name__}")


def check(what: Any, cells: Optional[npt.ArrayLike] = None, *, neighbors: Optional[npt.ArrayLike] = None,
          weights: Optional[npt.ArrayLike] = None, level: Optional[int] = None, canonical: bool = False,
          any_orientation: Optional[bool] = None, furthest_site: Optional[bool] = None, threads: int = 0) -> CheckReport:
    """Examines a result exactly, level after level, whoever made it: a `CheckReport`, which is true if there is no violation.

    what : a triangulation, hull, intersection or diagram of delone, what `read` has returned, or an object with `points` and `simplices`,
        as scipy.spatial.Delaunay is. With `cells`: points, (n, d).
    cells : (m, k+1) rows of points
        The simplices of a triangulation, from anywhere. `neighbors`, (m, k+1), and `weights`, (n,), if there are any.
    level : int
        The highest level to examine, from 1; all by default. Triangulations: 1 storage, 2 incidence, 3 sphere, 4 volume, 5 local
        convexity, 6 completeness. Hulls: 1 storage, 2 incidence, 3 convexity, 4 support, 5 completeness. Diagrams: 1 storage, 2 regions,
        3 vertices, 4 ridges, 5 rays. Intersections: 1 storage, 2 support, 3 completeness.
    canonical : bool
        Of a triangulation: whether ties must be decided as delone decides them.
    any_orientation : bool
        Of a triangulation: take cells as sets of vertices. By default where `what` has simplices, whose order says nothing.
    furthest_site : bool
        Of a triangulation: require that no point is outside the sphere of a cell. By default what `what` says.
    threads : int
        At most so many; 0: as many as there are cores, where that pays.

    No tolerance: all signs are exact. Errors: ValueError for a level that there is not, for arrays of wrong shapes, and for options of
    triangulations with something else; TypeError for what cannot be checked; InputError for NaN. Cost: O(m k^3) for a triangulation,
    O(n m k) for a hull; a diagram is made anew.
    """
    level = None if level is None else whole(level, "level", 1)
    threads = whole(threads, "threads")
    kind, members, are_sets, is_furthest = _data_to_check(what, cells, neighbors, weights)
    if level is not None and level > _levels[kind]:
        raise ValueError(f"level: 1 to {_levels[kind]}, not {level}")
    are_sets = are_sets if any_orientation is None else any_orientation
    is_furthest = is_furthest if furthest_site is None else furthest_site
    if kind != "complex" and (canonical or are_sets or is_furthest):
        raise ValueError("canonical, any_orientation and furthest_site are for triangulations")
    return CheckReport(**_core._check(kind, members, level, bool(canonical), not are_sets, bool(is_furthest), threads))


def generate(kind: str, n: int, dimension: int, seed: int = 0) -> npt.NDArray[np.float64]:
    """n points of a named kind in dimension d: an (n, d) float64 array, the same bits for the same arguments on every platform.

    kind : str
        {}
    n : int
        How many. Fewer are returned only by cube01, which has 2^d.
    dimension : int
        d >= 1.
    seed : int
        0 to 2^64 - 1.

    Errors: ValueError for an unknown kind, and for a combination that does not exist. Cost: O(n d).
    """
    n, dimension, seed = whole(n, "n", most=2**63 - 1), whole(dimension, "dimension", 1), whole(seed, "seed", most=2**64 - 1)
    if text(kind, "kind") not in _core._point_set_kinds():
        raise ValueError(f"kind: {', '.join(_core._point_set_kinds())}; not {_core._represented(kind)}")
    return _core._generate(kind, n, dimension, seed)


generate.__doc__ = generate.__doc__.replace("{}", ", ".join(f"{name} ({text})" for name, text in _core._point_set_kinds().items()))


def lower_hull(points: npt.ArrayLike, side: str = "lower", *, tolerance: float = 0.0, seed: int = 0, order: str = "automatic",
               threads: int = 0, progress: Any = None, memory_limit: Optional[float] = None,
               time_limit: Optional[float] = None) -> "_core.LowerHull":
    """The lower (or upper) hull of points, (n, d), with respect to the last coordinate: a `LowerHull`, which says all else."""
    return _core.LowerHull(points, side, tolerance=tolerance, seed=seed, order=order, threads=threads, progress=progress,
                           memory_limit=memory_limit, time_limit=time_limit)
