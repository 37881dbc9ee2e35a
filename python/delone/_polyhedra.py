# SPDX-License-Identifier: BSD-3-Clause
"""Polyhedra: what the compiled class needs in Python."""
from __future__ import annotations

import os
from typing import TYPE_CHECKING, Iterator, NamedTuple, Optional, Union

import numpy as np

from . import _core
from ._files import _max_stream_bytes

if TYPE_CHECKING:
    from fractions import Fraction


class Optimum(NamedTuple):
    """The largest or smallest value of a linear function on a polyhedron, and where it is attained.

    Parameters
    ----------
    state : {'attained', 'unbounded', 'empty'}
        'unbounded' if there is no such value, 'empty' if there is no point.
    value : float
        The value, rounded; infinite if it is unbounded, NaN for the empty set.
    value_fraction : fractions.Fraction or None
        The exact value; None unless it is attained.
    vertices : ndarray of int
        The vertices of the face at which it is attained, increasing: rows of `Polyhedron.vertices`.
    rays : ndarray of int
        The rays of that face. All lines belong to it.

    Examples
    --------
    >>> import delone
    >>> square = delone.Polyhedron.from_generators([[0, 0], [1, 0], [0, 1], [1, 1]])
    >>> best = square.maximize([1, 0])
    >>> best.state, best.value
    ('attained', 1.0)
    >>> square.vertices[best.vertices]
    array([[1., 0.],
           [1., 1.]])
    """

    state: str
    value: float
    value_fraction: Optional[Fraction]
    vertices: np.ndarray
    rays: np.ndarray


def read_polyhedron(path, *, threads=0, progress=None, memory_limit=None, time_limit=None) -> _core.Polyhedron:
    """Read a polyhedron in the form of cddlib and lrs: an .ine or .ext file.

    Parameters
    ----------
    path : str or os.PathLike
        The file; "-" is standard input. Files compressed by gzip are decompressed.
    threads : int, default 0
        The most threads to use; 0: one per core if the work is large enough to gain by it.
    progress : bool or callable, optional
        True shows a progress bar. A function is called about ten times a second with the fraction done, 0 to 1; returning a
        false value other than None cancels the call.
    memory_limit : float, optional
        The most bytes that the process may use during the call.
    time_limit : float, optional
        The most seconds that the call may take.

    Returns
    -------
    Polyhedron
        The polyhedron of its inequalities or generators. Real numbers mean what their digits say.

    Raises
    ------
    Error
        If the file cannot be read.
    InputError
        If it violates its format; the message names the line.
    CancelledError, OutOfMemoryError, TimeLimitError
        If the progress function cancels the call, or a limit is reached.

    See Also
    --------
    Polyhedron.save : Write one.

    Examples
    --------
    >>> import delone, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "third.ext")
    >>> delone.Polyhedron.from_generators([["1/3"], [2]]).save(path)
    >>> print(open(path).read(), end="")
    V-representation
    begin
    2 2 rational
    1 1/3
    1 2
    end
    >>> delone.read_polyhedron(path).vertex_integers
    array([[1, 3],
           [2, 1]])
    """
    return _core.Polyhedron._read(os.fsencode(path), _max_stream_bytes, threads, progress, memory_limit, time_limit)


def save(self, path, format: Optional[str] = None) -> None:
    """Write one of the two descriptions to a file, in the form of cddlib and lrs.

    Parameters
    ----------
    path : str or os.PathLike
        The file; "-" is standard output.
    format : {'ine', 'ext'}, optional
        'ine' has inequalities and equations, 'ext' vertices, rays and lines. By default the extension of the path tells it.

    Raises
    ------
    Error
        If the file cannot be written, or the format is another one.

    See Also
    --------
    delone.read_polyhedron : Read a file.

    Notes
    -----
    All numbers are exact. The file appears whole or not at all.
    """
    self._save(path, format or "")


class PolyhedraIntersection(NamedTuple):
    """What several polyhedra of a list have in common.

    Parameters
    ----------
    members : tuple of int
        Their numbers in the list, increasing, at least two.
    polyhedron : Polyhedron
        The intersection.

    Examples
    --------
    >>> import delone
    >>> left, right = (delone.Polyhedron.from_generators([[x], [x + 2]]) for x in (0, 1))
    >>> delone.intersections([left, right])[0].members
    (0, 1)
    """

    members: tuple[int, ...]
    polyhedron: _core.Polyhedron


