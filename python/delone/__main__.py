# SPDX-License-Identifier: BSD-3-Clause
"""Runs a program with delone in the place of scipy.spatial and scipy.interpolate.

    python -m delone program.py [arguments]
    python -m delone -m module [arguments]
    python -m delone --version
"""
import os
import runpy
import sys

import delone


def main():
    arguments = sys.argv[1:]
    if not arguments or arguments[0] in ("-h", "--help") or arguments == ["-m"]:
        sys.exit(__doc__)
    if arguments[0] == "--version":
        print("delone", delone.__version__)
        return
    if arguments[0].startswith("-") and arguments[0] != "-m":
        sys.exit(f"python -m delone: there is no option {arguments[0]}\n{__doc__}")
    delone.patch_scipy()
    if arguments[0] == "-m":
        sys.argv = arguments[1:]
        runpy.run_module(arguments[1], run_name="__main__", alter_sys=True)
    else:
        sys.argv = arguments
        sys.path[0] = os.path.dirname(os.path.abspath(arguments[0]))
        runpy.run_path(arguments[0], run_name="__main__")


if __name__ == "__main__":
    main()
