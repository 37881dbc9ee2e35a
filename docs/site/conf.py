# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx's configuration. tools/make_site.py gathers the pages and runs Sphinx; see there."""
import ast
import importlib
import inspect
import os
import pathlib
import re
import sys
import types

ROOT = pathlib.Path(__file__).resolve().parents[2]
project = "delone"
author = "the delone authors"
copyright = "the delone authors, BSD 3-clause license"
version = release = re.search(r"^project\(delone VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["deflist", "dollarmath"]
myst_heading_anchors = 4  # those of GitHub
html_theme = "furo"
html_title = f"delone {version}"
html_static_path = [str(ROOT / "docs" / "site" / "static")]
html_css_files = ["tables.css"]
html_favicon = str(ROOT / "docs" / "site" / "static" / "favicon.svg")
html_extra_path = [os.environ["DELONE_SITE_CPP"]] if "DELONE_SITE_CPP" in os.environ else []
html_copy_source = False
html_last_updated_fmt = None
pygments_style = "tango"
highlight_language = "text"
smartquotes = False  # -- begins an option

# Docstrings are in the form of numpydoc; a word in single backquotes is code. Signatures are those of the stub, which has the types.
napoleon_google_docstring = False
napoleon_use_rtype = False
default_role = "code"
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True, "inherited-members": True}
autodoc_typehints = "signature"


def stub_signatures():
    """(arguments, what it returns) of each function, method and constructor of _core.pyi, by its name after `delone.`."""
    found = {}
    tree = ast.parse((ROOT / "python" / "delone" / "_core.pyi").read_text(encoding="utf-8"))
    for owner in [tree, *(node for node in tree.body if isinstance(node, ast.ClassDef))]:
        for node in owner.body:
            if isinstance(node, ast.FunctionDef):
                arguments = node.args
                name = node.name
                if isinstance(owner, ast.ClassDef):
                    name = owner.name if node.name == "__init__" else f"{owner.name}.{node.name}"
                    arguments.args = [argument for argument in arguments.args if argument.arg != "self"]
                found.setdefault(name, (f"({ast.unparse(arguments)})", ast.unparse(node.returns) if node.returns else None))
    return found


STUB = stub_signatures()
SHORT = {"npt.NDArray": "NDArray", "npt.": "", "np.": "", "_Reals": "ndarray", "_Rows": "ndarray", "_Order": "str", "_Progress": "Union[bool, Callable, None]", "_Columns": "Optional[tuple]", "_Data": "Optional[dict]",
         "_Box": "Optional[ArrayLike]"}


def shortened(text):
    """A type, without the aliases of the stub."""
    for long, short in SHORT.items():
        text = text.replace(long, short)
    return text


def signature(app, what, name, thing, options, text, returned):
    """That of the stub: of a function, a class, or a method of a class or one of its bases."""
    parts = name.split(".")
    if what not in ("class", "function", "method"):
        return text, returned
    owner = getattr(importlib.import_module(parts[0]), parts[1], None)
    owners = [base.__name__ for base in owner.__mro__] if inspect.isclass(owner) else [parts[1]]
    for candidate in (".".join([owner, *parts[2:]]) for owner in owners):
        if candidate in STUB:
            arguments, result = STUB[candidate]
            return shortened(arguments), None if what == "class" else shortened(result or "") or None
    return text, returned


def docstring(app, what, name, thing, options, lines):
    """Without the signature that pybind11 writes above it; links to pages of docs/ instead of their names."""
    while lines and re.match(r"\w+\(.*\) -> |\w+\(self: ", lines[0]):
        del lines[0]
    if lines and lines[0].startswith("Alias for field number"):  # of a NamedTuple, whose fields its own docstring explains
        lines.clear()
    lines[:] = [re.sub(r"(?<![\w`/])docs/([\w/-]+)\.md\b", r":doc:`/\1`", line) for line in lines]


def skip(app, what, name, thing, skipped, options):
    """What every exception and tuple inherits, and private names."""
    builtin = any(getattr(base, name, None) is thing or name in vars(base) for base in (BaseException, tuple, object))
    return True if builtin and not name.startswith("__") else None


def complete(app, env):
    """Every public name of every module has its place in the reference."""
    from sphinx.util import logging
    described = env.get_domain("py").objects
    for module in [name for name in described if described[name].objtype == "module"]:
        for name in getattr(importlib.import_module(module), "__all__", ()):
            if f"{module}.{name}" not in described and not name.startswith("__"):
                logging.getLogger(__name__).warning("%s.%s is not described: it has no docstring", module, name)


def setup(app):
    # delone.mpi is described without MPI: its types and docstrings are Python's.
    stand_in = types.SimpleNamespace(size_of_communicator=0, library_version="none")
    sys.modules["mpi4py"] = types.SimpleNamespace(MPI=types.SimpleNamespace(Comm=None, _sizeof=lambda kind: 0, Get_library_version=lambda: "none"))
    sys.modules["delone._mpi"] = importlib.import_module("delone")._mpi = stand_in
    app.connect("env-check-consistency", complete)
    app.connect("autodoc-process-signature", signature)
    app.connect("autodoc-process-docstring", docstring, priority=400)  # before napoleon
    app.connect("autodoc-skip-member", skip)
