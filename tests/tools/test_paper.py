# SPDX-License-Identifier: BSD-3-Clause
"""The tools of benchmarks/paper on tiny input and made-up records, without any peer.

  DELONE=build/release/delone python3 tests/tools/test_paper.py [unittest arguments]
"""
import contextlib
import dataclasses
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

try:
    import matplotlib  # noqa: F401  (render.py needs it)
    import numpy as np
    import PIL  # noqa: F401  (plots.py needs it; Matplotlib brings it)
except ImportError as missing:
    print(f"skipped: {missing}", file=sys.stderr)
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "benchmarks"), str(ROOT / "benchmarks" / "rivals")]
from paper import __main__ as command  # noqa: E402
from paper import estimates, fit, inputs, plan, plots, programs, render, report_2008, results, runner, scoreboard, tables  # noqa: E402

DELONE = os.path.abspath(os.environ["DELONE"])

# A stand-in for a peer: it takes the interface, and behaves as its last argument says.
STAND_IN = """
import json, sys, time
points, behaviour = sys.argv[1], sys.argv[-3] if "--repeat" in sys.argv else sys.argv[-1]
if behaviour == "sleep": time.sleep(60)
while behaviour == "spin": pass
if behaviour == "grow":
    kept = bytearray(400_000_000)
    for i in range(0, len(kept), 4096): kept[i] = 1
    time.sleep(60)
if behaviour == "fail":
    print("stand-in: QH6154 initial simplex is flat", file=sys.stderr)
    sys.exit(2)
print(json.dumps({"program": "stand-in", "version": "1", "flags": "", "points": 1, "dimension": 2, "seconds": [0.5, 0.1, 0.3],
                  "cpu_seconds": [0.2, 0.2, 0.2], "cells": 7, "peak_bytes": 1000000, "input_bytes": 1000}))
"""


LIMITS = runner.Limits(8.0, 60.0, 2.0, 1.4e10, 3, 4.0)


def record(experiment, program, dimension, points, kind="uniform", seconds=1e-5, **more):
    """A made-up record whose time grows linearly."""
    time = seconds * points
    cells = 6 * points
    return {"experiment": experiment, "kind": kind, "dimension": dimension, "points": points, "program": program, "name": program.upper(),
            "outcome": "ok", "seconds": [1.1 * time] * 3, "cpu_seconds": [time, 0.9 * time, 2 * time], "cells": cells, "peak_bytes": 100 * cells,
            "input_bytes": 10 * points, "version": "1.0", "flags": "-O3", "created_cells": 3 * cells, "visited_cells": 2 * points,
            "insertions": points, **more}


def document():
    """Records of every experiment, some of them without a result."""
    sizes = (1000, 2000, 4000)
    records = [record("uniform", key, d, n, seconds=s) for d in (2, 3, 4) for n in sizes
               for key, s in (("delone", 1e-5), ("cgal_d", 3e-5), ("qhull", 0.5e-5), ("scipy", 4e-5))]
    records += [record("uniform", f"cgal_{d}", d, n) for d in (2, 3) for n in sizes]
    records += [record("order", key, 3, n, visited_cells=v * n) for n in sizes
                for key, v in (("delone", 2), ("delone:report", 3), ("delone:curve", 4), ("delone:shuffled", 40))]
    records += [record("manifold", key, 3, n, "manifold") for n in sizes for key in ("delone", "qhull")]
    records += [record("small", "delone", 2, 100), record("hulls", "hull_delone", 3, 100, "sphere"),
                {"experiment": "small", "kind": "uniform", "dimension": 2, "points": 100, "program": "lrs", "name": "lrs", "outcome": "too slow",
                 "message": "more than 8 s"}]
    records += [record("degenerate", "delone", 2, 100, "grid", verdict={"accepted": True, "level": "", "violation": ""}),
                record("degenerate", "qhull", 2, 100, "grid", verdict={"accepted": False, "level": "volume", "violation": "cell 3 | is `flat`"}),
                {"experiment": "degenerate", "kind": "flat", "dimension": 4, "points": 9, "program": "qhull", "name": "QHULL", "outcome": "failed",
                 "message": "QH6154 initial simplex is flat"}]
    records += [record("tiny", "delone", 4, 16, "flat", verdict={"accepted": True, "level": "", "violation": ""}),
                record("tiny", "lrs", 4, 16, "flat", verdict={"accepted": None, "level": "not simplices", "violation": "a cell is no simplex"})]
    about = {"date": "2008-11-30", "commit": "abc", "quick": True, "machine": "a machine", "cores": 2, "memory_bytes": 2**34, "system": "Debian",
             "compiler": "c++ 12", "limits": dataclasses.asdict(LIMITS), "minutes": None, "load": [0.1, 0.2], "elapsed_seconds": 300, "sittings": 1,
             "missing": [], "left_out": []}
    return {"about": about, "records": records}


