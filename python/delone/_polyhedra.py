# SPDX-License-Identifier: BSD-3-Clause
"""Polyhedra: what the compiled class needs in Python."""
from __future__ import annotations

import os
from fractions import Fraction
from typing import NamedTuple, Optional

import numpy as np

from . import _core
from ._data import text
from ._files import _max_stream_bytes


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
    self._save(os.fsencode(path), text(format or "", "format"))
