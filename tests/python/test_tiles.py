# SPDX-License-Identifier: BSD-3-Clause
"""delone.tiles: folders of tiles are the triangulations of all their points."""
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import warnings
import zlib

import numpy as np
import pytest

import delone
from delone import tiles
from delone.tiles import Tiles, make_tiles


@pytest.fixture
def random():
    return np.random.default_rng(3)


def global_cells(made):
    cells = np.concatenate([part.rows[part.cells] for part in made])
    neighbors = np.concatenate([part.neighbors for part in made])
    return cells, neighbors


def require_same(made, whole):
    """All that both say agrees; neighbors share the facet."""
    assert made.hash == whole.hash and made.affine_dimension == whole.affine_dimension
    assert (made.num_points, made.num_vertices, made.num_duplicates) == (whole.num_points, whole.num_vertices, whole.num_duplicates)
    cells, neighbors = global_cells(made)
    assert made.num_cells == len(cells) == len(whole)
    assert set(map(frozenset, cells.tolist())) == set(map(frozenset, whole.cells.tolist()))
    for j in range(cells.shape[1]):
        near = neighbors[:, j]
        facets = np.delete(cells, j, axis=1)
        shared = (cells[near][:, :, None] == facets[:, None, :]).any(axis=1).all(axis=1)
        assert shared[near >= 0].all()
    assert (neighbors == -1).sum() == made.num_hull_facets == len(whole.hull_facets)
    rows = np.concatenate([part.own_rows for part in made])
    vertices = np.concatenate([part.vertex_of_row for part in made])
    assert sorted(rows) == list(range(whole.num_points))
    assert (vertices[np.argsort(rows)] == whole.vertex_of_point).all()
    assert made.check(canonical=True)


@pytest.mark.parametrize("number", [1, 2, 5])
@pytest.mark.parametrize("dimension", [1, 2, 3, 4])
def test_same_as_in_memory(random, tmp_path, dimension, number):
    points = random.random((600, dimension))
    made = make_tiles(points, tmp_path / "out", tiles=number)
    assert len(made) == number
    require_same(made, delone.Delaunay(points))


def test_lattice_with_duplicates(random, tmp_path):
    points = random.integers(0, 8, (1500, 3))
    require_same(make_tiles(points, tmp_path / "out", tiles=6), delone.Delaunay(points))


def test_flat(random, tmp_path):
    points = random.integers(0, 40, (700, 2)) @ [[1, 2, 3, 0], [2, 1, 0, 5]]
    made = make_tiles(points, tmp_path / "out", tiles=4)
    assert made.affine_dimension == 2
    require_same(made, delone.Delaunay(points))


def test_weights(random, tmp_path):
    points, weights = random.random((900, 3)), random.random(900) * 0.03
    whole = delone.Regular(points, weights)
    made = make_tiles(points, tmp_path / "out", weights=weights, tiles=4)
    assert made.check(points=points, weights=weights)
    assert made.weighted and made.num_hidden == whole.num_hidden > 100
    require_same(made, whole)
    part = made[0]
    assert (part.weights == weights[part.rows]).all() and (part.points == points[part.rows]).all()
    # Of a file, its column.
    np.save(tmp_path / "p.npy", np.c_[weights, points])
    again = make_tiles(tmp_path / "p.npy", tmp_path / "again", weights=0, tiles=3)
    assert again.hash == made.hash


@pytest.mark.parametrize("points", [np.zeros((0, 2)), np.zeros((5, 3)), [[0.0, 1.0]], [[0.0], [2.0]]])
def test_little(tmp_path, points):
    made = make_tiles(points, tmp_path / "out")
    whole = delone.Delaunay(points)
    assert (made.hash, made.num_cells, made.num_vertices) == (whole.hash, len(whole), whole.num_vertices)
    assert sum(len(part.cells) for part in made) == len(whole)


