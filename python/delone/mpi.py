# SPDX-License-Identifier: BSD-3-Clause
"""Triangulations of more points than one machine holds: the processes of an MPI communicator make a folder of tiles together.

    mpirun -n 4 python program.py

with `from delone.mpi import make_tiles` in the program. Needs mpi4py, and a module that was built with the same MPI (DELONE_BUILD_MPI).
"""
from __future__ import annotations

import os
from typing import NamedTuple, Tuple

from mpi4py import MPI

try:
    from . import _mpi
except ImportError as missing:
    raise ImportError("this build of delone has no delone.mpi: build it with MPI (DELONE_BUILD_MPI)") from missing
from .tiles import Tiles, _bytes_of, _positive, _rows_of

__all__ = ["Effort", "make_tiles"]

if _mpi.size_of_communicator != MPI._sizeof(MPI.Comm) or _mpi.library_version != MPI.Get_library_version():
    raise ImportError(f"delone.mpi was built with another MPI ({_mpi.library_version.splitlines()[0]}) than mpi4py "
                      f"({MPI.Get_library_version().splitlines()[0]})")


class Effort(NamedTuple):
    """What this rank did: the tiles that it triangulated, the distinct points of all its tiles, the points of other tiles that it inserted;
    rounds of questions, pages received, messages and bytes; and times in seconds: reading and distributing points, inserting them, asking
    for points of other tiles, exchanging pages, waiting for other ranks, writing, and all."""

    num_tiles: int
    num_points: int
    num_foreign: int
    num_rounds: int
    num_pages_received: int
    num_messages: int
    bytes_sent: int
    bytes_received: int
    reading: float
    inserting: float
    asking: float
    exchanging: float
    waiting: float
    writing: float
    total: float


def make_tiles(points, folder, comm=None, *, weights=None, weighted=False, format=None, raw=None, memory=None, tiles=None, threads=1,
               resume=True) -> Tuple[Tiles, Effort]:
    """As `delone.tiles.make_tiles`, by all ranks of `comm`: each calls it with the same arguments, but its own rows. Returns the folder, and
    what this rank did for it. The triangulation, its hash and the numbers of rows are those of one process, for any number of ranks.

    points : an array (n, d), a path, or a list of paths
        The rows of this rank, which are numbered rank by rank; or files. One file is shared: every rank reads its part. Of several each is
        read by one rank; a name with %d stands for the files with 0, 1, 2, ... in its place.
    folder : a path that all ranks see
    comm : a communicator of mpi4py; MPI.COMM_WORLD, if not given
    weights : the weights of an array, (n,) floats
    weighted : of files, whether the last column has weights
    format, raw : of files, as for `delone.tiles.make_tiles`
    memory : of one rank, as for `delone.tiles.make_tiles`
    tiles : the number of all tiles; one per rank, or a multiple of that, if not given
    threads : of one rank
    resume : whether to go on with what an earlier call has left, whatever the number of its ranks

    delone.Error and its kinds are raised by all ranks, with the number of the rank that failed first in front.
    """
    comm = MPI.COMM_WORLD if comm is None else comm
    if threads < 1:
        raise ValueError(f"threads: at least 1, not {threads}")
    if isinstance(points, (str, bytes, os.PathLike)):
        points = [points]
    if isinstance(points, list) and points and all(isinstance(each, (str, bytes, os.PathLike)) for each in points):
        if weights is not None:
            raise ValueError("weights: of files they are the last column; say weighted=True")
        given = [os.fsencode(each) for each in points]
    else:
        if format is not None or raw is not None or weighted:
            raise ValueError("format, raw and weighted are for files")
        given, weighted = _rows_of(points, weights), weights is not None
    if raw is not None and format is not None:
        raise ValueError("raw: a format of its own; leave format out")
    found = _mpi.make_tiles(given, os.fsencode(folder), MPI._addressof(comm), memory=_bytes_of(memory),
                            tiles=0 if tiles is None else _positive(tiles, "tiles"), threads=threads, weighted=bool(weighted),
                            format="raw" if raw is not None else format or "", columns=0 if raw is None else _positive(raw, "raw"),
                            resume=bool(resume))
    return Tiles(folder), Effort(**found)
