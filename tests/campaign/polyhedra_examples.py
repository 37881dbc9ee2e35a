#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Converts the examples of cddlib and lrs, there and back, and compares what comes back with what was given.

  tests/campaign/polyhedra_examples.py build/release/delone [--folder FOLDER] [--time SECONDS] [WORD ...]

Fetches the sources of both from Debian's archive into FOLDER, a temporary one by default, and takes their .ine and .ext files: nothing else is used
of them, and nothing is kept in the repository. For each file `delone polyhedron` writes the other description, `delone check --same-as` proves that
it is one, and where lrs is installed its list is proved, too, if it ends in time. Words select files by their names. Exit status 1: some file failed."""
import argparse
import collections
import hashlib
import json
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import urllib.request

ARCHIVE = "https://deb.debian.org/debian/pool/main/"
SOURCES = {
    "c/cddlib/cddlib_094m.orig.tar.gz": "766d8ec2135989830748e5e2fe57f307ed0706431c135541c3c081cbec0bc34f",
    "l/lrslib/lrslib_0.71b.orig.tar.gz": "df22682cd742315fe04f866cfe4804d5950f7dc7f514d5b5f36f5b7f5aff9188"}


def fetch(folder):
    """Unpacks the examples into the folder; returns their paths."""
    paths = []
    for name, checksum in SOURCES.items():
        archive = folder / name.rsplit("/", 1)[1]
        if not archive.exists():
            try:
                with urllib.request.urlopen(ARCHIVE + name) as response:
                    archive.write_bytes(response.read())
            except OSError as error:
                print(f"{archive.name}: {error}; left out", file=sys.stderr)
                continue
        if hashlib.sha256(archive.read_bytes()).hexdigest() != checksum:
            sys.exit(f"{archive}: not the file that was expected; delete it to fetch it again")
        with tarfile.open(archive) as members:
            for member in members:
                inner = pathlib.PurePosixPath(member.name)
                if not member.isfile() or inner.suffix not in (".ine", ".ext"):
                    continue
                path = folder / "-".join(inner.parts)
                path.write_bytes(members.extractfile(member).read())
                paths.append(path)
    if not paths:
        sys.exit("no examples could be fetched")
    return sorted(paths)


def said(command, seconds):
    """(status, output, message) of a command; the status is None if it takes too long."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=seconds, check=False)
    except subprocess.TimeoutExpired:
        return None, "", f"more than {seconds:.0f} s"
    return done.returncode, done.stdout, done.stderr.strip()


def list_of_lrs(path, other, seconds):
    """Writes what lrs lists as a file. Whether it did: where a function is to be maximized, it lists one optimum."""
    if any(word in path.read_text(encoding="utf-8", errors="replace") for word in ("maximize", "minimize")):
        return False
    status, text, _ = said(["lrs", str(path)], seconds)
    if status != 0 or "\nbegin" not in text or "*****" not in text:
        return False
    head, rows = text.rsplit("\nbegin", 1)
    linear = [line for line in head.splitlines() if line.startswith("linearity")][-1:]
    kind = "V-representation" if other.suffix == ".ext" else "H-representation"
    other.write_text("\n".join([kind, *linear, "begin" + rows.split("\nend")[0], "end", ""]), encoding="ascii")
    return True


def convert(delone, path, folder, seconds):
    """One word for what has happened, and more about it."""
    other = folder / f"other{'.ext' if path.suffix == '.ine' else '.ine'}"
    status, text, message = said([delone, "polyhedron", str(path), "--stats", "-o", str(other), "--force"], seconds)
    if status is None:
        return "late", message
    if status != 0:
        return "refused", message.rsplit("/", 1)[-1]
    stats = json.loads(text)
    status, text, message = said([delone, "check", str(path), "--same-as", str(other)], seconds)
    if status is None:
        return "late", f"the way back takes {message}"
    if status != 0:
        return "WRONG", text + message
    words = f"{stats['vertices']} vertices, {stats['rays']} rays, {stats['lines']} lines, {stats['inequalities']} inequalities, {stats['equations']} equations"
    # lrs has no list for the empty set, and for the origin alone.
    if shutil.which("lrs") and stats["vertices"] > 1 and list_of_lrs(path, other, seconds):
        status, text, message = said([delone, "check", str(path), "--same-as", str(other)], seconds)
        if status == 1:
            return "DIFFERENT", text
        if status == 0:
            return "proved, with lrs", words
    return "proved", words


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("delone")
    parser.add_argument("words", nargs="*")
    parser.add_argument("--folder", type=pathlib.Path)
    parser.add_argument("--time", type=float, default=20)
    options = parser.parse_args()
    counts = collections.Counter()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.folder or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for path in fetch(folder):
            if all(word in path.name for word in options.words):
                result, words = convert(options.delone, path, pathlib.Path(scratch), options.time)
                counts[result] += 1
                print(f"{path.name:<60}{result:<18}{words}", flush=True)
    print(", ".join(f"{count} {result}" for result, count in counts.items()))
    sys.exit(1 if counts["WRONG"] or counts["DIFFERENT"] else 0)


if __name__ == "__main__":
    main()