def intersections(polyhedra, most_members=None, *, threads=0, progress=None, memory_limit=None, time_limit=None) -> list[PolyhedraIntersection]:
    """Intersect two or more of several polyhedra, in all combinations whose intersection has a volume.

    Parameters
    ----------
    polyhedra : sequence of Polyhedron
        The polyhedra, all in d dimensions.
    most_members : int, optional
        The most polyhedra that are intersected; 2 finds pairs alone. By default there is no limit.
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
    list of PolyhedraIntersection
        The intersections of affine dimension d: first of two, then of three, and so on.

    Raises
    ------
    TypeError
        If something else than a `Polyhedron` is in the sequence.
    ValueError
        If `most_members` is less than 2.
    Error
        If the polyhedra have different dimensions.
    CancelledError, OutOfMemoryError, TimeLimitError
        If the progress function cancels the call, or a limit is reached.

    See Also
    --------
    Polyhedron.intersection : The intersection of two, also one that is flat.
    union_volume : The volume of the union.
    ConvexHulls.intersection_volumes : Volumes alone, of pairs, in doubles.

    Notes
    -----
    An intersection is made from one with one member less, if that has a volume. n polyhedra that all have a common part have
    2^n - n - 1 intersections.

    Examples
    --------
    >>> import delone
    >>> squares = [delone.Polyhedron.from_generators([[x, 0], [x + 3, 0], [x, 3], [x + 3, 3]]) for x in (0, 1, 2, 4)]
    >>> for members, shared in delone.intersections(squares):
    ...     print(members, shared.volume_fraction)
    (0, 1) 6
    (0, 2) 3
    (1, 2) 6
    (2, 3) 3
    (0, 1, 2) 3
    """
    if most_members is not None and most_members < 2:
        raise ValueError(f"most_members: at least 2, not {most_members}")
    return [PolyhedraIntersection(*fields)
            for fields in _core._intersections(polyhedra, most_members or 0, threads, progress, memory_limit, time_limit)]


def union_volume(polyhedra, *, threads=0, progress=None, memory_limit=None, time_limit=None) -> Optional[Fraction]:
    """Compute the volume of the union of polyhedra, exactly.

    Parameters
    ----------
    polyhedra : sequence of Polyhedron
        The polyhedra, all in d dimensions.
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
    fractions.Fraction or None
        The d-dimensional volume; None if it is infinite.

    Raises
    ------
    TypeError
        If something else than a `Polyhedron` is in the sequence.
    Error
        If the polyhedra have different dimensions.
    CancelledError, OutOfMemoryError, TimeLimitError
        If the progress function cancels the call, or a limit is reached.

    See Also
    --------
    intersections : The intersections themselves.
    Polyhedron.convex_union : The smallest polyhedron that contains two.

    Notes
    -----
    Inclusion and exclusion: each polyhedron adds what the earlier ones do not have, which is its volume less that of the union of
    its intersections with them. Intersections within others and those without volume are left out. The cost is that of the
    remaining ones, which are 2^n if all n polyhedra have a common part and nothing is left out.

    Examples
    --------
    >>> import delone
    >>> squares = [delone.Polyhedron.from_generators([[x, x], [x + 2, x], [x, x + 2], [x + 2, x + 2]]) for x in range(5)]
    >>> delone.union_volume(squares)
    Fraction(16, 1)
    """
    return _core._union_volume(polyhedra, threads, progress, memory_limit, time_limit)


class GeneratorsOfPolyhedron(NamedTuple):
    """One polyhedron of PolyhedraVertices."""

    affine_dimension: int
    vertices: np.ndarray
    rays: np.ndarray
    lines: np.ndarray


