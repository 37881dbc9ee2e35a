#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks which room of the project includes which, that no two include each other, the size of files and rooms, that src/ holds only
sources and its headers open the namespaces of their rooms, that one page shows the algorithm of the report, and that the library never
prints or ends the program. The rules are the data below; docs/architecture.md explains them and has them as a table. Prints every
violation as FILE:LINE, and exits with status 1 if there is one.

Usage: check_layering.py [--self-test | --write-table]      --write-table renews the table of docs/architecture.md
"""
import pathlib
import posixpath
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# The public headers that a room may include; its other rooms are listed beside them.
BASICS = {"types", "error", "config", "arithmetic"}
PUBLIC = "all public headers"

# room (longest matching path decides) -> (public headers, other rooms of the project)
RULES = {
    "include/delone": (PUBLIC, set()),
    # Text for messages, which the command, the Python module and the C interface write, too.
    "src/messages": (BASICS | {"export", "printable"}, set()),
    "src/base": (BASICS | {"progress"}, {"src/messages"}),
    "src/kernel": (BASICS | {"predicates"}, {"src/base"}),
    "src/solve": (BASICS, {"src/kernel", "src/base"}),
    "src/order": (BASICS | {"options"}, {"src/base"}),
    "src/cells": (BASICS, {"src/base"}),
    "src/sites": (BASICS | {"edit", "points"}, {"src/kernel", "src/base"}),
    "src/geometry": (BASICS, {"src/geometry/hole_search", "src/sites", "src/cells", "src/kernel", "src/base"}),
    "src/geometry/facet_search": (BASICS, {"src/geometry", "src/cells", "src/base"}),
    # Numbers of vertices in, numbers of vertices out: whose images they are, the geometry tells it.
    "src/geometry/hole_search": (BASICS, {"src/kernel", "src/base"}),
    "src/engine": (BASICS | {"complex"}, {"src/cells", "src/base"}),
    "src/engine/wrap": (BASICS, {"src/engine", "src/cells", "src/base"}),
    "src/engine/hole": (BASICS | {"complex"}, {"src/engine", "src/cells", "src/base"}),
    "src/compiled": (BASICS | {"complex"}, {"src/engine", "src/engine/wrap", "src/engine/hole", "src/geometry",
                                            "src/geometry/facet_search", "src/geometry/hole_search", "src/sites", "src/cells", "src/kernel",
                                            "src/base"}),
    "src/complex": (PUBLIC, {"src/base"}),
    "src/construction": (PUBLIC, {"src/sites", "src/compiled", "src/geometry", "src/order", "src/kernel", "src/base"}),
    "src/triangulation": (PUBLIC, {"src/construction", "src/sites", "src/complex", "src/compiled", "src/order", "src/kernel",
                                   "src/forecast/model", "src/base"}),
    "src/forecast": (PUBLIC, {"src/forecast/model", "src/complex", "src/engine", "src/messages", "src/base"}),
    "src/forecast/model": (BASICS, {"src/engine/wrap", "src/base"}),
    "src/queries": (PUBLIC, {"src/triangulation", "src/solve", "src/order", "src/kernel", "src/base"}),
    "src/hull": (PUBLIC, {"src/complex", "src/compiled", "src/sites", "src/solve", "src/order", "src/kernel", "src/base"}),
    "src/hull/tolerance": (PUBLIC, {"src/hull", "src/compiled", "src/kernel", "src/base"}),
    "src/hull/products": (PUBLIC, {"src/hull", "src/hull/tolerance", "src/complex", "src/kernel", "src/base"}),
    "src/halfspaces": (PUBLIC, {"src/hull", "src/sites", "src/order", "src/solve", "src/kernel", "src/base"}),
    "src/polyhedra": (PUBLIC, {"src/kernel", "src/base"}),
    "src/voronoi": (PUBLIC, {"src/particles/pass", "src/triangulation", "src/solve", "src/kernel", "src/base"}),
    "src/faces": (PUBLIC, {"src/triangulation", "src/solve", "src/kernel", "src/base"}),
    "src/particles/pass": (BASICS, {"src/solve", "src/kernel", "src/base"}),
    "src/particles": (PUBLIC, {"src/particles/pass", "src/periodic", "src/triangulation", "src/voronoi", "src/sites", "src/solve", "src/kernel", "src/base"}),
    "src/check": (PUBLIC, {"src/periodic", "src/hull", "src/hull/tolerance", "src/halfspaces", "src/compiled", "src/complex", "src/kernel", "src/base"}),
    "src/point_sets": (BASICS | {"point_sets", "progress"}, {"src/base"}),
    "src/io": (PUBLIC, {"src/messages", "src/base"}),
    "src/io/points": (PUBLIC, {"src/io", "src/messages", "src/base"}),
    "src/io/complexes": (PUBLIC, {"src/io", "src/io/points", "src/messages", "src/base"}),
    "src/io/polyhedra": (PUBLIC, {"src/io", "src/messages", "src/base"}),
    "src/view": (PUBLIC, {"src/faces", "src/io", "src/io/complexes", "src/base"}),
    # Points in pages, and which of them is in conflict with a cell first: what tiles and periodic sets share.
    "src/pages": (BASICS, {"src/io", "src/order", "src/kernel", "src/base"}),
    "src/tiles": (PUBLIC, {"src/pages", "src/triangulation", "src/solve", "src/complex", "src/io", "src/io/points", "src/io/complexes",
                           "src/kernel", "src/forecast/model", "src/messages", "src/base"}),
    "src/tiles/making": (PUBLIC, {"src/tiles", "src/pages", "src/periodic", "src/triangulation", "src/complex", "src/io", "src/kernel", "src/base"}),
    "src/tiles/check": (PUBLIC, {"src/tiles", "src/tiles/making", "src/periodic", "src/check", "src/complex", "src/io", "src/kernel", "src/base"}),
    "src/periodic": (PUBLIC, {"src/pages", "src/queries", "src/triangulation", "src/solve", "src/complex", "src/kernel", "src/base"}),
    # The public header for MPI includes that of MPI.
    "include/delone/mpi": (PUBLIC, set()),
    "mpi": (PUBLIC, {"src/*", "cli"}),
    "c": (PUBLIC, {"src/messages"}),
    # On the C interface alone.
    "octave": ({"delone.h"}, set()),
    "r": ({"delone.h"}, set()),
    "js": ({"delone.h"}, set()),
    "cli": (PUBLIC, {"src/messages"}),
    "examples": (PUBLIC, set()),
    "benchmarks": (PUBLIC, {"tests/support"}),
    # These time what is below the public interface: predicates, orders, the phases of an insertion.
    "benchmarks/internal": (PUBLIC, {"src/*"}),
    "tests": (PUBLIC, {"tests/*"}),
    "tests/support": (PUBLIC, set()),
    "tests/consumer": (PUBLIC, set()),
    "tests/unit": (PUBLIC, {"tests/support", "src/*"}),
    "tests/c": (PUBLIC, set()),
    "tests/mpi": (PUBLIC, {"tests/support", "mpi"}),
    # These call the stages of the predicates one by one.
    "tests/campaign": (PUBLIC, {"tests/support", "src/*"}),
}

# What the public header for C may include besides those of the project.
C_HEADERS = {"stddef.h", "stdint.h"}

# The largest that files and rooms may be.
LARGEST_SHARE_OF_ROOM = 1 / 8  # of the lines of src/, rooms within a room apart
MOST_LINES_OF_FILE = 500

# What may lie below src/: sources, templates of sources, and what CMake reads. Generated files have a place of their own, as
# viewer/dist, or are made in the build.
SOURCE_FILE = re.compile(r"(^|/)[a-z0-9_-]+\.([ch]pp|cpp\.in|hpp\.in|map\.in)$|(^|/)CMakeLists\.txt$")

# Headers of src/ open the namespace of their room; `delone` itself has the public names.
PLAIN_NAMESPACE = re.compile(r"^\s*(?:inline\s+)?namespace\s+delone\s*(?:\{|$)")

# The page that shows the algorithm of the report, and the sections that its comments name.
ALGORITHM = "src/engine/build.hpp"
MOST_LINES_OF_ALGORITHM = 60
SECTIONS = {"§2.2", "§2.3", "§2.4", "§2.5", "§2.6", "§3.1"}

# The page that has the rules as a table, and what is around the table there.
PAGE = ROOT / "docs" / "architecture.md"
TABLE = re.compile(r"(?<=<!-- rules -->\n\n).*?(?=\n\n<!-- end of rules -->)", re.S)

# Folders to search for a quoted include, after that of the file itself.
SEARCH = ["src", "tests/support", "include", ""]

# Forbidden below src/: the library returns results or throws delone::Error.
FORBIDDEN = [
    (re.compile(r"\bstd::(cout|cerr|clog)\b|#\s*include\s*<iostream>"), "the library prints nothing"),
    (re.compile(r"(?<![\w.>])(?:std::)?(?:v?f?printf|puts|fputs|putchar|perror)\s*\((?!\s*\))"), "the library prints nothing"),
    (re.compile(r"(?<![\w.>])(?:fmt|std)::print(?:ln)?\s*\("), "the library prints nothing"),
    (re.compile(r"(?<![\w.>])(?:std::)?(?:abort|exit|_Exit|quick_exit|terminate)\s*\("), "the library never ends the program"),
    (re.compile(r"\bfesetround\s*\("), "the library does not switch the rounding mode"),
]
# Exceptions: (path, pattern text) -> the reason.
ALLOWED = {
    ("src/io", "fputs"): "text written to a file",
    ("src/base", "fesetround"): "sees to the floating-point state of callers, where that is all there is",
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    """The longest room that the path lies in, or None."""
    best = None
    for room in RULES:
        if (path == room or path.startswith(room + "/")) and (best is None or len(room) > len(best)):
            best = room
    return best


def may_know(rooms, other):
    """Whether `other` is one of the rooms, or below one that is given as `folder/*`."""
    return other in rooms or any(known.endswith("/*") and other.startswith(known[:-1]) for known in rooms)


def without_comments(text):
    """The text with comments and string literals blanked, line numbers kept."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def include_violation(path, kind, target, exists):
    """Why the file at `path` may not include `target`, or None. `exists` tells which paths of the project exist."""
    room = room_of(path)
    if room is None:
        return None
    public, rooms = RULES[room]
    if target.startswith("delone/"):
        header = target[len("delone/"):].removesuffix(".hpp")
        if public != PUBLIC and header not in public:
            return f"{room} may not include <{target}>; of the public headers it knows {', '.join(sorted(public))}"
        return None
    if kind == "<":
        foreign = room == "include/delone" and "." in target and not (path.endswith(".h") and target in C_HEADERS)
        return "a public header may not include a third-party header" if foreign else None
    found = find_included(path, target, exists)
    other = room_of(found) if found else None  # none: generated, or third-party in quotes
    if other is None or other == room or may_know(rooms, other):
        return None
    return f'{room} may not include "{target}" of {other}; it knows {", ".join(sorted(rooms)) or "public headers only"}'


