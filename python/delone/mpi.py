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
from .tiles import Tiles, _bytes_of, _lattice_of, _positive, _rows_of

__all__ = ["Effort", "make_tiles"]

if _mpi.size_of_communicator != MPI._sizeof(MPI.Comm) or _mpi.library_version != MPI.Get_library_version():
    raise ImportError(f"delone.mpi was built with another MPI ({_mpi.library_version.splitlines()[0]}) than mpi4py "
                      f"({MPI.Get_library_version().splitlines()[0]})")


class Effort(NamedTuple):
    """Work and times of one rank.

    Parameters
    ----------
    num_tiles : int
        Tiles that it triangulated.
    num_points : int
        Distinct points of these tiles.
    num_foreign : int
        Points of other tiles that it inserted.
    num_rounds : int
        Exchanges of pages.
    num_pages_received : int
        Pages that it received.
    num_messages : int
        Messages that it sent.
    bytes_sent : int
        Bytes that it sent.
    bytes_received : int
        Bytes that it received.
    reading : float
        Seconds of reading and distributing points.
    inserting : float
        Seconds of inserting points.
    asking : float
        Seconds of searching for points of other tiles.
    exchanging : float
        Seconds of exchanging pages.
    waiting : float
        Seconds of waiting for other ranks.
    writing : float
        Seconds of writing.
    total : float
        Seconds of the whole call.
    """

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


def make_tiles(points, folder, comm=None, *, weights=None, weighted=False, lattice=None, axes=None, unit=None, format=None, raw=None,
               memory=None, tiles=None, threads=1, resume=True) -> Tuple[Tiles, Effort]:
    """Triangulate points in tiles by all ranks of a communicator.

    As `delone.tiles.make_tiles`: each rank calls it with the same arguments, but its own rows. The triangulation, its hash and
    the numbers of rows are those of one process, for any number of ranks.

    Parameters
    ----------
    points : (n, d) array_like, str, os.PathLike, or list of paths
        The rows of this rank, which are numbered rank by rank; or files. Of one file every rank reads its share. Of several
        files each is read by one rank; a name with %d stands for the files with 0, 1, 2, ... in its place.
    folder : str or os.PathLike
        A folder that all ranks see.
    comm : mpi4py.MPI.Comm, optional
        The communicator. By default MPI.COMM_WORLD.
    weights : (n,) array_like, optional
        The weights of an array.
    weighted : bool, default False
        Whether the last column of files holds weights.
    lattice : float, (d,) or (r, d) array_like, or ase.cell.Cell, optional
        The lattice of a periodic set, as for `delone.tiles.make_tiles`.
    axes : sequence of int or of bool, optional
        The lattice vectors in whose directions it is periodic, as for `delone.tiles.make_tiles`.
    unit : float, optional
        Coordinates of a periodic set are multiples of this number, as for `delone.PeriodicDelaunay`.
    format : str, optional
        The format of files, as for `delone.tiles.make_tiles`.
    raw : int, optional
        The numbers in a row of files, as for `delone.tiles.make_tiles`.
    memory : int or str, optional
        The most memory of one rank, as for `delone.tiles.make_tiles`.
    tiles : int, optional
        The number of all tiles. By default one per rank, or a multiple of that.
    threads : int, default 1
        The threads of one rank.
    resume : bool, default True
        Continue from what an earlier call has left, whatever the number of its ranks.

    Returns
    -------
    tiles : delone.tiles.Tiles
        The finished folder.
    effort : Effort
        What this rank did for it.

    Raises
    ------
    delone.Error
        Raised by all ranks, with the number of the rank that failed first; its kinds as for `delone.tiles.make_tiles`.
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
        dimension = None
    else:
        if format is not None or raw is not None or weighted:
            raise ValueError("format, raw and weighted are for files")
        given, weighted = _rows_of(points, weights), weights is not None
        dimension = given.shape[1] - weighted
    if raw is not None and format is not None:
        raise ValueError("raw: a format of its own; leave format out")
    rows, unit = _lattice_of(lattice, axes, unit, dimension)
    found = _mpi.make_tiles(given, os.fsencode(folder), MPI._addressof(comm), memory=_bytes_of(memory),
                            tiles=0 if tiles is None else _positive(tiles, "tiles"), threads=threads, weighted=bool(weighted),
                            format="raw" if raw is not None else format or "", columns=0 if raw is None else _positive(raw, "raw"),
                            lattice=rows.ravel().tolist(), dimension=rows.shape[1], unit=unit, resume=bool(resume))
    return Tiles(folder), Effort(**found)
