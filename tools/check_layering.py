#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks who includes whom, and that the library keeps its manners. The rules are the data below; docs/architecture.md
explains them. Prints every violation as FILE:LINE and exits with status 1 if there is one.

Usage: check_layering.py [--self-test]
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# What every room may include of the public headers, beside what it may include of the other rooms of src/.
BASICS = {"types", "error", "config"}
PUBLIC = "all public headers"

# room (longest matching path decides) -> (public headers, rooms of the project)
RULES = {
    "include/delone": (PUBLIC, {"include/delone"}),
    "src": (BASICS, {"src"}),  # small headers that every room of the library may use
    "src/kernel": (BASICS | {"predicates"}, {"src/kernel", "src"}),
    "src/order": (BASICS, {"src/order", "src"}),
    "src/geometry": (BASICS, {"src/geometry", "src/kernel", "src"}),
    "src/engine": (BASICS | {"complex"}, {"src/engine", "src"}),
    "src/front_ends": (PUBLIC, {"src/front_ends", "src/engine", "src/geometry", "src/kernel", "src/order", "src"}),
    "src/point_sets": (BASICS | {"point_sets"}, {"src/point_sets", "src"}),
    "src/io": (PUBLIC, {"src/io", "src"}),
    "cli": (PUBLIC, {"cli"}),
    "examples": (PUBLIC, set()),
    "benchmarks": (PUBLIC, {"benchmarks", "tests/support"}),
    # What users never call by itself is timed by itself: predicates, orders, the phases of an insertion.
    "benchmarks/internal": (PUBLIC, {"benchmarks/internal", "src", "src/kernel", "src/order", "src/geometry", "src/engine",
                                     "src/front_ends"}),
    "tests": (PUBLIC, {"tests", "tests/support", "tests/property", "tests/differential", "tests/cli"}),
    "tests/support": (PUBLIC, {"tests/support"}),
    "tests/consumer": (PUBLIC, {"tests/consumer"}),
    "tests/unit": (PUBLIC, {"tests/unit", "tests/support", "src", "src/kernel", "src/order", "src/geometry", "src/engine",
                            "src/front_ends", "src/io", "src/point_sets"}),
}

# Where a quoted include is looked for, after the folder of the file itself.
SEARCH = ["src", "tests/support", "include", ""]

# What no file below src/ may do: a library returns results or throws delone::Error.
FORBIDDEN = [
    (re.compile(r"\bstd::(cout|cerr|clog)\b|#\s*include\s*<iostream>"), "the library prints nothing"),
    (re.compile(r"(?<![\w.>])(?:std::)?(?:v?f?printf|puts|fputs|putchar|perror)\s*\((?!\s*\))"), "the library prints nothing"),
    (re.compile(r"(?<![\w.>])(?:fmt|std)::print(?:ln)?\s*\("), "the library prints nothing"),
    (re.compile(r"(?<![\w.>])(?:std::)?(?:abort|exit|_Exit|quick_exit|terminate)\s*\("), "the library never ends the program"),
    (re.compile(r"\bfesetround\s*\("), "the library does not switch the rounding mode"),
]
# Where one of them has a reason: (path, pattern text) -> the reason.
ALLOWED = {
    ("src/io", "fputs"): "text written to a file",
}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    """The longest room that the path lies in, or None."""
    best = None
    for room in RULES:
        if (path == room or path.startswith(room + "/")) and (best is None or len(room) > len(best)):
            best = room
    return best


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
        return "a public header may not include a third-party header" if room == "include/delone" and "." in target else None
    folder = path.rsplit("/", 1)[0] if "/" in path else ""
    for base in [folder] + SEARCH:
        candidate = str(pathlib.PurePosixPath(base) / target) if base else target
        parts = []
        for part in candidate.split("/"):
            parts.pop() if part == ".." and parts else parts.append(part)
        candidate = "/".join(parts)
        if exists(candidate):
            other = room_of(candidate)
            if other is None or other in rooms or other == room:
                return None
            return f'{room} may not include "{target}" of {other}; it knows {", ".join(sorted(rooms)) or "public headers only"}'
    return None  # generated, or third-party in quotes


def forbidden_in(path, line):
    """Why this line (comments and strings removed) may not stand in the library, or None."""
    for pattern, reason in FORBIDDEN:
        match = pattern.search(line)
        if match and not any(path.startswith(where) and what in match.group() for where, what in ALLOWED):
            return f"{match.group().strip(' (')}: {reason}"
    return None


def violations():
    exists = lambda candidate: (ROOT / candidate).is_file()
    for top in ("include", "src", "cli", "examples", "benchmarks", "tests"):
        for file in sorted((ROOT / top).rglob("*")):
            if not re.search(r"\.(cpp|hpp|h)(\.in)?$", file.name):
                continue
            path = file.relative_to(ROOT).as_posix()
            text = file.read_text(encoding="utf-8")
            bare = without_comments(text).split("\n")
            for number, line in enumerate(text.split("\n"), 1):
                include = INCLUDE.match(line)
                found = include and include_violation(path, include.group(1), include.group(2), exists)
                if found:
                    yield path, number, found
                if path.startswith("src/"):
                    found = forbidden_in(path, bare[number - 1])
                    if found:
                        yield path, number, found


def self_test():
    """The rules refuse what they are there to refuse, and nothing innocent."""
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
    ]
    right = [
        ("src/geometry/pencil.hpp", '"', "kernel/exact.hpp"),
        ("src/triangulation/delaunay.cpp", '"', "engine/build.hpp"),
        ("src/engine/build.hpp", "<", "vector"),
        ("cli/main.cpp", '"', "command.hpp"),
        ("tests/unit/order/rounds_test.cpp", '"', "order/insertion_order.hpp"),
        ("src/io/read.cpp", "<", "delone/io.hpp"),
        ("include/delone/io.hpp", "<", "vector"),
    ]
    bad_lines = ["std::cout << 1;", "printf(x);", "std::fprintf(stderr, x);", "abort();", "  exit(1);", "fmt::print(x);"]
    good_lines = ["std::snprintf(b, n, x);", "on_exit(1);", "fmt::format(x);", "scope.exit(3);", "format_abort(x);"]
    assert all(include_violation(*case, there) for case in wrong), [c for c in wrong if not include_violation(*c, there)]
    assert not any(include_violation(*case, there) for case in right), [c for c in right if include_violation(*c, there)]
    assert all(forbidden_in("src/x.cpp", line) for line in bad_lines), [b for b in bad_lines if not forbidden_in("src/x.cpp", b)]
    assert not any(forbidden_in("src/x.cpp", line) for line in good_lines), [g for g in good_lines if forbidden_in("src/x.cpp", g)]
    assert forbidden_in("src/x.cpp", without_comments('f("abort()"); // exit(1)')) is None
    print("the layering rules catch what they should")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    found = list(violations())
    for path, number, reason in found[:20]:
        print(f"{path}:{number}: {reason}")
    if found:
        sys.exit(f"{len(found)} violation(s) of the layering; the rules are at the top of tools/check_layering.py")
    print("the layering holds")


if __name__ == "__main__":
    main()