def find_included(path, target, exists):
    """The file of the project that an include in quotes names, or None."""
    for base in [path.rpartition("/")[0]] + SEARCH:
        candidate = posixpath.normpath(posixpath.join(base, target))
        if exists(candidate):
            return candidate
    return None


def forbidden_in(path, line):
    """Why this line (without comments and strings) is forbidden in the library, or None."""
    for pattern, reason in FORBIDDEN:
        match = pattern.search(line)
        if match and not any(path.startswith(where) and what in match.group() for where, what in ALLOWED):
            return f"{match.group().strip(' (')}: {reason}"
    return None


def namespace_violation(path, line):
    """Why a header of src/ may not have this line (without comments and strings), or None."""
    if re.search(r"\.hpp(\.in)?$", path) and PLAIN_NAMESPACE.match(line):
        return "a header of src/ opens the namespace of its room, not that of public names"
    return None


def table_of_rules():
    """The rules in Markdown."""
    lines = ["| room | public headers | other rooms |", "|---|---|---|"]
    for room, (public, rooms) in RULES.items():
        headers = "all" if public == PUBLIC else ", ".join(["basics"] * (BASICS <= public) + sorted(public - BASICS))
        known = [f"all of `{other[:-1]}`" if other.endswith("/*") else other.removeprefix("src/") for other in sorted(rooms)]
        lines.append(f"| `{room}` | {headers} | {', '.join(known) or '–'} |")
    return "\n".join(lines)


