# SPDX-License-Identifier: BSD-3-Clause
"""Other processes: workers by fork, spawn and forkserver, and a locale whose numbers have a decimal comma."""
import json
import os
import shutil
import subprocess
import sys

import pytest

WORKERS = '''
import multiprocessing
import sys

import numpy as np

import delone
from delone import interpolate, spatial


def points(seed):
    return np.random.default_rng(seed).random((4000, 3))


def build(seed):
    return delone.Delaunay(points(seed), threads=2).hash


def answer(given):
    """What objects that were sent know, and an object to send back."""
    t, hull, diagram, regular, old, linear = given
    t.insert_range([[2.0, 2.0, 2.0]])
    return (t, t.hash, hull.volume, diagram.num_vertices, regular.hash, int(old.find_simplex([0.5, 0.5, 0.5])), float(linear(0.5, 0.5, 0.5)),
            delone.scipy_is_patched())


if __name__ == "__main__":
    multiprocessing.set_start_method(sys.argv[1])
    seeds = list(range(6))
    expected = [build(seed) for seed in seeds]  # with threads, before any child is made
    p = points(9)
    t, old = delone.Delaunay(p), spatial.Delaunay(p)
    given = (t, delone.ConvexHull(p), delone.Voronoi(p[:200]), delone.Regular(p, p[:, 0]), old, interpolate.LinearNDInterpolator(old, p[:, 0]))
    with multiprocessing.Pool(2) as pool:
        assert pool.map(build, seeds, chunksize=1) == expected
        back, *known = pool.apply(answer, (given,))
    assert back.hash == known[0] != t.hash
    assert known[1:] == [given[1].volume, given[2].num_vertices, given[3].hash, int(old.find_simplex([0.5] * 3)), float(given[5](0.5, 0.5, 0.5)), False]
    t.insert_range([[2.0, 2.0, 2.0]])
    assert t.hash == back.hash
    print("equal")
'''


@pytest.mark.skipif(sys.platform == "win32", reason="fork")
@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_workers(method, tmp_path):
    program = tmp_path / "program.py"
    program.write_text(WORKERS)
    done = subprocess.run([sys.executable, "-W", "ignore::DeprecationWarning", str(program), method], capture_output=True, text=True, timeout=250)
    assert done.returncode == 0 and done.stdout == "equal\n", done.stderr


COMMA = '''
import ctypes, hashlib, json, locale, pathlib, sys

import numpy as np

import delone
from delone import spatial

locale.setlocale(locale.LC_ALL, "")
digits = ctypes.create_string_buffer(20)
ctypes.CDLL(None).snprintf(digits, 20, b"%g", ctypes.c_double(1.5))
folder = pathlib.Path(sys.argv[1])
told = {}


def tell(name, call):
    try:
        told[name] = str(call())
    except (delone.Error, ValueError) as error:
        told[name] = f"{type(error).__name__}: {error}".replace(str(folder), "")


points = np.random.default_rng(1).random((40, 3)) * [1e-7, 1.0, 123456.789]
t, hull, diagram = delone.Delaunay(points), delone.ConvexHull(points), delone.Voronoi(points)
for extension in ("csv", "tsv", "txt", "xyz", "pts", "ply", "qhull", "off", "svg", "vtu", "json", "npz"):
    path = folder / f"points.{extension}"
    tell(f"points {extension}", lambda: delone.write_points(points, path))
    if path.exists():
        tell(f"read {extension}", lambda: np.array_equal(delone.read(path), points))
    for name, made in (("triangulation", t), ("hull", hull), ("diagram", diagram)):
        path = folder / f"{name}.{extension}"
        tell(f"{name} {extension}", lambda: made.save(path))
        if path.exists():
            tell(f"read {name} {extension}", lambda: type(delone.read(path)))
path = folder / "typed.csv"
path.write_text("x,y\\n1.5,2.5\\n-1e-3,0.25\\n3,4.75\\n")
tell("typed", lambda: delone.read(path).tolist())
path.write_text("1.5;2,5\\n")
tell("comma", lambda: delone.read(path).tolist())
tell("repr", lambda: (repr(t), repr(hull), delone.check(t)))
# Beside these it has a time, which may differ.
forecast = repr(delone.forecast(3, 12345))
tell("forecast", lambda: (forecast.rpartition(", ")[0], forecast.count(",")))
tell("nan", lambda: delone.Delaunay([[1.5, float("nan")]]))
tell("limit", lambda: delone.Delaunay(points, time_limit=-1.5))
tell("tolerance", lambda: delone.ConvexHull(points, tolerance=-1.5))
tell("options", lambda: spatial.ConvexHull(points, qhull_options="E1.5e-9 C-0.001", flat="result").tolerance)
tell("page", lambda: hashlib.sha256(t.to_html(values=points[:, 1], title="1.5").encode()).hexdigest())
files = {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.iterdir())}
print(json.dumps([digits.value.decode(), told, files]))
'''


def test_a_decimal_comma_changes_nothing(tmp_path):
    """Files, pages and messages are the same, byte for byte, and files are read."""
    if not shutil.which("localedef"):
        pytest.skip("no localedef")
    (tmp_path / "comma").write_text('LC_NUMERIC\ndecimal_point "<U002C>"\nthousands_sep "<U002E>"\ngrouping 3;3\nEND LC_NUMERIC\n')
    subprocess.run(["localedef", "-c", "-i", "./comma", "./xx_XX"], cwd=tmp_path, capture_output=True)
    if not (tmp_path / "xx_XX" / "LC_NUMERIC").is_file():
        pytest.skip("localedef has no character sets")
    said = []
    for name in ("C", "xx_XX"):
        folder = tmp_path / f"files_{name}"
        folder.mkdir()
        environment = {**os.environ, "LOCPATH": str(tmp_path), "LC_ALL": name, "PYTHONUTF8": "1"}
        done = subprocess.run([sys.executable, "-c", COMMA, str(folder)], capture_output=True, text=True, encoding="utf-8", env=environment)
        assert done.returncode == 0, done.stderr
        said.append(json.loads(done.stdout))
    if said[1][0] != "1,5":
        pytest.skip("this C library has no decimal comma for the locale")
    assert said[0][0] == "1.5" and len(said[0][2]) > 15
    assert said[0][1] == said[1][1]
    assert said[0][2] == said[1][2]
    assert all(value == "True" for name, value in said[0][1].items() if name.startswith("read ") and len(name.split()) == 2), said[0][1]
