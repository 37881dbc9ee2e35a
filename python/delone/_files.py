# SPDX-License-Identifier: BSD-3-Clause
"""Files, checks and point sets, as the command has them."""
from __future__ import annotations

import inspect
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._clipping import checked_box
from ._data import ComplexData, Data, from_core, names, text, whole
from ._frames import columns_of, framed

if TYPE_CHECKING:  # it takes longer to import than the module itself
    import numpy.typing as npt

_formats_of_results = ("npz", "json", "off")
_formats_of_polyhedra = ("ine", "ext")
_max_stream_bytes = 1 << 32
_levels = {"complex": 6, "hull": 5, "diagram": 5, "intersection": 3}
_levels_of_kinds = {"alpha_complex": 3, "trimmed": 3, "alpha_boundary": 2, "hull_boundary": 5}


def read(path, *, format: Optional[str] = None, columns: Optional[Sequence[Union[str, int]]] = None, skip_missing: bool = False,
         threads: int = 0, frame: bool = False) -> Any:
    """Read points or a result from a file.

    npz, json and off files hold points or a result; npy, csv, tsv, txt, xyz, pts, ply, pdb, las and qhull files hold points; ine and
    ext files hold a polyhedron. A folder of tiles is opened as `delone.tiles.Tiles`. docs/formats.md describes the formats.

    Parameters
    ----------
    path : str or os.PathLike
        The file or folder; "-" is standard input. Files compressed by gzip are decompressed, as "a.csv.gz".
    format : str, optional
        The format. By default the extension of the path tells it.
    columns : sequence of str or int, optional
        The columns of points to read, in this order: names, numbers from 0, or ranges such as "2-5", both ends included.
        A name takes precedence over a number. By default all columns.
    skip_missing : bool, default False
        Leave out the rows of points in which a value is missing: NaN, blank, "NA", "-", or another word that pandas reads so, in
        a column that is read. By default such rows are errors. Of an .off file the vertices are then read, also if it holds a result.
    threads : int, default 0
        The most threads that parse text; 0: one per core if the file is large enough to gain by it.
    frame : bool, default False
        Return points as a pandas DataFrame with the column names of the file.

    Returns
    -------
    numpy.ndarray, pandas.DataFrame, Data, Polyhedron or delone.tiles.Tiles
        Points as an (n, d) float64 array; a result as `ComplexData`, `HullData`, `IntersectionData` or `VoronoiData`; a polyhedron as
        `read_polyhedron` returns it.
    skipped : (m,) ndarray of int64
        With `skip_missing` only: the rows of the file that were left out, increasing. Points are numbered without them. The rows
        of the file that the points come from are ``np.delete(np.arange(n + m), skipped)``; they are the index of a DataFrame.

    Raises
    ------
    Error
        If the file cannot be read.
    InputError
        If the file violates its format, or points are NaN or infinite. The message names the line, row or member.
    TypeError
        If `frame` or `skip_missing` is true and the file holds a result; not for `skip_missing` and .off.
    ImportError
        If `frame` is true and pandas is missing.

    See Also
    --------
    check : Examine the contents of a result.
    write_points : Write points.

    Notes
    -----
    Numbers are read as the nearest float64. The shapes of all arrays of a result are checked; `check` examines their contents.
    Cost: O(size of the file) time and memory.

    Examples
    --------
    >>> import delone, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "points.csv")
    >>> delone.write_points([[0, 0], [1, 0.5]], path, columns=["x", "y"])
    >>> delone.read(path)
    array([[0. , 0. ],
           [1. , 0.5]])

    Rows with missing values:

    >>> with open(path, "w") as file:
    ...     _ = file.write("x,y\\n0,0\\n1,NA\\n2,3\\n")
    >>> points, skipped = delone.read(path, skip_missing=True)
    >>> points
    array([[0., 0.],
           [2., 3.]])
    >>> skipped
    array([1])
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
    if wanted in _formats_of_polyhedra:
        if chosen is not None or skip_missing or frame:
            raise TypeError(f"columns, skip_missing and frame are for points; {name} holds a polyhedron")
        return _core.Polyhedron._read(os.fsencode(name), _max_stream_bytes, threads, None, None, None)
    if chosen is None and wanted in _formats_of_results and not (skip_missing and wanted == "off"):
        data = from_core(*_core._read(os.fsencode(name), wanted, _max_stream_bytes))
        if wanted != "off" or len(data.cells):
            if frame or skip_missing:
                option = "frame" if frame else "skip_missing"
                raise TypeError(f"{option}: {name} holds no points, but {type(data).__name__}")
            return data
        points, found, skipped = np.array(data.points), data.columns, None
    else:
        points, found, skipped = _core._read_points(os.fsencode(name), format or "", chosen or [], bool(skip_missing), threads,
                                                    _max_stream_bytes)
    if frame:
        points = framed(points, found)
    if not skip_missing:
        return points
    if frame:
        points.index = np.delete(np.arange(len(points) + len(skipped)), skipped)
    return points, skipped


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
    """Write points to a file.

    Parameters
    ----------
    points : (n, d) array_like or pandas.DataFrame
        The points, finite numbers.
    path : str or os.PathLike
        The file; "-" is standard output.
    format : {'npy', 'csv', 'tsv', 'txt', 'xyz', 'pts', 'off', 'qhull'}, optional
        The format. By default the extension of the path tells it.
    columns : sequence of str, optional
        The names of the d coordinates, for csv and tsv. By default those of the DataFrame.

    Raises
    ------
    InputError
        If a number is NaN or infinite.
    Error
        If the file cannot be written.
    ValueError
        If the number of names is not d.

    See Also
    --------
    read : Read them back.

    Notes
    -----
    The file appears whole or not at all. `read` returns exactly the same numbers. Cost: O(n d).

    Examples
    --------
    >>> import delone, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "points.npy")
    >>> delone.write_points([[0, 0], [1, 0.5]], path)
    >>> delone.read(path).shape
    (2, 2)
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
    """Write the result to a file.

    Parameters
    ----------
    path : str or os.PathLike
        The file; "-" is standard output, for text formats.
    format : str, optional
        The format; by default the extension of the path tells it. Triangulations and hulls: npz and json (all arrays), off,
        vtu (ParaView), ply (surfaces), svg (plane), txt and npy (cells), html (as `to_html`). Diagrams: npz, json, svg, vtu, html.
        Intersections: npz, json, off, html. `to_meshio` gives stl, obj, msh and more.
    qhull : str, optional
        Write the output of Qhull for these options instead, such as "o Fv".

    Raises
    ------
    Error
        If the file cannot be written, or the format cannot hold the result.
    ValueError
        If Qhull has no such output, or `format` and `qhull` are both given.

    See Also
    --------
    delone.read : Read a file.
    to_data : The same arrays in memory.

    Notes
    -----
    The file appears whole or not at all. npz and json keep the names of columns.
    """
    _refuse_uninitialized(self)
    called = names(self)
    self._save(*_destination(path, format, qhull), called)