class Fits(unittest.TestCase):
    def test_a_power_law_is_found(self):
        sizes = [1000, 2000, 4000, 64000]
        k, alpha = fit.power_law(sizes, [99e-4 * n ** 1.236 for n in sizes])
        self.assertAlmostEqual(k, 99e-4, places=9)
        self.assertAlmostEqual(alpha, 1.236, places=9)

    def test_one_size_has_no_fit(self):
        self.assertIsNone(fit.power_law([1000, 1000], [1, 2]))

    def test_ratios_are_taken_turn_by_turn(self):
        self.assertEqual(fit.median_ratio([2, 20, 3], [1, 10, 1]), 2)  # the ratio of the medians would be 3
        self.assertIsNone(fit.median_ratio([], []))

    def test_extrapolation_is_between_linear_and_cubic(self):
        self.assertIsNone(fit.extrapolate([], 10))
        self.assertAlmostEqual(fit.extrapolate([(10, 3.0)], 100), 30)
        self.assertAlmostEqual(fit.extrapolate([(10, 1.0), (100, 1.0)], 1000), 10)
        self.assertAlmostEqual(fit.extrapolate([(10, 1.0), (100, 100.0)], 1000), 1e4)
        self.assertAlmostEqual(fit.extrapolate([(10, 1.0), (20, 1e6)], 40), 8e6)

    def test_constants_of_the_report(self):
        for d, value in ((2, 6), (3, 27.07), (4, 158.89)):
            self.assertAlmostEqual(report_2008.cells_at_a_vertex(d), value, places=2)
        self.assertAlmostEqual(report_2008.seconds(2, 1_000_000), 7.8 * 1e6 ** 0.0011, places=9)


