# SPDX-License-Identifier: BSD-3-Clause
"""Results do not depend on the floating-point state of the thread: a library compiled with -ffast-math changes it when it is loaded,
as other code does by fesetround()."""
import ctypes
import os
import pickle
import platform
import sys
import tempfile

import numpy as np
import pytest

import delone
from delone import interpolate, spatial

pytestmark = pytest.mark.skipif(sys.platform != "linux" or platform.machine() != "x86_64" or platform.libc_ver()[0] != "glibc",
                                reason="the layout of fenv_t of glibc on x86-64")

CONTROL_OF_X87, MXCSR = 0, 28  # where they are in fenv_t
FLUSH_TO_ZERO = 0x8040
STATES = {"flush to zero": (0, FLUSH_TO_ZERO), "upward": (2, 0), "downward": (1, 0), "toward zero": (3, 0), "all": (2, FLUSH_TO_ZERO)}


def math_library():
    return ctypes.CDLL("libm.so.6")


def state():
    """fenv_t without the flags."""
    env = (ctypes.c_ubyte * 32)()
    assert math_library().fegetenv(env) == 0
    return int.from_bytes(env[CONTROL_OF_X87:2], "little"), int.from_bytes(env[MXCSR:32], "little") & 0xffc0


class Hostile:
    """While it lasts, the thread has another state. `after`: what it was at the end."""

    def __init__(self, rounding, more):
        self.rounding, self.more = rounding, more

    def __enter__(self):
        library = math_library()
        self.usual, env = (ctypes.c_ubyte * 32)(), (ctypes.c_ubyte * 32)()
        library.fegetenv(self.usual)
        library.fegetenv(env)
        env[1] = env[1] & ~0x0c | self.rounding << 2
        word = int.from_bytes(env[MXCSR:32], "little") & ~0x6000 | self.rounding << 13 | self.more
        env[MXCSR:32] = list(word.to_bytes(4, "little"))
        library.fesetenv(env)
        self.before = state()
        return self

    def __exit__(self, *_):
        self.after = state()
        math_library().fesetenv(self.usual)


def sets(n, d):
    random = np.random.default_rng(d)
    return {
        "least": random.integers(0, 8, (n, d)).astype(np.uint64).view(np.float64),
        "subnormal": random.integers(0, 2 ** 52, (n, d)).astype(np.uint64).view(np.float64),
        "small": random.standard_normal((n, d)) * 1e-300,
        "large": random.standard_normal((n, d)) * 1e300,
        "usual": random.random((n, d)),
        "lattice": random.integers(0, 4, (n, d)).astype(float),
    }


def arrays(*items):
    """Copies of the bytes of arrays and floats, and the text of other things. Python itself writes floats as the state says."""
    return [(np.asarray(item).dtype.str, np.shape(item), np.asarray(item).tobytes()) if isinstance(item, (np.ndarray, float)) else repr(item)
            for item in items]


def triangulations(x):
    t = delone.Delaunay(x)
    copy = pickle.loads(pickle.dumps(t))
    t.insert_range(x[:3].copy())
    t.remove([1, 4])
    regular = delone.Regular(x, x[:, 0].copy())
    furthest = delone.FurthestSite(x)
    return arrays(copy.hash, t.hash, t.cells, t.circumradii, t.circumcenters, t.qualities(), t.transform, regular.hash, furthest.hash,
                  *[t.alpha_values(j) for j in range(2)], str(delone.check(t.to_data())))


def diagrams(x):
    v = delone.Voronoi(x)
    return arrays(v.vertices, v.ray_directions, v.region_volumes(), v.ridge_volumes(), delone.PowerDiagram(x, x[:, 1].copy()).vertices)


def hulls(x):
    hull = delone.ConvexHull(x)
    lower = delone.LowerHull(x)
    return arrays(hull.hash, hull.equations, hull.volume, hull.area, hull.contains(x), lower.cells, lower.height_above(x),
                  delone.convex_hulls(x.reshape(2, -1, x.shape[1])).volumes)


def halfspaces(x):
    made = delone.HalfspaceIntersection(np.c_[x, -np.ones(len(x))])
    return arrays(made.state, made.vertices, made.directions, made.volume, made.dual_volume)


def queries(x):
    t = delone.Delaunay(x[:20])
    values = x[:20, 0].copy()
    linear, natural = delone.LinearInterpolator(t, values), delone.NaturalNeighborInterpolator(t, values, smooth=True)
    return arrays(t.find_simplex(x), *t.nearest(x), *t.nearest(x, k=2), *t.barycentric(x), linear(x), linear.gradient(x), natural(x),
                  natural.gradient(x))


def conversions(x):
    """Of numbers that are no float64 yet."""
    least = np.arange(12, dtype=np.uint32).reshape(6, 2) ** 2
    floats = least.view(np.float32)
    return arrays(delone.Delaunay(floats).points, delone.Delaunay(floats).hash, delone.Delaunay(x.tolist()).points,
                  delone.Delaunay(np.array([[2 ** 53 + 2, 0], [1, 7], [2 ** 62, 3]])).points)


def files(x):
    with tempfile.TemporaryDirectory() as folder:
        found = []
        for format in ("csv", "txt", "npy"):
            path = os.path.join(folder, f"points.{format}")
            delone.write_points(x, path)
            with open(path, "rb") as file:
                found += [file.read(), delone.read(path)]
        return arrays(*found)


def of_scipy(x):
    """But default tolerances and equations of hulls, which Python and NumPy compute in the state of the thread."""
    t, hull, v = spatial.Delaunay(x), spatial.ConvexHull(x, tolerance=0), spatial.Voronoi(x, tolerance=0)
    return arrays(t.simplices, t.transform, t.find_simplex(x), hull.simplices, hull.volume, hull.area, v.vertices, v.ridge_points)


def interpolation(x):
    values = x[:, 0].copy()
    return arrays(interpolate.LinearNDInterpolator(x, values)(x), interpolate.NearestNDInterpolator(x, values)(x),
                  interpolate.CloughTocher2DInterpolator(x, values)(x) if x.shape[1] == 2 else None)


def outcome(work, x):
    try:
        return work(x)
    except (delone.Error, ValueError, spatial.QhullError) as error:
        return [type(error).__name__, str(error)]


@pytest.mark.parametrize("work", [triangulations, diagrams, hulls, halfspaces, queries, conversions, files, of_scipy, interpolation])
@pytest.mark.parametrize("name", list(STATES))
def test_results_do_not_depend_on_the_state_of_the_thread(work, name):
    for d in (2, 3):
        for kind, x in sets(30, d).items():
            with np.errstate(all="ignore"):
                expected = outcome(work, x)
                with Hostile(*STATES[name]) as thread:
                    found = outcome(work, x)
            assert thread.after == thread.before, kind
            assert found == expected, kind


def test_subnormal_points_stay_distinct():
    points = np.array([[0, 0], [1, 0], [0, 1], [7, 2], [3, 9], [5, 5]], np.uint64).view(np.float64)
    with Hostile(0, FLUSH_TO_ZERO):
        t = delone.Delaunay(points)
        k, vertices = t.affine_dimension, t.num_vertices
    assert (k, vertices) == (2, 6)


def test_progress_functions_run_in_the_state_of_the_thread():
    points, seen = np.random.default_rng(0).random((100_000, 3)), []
    with Hostile(2, FLUSH_TO_ZERO) as thread:
        delone.Delaunay(points, progress=lambda _: seen.append(state()))
    assert seen and set(seen) == {thread.before}
    assert thread.after == thread.before