def _refuse_uninitialized(product) -> None:
    """An object whose __init__ has not run says so before arguments are looked at."""
    product.dimension


def save_diagram(self, path, format: Optional[str] = None, *, box: Optional[npt.ArrayLike] = None, qhull: Optional[str] = None) -> None:
    called, to = names(self), _destination(path, format, qhull)
    if box is not None and (qhull is not None or _format_of(os.fsdecode(path), format) not in ("svg", "vtu")):
        raise ValueError("box: only svg and vtu hold what is cut off at a box")
    self._save(*to, called, checked_box(box, self.dimension))


def _destination(path, format: Optional[str], qhull: Optional[str]) -> Tuple[bytes, str, Optional[str]]:
    if qhull is not None and format is not None:
        raise ValueError("format and qhull exclude each other")
    return os.fsencode(path), text(format or "", "format"), None if qhull is None else text(qhull, "qhull")


# Python 3.13 takes the indentation of docstrings away by itself.
save_diagram.__doc__ = (inspect.cleandoc(save.__doc__) + "\n").replace("""qhull : str, optional
""", """box : (low, high), optional
    Clip the regions of svg and vtu to this box, two arrays (d,). By default to `bounding_box()`.
qhull : str, optional
""").replace("are both given.", "are both given, or if `box`\n    is given for another format.")


def to_data(self) -> Data:
    """Return a copy as plain arrays.

    Returns
    -------
    ComplexData, HullData, IntersectionData or VoronoiData
        The arrays, with the names that files use.

    See Also
    --------
    save : Write these arrays to a file.
    """
    kind, members = self._data()
    return from_core(kind, members, None if kind == "intersection" else names(self))


def alpha_to_data(self) -> ComplexData:
    """Return the cells of the complex as plain arrays.

    Returns
    -------
    ComplexData
        All points, and the cells of the complex.

    Raises
    ------
    RuntimeError
        If points have been added to the triangulation since.
    """
    whole = self.triangulation
    weights = whole.weights if isinstance(whole, _core.Regular) else None
    number = np.full(whole.num_cells + 1, -1, dtype=self.cells.dtype)  # of each cell within the complex; the last entry is beyond the hull
    number[self.cell_numbers] = np.arange(len(self))
    return ComplexData(whole.points, self.cells, number[whole.neighbors[self.cell_numbers]], weights=weights, column_names=names(whole) or None,
                       kind="alpha_complex")


