#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks docs/vocabulary.md: one name for one thing, in C++, in the command and in Python.

Usage: check_vocabulary.py [--self-test]

Every spelling in backquotes in the table of names must exist:
  C++      `name`, `name()`, `Class::member`: all words occur in the code of include/, a class in a header
           that declares it
  command  `delone NAME`: a sub-command; `--option`, `--option value`: an option of the command and one of its
           values; another word: one in quotes in cli/, such as a member of --stats
  Python   `Class`, `Class.member`: in the stubs of delone (not of delone.spatial), bases included; `name`: an argument or a
           member; `argument="value"`: a value the stubs allow
The names of the table of the other languages must be in that table. Its spellings must exist:
  C        a function of delone.h
  R        a function that the package exports, if parentheses follow
  Octave   `delone.NAME`: a function of the package; `delone.CLASS.NAME`: a function in the file of the class
Names that were retired (RETIRED below) must not come back. Prints every fault, and exits with status 1 if there is one.
"""
import ast
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = "docs/vocabulary.md"
HEADER = ["name", "meaning", "C++", "command", "Python"]
LANGUAGES = ["name", "C", "R", "Octave"]

CPP = ["include/**/*", "src/**/*", "cli/*", "python/src/*", "tests/**/*", "examples/*", "docs/*.md", "README.md"]

# (pattern, where it must not occur: globs, globs that are exempt, what to write instead)
RETIRED = [
    (r"--order[ =]given\b|\border ?= ?[\"']given[\"']|[\"']--order[\"'], [\"']given[\"']",
     ["cli/*", "python/**/*.py*", "python/src/*", "tests/**/*", "docs/*.md", "README.md", "tools/*.sh"], [], "as_given"),
    (r"\badd_points\b|\badd_halfspaces\b",
     ["include/**/*", "src/**/*", "python/**/*", "tests/**/*", "examples/*", "docs/*.md", "README.md"],
     ["python/delone/_missing.py", "python/delone/spatial/*", "tests/python/*spatial*", "tests/python/test_interruptible.py", "tests/python/test_pickle.py",
      "docs/from-scipy.md"], "insert_range"),
    (r"\bVoronoiDiagram\b|\bVoronoiParts\b", CPP, [], "Voronoi<D>, Diagram or DiagramParts"),
    (r"\boutside ?= ?[\"']raise[\"']", ["python/**/*.py*", "python/src/*", "docs/*.md"], ["docs/vocabulary.md"],
     'outside="error"'),
    (r"\bwhere\.weights\b", CPP, [], "barycentric"),
    (r"\bFaceOptions\b|\bEstimateOptions\b", CPP, [], "Execution, ForecastOptions"),
    (r"\bdelone::(Polytope|Envelope)\b|\bconst (Polytope|Envelope)&", CPP, [], "ConvexHullBase, LowerHullBase"),
    (r"\bchanges(\(\))?(\.|->)(killed|born|came|gone|hid|reappeared|moved)\b|\.weigh\b",
     CPP + ["python/**/*.py*"], [], "removed_cells, created_cells, added_vertices, … and reweight"),
]


def rows_of_table(text, header):
    """(line number, cells) of the rows of the table with that header."""
    inside = False
    for number, line in enumerate(text.split("\n"), 1):
        if not line.startswith("|"):
            inside = False
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]
        if cells == header:
            inside = True
        elif inside and not set(cells[0]) <= set("-: "):
            yield number, cells


def spellings(cell):
    return re.findall(r"`([^`]+)`", cell)


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", " ", text, flags=re.S)


class Cpp:
    def __init__(self, headers):
        """`headers`: the texts of the public headers."""
        self.headers = [without_comments(text) for text in headers]
        self.words = [set(re.findall(r"\w+", text)) for text in self.headers]

    def fault(self, spelling):
        parts = re.sub(r"\(\)$|<\w*>", "", spelling).split("::")
        if len(parts) == 1:
            return None if any(parts[0] in words for words in self.words) else "no public header has it"
        declares = re.compile(rf"\b(?:class|struct)\s+(?:DELONE_\w+\s+)?{parts[0]}\b(?!\s*;)")
        bodies = [words for text, words in zip(self.headers, self.words) if declares.search(text)]
        if not bodies:
            return f"no public header declares {parts[0]}"
        return None if any(set(parts) <= words for words in bodies) else f"no header that declares {parts[0]} has {parts[-1]}"


class Command:
    def __init__(self, sources):
        text = "\n".join(map(without_comments, sources))
        strings = re.findall(r'"((?:[^"\\\n]|\\.)*)"', text)
        self.strings = set(strings)
        self.options = {name for string in strings for name in re.findall(r"(?:^|,)(--[\w-]+)$", string)}
        self.commands = set(re.findall(r'\badd\("(\w+)"', text))

    def fault(self, spelling):
        if spelling.startswith("delone "):
            return None if spelling.split()[1] in self.commands else "there is no such sub-command"
        if spelling.startswith("--"):
            option, _, value = spelling.partition(" ")
            if option not in self.options:
                return "there is no such option"
            return None if not value or value in self.strings else f"{option} has no such value"
        return None if spelling in self.strings else "the command does not write it"


class Python:
    def __init__(self, stubs):
        self.classes, self.bases, self.words, self.values = {}, {}, set(), set()
        for tree in map(ast.parse, stubs):
            for node in ast.walk(tree):
                if isinstance(node, ast.ClassDef):
                    self.classes[node.name] = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
                    self.classes[node.name] |= {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}
                    self.bases[node.name] = [base.id for base in node.bases if isinstance(base, ast.Name)]
                    self.words |= self.classes[node.name]
                elif isinstance(node, ast.FunctionDef):
                    self.words |= {argument.arg for argument in node.args.args + node.args.kwonlyargs} | {node.name}
                elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                    self.values.add(node.value)

    def members(self, name):
        return self.classes.get(name, set()).union(*(self.members(base) for base in self.bases.get(name, [])))

    def fault(self, spelling):
        if "=" in spelling:
            argument, value = spelling.split("=", 1)
            known = argument in self.words and value.strip("\"'") in self.values
            return None if known else "the stubs do not allow it"
        name, _, member = spelling.partition(".")
        if member:
            return None if member in self.members(name) else "the stubs do not have it"
        return None if name in self.classes or name in self.words else "the stubs do not have it"


def faults_of_table(text, cpp, command, python):
    rows = list(rows_of_table(text, HEADER))
    if not rows:
        yield 1, "there is no table of names"
    for number, cells in rows:
        if len(cells) != len(HEADER):
            yield number, f"{len(cells)} columns, not {len(HEADER)}"
            continue
        for column, checker in (("C++", cpp), ("command", command), ("Python", python)):
            for spelling in spellings(cells[HEADER.index(column)]):
                if fault := checker.fault(spelling):
                    yield number, f"{column} `{spelling}`: {fault}"


def faults_of_languages(text, c, r, octave):
    """`c`, `r`: the names of functions; `octave`: of each function of the package the names of functions in its file."""
    names = {cells[0] for _, cells in rows_of_table(text, HEADER)}
    rows = list(rows_of_table(text, LANGUAGES))
    if not rows:
        yield 1, "there is no table of the other languages"
    for number, cells in rows:
        if len(cells) != len(LANGUAGES):
            yield number, f"{len(cells)} columns, not {len(LANGUAGES)}"
            continue
        if cells[0] not in names:
            yield number, f"{cells[0]} is not in the table of names"
        for spelling in spellings(cells[1]):
            if spelling.removesuffix("()") not in c:
                yield number, f"C `{spelling}`: there is no such function"
        for spelling in spellings(cells[2]):
            if spelling.endswith("()") and spelling[:-2] not in r:
                yield number, f"R `{spelling}`: there is no such function"
        for spelling in spellings(cells[3]):
            _, name, *member = spelling.split(".")
            if name not in octave or not set(member) <= octave[name]:
                yield number, f"Octave `{spelling}`: there is no such function"


def faults_of_javascript(text, types):
    """`types`: index.d.ts of the package."""
    section = re.search(r"^## In JavaScript$.*?(?=^## |\Z)", text, re.M | re.S)
    for found in re.finditer(r"`(\w+)`(?=[^|`]*(?:`[^`]*`[^|`]*)*\|$)", section[0] if section else "", re.M):
        if not re.search(rf"\b{found[1]}\b", types):
            yield text.count("\n", 0, section.start() + found.start()) + 1, f"JavaScript `{found[1]}`: the package has no such name"


def retired_in(path, text, retired=None):
    """(line number, fault) for every retired name in the file at `path`."""
    for pattern, places, exempt, instead in RETIRED if retired is None else retired:
        at = pathlib.PurePosixPath(path)
        if not any(matches(at, place) for place in places) or any(matches(at, place) for place in exempt):
            continue
        for number, line in enumerate(text.split("\n"), 1):
            if match := re.search(pattern, line):
                yield number, f"`{match.group().strip()}` is retired; write {instead}"


def matches(path, place):
    """Whether a glob covers the path; `**` stands for any folders."""
    pattern = re.escape(place).replace(r"\*\*/", "(?:.*/)?").replace(r"\*", "[^/]*")
    return re.fullmatch(pattern, str(path)) is not None


def texts(folder, *suffixes):
    files = [file for file in sorted((ROOT / folder).iterdir()) if file.suffix in suffixes]
    return [file.read_text(encoding="utf-8") for file in files]


def faults():
    table = (ROOT / TABLE).read_text(encoding="utf-8")
    checkers = (Cpp(texts("include/delone", ".hpp") + texts("include/delone/mpi", ".hpp")), Command(texts("cli", ".cpp", ".hpp")), Python(texts("python/delone", ".py", ".pyi")))
    for number, fault in faults_of_table(table, *checkers):
        yield f"{TABLE}:{number}: {fault}"
    c = set(re.findall(r"^DELONE_C_API [^;(]*?(\w+)\(", (ROOT / "include/delone/delone.h").read_text(encoding="utf-8"), re.M))
    exported = re.findall(r"^export\(([^)]*)\)", (ROOT / "r/NAMESPACE").read_text(encoding="utf-8"), re.M)
    octave = {file.stem: set(re.findall(r"^ +function (?:.*= *)?(\w+) \(", file.read_text(encoding="utf-8"), re.M))
              for file in (ROOT / "octave/inst/+delone").glob("*.m")}
    for number, fault in faults_of_languages(table, c, {name for line in exported for name in line.split(", ")}, octave):
        yield f"{TABLE}:{number}: {fault}"
    for number, fault in faults_of_javascript(table, (ROOT / "js/src/index.d.ts").read_text(encoding="utf-8")):
        yield f"{TABLE}:{number}: {fault}"
    for top in ("include", "src", "c", "cli", "python", "examples", "tests", "docs", "tools", "README.md"):
        for file in [ROOT / top] if (ROOT / top).is_file() else sorted((ROOT / top).rglob("*")):
            path = file.relative_to(ROOT).as_posix()
            if path in (TABLE, "tools/check_vocabulary.py") or file.suffix not in (".hpp", ".cpp", ".h", ".c", ".in", ".py", ".pyi", ".md", ".sh"):
                continue
            for number, fault in retired_in(path, file.read_text(encoding="utf-8")):
                yield f"{path}:{number}: {fault}"


def self_test():
    """Wrong spellings and retired names are found, right ones are not."""
    cpp = Cpp(["class Triangulation {\n  int dimension() const;  // hidden_word\n};\nenum class Side { inside };",
               "class Delaunay;\nint in_sphere();"])
    command = Command(['add("hull", "Hulls", add_hull);\nadd_option("-o,--output", x);\njson["cells"] = 1;\n{"as_given", 1}; // "commented"'])
    python = Python(['class Base:\n    def size(self): ...\nclass Hull(Base):\n    def __init__(self, order: Literal["as_given"]): ...\n'])
    right = [(cpp, "Triangulation::dimension()"), (cpp, "in_sphere()"), (cpp, "Side::inside"), (cpp, "Triangulation"),
             (command, "delone hull"), (command, "--output"), (command, "--output as_given"), (command, "cells"),
             (python, "Hull"), (python, "Hull.size"), (python, "order"), (python, 'order="as_given"')]
    wrong = [(cpp, "Triangulation::in_sphere()"), (cpp, "hidden_word"), (cpp, "Delaunay::dimension()"), (cpp, "Side::outside"),
             (command, "delone ball"), (command, "--input"), (command, "--output given"), (command, "commented"),
             (python, "Ball"), (python, "Base.order"), (python, 'order="given"')]
    for checker, spelling in right:
        assert checker.fault(spelling) is None, (spelling, checker.fault(spelling))
    for checker, spelling in wrong:
        assert checker.fault(spelling) is not None, spelling
    table = "| name | meaning | C++ | command | Python |\n|---|---|---|---|---|\n| a | b \\| c | {} | `cells` | |\n\n| x | y |\n|---|---|\n| `z` | |\n"
    assert not list(faults_of_table(table.format("`Side`"), cpp, command, python))
    assert len(list(faults_of_table(table.format("`Sides`"), cpp, command, python))) == 1
    languages = "| name | C | R | Octave |\n|---|---|---|---|\n| {} | `delone_a()` | `a()`, `with` | `delone.a`, `delone.a.b` |\n| a | {} | {} | {} |\n"
    known = ({"delone_a"}, {"a"}, {"a": {"b"}})
    for parts, count in [(("a", "", "", ""), 0), (("z", "", "", ""), 1), (("a", "`delone_b()`", "", ""), 1), (("a", "", "`b()`", ""), 1),
                         (("a", "", "", "`delone.b`, `delone.a.c`"), 2)]:
        assert len(list(faults_of_languages(table.format("`Side`") + "\n" + languages.format(*parts), *known))) == count, parts
    in_javascript = "## In JavaScript\n| locate | `find`, `nearest` |\n## Else\n"
    assert [number for number, _ in faults_of_javascript(in_javascript, "nearest(queries)")] == [2]
    assert list(faults_of_table("nothing", cpp, command, python))
    retired = [(r"\bgiven\b", ["docs/**/*", "cli/*"], ["docs/old.md"], "as_given")]
    assert len(list(retired_in("docs/a/b.md", "x\nas given\n", retired))) == 1
    for innocent in (("docs/a.md", "as_given"), ("docs/old.md", "given"), ("src/a.cpp", "given"), ("cli/x/a.cpp", "given")):
        assert not list(retired_in(*innocent, retired)), innocent
    for line in ("delone hull --order given", 'order="given"', '"--order", "given"'):
        assert list(retired_in("tests/cli/x.py", line)), line
    assert not list(retired_in("docs/a.md", "--order as_given"))
    print("the vocabulary check finds what it should")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    found = list(faults())
    for fault in found:
        print(fault)
    if found:
        sys.exit(f"{len(found)} fault(s) of the vocabulary; tools/check_vocabulary.py says what the table may hold")
    print("the vocabulary holds")


if __name__ == "__main__":
    main()