def test_parts(random, tmp_path):
    points = random.random((500, 2))
    made = make_tiles(points, str(tmp_path / "out"), tiles=3)
    assert made.folder == str(tmp_path / "out") and len(made) == 3 and made.dimension == 2 and not made.weighted
    assert repr(made) == f"<delone.tiles.Tiles: Delaunay, 500 points in dimension 2, {made.num_cells} cells in 3 parts>"
    for number, part in enumerate(made):
        assert part.number == number and part.weights is None
        assert part.first_cell == made.parts[number].first_cell and len(part.cells) == made.parts[number].num_cells
        assert part.points.dtype == np.float64 and part.points.shape == (len(part.rows), 2)
        assert part.cells.dtype == np.int32 and part.neighbors.dtype == np.int64 and part.cells.shape == part.neighbors.shape
        assert part.own_rows.shape == part.vertex_of_row.shape == (made.parts[number].num_points,)
        assert not any(each.flags.writeable for each in part if isinstance(each, np.ndarray))
    assert made[-1].number == made[np.int64(2)].number == 2
    for wrong in (3, -4):
        with pytest.raises(IndexError, match=f"part {wrong} of 3"):
            made[wrong]
    with pytest.raises(TypeError):
        made[0:2]
    assert pickle.loads(pickle.dumps(made)).hash == Tiles(pathlib.Path(made.folder)).hash == made.hash


def test_check(random, tmp_path):
    points = random.random((400, 3))
    made = make_tiles(points, tmp_path / "out", tiles=2)
    assert made.check(points=points)
    points[7] += 1e-9
    report = made.check(points=points)
    assert not report and report.level == 6 and 7 in report.points
    for wrong in (dict(points=points[:-1]), dict(points=points, weights=points[:, 0]), dict(points=points[:, :2]), dict(weights=points[:, 0])):
        with pytest.raises(ValueError):
            made.check(**wrong)
    report = made.check(2)
    assert report and report.ok and report.level == 2 and report.name == "incidence" and report.violation == ""
    with pytest.raises(ValueError):
        made.check(0)
    with pytest.raises(ValueError, match="threads"):
        made.check(threads=-1)
    os.truncate(tmp_path / "out" / "part-0001.npz", 1000)
    report = made.check()
    assert not report and report.level == 1 and "part-0001.npz" in report.violation
    assert made[0].number == 0
    with pytest.raises(delone.Error, match="part-0001.npz"):
        made[1]


def test_arguments(random, tmp_path):
    points = random.random((50, 2))
    out = tmp_path / "out"
    for wrong in [dict(memory="2X"), dict(memory=0), dict(memory="1.5"), dict(memory=2**63), dict(memory=True), dict(memory="1e3"), dict(tiles=0),
                  dict(tiles=1.5), dict(threads=-1), dict(weights=[1.0]), dict(columns=[0]), dict(format="npy"), dict(raw=2)]:
        with pytest.raises(ValueError, match=next(iter(wrong))):
            make_tiles(points, out, **wrong)
    with pytest.raises(TypeError, match="progress"):
        make_tiles(points, out, progress=3)
    with pytest.raises(TypeError, match="weights"):
        make_tiles("p.npy", out, weights=[1.0])
    with pytest.raises(ValueError, match="shape"):
        make_tiles(points[0], out)
    with pytest.raises(delone.InputError, match="row 7"):
        make_tiles(np.where(np.arange(50)[:, None] == 7, np.nan, points), out)
    with pytest.raises(delone.Error, match="nothing.npy"):
        make_tiles(tmp_path / "nothing.npy", out)
    assert not out.exists()
    with pytest.raises(delone.Error, match="index.json"):
        Tiles(tmp_path)


@pytest.mark.parametrize("text, bytes_", [("2G", 2 << 30), ("1.5 kib", 1536), ("500MB", 500_000_000), ("3t", 3 << 40), ("77", 77), (5, 5), ("9B", 9)])
def test_sizes(text, bytes_):
    assert tiles._bytes_of(text) == bytes_


