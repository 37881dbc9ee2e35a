#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the documentation: runs its examples, compares their output, follows its links, measures its prose.

Usage: check_docs.py BUILD_DIR [--compiler CXX] [--c-compiler CC] [--python PYTHON]
                                   BUILD_DIR holds libdelone, libdelone_c and the command, and for PYTHON the module;
                                   without PYTHON its examples are left out
       check_docs.py BUILD_DIR --js PACKAGE --only docs/js.md
       check_docs.py BUILD_DIR --octave FOLDER ... --only docs/octave.md
                                   the same for one document; the FOLDERs hold the installed Octave package, without
                                   which its examples are left out
       check_docs.py BUILD_DIR --r LIBRARY --only docs/r.md
                                   the same for one document; the LIBRARY holds the installed R package, without which its
                                   examples are left out
       check_docs.py --prose       only measures prose, follows links and looks for the files named; needs no build
       check_docs.py --self-test   shows that each rule of prose finds what it should

In README.md and docs/*.md a comment line directly before a fenced block says what the block is:
  <!-- run -->             a ```cpp or ```c block is a complete program, compiled and run; a ```sh block is run by bash -e in a
                           folder that has data/, with the command on the PATH. Python finds the shared library of the
                           C interface by its name. All blocks of one file share that folder. The ```python
                           blocks of one file are one session, and so are the ```r blocks; each ```octave block is one of its own.
  <!-- run: status 2 -->   the same, and it must end with this exit status
  <!-- output -->          the block is what the last run block printed (standard output, then standard error);
                           "…" in a line stands for any text, a line "…" for any lines
Relative links, and their #anchors, must exist in every .md file of the project.

Prose: no line is longer than 160 characters, no paragraph or list item longer than 130 words, no decision
(docs/decisions) longer than 600 words. Tables, link definitions, code blocks and comments do not count.

A source file in backquotes, such as `engine/build.hpp`, must exist: from the root of the project, or in src/, include/ or tests/.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"^<!-- (?P<mark>run(?:: status (?P<status>\d+))?|output) -->\n+```(?P<language>\w*)\n(?P<body>.*?)^```$", re.M | re.S)
LINK = re.compile(r"(?<!!)\[[^\]]*\]\((?!https?://|mailto:)([^)#\s]*)(#[^)\s]+)?\)")
FENCED = re.compile(r"^```.*?^```$", re.M | re.S)

LONGEST_LINE = 160  # characters
LONGEST_PARAGRAPH = 130  # words
LONGEST_DECISION = 600  # words

LEFT_OUT = object()  # in place of the output of a block that was not run


class DocsError(Exception):
    pass


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def libraries_of(build):
    """What programs link beside the library."""
    cache = dict(line.split("=", 1) for line in (build / "CMakeCache.txt").read_text().splitlines() if "=" in line)
    has_tbb = cache.get("DELONE_WITH_TBB:STRING") != "OFF" and not cache.get("TBB_DIR:PATH", "NOTFOUND").endswith("NOTFOUND")
    has_zlib = cache.get("DELONE_WITH_ZLIB:STRING") != "OFF" and not cache.get("ZLIB_LIBRARY_RELEASE:FILEPATH", "NOTFOUND").endswith("NOTFOUND")
    return ["-lhwy", "-lfmt"] + has_tbb * ["-ltbb"] + has_zlib * ["-lz"]


def find_library(build):
    for name in ("libdelone.a", "libdelone.so"):
        found = list(build.rglob(name))
        if found:  # an installed copy in the build may be older
            return max(found, key=lambda path: path.stat().st_mtime)
    raise DocsError(f"{build} holds no libdelone: build it first")


def find_command(build):
    for path in (build / "delone", build / "cli" / "delone", build / "bin" / "delone"):
        if path.is_file() and os.access(path, os.X_OK):
            return path
    raise DocsError(f"{build} holds no command `delone`: build it first")


class PythonSession:
    """A Python that runs one block after the other, in one namespace."""

    # Reads a block as a JSON string from each line, writes [exit status, output] as JSON.
    LOOP = """
import contextlib, io, json, sys, traceback
namespace = {"__name__": "__main__"}
for line in sys.stdin:
    printed, status = io.StringIO(), 0
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        try:
            exec(compile(json.loads(line), "example", "exec"), namespace)
        except BaseException:
            traceback.print_exc()
            status = 1
    print(json.dumps([status, printed.getvalue()]), flush=True)
"""

    def __init__(self, python, folder, environment):
        self.process = subprocess.Popen([python, "-c", self.LOOP], cwd=folder, env=environment, stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)

    def run(self, body):
        self.process.stdin.write(json.dumps(body) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            raise DocsError("the Python session has ended")
        return tuple(json.loads(answer))

    def close(self):
        self.process.stdin.close()
        self.process.stdout.close()
        self.process.wait()


class Runner:
    """Runs the blocks of one file in a scratch folder."""

    def __init__(self, build, compilers, interpreters, scratch):
        self.build, self.compilers, self.scratch, self.programs = build, compilers, scratch, 0
        self.python, self.octave, self.r, self.r_blocks = interpreters["python"], interpreters["octave"], interpreters["r"], []
        if interpreters["js"]:
            (scratch / "node_modules").mkdir()
            (scratch / "node_modules/delone").symlink_to(interpreters["js"])
        self.session = None
        (scratch / "data").symlink_to(ROOT / "data")
        (scratch / "include").symlink_to(ROOT / "include")
        (scratch / "examples").symlink_to(ROOT / "examples")
        path = f"{find_command(build).parent}:{os.environ['PATH']}"
        self.environment = {**os.environ, "PATH": path, "LC_ALL": "C.UTF-8", "COLUMNS": "100", "MPLBACKEND": "Agg",
                            "PYTHONPATH": str(build / "python"), "LD_LIBRARY_PATH": str(build)}

    def close(self):
        if self.session:
            self.session.close()

    def run(self, language, body):
        """(exit status, output) of a block."""
        if language in ("cpp", "c"):
            self.programs += 1
            source = self.scratch / f"program_{self.programs}.{language}"
            source.write_text(body, encoding="utf-8")
            program = source.with_suffix("")
            if language == "c":
                how = ["-std=c99", "-pedantic", f"-L{self.build}", "-ldelone_c", "-lm"]
            else:
                library = find_library(self.build)
                how = ["-std=c++20", f"-I{self.build / 'include'}", str(library), f"-Wl,-rpath,{library.parent}",
                       *libraries_of(self.build), "-pthread"]
            compiled = subprocess.run(
                [self.compilers[language], "-O0", "-Wall", "-Wextra", "-Werror", f"-I{ROOT / 'include'}", str(source), *how,
                 "-o", str(program)],
                capture_output=True, text=True)
            if compiled.returncode != 0:
                raise DocsError("does not compile:\n" + compiled.stderr)
            command = [str(program)]
        elif language == "sh":
            command = ["bash", "-e", "-o", "pipefail", "-c", body]
        elif language == "python":
            self.session = self.session or PythonSession(self.python, self.scratch, self.environment)
            return self.session.run(body)
        elif language == "octave":
            program = self.scratch / "program.m"
            program.write_text("".join(f'addpath ("{folder}");\n' for folder in self.octave) + body, encoding="utf-8")
            command = ["octave-cli", "--norc", "--no-history", str(program)]
        elif language == "js":
            program = self.scratch / "program.mjs"
            program.write_text(body, encoding="utf-8")
            command = ["node", str(program)]
        elif language == "r":
            return self.run_r(body)
        else:
            raise DocsError(f"marked to run, but its language is '{language}' and not cpp, c, sh, python, octave, r or js")
        done = subprocess.run(command, cwd=self.scratch, env=self.environment, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=300)
        return done.returncode, done.stdout + done.stderr

    def run_r(self, body):
        """A session of R that repeats the earlier blocks, and prints what the last one does."""
        program = self.scratch / "program.R"
        silent = "".join(f"sink(nullfile()); {{\n{block}}}; sink()\n" for block in self.r_blocks)
        program.write_text(f"grDevices::pdf(NULL)\n{silent}{body}", encoding="utf-8")
        environment = {**self.environment, "R_LIBS": str(self.r)}
        done = subprocess.run(["Rscript", "--vanilla", str(program)], cwd=self.scratch, env=environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=300)
        self.r_blocks.append(body)
        return done.returncode, done.stdout + done.stderr


def matches(expected, actual):
    """Whether the output is as documented; "…" stands for any text, alone on a line for any lines."""
    lines = []
    for line in expected.rstrip("\n").split("\n"):
        lines.append(r"(?:.*\n)*?" if line.strip() == "…" else ".*?".join(map(re.escape, line.rstrip().split("…"))) + r"[ \t]*\n")
    return re.fullmatch("".join(lines), actual.rstrip("\n") + "\n") is not None


def check_blocks(path, build, compilers, interpreters, faults):
    """Runs the marked blocks of a file and adds to `faults`. Returns how many blocks were run and how many were left out."""
    text = path.read_text(encoding="utf-8")
    count, left_out, output = 0, 0, None
    with tempfile.TemporaryDirectory(prefix="delone_docs_") as scratch:
        runner = None
        for block in BLOCK.finditer(text):
            try:
                if block["mark"] == "output":
                    if output is None:
                        raise DocsError("an output block without a run block before it")
                    if output is LEFT_OUT:
                        continue
                    if not matches(block["body"], output):
                        raise DocsError(f"the output is not what is documented.\n--- documented\n{block['body']}--- actual\n{output}")
                    continue
                if block["language"] in interpreters and not interpreters[block["language"]]:
                    left_out, output = left_out + 1, LEFT_OUT
                    continue
                count += 1
                output = ""
                runner = runner or Runner(build, compilers, interpreters, pathlib.Path(scratch))
                status, output = runner.run(block["language"], block["body"])
                if status != int(block["status"] or 0):
                    raise DocsError(f"ended with exit status {status}, expected {block['status'] or 0}\n{output}")
            except (DocsError, subprocess.TimeoutExpired) as error:
                faults.append(f"{path.relative_to(ROOT)}:{line_of(text, block.start())}: {error}")
        if runner:
            runner.close()
        marks, blocks = len(re.findall(r"^<!-- (?:run|output)\b", text, re.M)), len(BLOCK.findall(text))
        if marks != blocks:
            faults.append(f"{path.relative_to(ROOT)}: {marks} marks but {blocks} marked blocks")
    return count, left_out


def anchors(path):
    """The anchors that GitHub makes of the headings of a file."""
    found = set()
    for heading in re.findall(r"^#+ +(.+?) *#*$", FENCED.sub("", path.read_text(encoding="utf-8")), re.M):
        plain = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower())
        found.add("#" + plain.replace(" ", "-"))
    return found


def broken_links(path):
    """The relative links of a file whose targets do not exist."""
    text = path.read_text(encoding="utf-8")
    for link in LINK.finditer(blanked(FENCED, text)):
        target = path if not link[1] else (path.parent / link[1]).resolve()
        place = f"{path.relative_to(ROOT)}:{line_of(text, link.start())}"
        if not target.exists():
            yield f"{place}: there is no {link[1]}"
        elif link[2] and target.suffix == ".md" and link[2] not in anchors(target):
            yield f"{place}: {target.relative_to(ROOT)} has no heading {link[2]}"


def blanked(pattern, text):
    """The text with what matches replaced by spaces, so that lines keep their numbers."""
    return pattern.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


ITEM = re.compile(r"\s*(?:[-*+]|\d+[.)])\s")
NOT_PROSE = re.compile(r"\s*\||\s*\[[^\]]+\]:\s|\s*$")  # a row of a table, a link definition, a blank line
COMMENT = re.compile(r"<!--.*?-->", re.S)


def paragraphs(text):
    """(number of the first line, lines) of each paragraph, heading and list item."""
    lines = blanked(COMMENT, blanked(FENCED, text)).split("\n")
    found, open_paragraph, in_list, indented_code = [], False, False, False
    for number, line in enumerate(lines, 1):
        if NOT_PROSE.match(line):
            open_paragraph = False
            continue
        in_list = bool(ITEM.match(line)) or (in_list and line.startswith(" "))
        indented_code = line.startswith("    ") and not in_list and (indented_code or not open_paragraph)
        if indented_code:
            continue
        if not open_paragraph or ITEM.match(line) or line.startswith("#"):
            found.append((number, []))
        found[-1][1].append(line)
        open_paragraph = not line.startswith("#")
    return found


def prose_faults(name, text):
    """What the document with this name breaks of the rules of prose."""
    words_in_all = 0
    for first, lines in paragraphs(text):
        words = sum(len(line.split()) for line in lines)
        words_in_all += words
        if words > LONGEST_PARAGRAPH:
            yield f"{name}:{first}: a paragraph of {words} words, more than {LONGEST_PARAGRAPH}"
        for number, line in enumerate(lines, first):
            if len(line) > LONGEST_LINE:
                yield f"{name}:{number}: a line of {len(line)} characters, more than {LONGEST_LINE}"
    if name.startswith("docs/decisions/") and words_in_all > LONGEST_DECISION:
        yield f"{name}: a decision of {words_in_all} words, more than {LONGEST_DECISION}"


def self_test():
    long_line = "x" * (LONGEST_LINE + 1)
    line_of_words = " ".join(["word"] * 10)
    many_lines = "\n".join([line_of_words] * (LONGEST_PARAGRAPH // 10)) + "\nword"
    many_paragraphs = "\n\n".join([line_of_words] * (LONGEST_DECISION // 10)) + "\n\nword"
    wrong = {
        "a long line": ("a.md", long_line),
        "a long line in a list": ("a.md", f"- item\n  {long_line}"),
        "a long heading": ("a.md", f"# {long_line}"),
        "a long paragraph": ("a.md", many_lines),
        "a long list item": ("a.md", "- " + many_lines),
        "a long paragraph after a table": ("a.md", "| a |\n|---|\n| b |\n" + many_lines),
        "a long decision": ("docs/decisions/0001-a.md", many_paragraphs),
    }
    right = {
        "the longest line": ("a.md", long_line[1:]),
        "the longest paragraph": ("a.md", many_lines[: -len("\nword")]),
        "two paragraphs": ("a.md", many_lines[: -len("\nword")] + "\n\nword"),
        "a list of items": ("a.md", "\n".join(["- " + line_of_words] * 20)),
        "a long page that is no decision": ("docs/a.md", many_paragraphs),
        "the longest decision": ("docs/decisions/0001-a.md", many_paragraphs[: -len("\n\nword")]),
        "a table": ("a.md", f"| {long_line} |"),
        "a link definition": ("a.md", f"[a]: https://example.org/{long_line}"),
        "a fenced block": ("a.md", f"```sh\n{long_line}\n\n{many_lines}\n```"),
        "an indented block": ("a.md", f"text\n\n    {long_line}\n    {long_line}"),
        "a comment": ("a.md", f"<!-- {long_line} -->"),
    }
    exists = {"src/engine/build.hpp", "tools/a.py"}.__contains__
    wrong_files = list(missing_files("a.md", "`engine/build.hpp` `engine/other.hpp`\n`tools/a.py` `b.hpp` `tools/b.py`", exists))
    assert wrong_files == ["a.md:1: there is no file engine/other.hpp", "a.md:2: there is no file tools/b.py"], wrong_files
    missed = [what for what, case in wrong.items() if len(list(prose_faults(*case))) != 1]
    imagined = [what for what, case in right.items() if list(prose_faults(*case))]
    if missed or imagined:
        sys.exit(f"not found: {missed}; found without reason: {imagined}")
    print("the rules of prose find what they should")


SOURCE_FILE = re.compile(r"`((?:[\w.-]+/)+[\w.-]+\.(?:hpp|cpp|in|py|pyi|cmake|sh|md))`")


def missing_files(name, text, exists=lambda path: (ROOT / path).exists()):
    """The source files in backquotes that do not exist."""
    for found in SOURCE_FILE.finditer(blanked(FENCED, text)):
        if not any(exists(folder + found[1]) for folder in ("", "src/", "include/", "tests/")):
            yield f"{name}:{line_of(text, found.start())}: there is no file {found[1]}"


def documents():
    inside = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "data/README.md")]
    inside += sorted((ROOT / "docs").rglob("*.md")) + sorted((ROOT / "benchmarks").rglob("*.md"))
    return [path for path in inside if path.exists()]


def main():
    parser = argparse.ArgumentParser(description="Runs the examples of the documentation, follows its links, measures its prose.")
    parser.add_argument("build", type=pathlib.Path, nargs="?", help="a build directory that holds the library and the command")
    parser.add_argument("--compiler", default=os.environ.get("CXX") or shutil.which("c++") or "c++")
    parser.add_argument("--c-compiler", default=os.environ.get("CC") or shutil.which("cc") or "cc")
    parser.add_argument("--python", help="a Python for which BUILD_DIR/python holds the module")
    parser.add_argument("--octave", nargs="+", help="the folders of the installed Octave package")
    parser.add_argument("--r", type=lambda folder: pathlib.Path(folder).resolve(), help="the library of R that holds the installed package")
    parser.add_argument("--js", type=lambda folder: pathlib.Path(folder).resolve(), help="the folder of the npm package")
    parser.add_argument("--only", help="the one document to check")
    parser.add_argument("--prose", action="store_true", help="only measure prose, follow links and look for files")
    parser.add_argument("--self-test", action="store_true", help="only show that the rules of prose find what they should")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    if not arguments.prose and arguments.build is None:
        parser.error("a build directory is needed, or --prose")

    faults, blocks, left_out = [], 0, 0
    for path in documents():
        name = path.relative_to(ROOT).as_posix()
        if arguments.only not in (None, name):
            continue
        faults += broken_links(path)
        if not name.startswith("benchmarks/history/"):  # records name the files of their day
            faults += missing_files(name, path.read_text(encoding="utf-8"))
        faults += prose_faults(name, path.read_text(encoding="utf-8"))
        if not arguments.prose:
            compilers = {"cpp": arguments.compiler, "c": arguments.c_compiler}
            interpreters = {"python": arguments.python, "octave": arguments.octave, "r": arguments.r, "js": arguments.js}
            run, not_run = check_blocks(path, arguments.build.resolve(), compilers, interpreters, faults)
            blocks, left_out = blocks + run, left_out + not_run
    if blocks == 0 and not faults and not arguments.prose:
        faults.append("no runnable block was found: the marks have changed")
    for fault in faults:
        print(fault)
    if faults:
        sys.exit(f"{len(faults)} fault(s) in the documentation")
    examples = "" if arguments.prose else f"{blocks} examples run, {left_out} left out, "
    print(f"{len(documents())} documents: {examples}links and files exist, lines and paragraphs are short enough")


if __name__ == "__main__":
    main()
