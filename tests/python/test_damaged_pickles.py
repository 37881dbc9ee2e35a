# SPDX-License-Identifier: BSD-3-Clause
"""Pickles that were damaged: an exception, or an object that can be used; never a crash or a hang."""
import inspect
import pickle

import pytest

from hostile_support import is_large, run

PROGRAM = """
import contextlib, copyreg, io, pickle, random, signal, sys
import numpy as np
import delone, delone.spatial, delone.interpolate
from hostile_support import array, dumps, members, new

{source}

seed, count, offset = int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
kinds = list(makers().items())
for number in range(offset, offset + count):
    rng = random.Random(seed * 1_000_003 + number)
    name, make = rng.choice(kinds)
    print(number, name, flush=True)
    signal.alarm(20)  # of one case; then the process ends by the signal
    data = DAMAGES[number % len(DAMAGES)](make(), rng)
    try:
        made = Careful(io.BytesIO(data)).load()
    except Exception:
        continue
    exercise(made)
signal.alarm(0)
print("done")
"""


class Careful(pickle.Unpickler):
    """A damaged name must not become a call of something else that exists."""

    def find_class(self, module, name):
        if module.split(".")[0] not in ("delone", "copyreg", "_codecs", "builtins", "hostile_support") or (module == "builtins" and name not in ("complex", "float", "int", "bool")):
            raise pickle.UnpicklingError(f"{module}.{name} is not for pickles of these tests")
        return super().find_class(module, name)


def makers():
    points = np.random.default_rng(0).random((12, 2))
    space = np.random.default_rng(1).random((9, 3))
    rows = np.c_[points - 0.5, -np.ones(12)]
    made = {
        "Delaunay": delone.Delaunay(points), "Regular": delone.Regular(points, np.arange(12) / 100), "FurthestSite": delone.FurthestSite(space),
        "ConvexHull": delone.ConvexHull(space), "Voronoi": delone.Voronoi(points), "PowerDiagram": delone.PowerDiagram(points, np.zeros(12)),
        "HalfspaceIntersection": delone.HalfspaceIntersection(rows, [0.0, 0.0]), "TrimResult": delone.Delaunay(points).trim(0.05),
        "LinearInterpolator": delone.LinearInterpolator(points, points @ [1, 2j]),
        "NaturalNeighborInterpolator": delone.NaturalNeighborInterpolator(points, points[:, 0], smooth=True),
        "Polyhedron": delone.Polyhedron(np.round(rows[:, :2], 2), [1] * 12), "cone": delone.Polyhedron.from_generators(rays=np.eye(3, dtype=int)),
        "PolyhedraVertices": delone.polyhedra_vertices([np.eye(2)], [[1, 2]]),
        "LowerHull": delone.LowerHull(space), "ComplexData": delone.Delaunay(points).to_data(),
        "Faces": delone.Delaunay(points).faces(1), "Forecast": delone.forecast(2, 12),
        "Locations": delone.Delaunay(points).locate(points + 0.1), "ConvexHulls": delone.convex_hulls([points, points[:5]]),
        "spatial.Delaunay": delone.spatial.Delaunay(points, incremental=True), "spatial.ConvexHull": delone.spatial.ConvexHull(space),
        "spatial.Voronoi": delone.spatial.Voronoi(points),
        "interpolate": delone.interpolate.LinearNDInterpolator(points, points[:, 1]),
    }
    return {name: (lambda each=each: each) for name, each in made.items()}


def truncated(made, rng):
    data = dumps(made, rng.randint(2, pickle.HIGHEST_PROTOCOL))
    return data[:rng.randrange(len(data))] + rng.choice([b"", b".", b"0.", b"1.", b"\x94."])


def with_flipped_bytes(made, rng):
    data = bytearray(dumps(made, rng.randint(2, pickle.HIGHEST_PROTOCOL)))
    for _ in range(rng.randint(1, 3)):
        data[rng.randrange(len(data))] ^= 1 << rng.randrange(8)
    return bytes(data)


def with_other_opcodes(made, rng):
    data = bytearray(dumps(made, rng.randint(2, pickle.HIGHEST_PROTOCOL)))
    at = rng.randrange(len(data))
    data[at:at + rng.randint(0, 2)] = rng.choice([b"N", b"0", b"2", b")", b"]", b"}", b"K\x00", b"J\xff\xff\xff\x7f", b"b", b"R", b"t", b"\x85", b"\x93",
                                                  b"G\x7f\xf8" + bytes(6), b"\x81", b"s", b"a", b"e", b"u", b"\x92"])
    return bytes(data)


