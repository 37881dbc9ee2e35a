#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the documentation against the program: runs its examples, compares their output, follows its links.

Usage: check_docs.py BUILD_DIR [--compiler CXX] [--python PYTHON]
                           BUILD_DIR holds libdelone and the command, and for PYTHON the module; without PYTHON its examples are left out

In README.md and docs/*.md a comment line directly before a fenced block says what the block is:
  <!-- run -->             a ```cpp block is a complete program, compiled and run; a ```sh block is run by bash -e in a folder
                           that has data/, with the command on the PATH. All blocks of one file share that folder. The ```python
                           blocks of one file are one session.
  <!-- run: status 2 -->   the same, and it must end with this exit status
  <!-- output -->          the block is what the last run block printed (standard output, then standard error);
                           "…" in a line stands for any text, a line "…" for any lines
Relative links, and their #anchors, must exist in every .md file of the project.
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

LEFT_OUT = object()  # in place of the output of a block that was not run


class DocsError(Exception):
    pass


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


def find_library(build):
    for name in ("libdelone.a", "libdelone.so"):
        found = sorted(build.rglob(name))
        if found:
            return found[0]
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

    def __init__(self, build, compiler, python, scratch):
        self.build, self.compiler, self.python, self.scratch, self.programs = build, compiler, python, scratch, 0
        self.session = None
        (scratch / "data").symlink_to(ROOT / "data")
        (scratch / "include").symlink_to(ROOT / "include")
        (scratch / "examples").symlink_to(ROOT / "examples")
        path = f"{find_command(build).parent}:{os.environ['PATH']}"
        self.environment = {**os.environ, "PATH": path, "LC_ALL": "C.UTF-8", "COLUMNS": "100", "MPLBACKEND": "Agg",
                            "PYTHONPATH": str(build / "python")}

    def close(self):
        if self.session:
            self.session.close()

    def run(self, language, body):
        """(exit status, output) of a block."""
        if language == "cpp":
            self.programs += 1
            source = self.scratch / f"program_{self.programs}.cpp"
            source.write_text(body, encoding="utf-8")
            program = source.with_suffix("")
            library = find_library(self.build)
            compiled = subprocess.run(
                [self.compiler, "-std=c++20", "-O0", "-Wall", "-Wextra", "-Werror", f"-I{ROOT / 'include'}", f"-I{self.build / 'include'}",
                 str(source), str(library), f"-Wl,-rpath,{library.parent}", "-lhwy", "-pthread", "-o", str(program)],
                capture_output=True, text=True)
            if compiled.returncode != 0:
                raise DocsError("does not compile:\n" + compiled.stderr)
            command = [str(program)]
        elif language == "sh":
            command = ["bash", "-e", "-o", "pipefail", "-c", body]
        elif language == "python":
            self.session = self.session or PythonSession(self.python, self.scratch, self.environment)
            return self.session.run(body)
        else:
            raise DocsError(f"marked to run, but its language is '{language}' and not cpp, sh or python")
        done = subprocess.run(command, cwd=self.scratch, env=self.environment, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=300)
        return done.returncode, done.stdout + done.stderr


def matches(expected, actual):
    """Whether the output is as documented; "…" stands for any text, alone on a line for any lines."""
    lines = []
    for line in expected.rstrip("\n").split("\n"):
        lines.append(r"(?:.*\n)*?" if line.strip() == "…" else ".*?".join(map(re.escape, line.rstrip().split("…"))) + r"[ \t]*\n")
    return re.fullmatch("".join(lines), actual.rstrip("\n") + "\n") is not None


def check_blocks(path, build, compiler, python, faults):
    """Runs the marked blocks of a file; returns how many were run and how many left out, and adds what is wrong to `faults`."""
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
                if block["language"] == "python" and not python:
                    left_out, output = left_out + 1, LEFT_OUT
                    continue
                count += 1
                output = ""
                runner = runner or Runner(build, compiler, python, pathlib.Path(scratch))
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
    """What the relative links of a file name that does not exist."""
    text = path.read_text(encoding="utf-8")
    blanked = FENCED.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)
    for link in LINK.finditer(blanked):
        target = path if not link[1] else (path.parent / link[1]).resolve()
        place = f"{path.relative_to(ROOT)}:{line_of(text, link.start())}"
        if not target.exists():
            yield f"{place}: there is no {link[1]}"
        elif link[2] and target.suffix == ".md" and link[2] not in anchors(target):
            yield f"{place}: {target.relative_to(ROOT)} has no heading {link[2]}"


def documents():
    inside = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "data/README.md")]
    inside += sorted((ROOT / "docs").rglob("*.md")) + sorted((ROOT / "benchmarks").rglob("*.md"))
    return [path for path in inside if path.exists()]


def main():
    parser = argparse.ArgumentParser(description="Runs the examples of the documentation and follows its links.")
    parser.add_argument("build", type=pathlib.Path, help="a build directory that holds the library and the command")
    parser.add_argument("--compiler", default=os.environ.get("CXX") or shutil.which("c++") or "c++")
    parser.add_argument("--python", help="a Python for which BUILD_DIR/python holds the module")
    arguments = parser.parse_args()

    faults, blocks, left_out = [], 0, 0
    for path in documents():
        faults += broken_links(path)
        run, not_run = check_blocks(path, arguments.build.resolve(), arguments.compiler, arguments.python, faults)
        blocks, left_out = blocks + run, left_out + not_run
    if blocks == 0 and not faults:
        faults.append("no runnable block was found: the marks have changed")
    for fault in faults:
        print(fault)
    if faults:
        sys.exit(f"{len(faults)} fault(s) in the documentation")
    print(f"{len(documents())} documents: {blocks} examples run, {left_out} left out, all links lead somewhere")


if __name__ == "__main__":
    main()
