# SPDX-License-Identifier: BSD-3-Clause
"""The shared library exports what the public headers mark with DELONE_EXPORT, and nothing else.

Usage: test_exports.py LIBRARY INCLUDE_DIR
       test_exports.py --self-test
"""
import pathlib
import re
import subprocess
import sys

TYPE_DATA = re.compile(r"^(?:vtable|typeinfo|typeinfo name) for delone::(\w+)$")


def bracketed(text, start, pair):
    """Where the bracket that opens at `start` closes."""
    depth = 0
    for i in range(start, len(text)):
        depth += (text[i] == pair[0]) - (text[i] == pair[1])
        if depth == 0:
            return i
    raise ValueError(text[start:start + 80])


def declared(headers):
    """(functions, {class: its members}, types) that are marked; `headers`: their texts."""
    functions, classes, types = set(), {}, set()
    for text in headers:
        text = re.sub(r"//.*|^#.*", "", text, flags=re.M)
        types |= set(re.findall(r"\b(?:class|struct) DELONE_EXPORT_TYPE (\w+)", text))
        for found in re.finditer(r"\b(?:class|struct) DELONE_EXPORT (\w+)[^{;]*\{", text):
            body = text[found.end() - 1:bracketed(text, found.end() - 1, "{}")]
            classes[found[1]] = set(re.findall(r"([\w~]+|operator\W+)\s*\(", body)) | {"operator="}
        for found in re.finditer(r"^DELONE_EXPORT (?!class|struct|friend)[^;{(]*?\b(\w+|operator\W+)\(", text, re.M):
            functions.add(found[1])
        for found in re.finditer(r"^ *DELONE_EXPORT friend [^;(]*?\b(operator\W+)\(", text, re.M):
            functions.add(name_of(found[1]))
    return functions, classes, types


def name_of(symbol):
    """The qualified name in a demangled symbol, without template arguments, parameters and what is returned."""
    previous = None
    while symbol != previous:
        previous, symbol = symbol, re.sub(r"<[^<>]*>", "", symbol)
    return re.sub(r"\[abi:\w+\]", "", symbol.partition("(")[0]).split(" ")[-1]


def compare(symbols, headers):
    """What is wrong with the exported symbols."""
    functions, classes, types = declared(headers)
    faults, seen = [], set()
    for symbol in symbols:
        data = TYPE_DATA.match(symbol)
        if data:
            if data[1] not in types | set(classes):
                faults.append(f"exported, but not in a header: {symbol}")
            continue
        parts = [part for part in name_of(symbol).split("::") if part not in ("detail", "messages", "")]
        if parts[:1] == ["delone"] and len(parts) == 2 and parts[1] in functions:
            seen.add(parts[1])
        elif parts[:1] == ["delone"] and len(parts) == 3 and parts[2] in classes.get(parts[1], ()):
            seen.add(parts[1])
        else:
            faults.append(f"exported, but not in a header: {symbol}")
    return faults + [f"not exported: {name}" for name in sorted((functions | set(classes)) - seen)]


def self_test():
    header = ["DELONE_EXPORT int f(int a);\nclass DELONE_EXPORT C : public B {\n  void m() const;\n  struct Impl;\n};\nstruct DELONE_EXPORT_TYPE E {};\n"]
    good = ["delone::f(int)", "delone::C::m() const", "typeinfo for delone::E"]
    assert compare(good, header) == [], compare(good, header)
    assert compare(good[:1] + good[2:], header) == ["not exported: C"]
    for bad in ("std::vector<delone::E>::push_back(delone::E const&)", "delone::g(int)", "delone::C::Impl::m()", "delone::internal::f(int)", "hwy::F()",
                "typeinfo for delone::X", "fmt::v9::detail::f()", "std::vector<int> delone::g<int>()"):
        assert len(compare(good + [bad], header)) == 1, bad


if __name__ == "__main__":
    self_test()
    if sys.argv[1] != "--self-test":
        library, folder = sys.argv[1:]
        table = subprocess.run(["nm", "-DC", "--defined-only", "--without-symbol-versions", library], check=True, capture_output=True, text=True).stdout
        # A: the version itself
        exported = [line.split(" ", 2)[2] for line in table.splitlines() if line.split(" ", 2)[1] != "A"]
        # Headers of messages are for the command and the bindings.
        headers = [*pathlib.Path(folder).glob("*.hpp"), *(pathlib.Path(__file__).parents[2] / "src/messages").glob("*.hpp")]
        faults = compare(exported, [path.read_text(encoding="utf-8") for path in sorted(headers)])
        print(f"{len(exported)} symbols")
        sys.exit("\n".join(faults) or None)