class Running(unittest.TestCase):
    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = pathlib.Path(made.name)
        self.script = self.folder / "stand_in.py"
        self.script.write_text(STAND_IN)

    def program(self, key, behaviour):
        return programs.Program(key, key, str(self.script), (behaviour,))

    def runner(self, *behaviours, seconds=10.0, memory=2e8, turn_seconds=60.0):
        limits = runner.Limits(seconds, seconds, seconds, memory, 2, turn_seconds)
        catalogue = {behaviour: self.program(behaviour, behaviour) for behaviour in behaviours}
        return runner.Runner(catalogue, self.folder, DELONE, limits, self.folder, lambda line: None)

    def case(self, *keys, points=20):
        return plan.Case("uniform", "uniform", 2, points, keys)

    def test_programs_take_turns_and_medians_are_kept(self):
        records = self.runner("good", "other").measure(self.case("good", "missing", "other"))
        self.assertEqual([r["program"] for r in records], ["good", "other"])
        for r in records:
            self.assertEqual((r["outcome"], r["seconds"], r["cells"], r["points"]), ("ok", [0.3, 0.3], 7, 20))

    def test_a_failure_keeps_its_message_and_ends_the_series(self):
        run = self.runner("fail")
        (record,) = run.measure(self.case("fail"))
        self.assertEqual((record["outcome"], record["message"]), ("failed", "QH6154 initial simplex is flat"))
        (record,) = run.measure(self.case("fail", points=40))
        self.assertEqual(record["outcome"], "not tried")

    def test_what_is_long_has_no_further_turn(self):
        (record,) = self.runner("good", turn_seconds=0.0).measure(self.case("good"))
        self.assertEqual((len(record["seconds"]), len(record["turn_seconds"])), (1, 1))
        self.assertGreater(record["turn_seconds"][0], 0)

    def test_limits_of_each_program(self):
        keys = ("delone:curve", "hull_delone", "qhull", "hull_qhull", "lrs", "hull_cddlib_gmp")
        self.assertEqual([LIMITS.of(key) for key in keys], [60, 60, 8, 8, 2, 2])

    def test_what_a_case_is_expected_to_take(self):
        run = self.runner("good")
        run.programs["qhull"] = run.programs["good"]
        small, large = self.case("qhull", "missing", points=10_000), self.case("qhull", points=4_000_000)
        self.assertAlmostEqual(run.expected_seconds(small), 2 * (0.03 + 1.1 * estimates.construction_seconds("uniform", "qhull", 2, 10_000)))
        run.history[("uniform", "uniform", 2, "qhull")] = [(1_000_000, 2.0, 10)]
        self.assertAlmostEqual(run.expected_seconds(large), 2 * (0.03 + 1.1 * 8.0))
        run.history[("uniform", "uniform", 2, "qhull")] = [(1_000_000, 4.0, 10)]
        self.assertEqual(run.expected_seconds(large), 0.0)  # it would not be tried

    def sitting(self, *more):
        """Measures two cases with a stand-in; the document."""
        path = self.folder / "records.json"
        options = command.arguments(["--build", str(self.folder), "--delone", DELONE, "--quick", "--results", str(path), *more])
        planned = [self.case("good", "scipy", points=n) for n in (20, 40)]
        catalogue = {"good": self.program("good", "good"), "scipy": programs.Program("scipy", "SciPy", "not built")}
        with mock.patch.object(plan, "cases", lambda quick: planned), mock.patch.object(programs, "catalogue", lambda hull: catalogue), \
                contextlib.redirect_stdout(io.StringIO()):
            return command.measure(options, path)

    def test_what_does_not_fit_in_the_time_is_listed_and_can_be_measured_later(self):
        document = self.sitting("--minutes", "1e-9")
        self.assertEqual((document["records"], document["about"]["left_out"]), ([], ["uniform uniform 2 20", "uniform uniform 2 40"]))
        document = self.sitting("--minutes", "5", "--resume")
        self.assertEqual([r["points"] for r in document["records"]], [20, 40])
        self.assertEqual({key: document["about"][key] for key in ("left_out", "sittings", "missing")}, {"left_out": [], "sittings": 2, "missing": ["SciPy"]})
        again = self.sitting("--resume")
        self.assertEqual(again["records"], document["records"])

    def test_limits_of_time_and_memory(self):
        for behaviour, seconds in (("spin", 1), ("sleep", 0.02)):
            (record,) = self.runner(behaviour, seconds=seconds).measure(self.case(behaviour))
            self.assertEqual(record["outcome"], "too slow", record)
        (record,) = self.runner("grow").measure(self.case("grow"))
        self.assertEqual(record["outcome"], "too large")

    def test_what_would_take_too_long_is_not_tried(self):
        run = self.runner("good")
        run.history[("uniform", "uniform", 2, "good")] = [(10, 1.0, 10), (20, 4.0, 20)]
        (record,) = run.measure(self.case("good", points=80))
        self.assertEqual((record["outcome"], record["message"]), ("not tried", "would take about 64 s"))

    def test_real_data(self):
        for name, (_, columns) in inputs.REAL.items():
            path = self.folder / "real.npy"
            self.assertEqual(inputs.write(f"real:{name}", len(columns), 0, path, DELONE), len(np.load(path)))
            self.assertEqual(np.load(path).shape[1], len(columns))

    def test_the_interface_in_python(self):
        fake = self.folder / "hull"  # prints the two triangles of a square and two infinite ones
        fake.write_text("#!/bin/sh\ncase \"$*\" in *-fvn*) printf '0 1 2\\n1 2 3\\n-1 0 1\\n3 -1 2\\n';; esac\n")
        fake.chmod(0o755)
        points, cells = self.folder / "square.npy", self.folder / "cells.npy"
        np.save(points, np.array([[0, 0], [1, 0], [0, 1], [1, 1.5]]))
        command = programs.catalogue(str(fake))["clarkson"].command_line(self.folder, points, 2)
        outcome, report = runner.run_limited([*command, "--repeat", "2", "--cells", str(cells)], 60, 1e9)
        self.assertEqual(outcome, "ok", report)
        self.assertEqual((report["cells"], len(report["seconds"]), report["flags"]), (2, 2, "-d -m1e+06"))
        self.assertEqual(np.load(cells).tolist(), [[0, 1, 2], [1, 2, 3]])


