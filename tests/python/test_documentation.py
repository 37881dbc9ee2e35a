# SPDX-License-Identifier: BSD-3-Clause
"""Stubs and docstrings: all names are there, with the same arguments, and each says what it is."""
import ast
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
OF_THE_BINDING = {"__getstate__", "__setstate__", "__reduce__", "__repr__", "__module__", "__doc__", "__init__", "__new__", "__dict__", "__weakref__"}


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


@pytest.mark.parametrize("name", sorted(STUBBED))
def test_stub_has_the_arguments_of_methods(name):
    for member, node in members(STUBBED[name]).items():
        is_property = any(isinstance(decorator, ast.Name) and decorator.id == "property" for decorator in node.decorator_list)
        compiled = getattr(COMPILED[name], member)
        assert is_property == isinstance(compiled, property), member
        if is_property or (member.startswith("__") and member != "__init__"):
            continue
        positional = [argument.arg for argument in node.args.args]
        keyword_only = [argument.arg for argument in node.args.kwonlyargs]
        if inspect.isfunction(compiled):  # in Python
            described = inspect.getfullargspec(compiled)
            assert (described.args, described.kwonlyargs) == (positional, keyword_only), member
            continue
        signature = compiled.__doc__.splitlines()[0]
        before, _, after = signature.partition("*, ")
        assert re.findall(r"(\w+): ", before) == positional, signature
        assert re.findall(r"(\w+): ", after) == keyword_only, signature


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
