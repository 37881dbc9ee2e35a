#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the Octave package: one file that `pkg install` takes.

Usage: octave_package.py FOLDER      writes FOLDER/delone-VERSION.tar.gz and prints its path

The package is built on the C interface, which has to be installed where pkg-config finds delone-c.
"""
import io
import pathlib
import re
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


def contents():
    """(path in the package, bytes), in a fixed order."""
    for path in sorted((ROOT / "octave").rglob("*")):
        if path.is_file() and path.suffix not in (".o", ".oct"):
            yield path.relative_to(ROOT / "octave").as_posix(), path.read_bytes()
    yield "COPYING", (ROOT / "LICENSE").read_bytes()


def make(folder):
    version = re.search(r"^Version: (\S+)", (ROOT / "octave/DESCRIPTION").read_text(encoding="utf-8"), re.M)[1]
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"delone-{version}.tar.gz"
    with tarfile.open(path, "w:gz", format=tarfile.USTAR_FORMAT) as archive:
        for name, data in contents():
            member = tarfile.TarInfo(f"delone-{version}/{name}")
            member.size = len(data)
            archive.addfile(member, io.BytesIO(data))
    return path


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print(make(pathlib.Path(sys.argv[1])))