def test_files(random, tmp_path):
    points = random.random((300, 3))
    whole = delone.Delaunay(points).hash
    points.tofile(tmp_path / "p.dat")
    assert make_tiles(tmp_path / "p.dat", tmp_path / "a", raw=3, tiles=2).hash == whole
    np.savetxt(tmp_path / "p.csv", points, delimiter=",", header="x,y,z", comments="", fmt="%.17g")
    assert make_tiles(str(tmp_path / "p.csv"), tmp_path / "b", columns=["x", "y", "z"], memory="1G").hash == whole
    assert make_tiles(os.fsencode(tmp_path / "p.csv"), tmp_path / "c", columns=["x", 1]).hash == delone.Delaunay(points[:, :2]).hash


def test_folders(random, tmp_path):
    points = random.random((300, 2))
    made = make_tiles(points, tmp_path / "out", tiles=2)
    times = [os.stat(tmp_path / "out" / part.file).st_mtime_ns for part in made.parts]
    assert make_tiles(points, tmp_path / "out", tiles=2).hash == made.hash
    assert [os.stat(tmp_path / "out" / part.file).st_mtime_ns for part in made.parts] == times
    with pytest.raises(delone.InputError, match="finished tiles"):
        make_tiles(points + 1, tmp_path / "out", tiles=2)
    with pytest.raises(delone.InputError, match="finished tiles"):
        make_tiles(points, tmp_path / "out", tiles=3)
    assert make_tiles(points, tmp_path / "out", tiles=3, resume=False).hash == made.hash
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notes").write_text("")
    with pytest.raises(delone.InputError, match="it holds notes"):
        make_tiles(points, tmp_path / "mine")


@pytest.mark.parametrize("number", [1, 3])
@pytest.mark.parametrize("weighted", [False, True])
def test_damage(random, tmp_path, number, weighted):
    points = random.random((800, 3))
    how = dict(weights=random.random(800) * 0.02 if weighted else None, tiles=number)
    out = tmp_path / "out"
    made = make_tiles(points, out, **how)
    last = made.parts[-1]
    assert all(len(data := (out / part.file).read_bytes()) == part.num_bytes and zlib.crc32(data) == part.crc32 for part in made.parts)
    seams = out / last.file.replace(".npz", ".seams.npy")
    assert (seams.stat().st_size, zlib.crc32(seams.read_bytes())) == (last.num_seam_bytes, last.seam_crc32)
    whole = {path: path.read_bytes() for path in out.iterdir()}
    for path in (out / last.file, seams):
        data = whole[path]
        for damaged in (data[:-1], data[:50], b"", data[:-9] + b"?" + data[-8:], data + b"\0", None):
            path.unlink() if damaged is None else path.write_bytes(damaged)
            with pytest.raises(delone.Error, match=path.name):
                made[-1]
            assert path.name in made.check().violation
            seen = []
            assert make_tiles(points, out, damage=seen.append, **how).hash == made.hash
            assert len(seen) == 1 and len(seen[0]) == 1 and f"{path.name}: " in seen[0][0]
            assert {path: path.read_bytes() for path in out.iterdir()} == whole
    (out / last.file).unlink()
    with pytest.raises(delone.CancelledError):
        make_tiles(points, out, damage=lambda files: False, **how)
    with pytest.raises(ZeroDivisionError):
        make_tiles(points, out, damage=lambda files: 1 / 0, **how)
    with pytest.raises(TypeError, match="damage"):
        make_tiles(points, out, damage=3, **how)
    assert not (out / last.file).exists()
    with pytest.warns(RuntimeWarning, match=f"{last.file}.*made again"):
        make_tiles(points, out, **how)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert make_tiles(points, out, **how).check()


