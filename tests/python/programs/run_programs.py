#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tests of programs that use scipy.spatial, as they are and with delone in its place, and lists what differs.

Usage: run_programs.py [PROGRAM …]       of scipy itself, skimage, libpysal, ase, pymatgen; by default all; those not installed are left out

They are those of the Python that runs this script (Debian: python3-scipy python3-skimage python3-libpysal python3-ase python3-pymatgen
python3-xarray), and import delone from PYTHONPATH. Debian's pymatgen comes without tests: pymatgen_uses.py beside this file stands for them. Ends with 1 if a
test passes with scipy and not with delone, 77 if no program is installed.
"""
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

HERE = pathlib.Path(__file__).resolve().parent

# The parts of each program that use scipy.spatial, or that use such a part.
TESTS = {
    "scipy": ["spatial/tests/test_qhull.py", "interpolate/tests/test_interpnd.py"],
    "skimage": ["morphology", "measure", "transform", "segmentation", "feature"],
    "libpysal": ["."],
    "ase": ["test/bandstructure", "test/bravais", "test/cell", "test/dft", "test/spectrum", *(f"test/test_{name}.py" for name in (
        "doctests", "dos", "hcp", "kpts", "phasediagram", "pourbaix", "things"))],
    "pymatgen": [str(HERE / "pymatgen_uses.py")],
}

ORDER = "It wants simplices, facets or vertices in the order in which Qhull happens to list them."

# Tests that rely on an answer of Qhull which is not the exact one: the test, and the reason.
KNOWN = {
    **{f"spatial.tests.test_qhull.{name}": ORDER for name in (
        "TestUtilities::test_find_simplex", "TestUtilities::test_convex_hull", "TestDelaunay::test_2d_square", "TestDelaunay::test_furthest_site",
        *(f"TestConvexHull::test_good2d_incremental_changes[new_gen{i}-expected{i}-{option}]" for i in (2, 3) for option in ("QG4", "QG-4")),
        "TestVoronoi::test_simple", "TestVoronoi::test_furthest_site", "Test_HalfspaceIntersection::test_cube",
        *(f"Test_HalfspaceIntersection::test_cube_halfspace_intersection[{kind}]" for kind in ("float64", "int")))},
    "spatial.tests.test_qhull.TestUtilities::test_degenerate_barycentric_transforms":
        "It limits the number of flat simplices. Qhull leaves out points that rounding puts next to a hyperplane; here they make slivers.",
    "spatial.tests.test_qhull.TestDelaunay::test_joggle": "It wants duplicates of points to be vertices, as QJ makes them; here they are merged.",
    "spatial.tests.test_qhull.TestDelaunay::test_vertices_deprecation": "It wants the release of scipy that removes the attribute in the warning.",
    "spatial.tests.test_qhull.TestVoronoi::test_ridges[pathological-2]":
        "It measures distances to the middle of a ridge. An exact vertex is so far away here that they are equal once rounded.",
    "spatial.tests.test_qhull::test_gh_21286": "It wants an IndexError for a number as a query; here that is a ValueError, as for all wrong shapes.",
    "cg.tests.test_voronoi.Voronoi::test_voronoi": "It wants Voronoi vertices with the numbers that Qhull happens to give them.",
    "transform.tests.test_geometric::test_degenerate": "It wants the flat simplex that Qhull makes as its fifth; here none is flat.",
    "test_phasediagram::test_phasediagram": "It wants the two ends of an edge in the order in which Qhull happens to list them.",
}


def outcomes(folder, paths, runner, report):
    """{test: (outcome, first line of the message)}"""
    command = [sys.executable, *runner, "pytest", "-q", "-p", "no:cacheprovider", "-W", "ignore", "--continue-on-collection-errors",
               f"--junitxml={report}", *paths]
    subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env={**os.environ, "MPLBACKEND": "Agg", "PYTHONDONTWRITEBYTECODE": "1"})
    if not report.exists():
        sys.exit(f"{' '.join(map(str, command))}: no report")
    found = {}
    for case in xml.etree.ElementTree.parse(report).iter("testcase"):
        problem = next((part for part in case if part.tag in ("failure", "error", "skipped")), None)
        name = f"{case.get('classname')}::{case.get('name')}"
        message = "" if problem is None else (problem.get("message") or "").strip().splitlines()
        found[name] = ("passed" if problem is None else problem.tag, message[0][:200] if message else "")
    return found


def compare(program, scratch):
    """The number of tests that only delone fails, after a list of all that differ."""
    folder = pathlib.Path(importlib.util.find_spec(program).submodule_search_locations[0])
    paths = [str(path) for path in (folder / name for name in TESTS[program]) if path.exists()]
    theirs = outcomes(scratch, paths, ["-m"], scratch / f"{program}_scipy.xml")
    ours = outcomes(scratch, paths, ["-m", "delone", "-m"], scratch / f"{program}_delone.xml")
    worse = 0
    differing = [name for name in {**theirs, **ours} if theirs.get(name, ("missing", ""))[0] != ours.get(name, ("missing", ""))[0]]
    passed = [sum(outcome == "passed" for outcome, _ in run.values()) for run in (theirs, ours)]
    print(f"{program}: {len(theirs)} tests, {passed[0]} pass with scipy, {passed[1]} with delone, {len(differing)} differ", flush=True)
    for name in sorted(differing):
        (before, _), (after, message) = theirs.get(name, ("missing", "")), ours.get(name, ("missing", ""))
        print(f"  {name}: {before} with scipy, {after} with delone. {KNOWN.get(name, message)}", flush=True)
        worse += before == "passed" and name not in KNOWN
    return worse


def main():
    wanted = sys.argv[1:] or list(TESTS)
    chosen = [program for program in wanted if importlib.util.find_spec(program)]
    if not chosen:
        print("not installed:", *wanted)
        sys.exit(77)
    with tempfile.TemporaryDirectory(prefix="delone_programs_") as scratch:
        worse = sum(compare(program, pathlib.Path(scratch)) for program in chosen)
    sys.exit(1 if worse else 0)


if __name__ == "__main__":
    main()