class Scoreboard(unittest.TestCase):
    SQUARE = np.array([[0.0, 0], [1, 0], [0, 1], [1, 1]])

    def judge(self, cells):
        with tempfile.TemporaryDirectory() as folder:
            return scoreboard.judge(self.SQUARE, np.array(cells), DELONE, pathlib.Path(folder))

    def test_either_diagonal_of_a_square_is_right(self):
        self.assertTrue(self.judge([[0, 1, 2], [1, 2, 3]])["accepted"])
        self.assertTrue(self.judge([[0, 1, 3], [0, 2, 3]])["accepted"])

    def test_a_hole_and_an_overlap_are_not(self):
        for cells in ([[0, 1, 2]], [[0, 1, 2], [0, 1, 3]], [[0, 1, 2], [1, 2, 9]]):
            verdict = self.judge(cells)
            self.assertFalse(verdict["accepted"])
            self.assertTrue(verdict["level"] and verdict["violation"], verdict)


class WritingUp(unittest.TestCase):
    def test_the_whole_page_is_written_and_the_same_again(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "records.json").write_text(json.dumps(document()), encoding="utf-8")
            done = subprocess.run([sys.executable, "-B", "-m", "paper", "--render", str(folder / "records.json"), "--output", str(folder)],
                                  env={**os.environ, "PYTHONPATH": str(ROOT / "benchmarks")}, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            page = (folder / "experiments.md").read_text(encoding="utf-8")
            pictures = {p.name: p.read_bytes() for p in folder.rglob("*.png")}
            found = results.Results(document())
            with plots.plt.rc_context(plots.STYLE):
                plots.figure_2(found, folder)
            self.assertEqual((folder / "figure-2.png").read_bytes(), pictures["figure-2.png"])
            template = render.TEMPLATE.read_text(encoding="utf-8").replace("](../", f"]({os.path.relpath(ROOT, folder)}/")
            self.assertEqual(page, render.fill(template, render.pieces(found)))
            for link in re.findall(r"\]\(([^)#]+)[^)]*\)", page):
                self.assertTrue("://" in link or (folder / link).exists(), link)
        for picture in pictures:
            self.assertIn(f"pictures/experiments/{picture})", page)
        self.assertEqual(page.count(".png)"), len(pictures))
        self.assertNotIn("{{", page)
        prose = [line for line in page.split("\n") if not line.startswith(("|", "#", "!", "<!--"))]
        self.assertLessEqual(max(map(len, prose)), render.WIDTH)
        self.assertIn("QH6154 initial simplex is flat", page)
        self.assertIn("**volume**", page)
        self.assertIn("too slow", page)

    def test_only_the_option_docs_writes_the_documentation(self):
        for words, folder in (([], ROOT / "build" / "paper"), (["--quick"], ROOT / "build" / "paper"), (["--output", "here"], pathlib.Path("here")),
                              (["--docs"], ROOT / "docs"), (["--docs", "--output", "here"], ROOT / "docs")):
            with mock.patch.object(render, "write") as write, contextlib.redirect_stdout(io.StringIO()):
                command.write_up({}, command.arguments(words))
            write.assert_called_once_with({}, folder)

    def test_what_is_said_of_the_run(self):
        made = document()
        about = made["about"]
        self.assertIn("quick run", render.kind_of_run(about))
        about.update(quick=False, sittings=2, minutes=58, missing=["lrs"],
                     left_out=["degenerate real:cars 5 0", "hulls sphere 8 500", "uniform uniform 6 64000", "uniform uniform 6 128000"])
        words = render.kind_of_run(about)
        for part in ("full run", "2 sittings", "not measured: lrs.", "58 minutes", "section 5.1, 6D, n = 64 000 and more; "
                     "convex hulls, sphere, 8D, n = 500; degenerate input, cars, 5D."):
            self.assertIn(part, words)
        self.assertIn("3 times", render.rounds(results.Results(made)))
        self.assertIn("8 seconds", render.limits(about))

    def test_how_busy_the_machine_was(self):
        for wait, word in ((1.01, "it was quiet"), (1.5, "other work went on")):
            made = document()
            made["records"] = [{**record("uniform", "delone", 2, 1000), "seconds": [wait], "cpu_seconds": [1.0]}]
            self.assertIn(word, render.load(results.Results(made)))

    def test_programs_that_find_other_cells_are_named(self):
        made = document()
        self.assertIn("all ", render.agreement(results.Results(made)))
        next(r for r in made["records"] if (r["program"], r["dimension"], r["points"]) == ("qhull", 4, 2000))["cells"] = 11_999
        self.assertIn("section 5.1, 4D, n = 2 000: DELONE 12 000, QHULL 11 999.", render.agreement(results.Results(made)))

    def test_an_executable_of_hull_has_its_figure(self):
        made = document()
        self.assertIn("no executable was named", render.clarkson(results.Results(made)))
        made["records"] += [record("uniform", "clarkson", d, n, seconds=7e-5) for d in (2, 3) for n in (1000, 2000)]
        with tempfile.TemporaryDirectory() as folder:
            page = render.write(made, folder).read_text(encoding="utf-8")
            self.assertTrue((pathlib.Path(folder) / "pictures" / "experiments" / "figure-6.png").exists())
        self.assertIn("| 7.00 × to 7.00 × |", page)
        self.assertIn("pictures/experiments/figure-6.png", page)

    def test_failures_follow_the_table(self):
        made = document()
        self.assertNotIn("failed", tables.with_failures(results.Results(made), "small"))
        made["records"].append({"experiment": "small", "kind": "uniform", "dimension": 3, "points": 1000, "program": "cddlib", "name": "cddlib",
                                "outcome": "failed", "message": "error 16"})
        self.assertEqual(tables.with_failures(results.Results(made), "small").splitlines()[-2:], ["", "- uniform 3D, n = 1 000: cddlib failed: `error 16`"])

    def test_of_a_program_that_stopped_one_line_says_so(self):
        records = [{**record("uniform", "qhull", d, n), "outcome": "ok" if n < 2000 else "not tried"} for d in (2, 3) for n in (1000, 2000, 4000)]
        self.assertEqual([(r["dimension"], r["points"]) for r in tables.stopping(records)], [(2, 1000), (2, 2000), (3, 1000), (3, 2000)])

    def test_ratios_of_one_turn(self):
        found = results.Results(document())
        ours, theirs = (found.at("uniform", "uniform", 2, 1000, key) for key in ("delone", "cgal_d"))
        self.assertAlmostEqual(results.cpu_ratio(theirs, ours), 3)
        self.assertIsNone(results.cpu_ratio(None, ours))
        self.assertEqual(found.dimensions("uniform"), [2, 3, 4])

    def test_a_template_and_its_pieces_must_agree(self):
        with self.assertRaises(KeyError):
            render.fill("{{unknown}}", {})
        with self.assertRaises(KeyError):
            render.fill("nothing", {"unused": 1})

    def test_numbers(self):
        self.assertEqual([tables.number(x) for x in (0, 0.012345, 0.5, 12.34, 1234.5, 7.8e-6, None)],
                         ["0", "0.0123", "0.50", "12.3", "1234", "7.80·10⁻⁶", "–"])
        self.assertEqual(tables.count(1024000), "1 024 000")
        self.assertEqual(tables.table(["a"], [["x|y"]]).splitlines()[-1], "| x\\|y |")

    def test_plans(self):
        for quick in (True, False):
            planned = plan.cases(quick)
            self.assertEqual(len(planned), len(set(planned)))
            known = set(programs.catalogue("hull"))
            self.assertLessEqual({key for case in planned for key in case.programs}, known)
            last = {}
            for case in planned:  # sizes of a series grow
                self.assertGreaterEqual(case.points, last.get(case.series(), 0), case)
                last[case.series()] = case.points
            ordered = plan.by_importance(planned, LIMITS)
            self.assertCountEqual(ordered, planned)
            last = {}
            for case in ordered:  # there, too
                self.assertGreaterEqual(case.points, last.get(case.series(), 0), case)
                last[case.series()] = case.points


if __name__ == "__main__":
    unittest.main()