def test_progress_stops_and_resumes(random, tmp_path):
    points = random.random((40_000, 3))
    out = tmp_path / "out"
    seen = []

    def progress(fraction):
        seen.append(fraction)
        return len(list(out.glob("work/tile-*.json"))) < 2

    with pytest.raises(delone.CancelledError):
        make_tiles(points, out, tiles=20, threads=1, progress=progress)
    assert seen == sorted(seen) and 0 <= seen[0] and seen[-1] <= 1
    done = {path: path.stat().st_mtime_ns for path in out.glob("part-*.npz") if (out / "work" / path.name.replace("part", "tile").replace("npz", "json")).exists()}
    assert len(done) >= 2
    made = make_tiles(points, out, tiles=20)
    assert made.hash == delone.Delaunay(points).hash
    assert done == {path: path.stat().st_mtime_ns for path in done}


def test_forecast(random, tmp_path):
    seen = []
    points = random.random((3000, 2))
    make_tiles(points, tmp_path / "out", tiles=3, forecast=seen.append)
    assert len(seen) == 1 and (seen[0].num_points, seen[0].num_tiles) == (3000, 3) and 0 < seen[0].foreign_share < 1
    with pytest.raises(delone.CancelledError):
        make_tiles(random.random((2000, 7)), tmp_path / "no", tiles=4, forecast=lambda forecast: forecast.foreign_share < 1)
    with pytest.raises(ZeroDivisionError):
        make_tiles(points, tmp_path / "no", forecast=lambda forecast: 1 / 0)
    with pytest.raises(TypeError, match="forecast"):
        make_tiles(points, tmp_path / "no", forecast=3)
    assert not (tmp_path / "no").exists()


PROGRAM = """
import pathlib, signal, sys
import numpy as np
import delone.tiles
{before}
points = np.random.default_rng(3).random((20_000, 3))
print("ready", flush=True)
try:
    print(delone.tiles.make_tiles(points, sys.argv[1], tiles=10, threads=1).hash)
except KeyboardInterrupt:
    print("interrupted")
except delone.Error as error:
    print(type(error).__name__, error)
"""


def run(folder, before=""):
    return subprocess.Popen([sys.executable, "-c", PROGRAM.format(before=before), str(folder)], stdout=subprocess.PIPE, text=True)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_going_on_after_signals(tmp_path, number):
    out = tmp_path / "out"
    program = run(out)
    while len(list(out.glob("work/tile-*.json"))) < 2 and program.poll() is None:
        pass
    assert program.poll() is None, "it was over before the signal"
    program.send_signal(number)
    text = program.communicate(timeout=60)[0]
    assert text == ("ready\ninterrupted\n" if number == signal.SIGINT else "ready\n")
    assert list(out.glob("work/tile-*.json")) and not (out / "index.json").exists()
    text = run(out).communicate(timeout=60)[0]
    points = np.random.default_rng(3).random((20_000, 3))
    assert text == f"ready\n{delone.Delaunay(points).hash}\n"
    assert not (out / "work").exists()


def test_full_disk(tmp_path):
    limit = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, 300_000)); signal.signal(signal.SIGXFSZ, signal.SIG_IGN)"
    text = run(tmp_path / "out", limit).communicate(timeout=60)[0]
    assert text.startswith("ready\nError ") and "File too large" in text
    points = np.random.default_rng(3).random((20_000, 3))
    assert run(tmp_path / "out").communicate(timeout=60)[0] == f"ready\n{delone.Delaunay(points).hash}\n"


@pytest.mark.parametrize("axes", [None, [0, 1]])
def test_periodic(tmp_path, axes):
    points = delone.generate("uniform", 2000, 3, seed=3)
    whole = delone.PeriodicDelaunay(points, 1.0, axes)
    made = tiles.make_tiles(points, tmp_path / "out", tiles=4, lattice=1.0, axes=axes)
    assert made.hash == whole.hash and "periodic Delaunay" in repr(made)
    assert (made.lattice == whole.lattice).all()
    volume = 0.0
    for part in made:
        corners = part.points[part.cells] + part.cell_offsets @ made.lattice
        volume += np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
        # Neighbors share the facet opposite their vertex.
        cell = int(np.flatnonzero((part.neighbors >= part.first_cell + len(part.cells)).any(axis=1))[0]) if part.number == 0 else None
        if cell is None:
            continue
        i = int(np.flatnonzero(part.neighbors[cell] >= part.first_cell + len(part.cells))[0])
        other = next(p for p in made if p.first_cell <= part.neighbors[cell, i] < p.first_cell + len(p.cells))
        at = part.neighbors[cell, i] - other.first_cell
        there = other.points[other.cells[at]] + (other.cell_offsets[at] + part.neighbor_offsets[cell, i]) @ made.lattice
        shared = {tuple(p) for p in there.tolist()} & {tuple(p) for p in corners[cell].tolist()}
        assert len(shared) == 3
    if axes is None:
        assert abs(volume - 1) < 1e-12
    assert made.check() and tiles.Tiles(tmp_path / "out").check(canonical=True)