class PolyhedraVertices:
    """Vertices, rays and lines of n polyhedra in d dimensions; a sequence of them.

    The arrays are read-only and hold one polyhedron after the other. Entry i is a named tuple (affine_dimension, vertices, rays,
    lines). All are those of `Polyhedron`, in its order. Made by `polyhedra_vertices`.

    Parameters
    ----------
    affine_dimensions : (n,) ndarray of int32
        The dimension k <= d of each affine hull; -1 for the empty set.
    vertex_offsets : (n+1,) ndarray of int64
        Polyhedron i has the vertices ``vertices[vertex_offsets[i]:vertex_offsets[i+1]]``.
    vertices : (v, d) ndarray of float64
        The vertices, each coordinate rounded to the nearest double.
    ray_offsets : (n+1,) ndarray of int64
        The same for rays.
    rays : (r, d) ndarray of float64
        The directions of the rays.
    line_offsets : (n+1,) ndarray of int64
        The same for lines.
    lines : (l, d) ndarray of float64
        The directions of the lines.

    Examples
    --------
    >>> import delone
    >>> A = [[1, 0], [0, 1], [-1, -1]]
    >>> found = delone.polyhedra_vertices([A, A], [[1, 1, 0], [2, 2, -5]])
    >>> found.affine_dimensions
    array([ 2, -1], dtype=int32)
    >>> found[0].vertices
    array([[-1.,  1.],
           [ 1., -1.],
           [ 1.,  1.]])
    """

    __slots__ = ("affine_dimensions", "line_offsets", "lines", "ray_offsets", "rays", "vertex_offsets", "vertices")

    def __init__(self, affine_dimensions, vertex_offsets, vertices, ray_offsets, rays, line_offsets, lines):
        self.affine_dimensions = affine_dimensions
        self.vertex_offsets, self.vertices = vertex_offsets, vertices
        self.ray_offsets, self.rays = ray_offsets, rays
        self.line_offsets, self.lines = line_offsets, lines

    def __len__(self) -> int:
        return len(self.affine_dimensions)

    def __getitem__(self, i: Union[int, slice]) -> Union[GeneratorsOfPolyhedron, list[GeneratorsOfPolyhedron]]:
        if isinstance(i, slice):
            return [self[j] for j in range(*i.indices(len(self)))]
        if not -len(self) <= i < len(self):
            raise IndexError(f"polyhedron {i} of {len(self)}")
        i %= len(self)
        return GeneratorsOfPolyhedron(int(self.affine_dimensions[i]), self.vertices[slice(*self.vertex_offsets[i:i + 2])],
                                      self.rays[slice(*self.ray_offsets[i:i + 2])], self.lines[slice(*self.line_offsets[i:i + 2])])

    def __iter__(self) -> Iterator[GeneratorsOfPolyhedron]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        return f"<delone.PolyhedraVertices: {len(self)} polyhedra, {len(self.vertices)} vertices, {len(self.rays)} rays>"


def polyhedra_vertices(A, b, *, threads=0, progress=None, memory_limit=None, time_limit=None) -> PolyhedraVertices:
    """Compute the vertices of many small polyhedra A x <= b.

    Parameters
    ----------
    A : (n, m, d) or (m, d) array_like
        The left sides of the m inequalities of each of n polyhedra, or of all of them.
    b : (n, m) array_like
        The right sides.
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
    PolyhedraVertices
        The vertices, rays and lines of each.

    Raises
    ------
    ValueError
        If an array has another shape.
    InputError
        If a number is NaN or infinite, or not exact in double precision; the message names the polyhedron and the row.
    CancelledError, OutOfMemoryError, TimeLimitError
        If the progress function cancels the call, or a limit is reached.

    See Also
    --------
    Polyhedron : One polyhedron, with numbers of any kind and more answers.

    Notes
    -----
    As exact as `Polyhedron`. Polyhedra of up to 63 inequalities in up to 6 dimensions are made in another way, which is several
    times as fast, unless they are flat or have a line. Method: double description with minors of the rows as coordinates.
    Cost: some ten microseconds for each of 8 inequalities in 3D.

    Examples
    --------
    >>> import delone
    >>> import numpy as np
    >>> A = np.concatenate([np.eye(3), -np.eye(3)])
    >>> boxes = delone.polyhedra_vertices(A, [[1, 1, 1, 0, 0, 0], [1, 2, 3, 0, 0, -3]])
    >>> boxes
    <delone.PolyhedraVertices: 2 polyhedra, 12 vertices, 0 rays>
    >>> boxes.affine_dimensions
    array([3, 2], dtype=int32)
    """
    A, b = _core._doubles(A, "A"), _core._doubles(b, "b")
    if b.ndim != 2:
        raise ValueError(f"b: an array of shape (n, m), not {b.shape}")
    n, m = b.shape
    if A.shape[:-1] not in ((n, m), (m,)):
        raise ValueError(f"A: an array of shape ({n}, {m}, d) or ({m}, d), not {A.shape}")
    if A.ndim == 2:
        A = np.broadcast_to(A, (n, *A.shape))
    if 0 in A.shape[1:]:
        raise ValueError("A: at least one inequality, and one dimension")
    return PolyhedraVertices(*_core._polyhedra_vertices(A, b, threads=threads, progress=progress, memory_limit=memory_limit, time_limit=time_limit))
