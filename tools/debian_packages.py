#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the Debian packages of the committed tree, and tries them in a clean system.

Usage: debian_packages.py [--keep] [--build-only] [OUTPUT]

In OUTPUT, build/packages if not given: the tree with packaging/debian as its folder debian, built by dpkg-buildpackage,
through ccache where that is installed; the packages, which lintian has to find clean; and a Debian of this machine's release,
made by tools/clean_system.py, in which they are installed with what they depend on and the tests of packaging/debian/tests run. That system is
deleted afterwards, if --keep is not given. Needs root, a Debian, and a mirror in /etc/apt.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import clean_system
from clean_system import run

ROOT = pathlib.Path(__file__).resolve().parent.parent


def said(*command):
    return subprocess.run([str(word) for word in command], check=True, text=True, stdout=subprocess.PIPE).stdout.strip()


def copy_tree(folder):
    """The committed files, with packaging/debian where Debian's tools look for it. What is equal keeps its time, and its objects."""
    version = re.search(r"^project\(delone VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)[1]
    tree, fresh = folder / f"delone-{version}", folder / "fresh"
    shutil.rmtree(fresh, ignore_errors=True)
    fresh.mkdir(parents=True)
    archive = subprocess.run(["git", "archive", "HEAD"], cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
    subprocess.run(["tar", "-x", "-C", str(fresh)], input=archive, check=True)
    shutil.move(fresh / "packaging" / "debian", fresh / "debian")
    shutil.rmtree(tree, ignore_errors=True)
    fresh.rename(tree)
    return tree


def build(tree):
    environment = {**os.environ, "DEB_BUILD_OPTIONS": f"parallel={os.cpu_count()} noautodbgsym"}
    if shutil.which("ccache"):  # debhelper hides the home folder, in which ccache would look
        environment |= {"CCACHE_DIR": said("ccache", "--get-config", "cache_dir"), "CCACHE_BASEDIR": str(tree), "CCACHE_NOHASHDIR": "1"}
    with open(tree.parent / "build.log", "w", encoding="utf-8") as log:
        done = subprocess.run(["dpkg-buildpackage", "-us", "-uc", "-b"], cwd=tree, env=environment, stdout=log, stderr=subprocess.STDOUT)
    if done.returncode:
        sys.exit("".join(open(log.name, encoding="utf-8").readlines()[-60:]) + f"debian_packages.py: dpkg-buildpackage failed: {log.name}")
    return sorted(tree.parent.glob("*.deb"))


def tests_in(tree):
    """[(name, packages)]: the tests of debian/tests/control."""
    text = (tree / "debian" / "tests" / "control").read_text(encoding="utf-8")
    return re.findall(r"^Tests: (\S+)\nDepends: (.+)$", text, re.M)


def try_in_clean_system(tree, packages, keep):
    root = tree.parent / "root"
    clean_system.make(root)
    (root / "packages").mkdir()
    for package in packages:
        shutil.copy2(package, root / "packages")
    shutil.copytree(tree / "debian" / "tests", root / "packages" / "tests")
    with open(root / "packages" / "Packages", "w", encoding="utf-8") as index:
        subprocess.run(["dpkg-scanpackages", "--multiversion", "."], cwd=root / "packages", check=True, stdout=index, stderr=subprocess.DEVNULL)
    (root / "etc/apt/sources.list.d/packages.list").write_text("deb [trusted=yes] file:/packages ./\n", encoding="utf-8")
    for rule in root.glob("etc/dpkg/dpkg.cfg.d/*"):  # manuals are looked for
        rule.unlink()
    inside = clean_system.inside(root)
    install = [*inside, "apt-get", "-qq", "install", "--yes", "--no-install-recommends"]
    names = [package.name.partition("_")[0] for package in packages]
    with open(tree.parent / "install.log", "w", encoding="utf-8") as log:
        run(*inside, "apt-get", "-qq", "update", stdout=log, stderr=subprocess.STDOUT)
        for name, wanted in tests_in(tree):  # each after what it depends on has been installed, and no more
            run(*install, *(word.strip() for word in wanted.split(",")), stdout=log, stderr=subprocess.STDOUT)
            run(*inside, f"/packages/tests/{name}")
        run(*install, *names, stdout=log, stderr=subprocess.STDOUT)
        run(*inside, "apt-get", "-qq", "purge", "--yes", *names, stdout=log, stderr=subprocess.STDOUT)
    if not keep:
        shutil.rmtree(root)


def main():
    parser = argparse.ArgumentParser(description="Builds the Debian packages of the committed tree, and tries them in a clean system.")
    parser.add_argument("output", nargs="?", type=pathlib.Path, default=ROOT / "build" / "packages")
    parser.add_argument("--keep", action="store_true", help="keep the clean system")
    parser.add_argument("--build-only", action="store_true", help="neither install nor try them")
    arguments = parser.parse_args()
    output = arguments.output.resolve()
    times, start = [], time.monotonic()

    def done(what):
        nonlocal start
        times.append(f"{what} {(time.monotonic() - start) / 60:.1f} min")
        start = time.monotonic()

    for old in [*output.glob("*.deb"), *output.glob("*.changes"), *output.glob("*.buildinfo")]:
        old.unlink()
    tree = copy_tree(output)
    packages = build(tree)
    done("build")
    run("lintian", "--fail-on", "error,warning", "--allow-root", *output.glob("*.changes"))
    done("lintian")
    if not arguments.build_only:
        try_in_clean_system(tree, packages, arguments.keep)
        done("clean system")
    for package in packages:
        print(f"{package.stat().st_size / 1e6:8.2f} MB  {package.name}")
    print(", ".join(times))


if __name__ == "__main__":
    main()
