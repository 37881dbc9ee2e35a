# SPDX-License-Identifier: BSD-3-Clause
"""Objects whose __init__ has not run, as damaged pickles make them: whatever is done with them raises."""
import inspect

from hostile_support import run

PROGRAM = """
import copy, inspect, pickle
import numpy as np
import delone
from hostile_support import classes, members

POINTS = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
# Most methods take one of these; a call with arguments of other types or another number of them raises in any case.
ARGUMENTS = [(), (POINTS,), (0,), (0.5,), (POINTS, [1.0, 2.0, 3.0]), (POINTS, POINTS, POINTS, 0.0, 0.0, 1.0)]
REFUSED = (TypeError, AttributeError, RuntimeError)

{source}

count = 0
for cls in classes():
    for name, use in uses(cls):
        print(cls.__module__, cls.__name__, name, flush=True)
        try:
            made = cls.__new__(cls)
        except TypeError:
            break  # without arguments it cannot be made at all, as named tuples
        check(made, name, use)
        count += 1
print("uses:", count)
"""


def uses(cls):
    """What can be done with an object, with a name for each."""
    for name in members(cls):
        if isinstance(inspect.getattr_static(cls, name), (staticmethod, classmethod)):
            continue  # not of an object
        if callable(getattr(cls, name)):
            for arguments in ARGUMENTS:
                yield f"{name}{arguments}", lambda made, name=name, arguments=arguments: getattr(made, name)(*arguments)
        else:
            yield name, lambda made, name=name: getattr(made, name)
    yield "copy", copy.copy
    yield "deepcopy", copy.deepcopy
    for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
        yield f"pickle {protocol}", lambda made, protocol=protocol: pickle.dumps(made, protocol)
    if issubclass(cls, delone.Delaunay.__base__):
        yield "Voronoi", delone.Voronoi
        yield "PowerDiagram", delone.PowerDiagram
        yield "LinearInterpolator", lambda made: delone.LinearInterpolator(made, [1.0, 2.0, 3.0])
        yield "NaturalNeighborInterpolator", lambda made: delone.NaturalNeighborInterpolator(made, [1.0, 2.0, 3.0])
        yield "natural_neighbors", lambda made: delone.natural_neighbors(made, POINTS)


def check(made, name, use):
    compiled = type(type(made)).__name__ == "pybind11_type"
    try:
        use(made)
    except REFUSED if compiled else Exception as error:
        # By the class itself, before anything else is looked at; arguments of a wrong number or type are seen even before.
        known = ("initialized", "needs the argument", "by position", "was expected", "incompatible", "cannot pickle", "positional argument")
        assert len(str(error)) > 0 and (any(part in str(error) for part in known) or not compiled), (type(made), name, error)
        return
    # Objects of Python have no memory of C++: they may have copies and names as empty as they are.
    assert not compiled and (name.startswith(("copy", "deepcopy", "pickle", "__", "close")) or "Patched" in type(made).__name__), (type(made), name)


def test_every_use_of_an_uninitialized_object_raises():
    source = inspect.getsource(uses) + inspect.getsource(check)
    output = run(PROGRAM.format(source=source))
    assert int(output.rsplit(":", 1)[1]) > 1000


def test_a_subclass_must_call_init():
    output = run('''
import delone

class Mine(delone.Delaunay):
    def __init__(self):
        pass

class Failing(delone.ConvexHull):
    def __init__(self):
        try:
            super().__init__([[float("nan")]])
        except ValueError:
            print("failed as it should")
        print(self.num_cells)

for cls in (Mine, Failing):
    try:
        print(cls().num_cells)
    except TypeError as error:
        print(type(error).__name__, error)
''')
    assert output.count("TypeError") == 2 and "failed as it should" in output


def test_the_base_of_pybind11_cannot_be_made():
    output = run('''
import pickle
import delone

base = delone.Delaunay.__mro__[-2]

class Derived(base):
    pass

class Initialized(base):
    def __init__(self):
        pass

class Mixed(delone.Delaunay, base):
    pass

for cls in (base, Derived, Initialized):
    try:
        cls()
    except TypeError as error:
        print(error)
print(Mixed([[0, 0], [1, 0], [0, 1]]))
try:
    object.__new__(base)
except TypeError as error:
    print(error)
''')
    assert output.count("cannot make") == 3 and "<delone.Delaunay: 3 points" in output and "is not safe" in output


def test_old_pickle_protocols_give_the_same():
    output = run('''
import pickle
import delone

points = [[0, 0], [1, 0], [0, 1]]
for made in (delone.Delaunay(points), delone.ConvexHull(points), delone.LinearInterpolator(points, [1, 2, 3])):
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        copy = pickle.loads(pickle.dumps(made, protocol))
        print(type(copy) is type(made) and repr(copy) == repr(made))
    print(made.__reduce__()[1] == (type(made),), object.__reduce_ex__(made, 0)[1] == (type(made),))
''')
    assert output.split() == ["True"] * (3 * 8)
