# SPDX-License-Identifier: BSD-3-Clause
"""What tests of hostile input share: all public classes, and programs that may crash or hang without ending the tests."""
import importlib
import inspect
import io
import os
import pickle
import subprocess
import sys

import numpy as np

MODULES = ["delone", "delone._core", "delone.spatial", "delone.interpolate", "delone.tiles"]


def is_large():
    """Whether tests run at their full size, as in the preset nightly."""
    return os.environ.get("DELONE_TEST_SCALE") == "large"


def classes():
    """All classes of the module but exceptions, in the order of their names."""
    found = set()
    for name in MODULES:
        for _, cls in inspect.getmembers(importlib.import_module(name), inspect.isclass):
            if cls.__module__.startswith("delone") and not issubclass(cls, BaseException):
                found.update(base for base in cls.__mro__ if base.__module__.startswith("delone"))
    return sorted(found, key=lambda cls: (cls.__module__, cls.__qualname__))


def members(cls):
    """The names of all public members of a class, and of those that Python itself calls."""
    called = {"__call__", "__len__", "__iter__", "__getitem__", "__repr__", "__str__", "__reduce__", "__reduce_ex__", "__getstate__",
              "__copy__", "__deepcopy__"}
    return [name for name in dir(cls) if not name.startswith("_") or (name in called and not hasattr(object, name))
            or (name in called and getattr(cls, name) is not getattr(object, name))]


def new(cls, *arguments):
    """An object whose __init__ has not run, for pickles."""
    return cls.__new__(cls, *arguments)


def array(dtype, shape, content):
    """An array of a pickle made by dumps()."""
    made = np.array(content, object) if dtype == "objects" else np.frombuffer(content, np.dtype(dtype)).copy()
    return made.reshape(shape)


class _Pickler(pickle.Pickler):
    def reducer_override(self, made):
        if type(made) is np.ndarray:
            return array, ("objects", made.shape, made.ravel().tolist()) if made.dtype.hasobject else (made.dtype.str, made.shape, made.tobytes())
        return (type(made.item()), (made.item(),)) if isinstance(made, np.generic) else NotImplemented


def dumps(made, protocol):
    """A pickle in which arrays are bytes: a damaged one in NumPy's own form can change the types of NumPy itself, and end the process."""
    file = io.BytesIO()
    _Pickler(file, protocol).dump(made)
    return file.getvalue()


def run(program, *arguments, seconds=120, megabytes=4096):
    """The output of a program of Python in a process of its own, which must end by itself and without a signal."""
    limit = f"import faulthandler, resource; faulthandler.enable(); resource.setrlimit(resource.RLIMIT_AS, ({megabytes} << 20,) * 2)\n"
    result = subprocess.run([sys.executable, "-c", limit + program, *map(str, arguments)], capture_output=True, text=True, timeout=seconds,
                            env=os.environ | {"PYTHONPATH": os.pathsep.join([os.path.dirname(__file__)] + sys.path)})
    assert result.returncode == 0, f"status {result.returncode}, after {result.stdout[-400:]!r}:\n{result.stderr[-4000:]}"
    return result.stdout
