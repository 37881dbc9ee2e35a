# SPDX-License-Identifier: BSD-3-Clause
"""Stubs and docstrings: all names are there, with the same arguments, and each says what it is."""
import ast
import doctest
import functools
import inspect
import pathlib
import re
import subprocess
import sys

import pytest

import delone
from delone import _core, interpolate, spatial, tiles

STUB = ast.parse((pathlib.Path(delone.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
STUBBED = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
COMPILED = {name: value for name, value in vars(_core).items() if inspect.isclass(value)}
OF_THE_BINDING = {"__getstate__", "__setstate__", "__reduce__", "__repr__", "__module__", "__doc__", "__init__", "__new__", "__dict__", "__weakref__", "__getattr__"}


def members(node):
    return {item.name: item for item in node.body if isinstance(item, ast.FunctionDef)}


def test_stub_has_the_classes_of_the_module():
    assert STUBBED.keys() == COMPILED.keys()
    for name, node in STUBBED.items():
        assert {base.id for base in node.bases if base.id in STUBBED} == {base.__name__ for base in COMPILED[name].__bases__ if base.__name__ in STUBBED}


@pytest.mark.parametrize("name", sorted(STUBBED))
def test_stub_has_the_members_of_the_class(name):
    stubbed = {member for member in members(STUBBED[name]) if member != "__init__"}
    compiled = {member for member in vars(COMPILED[name]) if not member.startswith("_pybind11") and member not in OF_THE_BINDING}
    if issubclass(COMPILED[name], Exception):
        return
    assert stubbed == compiled


def signature_of(node, is_method):
    """(name, kind, default) of each argument that the stub has."""
    arguments, kinds = node.args, inspect.Parameter
    positional = arguments.posonlyargs + arguments.args
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    found = [(argument.arg, kinds.POSITIONAL_OR_KEYWORD, default) for argument, default in zip(positional, defaults)][is_method:]
    found += [(argument.arg, kinds.KEYWORD_ONLY, default) for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults)]
    found += [(argument.arg, kinds.VAR_KEYWORD, None) for argument in [arguments.kwarg] if argument]
    return [(name, kind, repr(eval(ast.unparse(default), {"nan": _core.nan})) if default else None) for name, kind, default in found]


def compiled_signature(thing, is_method):
    found = list(inspect.signature(thing).parameters.values())[is_method:]
    return [(each.name, each.kind, None if each.default is each.empty else repr(each.default)) for each in found]


def decorated(node, name):
    return any(isinstance(decorator, ast.Name) and decorator.id == name for decorator in node.decorator_list)


@pytest.mark.parametrize("name", sorted(STUBBED))
def test_stub_has_the_arguments_of_methods(name):
    for member, node in members(STUBBED[name]).items():
        is_property, compiled = decorated(node, "property"), getattr(COMPILED[name], member)
        assert is_property == isinstance(compiled, property), member
        if is_property or (member.startswith("__") and member not in ("__init__", "__call__")):
            continue
        is_method = not decorated(node, "staticmethod")
        assert compiled_signature(compiled, is_method) == signature_of(node, is_method), member
        if member == "__init__":
            assert compiled_signature(COMPILED[name], False) == signature_of(node, True)
        else:
            assert not compiled.__doc__ or "(self" not in compiled.__doc__.split("\n")[0]


def test_stub_has_the_arguments_of_functions():
    functions = {node.name: node for node in STUB.body if isinstance(node, ast.FunctionDef)}
    assert functions.keys() == {name for name, value in vars(_core).items() if inspect.isbuiltin(value)}
    for name, node in functions.items():
        assert compiled_signature(getattr(_core, name), False) == signature_of(node, False), name


@pytest.mark.parametrize("module", [delone, spatial, interpolate, tiles])
def test_everything_public_has_a_signature(module):
    for name in module.__all__:
        thing = getattr(module, name)
        for each in [thing, *(value for member, value in inspect.getmembers(thing) if not member.startswith("_"))]:
            if callable(each) and getattr(each, "__objclass__", None) not in (BaseException, tuple) and not inspect.isbuiltin(each):
                assert inspect.signature(each) is not None


def test_signatures_of_objects():
    t = delone.Delaunay([[0, 0], [1, 0], [0, 1]])
    assert str(inspect.signature(t.find_simplex)) == "(queries, *, tolerance=0.0)"
    assert str(inspect.signature(delone.Delaunay.find_simplex)) == "(self, queries, *, tolerance=0.0)"
    assert str(inspect.signature(delone.LinearInterpolator(t, [0, 1, 2]))) == "(queries)"


@pytest.mark.parametrize("name", [name for name in delone.__all__ if not name.startswith("__")])
def test_everything_public_has_a_docstring(name):
    described = getattr(delone, name)
    assert described.__doc__ and described.__module__ in ("delone", "delone._locations", "delone._patch")
    for member, value in inspect.getmembers(described):
        if not member.startswith("_") and (isinstance(value, property) or callable(value)):
            text = value.__doc__ or ""
            assert len(re.sub(r"^\w+\(self.*\n", "", text).strip()) >= 2, f"{name}.{member}"


@pytest.mark.parametrize("module, name", [(module, name) for module in (spatial, interpolate, tiles) for name in module.__all__])
def test_everything_public_of_the_layers_has_a_docstring(module, name):
    described = getattr(module, name)
    assert described.__doc__
    for member, value in vars(described).items():
        if not member.startswith("_") and callable(value):
            assert value.__doc__, f"{name}.{member}"


# Codes of numpydoc's validator that do not apply.
NOT_APPLICABLE = {
    "GL01": "how a docstring begins in its source; compiled ones have none",
    "GL02": "how it ends there",
    "ES01": "a property or a short method needs no more than its summary",
    "SA01": "other names are listed only if they help",
    "EX01": "classes and the main functions have examples: see below",
}
# Functions that have examples; classes all have, but exceptions and bases.
WITH_EXAMPLES = ["delone.ball_halfspaces", "delone.check", "delone.convex_hulls", "delone.coordination", "delone.cylinder_halfspaces", "delone.estimate", "delone.forecast", "delone.generate", "delone.intersections", "delone.interpolate.griddata",
                 "delone.lloyd", "delone.lower_hull", "delone.natural_neighbors", "delone.patch_scipy", "delone.polyhedra_vertices", "delone.prescribed_volumes", "delone.read", "delone.read_polyhedron", "delone.union_volume", "delone.spatial.tsearch",
                 "delone.tiles.make_tiles", "delone.write_points"]


def described():
    """(name, object) of every public class, function, method and property, and of __call__."""
    for module in (delone, spatial, interpolate, tiles):
        for name in (name for name in module.__all__ if not name.startswith("__")):
            thing = getattr(module, name)
            yield f"{module.__name__}.{name}", thing
            for member, value in inspect.getmembers(thing) if inspect.isclass(thing) else ():
                owner = next(base for base in thing.__mro__ if member in vars(base) or base is object)
                is_call = member == "__call__" and inspect.isfunction(value)
                is_public = not member.startswith("_") and (callable(value) or isinstance(value, (property, functools.cached_property)))
                if (is_call or is_public) and owner.__module__.startswith("delone"):
                    yield f"{module.__name__}.{name}.{member}", value


DESCRIBED = dict(described())
CLASSES = [name for name, thing in DESCRIBED.items() if inspect.isclass(thing) and not issubclass(thing, Exception) and thing is not delone.Data]


@pytest.mark.parametrize("name", sorted(DESCRIBED))
def test_docstrings_are_in_the_form_of_numpydoc(name):
    validate = pytest.importorskip("numpydoc.validate").validate
    thing = DESCRIBED[name]
    apart = {"PR01"} if inspect.isclass(thing) and issubclass(thing, Exception) else set()  # the arguments of exceptions are those of Python's
    errors = [error for error in validate(name)["errors"] if error[0] not in NOT_APPLICABLE and error[0] not in apart]
    assert not errors


@pytest.mark.parametrize("name", [*CLASSES, *WITH_EXAMPLES])
def test_classes_and_main_functions_have_examples(name):
    assert "\n>>> " in inspect.getdoc(DESCRIBED[name])


@pytest.mark.parametrize("name", sorted(name for name, thing in DESCRIBED.items() if ">>> " in (inspect.getdoc(thing) or "")))
def test_examples_of_docstrings(name):
    if name in ("delone.patch_scipy", "delone.interpolate.griddata"):
        pytest.importorskip("scipy")
    example = doctest.DocTestParser().get_doctest(inspect.getdoc(DESCRIBED[name]), {}, name, None, 0)
    said = []
    assert doctest.DocTestRunner().run(example, out=said.append).failed == 0, "".join(said)


def test_statistics_have_the_documented_keys():
    products = [delone.Delaunay([[0, 0], [1, 0], [0, 1]]), delone.ConvexHull([[0, 0], [1, 0], [0, 1]]), delone.HalfspaceIntersection([[1, -1], [-1, 0]])]
    for product in products:
        text = inspect.getdoc(type(product).statistics)
        assert set(re.findall(r"`(\w+)`", text)) == product.statistics.keys()


def test_scipy_and_matplotlib_are_not_imported():
    code = "import sys, delone, delone.spatial; delone.spatial.Delaunay([[0, 0], [1, 0], [0, 1]]).transform; " \
           "print(sorted({'scipy', 'matplotlib'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_module():
    assert re.fullmatch(r"\d+\.\d+\.\d+", delone.__version__) and delone.spatial is spatial
    with pytest.raises(AttributeError, match="module 'delone' has no attribute 'spatiall'"):
        delone.spatiall
    assert issubclass(delone.InputError, ValueError) and issubclass(delone.OutOfMemoryError, MemoryError)
    assert all(issubclass(error, delone.Error) for error in (delone.InputError, delone.OutOfMemoryError, delone.CancelledError))
    assert delone.Error("text").rows == ()