def violations():
    exists = lambda candidate: (ROOT / candidate).is_file()
    includes = set()  # pairs of rooms
    for top in ("include", "src", "c", "octave", "r", "js", "mpi", "cli", "examples", "benchmarks", "tests"):
        for file in sources_of(top):
            path = file.relative_to(ROOT).as_posix()
            text = file.read_text(encoding="utf-8")
            bare = without_comments(text).split("\n")
            for number, line in enumerate(text.split("\n"), 1):
                include = INCLUDE.match(line)
                found = include and include_violation(path, include.group(1), include.group(2), exists)
                if found:
                    yield path, number, found
                if path.startswith("src/"):
                    included = include and include.group(1) == '"' and find_included(path, include.group(2), exists)
                    if included and room_of(included) != room_of(path):
                        includes.add((room_of(path), room_of(included)))
                    found = forbidden_in(path, bare[number - 1]) or namespace_violation(path, bare[number - 1])
                    if found:
                        yield path, number, found
    if TABLE.findall(PAGE.read_text(encoding="utf-8")) != [table_of_rules()]:
        yield PAGE.relative_to(ROOT).as_posix(), 0, "the table of rules is not that of tools/check_layering.py, which --write-table writes"
    yield from cycle_violations(includes)
    yield from algorithm_violations((ROOT / ALGORITHM).read_text(encoding="utf-8"))
    yield from size_violations({file.relative_to(ROOT).as_posix(): len(file.read_text(encoding="utf-8").splitlines())
                                for file in sources_of("src")})
    yield from foreign_files(file.relative_to(ROOT).as_posix() for file in sorted((ROOT / "src").rglob("*")) if file.is_file())