def with_another_state(made, rng):
    """A sound pickle of a state that does not fit: entries of other types, shapes and values."""
    reduced = made.__reduce_ex__(2)
    state = list(reduced[2]) if len(reduced) > 2 and isinstance(reduced[2], tuple) else None
    arguments = list(reduced[1])
    entries = state if state else arguments
    for _ in range(rng.randint(1, 2)):
        at = rng.randrange(len(entries))
        with contextlib.suppress(ValueError, TypeError, OverflowError):  # where NumPy has no such array
            entries[at] = another(entries[at], rng)
    if rng.random() < 0.1:
        entries.append(None)

    class Pickled:
        def __reduce__(self):
            return (new if reduced[0] is copyreg.__newobj__ else reduced[0], tuple(arguments)) + ((tuple(state),) if state else tuple(reduced[2:3]))

    return dumps(Pickled(), 4)


def another(value, rng):
    numbers = [None, -1, 0, 1, 2, 3, 10**9, 2**31 - 1, 2**31, 2**64, -2**63, 10**400, float("nan"), float("inf"), -0.0, 1e300, "", "as_given", b"x", [],
               (), {}, [1, -1], [5, 7], [12], [10**18, 1], np.zeros(0), np.zeros((0, 2)), np.zeros((2, 0)), np.array(3.0), np.zeros((3, 1), complex),
               np.full((12, 2), np.nan), np.zeros((12, 2), "S3"), np.zeros((12, 2), object), np.array([[None, 1]]), np.zeros((1, 10**6))]
    if isinstance(value, tuple) and value and rng.random() < 0.7:  # the state of a part
        at = rng.randrange(len(value))
        return value[:at] + (another(value[at], rng),) + value[at + 1:]
    if isinstance(value, np.ndarray) and value.size and rng.random() < 0.8:
        changed = value.copy()
        how = rng.randrange(7)
        if how == 0:
            return changed[:rng.randrange(len(changed))]
        if how == 1:
            return changed.T
        if how == 2:
            with np.errstate(all="ignore"):
                return np.zeros(changed.shape, "S8") if rng.random() < 0.1 else changed.astype(rng.choice(["f4", "i8", "u1", "O", "?"]))
        if how == 3:
            return changed[..., None] if rng.random() < 0.5 else changed.ravel()
        if how == 4:
            return np.concatenate([changed, changed])
        with np.errstate(all="ignore"):
            changed.reshape(-1)[rng.randrange(changed.size)] = rng.choice([-1, 0, 1, 10**6, 2**31 - 1, -2**31] if changed.dtype.kind in "iu"
                                                                         else [0, 1e308, -1e308, 5e-324, float("nan"), float("inf"), 0.5])
        return changed
    return rng.choice(numbers)


def exercise(made):
    """Everything that an object can be asked, as far as it goes."""
    if not type(made).__module__.startswith("delone"):
        return
    queries = np.random.default_rng(2).random((4, getattr(type(made), "dimension", None) and dimension_of(made) or 2))
    for name in members(type(made)):
        try:
            member = getattr(made, name)
            if not callable(member) or name in ("__reduce_ex__", "__deepcopy__", "__copy__"):
                continue
            for arguments in ((), (queries,), (0,), (0.1,)):
                try:
                    result = member(*arguments)
                    repr(result)
                    if name == "__iter__":
                        list(result)
                except Exception:
                    pass
        except Exception:
            pass


def dimension_of(made):
    try:
        return made.dimension if 0 < made.dimension < 10 else 2
    except Exception:
        return 2


DAMAGES = (truncated, with_flipped_bytes, with_other_opcodes, with_another_state)


def program():
    parts = [Careful, makers, truncated, with_flipped_bytes, with_other_opcodes, with_another_state, another, exercise, dimension_of]
    source = "\n\n".join(inspect.getsource(part) for part in parts)
    return PROGRAM.format(source=source + "\n\nDAMAGES = (truncated, with_flipped_bytes, with_other_opcodes, with_another_state)\n")


@pytest.mark.parametrize("part", range(20 if is_large() else 1))
def test_damaged_pickles(part):
    count = 5000 if is_large() else 400
    assert run(program(), 1, count, part * count, seconds=1800).endswith("done\n")


def test_the_state_taken_out():
    """What is left is an object whose memory nothing has been made in."""
    output = run('''
import pickle
import delone

hull = delone.ConvexHull([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
made = pickle.loads(pickle.dumps(hull)[:-2] + b"0.")
try:
    print(made.cells)
except TypeError as error:
    print("TypeError:", error)
''')
    assert output.startswith("TypeError: the object is not initialized")
