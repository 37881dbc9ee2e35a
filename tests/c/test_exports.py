# SPDX-License-Identifier: BSD-3-Clause
"""The shared library exports the functions of the header, and nothing else.

Usage: test_exports.py LIBRARY HEADER
"""
import pathlib
import re
import subprocess
import sys

library, header = sys.argv[1:]
table = subprocess.run(["nm", "-D", "--defined-only", library], check=True, capture_output=True, text=True).stdout
symbols = [line.split() for line in table.splitlines()]
exported = {words[-1].split("@")[0] for words in symbols if words[-2] != "A"}  # A: the version itself
declared = set(re.findall(r"^DELONE_C_API [^;(]*?(\w+)\(", pathlib.Path(header).read_text(encoding="utf-8"), re.M))
assert len(declared) > 40, declared
assert declared - exported == set(), f"not exported: {sorted(declared - exported)}"
assert exported - declared == set(), f"exported, but not in the header: {sorted(exported - declared)[:20]}"