def foreign_files(paths):
    """Those that are neither sources nor read by CMake."""
    for path in paths:
        if not SOURCE_FILE.search(path):
            yield path, 0, "src/ holds only sources, templates (.in) and CMakeLists.txt"


def sources_of(top):
    return [file for file in sorted((ROOT / top).rglob("*")) if re.search(r"\.(cpp|hpp|c|h)(\.in)?$", file.name)]


def cycle_violations(includes):
    """Rooms of which one includes the other, perhaps by way of others, and the other way round. `includes`: pairs of rooms."""
    known = {}
    for room, other in includes:
        known.setdefault(room, set()).add(other)
    seen = {}  # the rooms that each reaches

    def reached(room):
        if room not in seen:
            seen[room] = set()
            todo = [room]
            while todo:
                for other in known.get(todo.pop(), ()):
                    if other not in seen[room]:
                        seen[room].add(other)
                        todo.append(other)
        return seen[room]

    for room in sorted(known):
        for other in sorted(known[room]):
            if room in reached(other):
                yield room, 0, f"{room} and {other} include each other"


def algorithm_violations(text):
    """The page that shows the algorithm does so in few lines, and names the sections of the report."""
    lines = sum(1 for line in without_comments(text).split("\n") if line.strip() and not line.lstrip().startswith("#"))
    if lines > MOST_LINES_OF_ALGORITHM:
        yield ALGORITHM, 0, f"the algorithm takes {lines} lines of code; {MOST_LINES_OF_ALGORITHM} are the most"
    missing = sorted(section for section in SECTIONS if section not in text)
    if missing:
        yield ALGORITHM, 0, f"no comment names {', '.join(missing)} of the report"


def size_violations(lines_of_file):
    """Files of src/ that are too long, and rooms that hold too much. `lines_of_file`: path -> number of lines."""
    lines_of_room = {}
    for path, lines in lines_of_file.items():
        if lines > MOST_LINES_OF_FILE:
            yield path, lines, f"the file has {lines} lines; {MOST_LINES_OF_FILE} are the most"
        room = path.rsplit("/", 1)[0]
        lines_of_room[room] = lines_of_room.get(room, 0) + lines
    most = LARGEST_SHARE_OF_ROOM * sum(lines_of_file.values())
    for room, lines in lines_of_room.items():
        if room not in RULES:
            yield room, 0, "no rule says what this folder may include"
        if lines > most:
            yield room, 0, f"the room holds {lines} lines; {int(most)}, an eighth of src/, are the most"


