#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of the documentation again that are stale: what they show has changed since.

Usage: pictures.py BUILD_DIR   makes them; BUILD_DIR has the command and the Python module
       pictures.py --check     only names them; the exit status is 1 if there are any
       pictures.py --accept    takes the pictures as they are for fresh: a change that they do not show

docs/pictures/inputs.json has a hash of what each program makes its pictures of: the program, the page of the viewer or the Python code
that draws, and the data.
"""
import hashlib
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RECORD = pathlib.Path("docs/pictures/inputs.json")
DATA = ["data/cars.csv", "data/earthquakes.csv", "data/protein.csv"]

# program: (what its pictures are made of, modules of Python that it needs)
PROGRAMS = {
    "tools/make_view_pictures.py": (["tests/site/chromium.py", "viewer/dist/viewer.html", *DATA], ["PIL", "selenium"]),
    "tools/make_pictures.py": (["python/delone/_canvas.py", "python/delone/_plot.py", "python/delone/spatial/_plot.py", *DATA],
                               ["matplotlib", "numpy", "PIL", "scipy"]),
    "tools/make_particle_pictures.py": (["tools/make_pictures.py", *DATA], ["matplotlib", "numpy", "PIL", "scipy"]),
}


def digest(program, root=ROOT):
    """The hash of a program and of what it makes pictures of."""
    total = hashlib.sha256()
    for name in [program, *PROGRAMS[program][0]]:
        total.update(f"{name}\n".encode() + hashlib.sha256((root / name).read_bytes()).digest())
    return total.hexdigest()


def stale(root=ROOT):
    """The programs whose pictures are stale."""
    record = json.loads((root / RECORD).read_text(encoding="utf-8"))
    return [program for program in PROGRAMS if record.get(program) != digest(program, root)]


def accept(programs):
    record = json.loads((ROOT / RECORD).read_text(encoding="utf-8")) if (ROOT / RECORD).exists() else {}
    record.update({program: digest(program) for program in programs})
    (ROOT / RECORD).write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")


def python_with(modules):
    """A Python that has these modules, or None."""
    for python in ("python3", "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import " + ", ".join(modules)], stderr=subprocess.DEVNULL).returncode == 0:
            return python
    return None


def main(arguments):
    if arguments == ["--accept"]:
        accept(PROGRAMS)
        return 0
    programs = stale()
    if arguments == ["--check"]:
        for program in programs:
            print(f"the pictures of {program} are stale: run make docs, or tools/pictures.py --accept if what they show is the same")
        return 1 if programs else 0
    if len(arguments) != 1 or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 64
    build = pathlib.Path(arguments[0]).resolve()
    environment = dict(os.environ, DELONE=str(build / "delone"), PYTHONPATH=str(build / "python"))
    for program in programs:
        modules = PROGRAMS[program][1]
        python = python_with(modules)
        if python is None:
            print(f"the pictures of {program} are stale, and no Python here has {', '.join(modules)}", file=sys.stderr)
            return 1
        print(f"{program}: its pictures are made again", flush=True)
        subprocess.run([python, str(ROOT / program)], cwd=ROOT, env=environment, check=True)
        accept([program])
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