def test_periodic_files_and_weights(tmp_path):
    points, weights = delone.generate("uniform", 500, 2, seed=4), np.linspace(0, 0.01, 500)
    np.save(tmp_path / "points.npy", np.column_stack([points, weights]))
    whole = delone.PeriodicRegular(points, weights, [1.0, 1.0])
    made = tiles.make_tiles(tmp_path / "points.npy", tmp_path / "file", weights="2", tiles=3, lattice=[1.0, 1.0])
    assert made.hash == whole.hash and made.num_hidden == whole.num_hidden > 0
    assert tiles.make_tiles(points, tmp_path / "array", weights=weights, tiles=2, lattice=1.0).hash == whole.hash
    with pytest.raises(ValueError, match="a length per axis"):
        tiles.make_tiles(tmp_path / "points.npy", tmp_path / "no", weights="2", lattice=1.0)
    with pytest.raises(ValueError, match="axes: give a lattice"):
        tiles.make_tiles(points, tmp_path / "no", axes=[0])
    with pytest.raises(ValueError, match="unit: give a lattice"):
        tiles.make_tiles(points, tmp_path / "no", unit=0.1)
    with pytest.raises(ValueError, match="unit: a finite number above 0"):
        tiles.make_tiles(points, tmp_path / "no", lattice=1.0, unit=-0.1)
    with pytest.raises(delone.Error, match="not compared"):
        made.check(points=points, weights=weights)
    with pytest.raises(delone.Error, match="vtu"):
        tiles.make_tiles(points, tmp_path / "no", lattice=1.0, vtu=True)


# Multiples of 0.1 with ties; weights that are no multiples of anything.
@pytest.mark.parametrize("axes", [None, [1]])
def test_periodic_units(tmp_path, axes):
    points = np.stack(np.meshgrid(*[np.arange(7)] * 3), axis=-1).reshape(-1, 3) * 0.1
    whole = delone.PeriodicDelaunay(points, 0.7, axes, unit=0.1)
    made = tiles.make_tiles(points, tmp_path / "out", tiles=4, lattice=0.7, axes=axes, unit=0.1)
    assert made.hash == whole.hash and made.check(canonical=True)
    assert made.unit == 0.1 and (made.lattice == whole.lattice).all()
    weights = np.random.default_rng(1).random(len(points)) * 0.02
    made = tiles.make_tiles(points, tmp_path / "weighted", weights=weights, tiles=4, lattice=0.7, axes=axes, unit=0.1)
    assert made.hash == delone.PeriodicRegular(points, weights, 0.7, axes, unit=0.1).hash and made.check(canonical=True)
    for part in made:
        assert np.allclose(part.weights, weights[part.rows], rtol=4 * np.finfo(float).eps, atol=0)
    for other in (None, 0.05):
        with pytest.raises(delone.InputError, match="another unit"):
            tiles.make_tiles(points, tmp_path / "out", tiles=4, lattice=0.7, axes=axes, unit=other)
    assert tiles.make_tiles(points, tmp_path / "none", lattice=0.7).unit is None
    with pytest.raises(delone.InputError, match="point 5 is not below 2.53 units") as refused:
        points[5, 1] = 1e17
        tiles.make_tiles(points, tmp_path / "far", lattice=0.7, unit=0.1)
    assert refused.value.rows == [5]