def save_alpha(self, path, format: Optional[str] = None) -> None:
    """Write all points and the cells of the complex to a file.

    Parameters
    ----------
    path : str or os.PathLike
        The file; "-" is standard output, for text formats.
    format : str, optional
        A format of `Delaunay.save` other than html. By default the extension of the path tells it.

    Raises
    ------
    Error
        If the file cannot be written, or the format cannot hold the complex.
    RuntimeError
        If points have been added to the triangulation since.

    Notes
    -----
    The file appears whole or not at all.
    """
    self.to_data().save(path, None if format is None else text(format, "format"))


class CheckReport(NamedTuple):
    """Report of `check`; true if there is no violation.

    Parameters
    ----------
    ok : bool
        Whether there is no violation.
    level : int
        The highest level examined: the failing one, or the last one requested.
    name : str
        The name of that level.
    violation : str
        The first violation, naming rows of arrays; empty if there is none.
    cells : tuple of int
        The cells that the violation concerns.
    points : tuple of int
        The input rows that it concerns.
    vertices : tuple of int
        The vertices that it concerns.
    halfspaces : tuple of int
        The halfspaces that it concerns.
    ties : int
        For triangulations the number of facets between two cells on one sphere (level 5), for hulls the number of ridges
        between two cells in one hyperplane (level 3).
    not_examined : str
        What the data say without holding a proof of it; empty for most data.

    Examples
    --------
    >>> import delone
    >>> report = delone.check([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    >>> report.ok, report.level, report.name
    (True, 6, 'completeness')
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
    not_examined: str = ""

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
    if isinstance(what, _core.AlphaComplex):
        what = what.to_data()
    if isinstance(what, Data):
        return what._kind, what._members, False, False
    if isinstance(what, (_core.Triangulation, _core.PeriodicTriangulation, _core.ConvexHull, _core.LowerHull, _core.HalfspaceIntersection, _core.Diagram)):
        return (*what._data(), False, False)
    if hasattr(what, "points") and hasattr(what, "simplices"):  # as scipy.spatial.Delaunay has them
        if np.shape(what.simplices)[1:] != (np.shape(what.points)[-1] + 1,):
            raise TypeError(f"a {type(what).__name__} whose simplices are no cells of a triangulation; check a delone.ConvexHull of its points")
        data = ComplexData(what.points, what.simplices, getattr(what, "neighbors", None))
        return data._kind, data._members, True, bool(getattr(what, "furthest_site", False))
    raise TypeError(f"a result of delone, one with points and simplices, or points and cells; not {type(what).__name__}")


def check(what: Any, cells: Optional[npt.ArrayLike] = None, *, neighbors: Optional[npt.ArrayLike] = None,
          weights: Optional[npt.ArrayLike] = None, level: Optional[int] = None, canonical: bool = False,
          any_orientation: Optional[bool] = None, furthest_site: Optional[bool] = None, threads: int = 0) -> CheckReport:
    """Examine a result exactly, level after level.

    The result may come from any program. The examination stops at the first violation.

    Parameters
    ----------
    what : object
        A triangulation, alpha complex, hull, lower hull, intersection or diagram of delone, what `read` has returned, or an object
        with `points` and `simplices`, such as scipy.spatial.Delaunay. Its `kind`, if it has one, decides what is proved. With
        `cells`: the points, an (n, d) array_like.
    cells : (m, k+1) array_like of int, optional
        The cells of a triangulation, as rows of the points.
    neighbors : (m, k+1) array_like of int, optional
        The neighbors of `cells`: number j is opposite vertex j, -1 outside the hull. By default they are derived.
    weights : (n,) array_like, optional
        The weights of the points of a regular triangulation, with `cells`.
    level : int, optional
        The highest level to examine, from 1; by default the last. Triangulations: 1 storage, 2 incidence, 3 sphere, 4 volume,
        5 local convexity, 6 completeness; lower hulls alike. Alpha complexes: 1 storage, 2 incidence, 3 part. Hulls: 1 storage,
        2 incidence, 3 convexity, 4 support, 5 completeness. Diagrams: 1 storage, 2 regions, 3 vertices, 4 ridges, 5 rays. Intersections: 1 storage, 2 support, 3 completeness.
    canonical : bool, default False
        Require that a triangulation breaks ties as delone does.
    any_orientation : bool, optional
        Take the cells of a triangulation as sets of vertices. By default true if `what` has `simplices`, whose order means
        nothing.
    furthest_site : bool, optional
        Require of a triangulation of unknown kind that no point is outside the sphere of a cell. By default `what` tells.
    threads : int, default 0
        The most threads to use; 0: one per core if the data are large enough to gain by it.

    Returns
    -------
    CheckReport
        The report; true if there is no violation.

    Raises
    ------
    ValueError
        If there is no such level, if arrays have wrong shapes, or if options of triangulations are given for another result.
    TypeError
        If `what` cannot be checked.

    Notes
    -----
    There is no tolerance: all signs are exact. Cost: O(m k^3) for a triangulation, O(n m k) for a hull; the points of a diagram
    are triangulated again.

    Examples
    --------
    >>> import delone
    >>> points = [[0, 0], [2, 0], [2, 1], [0, 2]]
    >>> delone.check(points, [[0, 1, 3], [1, 2, 3]]).violation == ""
    False
    >>> bool(delone.check(delone.Delaunay(points)))
    True
    """
    level = None if level is None else whole(level, "level", 1)
    threads = whole(threads, "threads")
    kind, members, are_sets, is_furthest = _data_to_check(what, cells, neighbors, weights)
    most = _levels_of_kinds.get(members.get("kind"), _levels[kind])
    if level is not None and level > most:
        raise ValueError(f"level: 1 to {most}, not {level}")
    are_sets = are_sets if any_orientation is None else any_orientation
    is_furthest = is_furthest if furthest_site is None else furthest_site
    if kind != "complex" and (canonical or are_sets or is_furthest):
        raise ValueError("canonical, any_orientation and furthest_site are for triangulations")
    return CheckReport(**_core._check(kind, members, level, bool(canonical), not are_sets, bool(is_furthest), threads))


def generate(kind: str, n: int, dimension: int, seed: int = 0) -> npt.NDArray[np.float64]:
    """Generate points of a named kind.

    The same arguments give the same bits on every platform.

    Parameters
    ----------
    kind : str
        The kind: {}.
    n : int
        The number of points. Only cube01, which has 2^d corners, may return fewer.
    dimension : int
        The number of coordinates, d >= 1.
    seed : int, default 0
        The seed of random kinds, 0 to 2^64 - 1.

    Returns
    -------
    (n, d) ndarray of float64
        The points.

    Raises
    ------
    ValueError
        If the kind is unknown, or does not exist for this n or d.

    Notes
    -----
    Cost: O(n d).

    Examples
    --------
    >>> import delone
    >>> delone.generate("grid", 4, 2)
    array([[0., 0.],
           [0., 1.],
           [1., 0.],
           [1., 1.]])
    """
    n, dimension, seed = whole(n, "n", most=2**63 - 1), whole(dimension, "dimension", 1), whole(seed, "seed", most=2**64 - 1)
    if text(kind, "kind") not in _core._point_set_kinds():
        raise ValueError(f"kind: {', '.join(_core._point_set_kinds())}; not {_core._represented(kind)}")
    return _core._generate(kind, n, dimension, seed)


generate.__doc__ = generate.__doc__.replace("{}", ", ".join(f"{name} ({text})" for name, text in _core._point_set_kinds().items()))


def lower_hull(points: npt.ArrayLike, side: str = "lower", *, tolerance: float = 0.0, seed: int = 0, order: str = "automatic",
               threads: int = 0, progress: Any = None, memory_limit: Optional[float] = None,
               time_limit: Optional[float] = None) -> "_core.LowerHull":
    """Compute the lower or upper hull of points with respect to the last coordinate.

    Parameters
    ----------
    points : (n, d) array_like or pandas.DataFrame
        The points, d >= 2: d-1 numbers of the composition, then the height.
    side : {'lower', 'upper'}
        Which hull.
    tolerance : float, default 0.0
        The largest height by which a point may be outside; 0 is exact.
    seed : int, default 0
        Seed of the random choices in the insertion order. Does not change the result.
    order : {'automatic', 'as_given', 'shuffled'}
        The insertion order. Does not change the result.
    threads : int, default 0
        The most threads to use; 0: one per core of this process if the work is large enough to gain by it.
    progress : bool or callable, optional
        True shows a progress bar. A function is called about ten times a second with the fraction done, 0 to 1; returning a
        false value other than None cancels the call.
    memory_limit : float, optional
        The most bytes that the process may use during the call.
    time_limit : float, optional
        The most seconds that the call may take.

    Returns
    -------
    LowerHull
        The hull; its class describes arguments and errors.

    See Also
    --------
    LowerHull : The class.

    Examples
    --------
    >>> import delone
    >>> hull = delone.lower_hull([[0.0, 0], [0.4, 1], [0.5, -1], [1, 0]])
    >>> hull.vertices
    array([0, 2, 3], dtype=int32)
    """
    return _core.LowerHull(points, side, tolerance=tolerance, seed=seed, order=order, threads=threads, progress=progress,
                           memory_limit=memory_limit, time_limit=time_limit)
