#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Source distribution → wheel → new virtual environment: each is complete, and the wheel stands alone.

Usage: check_wheel.py BUILD_DIR VERSION [--wheels FOLDER]    BUILD_DIR has the compiled module, which goes into the wheel as it is
       check_wheel.py --full VERSION [--wheels FOLDER]       compiles the module, and runs the tests of Python with the wheel

--wheels leaves the source distribution and the wheel in a folder. NumPy and pytest are those of this Python, whose packages the environment
sees; nothing is fetched.
"""
import argparse
import email
import fnmatch
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import platform_tag  # noqa: E402

LARGEST_WHEEL = 12 * 10**6  # bytes
NOT_IN_SDIST = (".ci/*", ".gitignore", "*/.gitignore", ".git*", "MANIFEST.in", "benchmarks/history/*.json", "benchmarks/history/*.csv")
PLATFORM = {"libz.so.1", "libc.so.6", "libm.so.6", "libdl.so.2", "librt.so.1", "libpthread.so.0", "libgcc_s.so.1", "libstdc++.so.6"}

SPDX = {"Apache License 2.0": "Apache-2.0", "MIT License": "MIT", "BSD 3-Clause License": "BSD-3-Clause", "Boost Software License 1.0": "BSL-1.0"}

USE = """
import importlib.metadata, pathlib, pickle, re, sys
import numpy as np, numpy.random


def mapped():
    maps = pathlib.Path("/proc/self/maps")
    return set(re.findall(r"(/\\S+\\.so[.\\d]*)$", maps.read_text(), re.M)) if maps.exists() else set()


before = mapped()
import delone, delone.spatial
inside = pathlib.Path(sys.prefix).resolve()
assert inside in pathlib.Path(delone.__file__).resolve().parents, delone.__file__
assert importlib.metadata.version("delone") == delone.__version__ == sys.argv[1], delone.__version__
files = {file.name for file in importlib.metadata.files("delone")}
assert {"LICENSE", "THIRD_PARTY_LICENSES", "py.typed", "_core.pyi", "_delaunay.py"} <= files, files
lattice = np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3)
t = delone.Delaunay(lattice)
assert t.num_cells == len(t.cells) and len(np.unique(t.cells)) == 64
assert abs(delone.spatial.ConvexHull(lattice).volume - 27) < 1e-9
assert delone.spatial.Delaunay(lattice).find_simplex([1.5, 1.5, 1.5]) >= 0
assert pickle.loads(pickle.dumps(t)).hash == t.hash
points = np.random.default_rng(1).random((30000, 3))
assert delone.Delaunay(points, threads=2).hash == delone.Delaunay(points, threads=1).hash
assert "scipy" not in sys.modules
for library in map(pathlib.Path, mapped() - before):  # what importing and using it brought along
    assert inside in library.parents or library.name.startswith(tuple(sys.argv[2].split())) or "lib-dynload" in library.parts, f"{library} was loaded"
