# SPDX-License-Identifier: BSD-3-Clause
"""delone.mpi: every rank runs this program, by mpirun."""
import pathlib
import sys
import tempfile

try:
    import numpy as np
    from mpi4py import MPI
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(0)

import delone
from delone.mpi import make_tiles

comm = MPI.COMM_WORLD
folder = tempfile.TemporaryDirectory(prefix="delone-mpi-") if comm.rank == 0 else None
path = pathlib.Path(comm.bcast(folder.name if folder else None))

points = np.random.default_rng(1).random((2000, 3))
weights = 0.01 * np.random.default_rng(2).random(len(points))
mine, weights_of_mine = np.array_split(points, comm.size)[comm.rank], np.array_split(weights, comm.size)[comm.rank]

tiles, effort = make_tiles(mine, path / "out", tiles=2 * comm.size)
assert tiles.hash == delone.Delaunay(points).hash
assert effort.num_tiles == 2
assert comm.allreduce(effort.num_points) == len(points)
assert comm.allreduce(effort.bytes_sent) == comm.allreduce(effort.bytes_received)

tiles, _ = make_tiles(mine, path / "weighted", weights=weights_of_mine)
assert tiles.hash == delone.Regular(points, weights).hash

# Half of the ranks, with a communicator of their own.
half = comm.Split(comm.rank % 2)
tiles, _ = make_tiles(np.array_split(points, half.size)[half.rank], path / f"half{comm.rank % 2}", half)
assert tiles.hash == delone.Delaunay(points).hash

if comm.rank == 0:
    np.save(path / "points.npy", np.column_stack([points, weights]))
comm.Barrier()
tiles, _ = make_tiles(path / "points.npy", path / "file", weighted=True)
assert tiles.hash == delone.Regular(points, weights).hash

tiles, _ = make_tiles(mine, path / "periodic", lattice=1.0)
assert tiles.hash == delone.PeriodicDelaunay(points, 1.0).hash
assert (tiles.lattice == np.eye(3)).all()
tiles, _ = make_tiles(mine, path / "slab", weights=weights_of_mine, lattice=[1, 1, 2], axes=[0, 2], unit=0.125)
assert tiles.hash == delone.PeriodicRegular(points, weights, [1, 1, 2], [0, 2], unit=0.125).hash
tiles, _ = make_tiles(path / "points.npy", path / "periodic_file", weighted=True, lattice=np.eye(3))
assert tiles.hash == delone.PeriodicRegular(points, weights, 1.0).hash

if comm.rank == comm.size - 1:
    mine = mine.copy()
    mine[3, 1] = np.nan
try:
    make_tiles(mine, path / "bad")
    raise AssertionError("a NaN was accepted")
except delone.InputError as error:
    assert error.rows == [3], error.rows
    assert comm.size == 1 or f"rank {comm.size - 1}: " in str(error), error
for wrong in [dict(threads=0), dict(weighted=True), dict(raw=3), dict(memory="much"), dict(axes=[0]), dict(unit=0.1)]:
    try:
        make_tiles(mine, path / "bad", **wrong)
        raise AssertionError(f"{wrong} was accepted")
    except ValueError:
        pass
comm.Barrier()
