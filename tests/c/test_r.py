# SPDX-License-Identifier: BSD-3-Clause
"""Compiles the C of docs/c.md that R calls, and runs its example, if R is found.

  python3 tests/c/test_r.py FOLDER_WITH_LIBDELONE_C
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main(library):
    if not shutil.which("Rscript"):
        print("skipped: there is no R")
        return 77
    page = (ROOT / "docs" / "c.md").read_text(encoding="utf-8").split("## From R\n")[1].split("\n## ")[0]
    blocks = {language: re.search(rf"^```{language}\n(.*?)^```$", page, re.M | re.S)[1] for language in ("c", "sh", "r")}
    with tempfile.TemporaryDirectory() as folder:
        here = pathlib.Path(folder)
        (here / "data").symlink_to(ROOT / "data")
        (here / "include").symlink_to(ROOT / "include")
        (here / "build").mkdir()
        (here / "build" / "release").symlink_to(library)
        (here / "delaunay.c").write_text(blocks["c"])
        environment = dict(os.environ, LD_LIBRARY_PATH=library)
        subprocess.run(["bash", "-ec", blocks["sh"]], cwd=here, env=environment, check=True, stdout=subprocess.DEVNULL)
        printed = subprocess.run(["Rscript", "-e", blocks["r"]], cwd=here, env=environment, check=True, capture_output=True, text=True).stdout
    expected = re.search(r"print\(.*# (.*)", blocks["r"])[1]
    print(printed)
    return 0 if printed.split()[1:] == expected.split() else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