def self_test():
    """The rules find violations, and only violations."""
    there = {"src/engine/build.hpp", "src/kernel/exact.hpp", "src/order/insertion_order.hpp", "cli/command.hpp"}.__contains__
    wrong = [
        ("src/kernel/filter.hpp", '"', "engine/build.hpp"),
        ("src/engine/build.hpp", '"', "kernel/exact.hpp"),
        ("src/engine/build.hpp", '"', "../kernel/exact.hpp"),
        ("src/order/rounds.cpp", "<", "delone/complex.hpp"),
        ("src/io/write.cpp", '"', "engine/build.hpp"),
        ("cli/main.cpp", '"', "order/insertion_order.hpp"),
        ("examples/first.cpp", '"', "src/kernel/exact.hpp"),
        ("tests/property/order_test.cpp", '"', "order/insertion_order.hpp"),
        ("include/delone/io.hpp", "<", "fmt/format.h"),
        ("include/delone/io.hpp", "<", "stdint.h"),
        ("include/delone/delone.h", "<", "stdio.h"),
        ("c/hull.cpp", '"', "src/kernel/exact.hpp"),
    ]
    right = [
        ("src/geometry/pencil.hpp", '"', "kernel/exact.hpp"),
        ("src/compiled/boundary_engine.hpp", '"', "engine/build.hpp"),
        ("src/engine/build.hpp", "<", "vector"),
        ("cli/main.cpp", '"', "command.hpp"),
        ("tests/unit/order/rounds_test.cpp", '"', "order/insertion_order.hpp"),
        ("tests/unit/engine/wrap/wrapping_test.cpp", '"', "engine/build.hpp"),
        ("src/io/read.cpp", "<", "delone/io.hpp"),
        ("include/delone/io.hpp", "<", "vector"),
        ("include/delone/delone.h", "<", "stdint.h"),
        ("c/hull.cpp", "<", "delone/delone.h"),
    ]
    sizes = {"src/kernel/a.hpp": 501, "src/order/b.cpp": 20, "src/nowhere/c.cpp": 1}
    assert [path for path, _, _ in size_violations(sizes)] == ["src/kernel/a.hpp", "src/kernel", "src/nowhere"]
    even = {f"{room}/a.cpp": 100 for room in RULES if room.startswith("src/")}
    assert not list(size_violations(even))
    foreign = ["src/view/viewer.html", "src/kernel/constants.json", "src/notes.md", "src/view/page.js", "src/exports.map", "src/base/x.cpp.orig"]
    at_home = ["src/kernel/a.hpp", "src/order/b.cpp", "src/compiled/boundary_engine_instance.cpp.in", "src/exports.map.in", "src/CMakeLists.txt"]
    assert [path for path, _, _ in foreign_files([*foreign, *at_home])] == foreign
    assert [path for path, _, _ in cycle_violations({("a", "b"), ("b", "c"), ("c", "a"), ("d", "a")})] == ["a", "b", "c"]
    assert not list(cycle_violations({("a", "b"), ("a", "c"), ("b", "c")}))
    sections = "// " + " ".join(sorted(SECTIONS)) + "\n"
    assert not list(algorithm_violations(sections + "int x;\n\n// y\n" * MOST_LINES_OF_ALGORITHM))
    assert list(algorithm_violations(sections + "int x;\n" * (MOST_LINES_OF_ALGORITHM + 1)))
    assert list(algorithm_violations("int x;\n"))
    bad_lines = ["std::cout << 1;", "printf(x);", "std::fprintf(stderr, x);", "abort();", "  exit(1);", "fmt::print(x);"]
    good_lines = ["std::snprintf(b, n, x);", "on_exit(1);", "fmt::format(x);", "scope.exit(3);", "format_abort(x);"]
    assert all(include_violation(*case, there) for case in wrong), [c for c in wrong if not include_violation(*c, there)]
    assert not any(include_violation(*case, there) for case in right), [c for c in right if include_violation(*c, there)]
    assert all(forbidden_in("src/x.cpp", line) for line in bad_lines), [b for b in bad_lines if not forbidden_in("src/x.cpp", b)]
    assert not any(forbidden_in("src/x.cpp", line) for line in good_lines), [g for g in good_lines if forbidden_in("src/x.cpp", g)]
    assert forbidden_in("src/x.cpp", without_comments('f("abort()"); // exit(1)')) is None
    assert all(namespace_violation("src/x.hpp", line) for line in ["namespace delone {", "namespace delone", "inline namespace delone {"])
    assert not any(namespace_violation("src/x.hpp", line) for line in ["namespace delone::hull {", "namespace delone_tests {", "}"])
    assert namespace_violation("src/x.cpp", "namespace delone {") is None
    print("the layering rules catch what they should")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    if sys.argv[1:] == ["--write-table"]:
        PAGE.write_text(TABLE.sub(lambda _: table_of_rules(), PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    found = list(violations())
    for path, number, reason in found[:20]:
        print(f"{path}:{number}: {reason}")
    if found:
        sys.exit(f"{len(found)} violation(s) of the layering; the rules are at the top of tools/check_layering.py")
    print("the layering holds")


if __name__ == "__main__":
    main()
