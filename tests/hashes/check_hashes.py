#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Results and files are the same bit for bit on every platform: compares those of the command with expected.txt.

Usage: check_hashes.py [--update] COMMAND...

COMMAND is `delone`; words before it, such as an emulator, are run with it. Each line of expected.txt holds a hash and what it is the hash
of: a set of points as `delone generate` makes it or a file of data/, then a product and its options. With -o it is the hash of the bytes of
the file (SHA-256, cut to 128 bits), otherwise the canonical hash that the command reports. --update writes expected.txt anew.
"""
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

EXPECTED = pathlib.Path(__file__).with_name("expected.txt")
DATA = pathlib.Path(__file__).parents[2] / "data"


def of_file(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()[:32]


def hash_of(case, command, folder):
    """The hash of one case, such as `sphere -d 3 -n 500 : hull -o a.npz`."""
    points, _, product = case.partition(" : ")
    name, *options = points.split()
    path = DATA / name
    if "." not in name:
        path = folder / "points.npy"
        subprocess.run([*command, "generate", name, *options, "-o", path], check=True)
        options = []
        if not product:
            return of_file(path)
    product = product.split()
    if "-o" in product:
        out = folder / product.pop()
        subprocess.run([*command, *product[:-1], path, *options, "-q", "-o", out], check=True, stdout=subprocess.DEVNULL)
        return of_file(out)
    done = subprocess.run([*command, *product, path, *options, "--stats"], check=True, stdout=subprocess.PIPE)
    return json.loads(done.stdout)["hash"]


def main(arguments):
    update = arguments[:1] == ["--update"]
    command = arguments[update:]
    if not command:
        sys.exit(__doc__)
    lines = EXPECTED.read_text().splitlines()
    wrong = 0
    with tempfile.TemporaryDirectory() as folder:
        for i, line in enumerate(lines):
            expected, _, case = line.partition(" ")
            found = hash_of(case, command, pathlib.Path(folder))
            if found != expected and not update:
                print(f"{case}: {found}, not {expected}")
                wrong += 1
            lines[i] = f"{found} {case}"
    if update:
        EXPECTED.write_text("\n".join(lines) + "\n")
    print(f"{len(lines) - wrong} of {len(lines)} hashes are as expected")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