print(delone.__version__, t.num_cells, "cells")
"""


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}\n{done.stdout[-20000:]}{done.stderr[-20000:]}")
    return done.stdout


def sources():
    """The files that the source distribution has to have: those of Git, or of this tree if it is no repository."""
    try:
        done = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True, text=True)
        listed = done.stdout.splitlines() if done.returncode == 0 and (ROOT / ".git").exists() else []
    except OSError:
        listed = []
    needed = {name for name in listed if (ROOT / name).is_file() and not any(fnmatch.fnmatch(name, pattern) for pattern in NOT_IN_SDIST)}
    for folder in ("src", "include", "cmake", "python"):
        needed |= {str(path.relative_to(ROOT)) for path in (ROOT / folder).rglob("*") if path.is_file() and path.suffix in (".cpp", ".hpp", ".h", ".py", ".cmake")}
    return needed


def check_sdist(made, version):
    assert made.name == f"delone-{version}.tar.gz", made.name
    with tarfile.open(made) as archive:
        inside = {member.name.partition("/")[2] for member in archive.getmembers() if not member.isdir()}
    needed = sources()
    # What setuptools adds.
    more = {name for name in inside - needed if name not in ("MANIFEST.in", "PKG-INFO", "setup.cfg") and ".egg-info/" not in name}
    assert not needed - inside, f"{made.name} lacks {len(needed - inside)} files: {sorted(needed - inside)[:10]}"
    assert not more, f"{made.name} contains files that git does not track: {sorted(more)[:10]}"


def check_libraries(wheel, folder):
    """Its libraries need each other and what the platform of its tag has, the module exports one symbol, and all is small."""
    size = wheel.stat().st_size
    assert size <= LARGEST_WHEEL, f"{wheel.name} has {size} bytes, more than {LARGEST_WHEEL}"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder)
    libraries = sorted(folder.rglob("*.so*"))
    bundled = {path.name for path in libraries}
    newest = {}
    for path in libraries:
        # Not as platform_tag reads it: the versions of the symbols themselves, and the names by readelf.
        table = run("objdump", "-T", path, env={**os.environ, "LC_ALL": "C"})
        for family, version in re.findall(r"\*UND\*.*?\(?\b(GLIBC|GLIBCXX|CXXABI|GCC)_([\d.]+)\b", table):
            newest[family] = max(newest.get(family, ()), tuple(int(part) for part in version.split(".")))
        dynamic = run("readelf", "-d", path, env={**os.environ, "LC_ALL": "C"})
        asked = {name for name in re.findall(r"\(NEEDED\).*\[(.+)\]", dynamic) if not name.startswith("ld-linux")}
        assert asked <= PLATFORM | bundled, f"{path.name} of {wheel.name} needs {sorted(asked - PLATFORM - bundled)}"
        if asked & bundled:
            assert re.search(r"\(RPATH\).*\[\$ORIGIN\]", dynamic), f"{path.name} does not look beside itself:\n{dynamic}"
        if path.name.startswith("_core."):
            exported = [line.split()[-1] for line in run("nm", "-D", "--defined-only", path).splitlines()]
            assert exported == ["PyInit__core"], exported[:10]
            assert ".symtab" not in run("readelf", "-SW", path), f"{path.name} is not stripped"
    tag = wheel.stem.split("-")[-1]
    claim = re.fullmatch(r"manylinux_(\d+)_(\d+)_\w+", tag)
    assert claim, f"{wheel.name} claims nothing: {platform_tag.tag(libraries)[1]}"
    allowed = dict(platform_tag.POLICIES)[tuple(map(int, claim.groups()))]
    for family, version in newest.items():
        assert version <= allowed[family], f"{wheel.name} needs {family}_{'.'.join(map(str, version))}"
    lower = [policy for policy, limits in platform_tag.POLICIES if all(version <= limits[family] for family, version in newest.items())]
    assert min(lower) == tuple(map(int, claim.groups())), f"{wheel.name} could claim manylinux_{min(lower)[0]}_{min(lower)[1]}"
    needed = " ".join(f"{family}_{'.'.join(map(str, version))}" for family, version in sorted(newest.items()))
    return f"{size / 1e6:.1f} MB, {len(bundled)} libraries, {needed}"


def check_metadata(wheel, version):
    """The license is named, and the bill of materials lists what THIRD_PARTY_LICENSES does, and every library in the wheel."""
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        folder = f"delone-{version}.dist-info"
        metadata = email.message_from_string(archive.read(f"{folder}/METADATA").decode())
        bill = json.loads(archive.read(f"{folder}/sboms/delone.cdx.json"))
        record = archive.read(f"{folder}/RECORD").decode()
    assert "BSD-3-Clause" in (metadata["License"], metadata["License-Expression"]), metadata.items()
    assert set(metadata.get_all("License-File")) == {"LICENSE", "THIRD_PARTY_LICENSES"}, metadata.get_all("License-File")
    assert f"{folder}/sboms/delone.cdx.json,sha256=" in record, record
    assert (bill["bomFormat"], bill["specVersion"], bill["metadata"]["component"]["version"]) == ("CycloneDX", "1.6", version), bill
    components = {component["name"]: component for component in bill["components"]}
    listed = (ROOT / "THIRD_PARTY_LICENSES").read_text(encoding="utf-8").partition("\n\n")[2].partition("\n\n")[0]
    for line in listed.splitlines():
        name, license_text = re.split(r"  +", line.strip())[:2]
        if name == "CLI11":  # in the command
            continue
        component = components.pop(name)
        assert re.fullmatch(r"\d+(\.\d+)+", component["version"]), component
        assert component["purl"] == component["bom-ref"] and component["purl"].endswith("@" + component["version"]), component
        assert component["licenses"] == [{"license": {"id": SPDX[license_text]}}], component
    assert not components, f"{sorted(components)} are not in THIRD_PARTY_LICENSES"
    parts = [component["bom-ref"] for component in bill["components"]]
    assert bill["dependencies"] == [{"ref": bill["metadata"]["component"]["bom-ref"], "dependsOn": parts}] and len(set(parts)) == len(parts)
    files = {"libhwy": "highway", "libtbb": "oneTBB", "libfmt": "fmt"}
    for name in names:
        if name.startswith("delone/lib"):
            assert any(f"/{files[pathlib.PurePath(name).name.partition('.')[0]]}@" in part for part in parts), name


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", nargs="?", type=pathlib.Path)
    parser.add_argument("version")
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--wheels", type=pathlib.Path)
    arguments = parser.parse_args()
    if arguments.full == bool(arguments.build):
        parser.error("either BUILD_DIR or --full")
    version = arguments.version
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # tests of interrupts need it, also where a shell starts this in the background
    clean = {key: value for key, value in os.environ.items() if not key.startswith(("PYTHON", "PIP_", "VIRTUAL_ENV", "DELONE_BUILD_DIR", "LD_"))}
    clean["PYTHONDONTWRITEBYTECODE"] = "1"
    building = {**clean, **({"DELONE_BUILD_DIR": str(arguments.build.resolve())} if arguments.build else {})}
    with tempfile.TemporaryDirectory(prefix="delone_wheel_") as folder:
        folder = pathlib.Path(folder)
        run(sys.executable, "setup.py", "-q", "sdist", "--formats=gztar", "-d", folder / "dist", cwd=ROOT, env=clean)
        sdist, = (folder / "dist").iterdir()
        check_sdist(sdist, version)
        with tarfile.open(sdist) as archive:
            archive.extraction_filter = getattr(tarfile, "data_filter", None)  # what Python 3.14 does by itself
            archive.extractall(folder)
        source = folder / f"delone-{version}"
        building.update({"CCACHE_BASEDIR": str(source), "CCACHE_NOHASHDIR": "1"})  # the same objects in any folder
        run(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", folder / "dist", source, cwd=folder, env=building)
        wheel, = (folder / "dist").glob("delone-*.whl")
        assert wheel.name.startswith(f"delone-{version}-cp") and "none-any" not in wheel.name, wheel.name
        names = zipfile.ZipFile(wheel).namelist()
        assert sum(name.startswith("delone/_core.") and name.endswith(".so") for name in names) == 1, names
        assert all(name.startswith(("delone/", f"delone-{version}.dist-info/")) for name in names), names
        check_metadata(wheel, version)
        about = check_libraries(wheel, folder / "unpacked") if sys.platform == "linux" else f"{wheel.stat().st_size / 1e6:.1f} MB"

        environment = folder / "environment"
        run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", environment)
        python = environment / "bin" / "python"
        run(sys.executable, "-m", "pip", "--python", python, "install", "--no-deps", "--no-index", "--ignore-installed", wheel, env=clean)
        print(run(python, "-c", USE, version, " ".join(PLATFORM), cwd=folder, env=clean).strip(), "from", wheel.name + ":", about, flush=True)
        if arguments.wheels:
            arguments.wheels.mkdir(parents=True, exist_ok=True)
            for path in (sdist, wheel):
                shutil.copy2(path, arguments.wheels)
                print(arguments.wheels / path.name)
        if arguments.full:  # a process for each file, as in the build tree: some ask how much memory is in use
            files = sorted((source / "tests" / "python").glob("test_*.py"))
            failed = [file.name for file in files
                      if subprocess.run([python, "-m", "pytest", "-q", "-p", "no:cacheprovider", file], cwd=folder, env={**clean, "MPLBACKEND": "Agg"}).returncode]
            sys.exit(f"{', '.join(failed)} failed" if failed else 0)


if __name__ == "__main__":
    main()
