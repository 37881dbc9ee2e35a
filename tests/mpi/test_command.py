#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""delone-mpi by mpirun: the hash of `delone`, errors that are printed once, and a rank that is killed.

DELONE, DELONE_MPI and MPIRUN in the environment are the commands."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    import numpy as np
except ImportError:
    sys.exit(77)

DELONE, DELONE_MPI, MPIRUN = os.environ["DELONE"], os.environ["DELONE_MPI"], os.environ["MPIRUN"]
LARGE = os.environ.get("DELONE_TEST_SCALE") == "large"


def mpirun(ranks, *arguments):
    return [MPIRUN, "-n", str(ranks), DELONE_MPI, *map(str, arguments)]


def run(ranks, *arguments):
    return subprocess.run(mpirun(ranks, *arguments), capture_output=True, text=True, timeout=300)


def ranks_of(job):
    """The processes of the ranks: the children of mpirun that are delone-mpi."""
    pids = []
    for status in pathlib.Path("/proc").glob("[0-9]*/status"):
        try:
            lines = dict(line.split(":\t", 1) for line in status.read_text().splitlines() if ":\t" in line)
        except OSError:
            continue
        if lines.get("PPid", "").strip() == str(job.pid) and lines["Name"].startswith("delone-mpi"):
            pids.append(int(status.parent.name))
    return sorted(pids)


class Command(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="delone-mpi-")
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def save(self, name, rows):
        path = self.path / name
        if path.suffix == ".npy":
            np.save(path, rows)
        else:
            np.savetxt(path, rows, fmt="%.17g", delimiter="," if path.suffix == ".csv" else " ")
        return path

    def hash_of(self, path, command="delaunay"):
        report = subprocess.run([DELONE, command, path, "--stats"], capture_output=True, text=True, check=True)
        return json.loads(report.stdout)["hash"]

    def test_hash_is_that_of_delone(self):
        rows = np.random.default_rng(1).random((20000 if LARGE else 3000, 3))
        whole = self.save("whole.npy", rows)
        expected = self.hash_of(whole)
        for i, part in enumerate(np.array_split(rows, 4)):
            self.save(f"part-{i}.csv", part)
        for number, (ranks, files) in enumerate([(1, [whole]), (3, [whole]), (2, [self.path / "part-%d.csv"]),
                                                 (3, [self.path / f"part-{i}.csv" for i in range(4)])]):
            result = run(ranks, "delaunay", *files, "-o", self.path / f"out{number}", "--stats")
            self.assertEqual(result.returncode, 0, result.stderr)
            report = json.loads(result.stdout)
            self.assertEqual(report["hash"], expected)
            self.assertEqual(len(report["ranks"]), ranks)
            self.assertEqual(sum(rank["points"] for rank in report["ranks"]), len(rows))
            self.assertEqual(sum(rank["bytes_sent"] for rank in report["ranks"]),
                             sum(rank["bytes_received"] for rank in report["ranks"]))
            self.assertEqual(json.loads((self.path / f"out{number}" / "index.json").read_text())["hash"], expected)

    def test_periodic_sets(self):
        whole = self.save("whole.npy", np.random.default_rng(1).random((900, 3)))
        vectors = self.save("vectors.csv", np.array([[1, 0, 0], [0.25, 1, 0], [0, 0.5, 1]]))
        for number, lattice in enumerate((["1,1,1"], [vectors], [vectors, "--periodic", "xz"], ["1,1,1", "--periodic", "y", "--unit", "0.001"])):
            out = self.path / f"out{number}"
            result = run(3, "delaunay", whole, "--lattice", *lattice, "-o", out, "--stats")
            self.assertEqual(result.returncode, 0, result.stderr)
            made = json.loads(result.stdout)
            report = subprocess.run([DELONE, "delaunay", whole, "--lattice", *map(str, lattice), "--stats"], capture_output=True, text=True, check=True)
            self.assertEqual(made["hash"], json.loads(report.stdout)["hash"])
            self.assertEqual(made["lattice_vectors"], json.loads(report.stdout)["periodic_directions"])
            subprocess.run([DELONE, "check", "--canonical", out], stdout=subprocess.DEVNULL, check=True)
        for other, text in ((["1,1,2"], "of another lattice"), (["1,1,1", "--periodic", "xy"], "with 3 lattice vectors, not 2"),
                            (["1,1,1", "--unit", "0.1"], "another unit"), (["1,1"], "the lattice has 2 dimensions, not 3"),
                            (["none.csv"], "neither lengths nor a file")):
            self.expect_one_message(run(2, "delaunay", whole, "--lattice", *other, "-o", self.path / "out0"), 2, text)
        for other, text in ((["1"], "a length per axis"), (["1,1,1", "--periodic", "w"], "--periodic w"), (["1,1,1", "--vtu"], "--vtu"),
                            (["1,1,1", "--unit", "0"], "--unit")):
            self.expect_one_message(run(2, "delaunay", whole, "--lattice", *other, "-o", self.path / "no"), 64, text)

    def expect_one_message(self, result, status, text):
        self.assertEqual(result.returncode, status, result.stderr)
        self.assertEqual(result.stdout, "")
        lines = [line for line in result.stderr.splitlines() if line.startswith("delone-mpi: ")]
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertIn(text, lines[0])

    def test_errors_are_printed_once(self):
        out = self.path / "out"
        self.expect_one_message(run(2, "delaunay", self.path / "missing.npy", "-o", out), 2, "missing.npy")
        rows = np.random.default_rng(1).random((900, 2))
        rows[700, 1] = np.nan
        bad = self.save("bad.npy", rows)
        self.expect_one_message(run(3, "delaunay", bad, "-o", out), 2, "rank 2: ")
        self.expect_one_message(run(3, "delaunay", self.save("bad.csv", rows), "-o", out), 2, "bad.csv:701: ")
        self.expect_one_message(run(2, "delaunay", bad), 64, "--output")
        self.expect_one_message(run(2, "delaunay", bad, "-o", out, "--memory", "much"), 64, "--memory")
        good = self.save("good.npy", rows[:500])
        (self.path / "full").mkdir()
        (self.path / "full" / "letter.txt").write_text("mine")
        self.expect_one_message(run(2, "delaunay", good, "-o", self.path / "full"), 2, "letter.txt")
        other = self.save("other.npy", rows[:499])
        self.assertEqual(run(2, "delaunay", good, "-o", out).returncode, 0)
        self.expect_one_message(run(2, "delaunay", other, "-o", out), 2, "500 points, not 499")
        self.assertEqual(run(2, "delaunay", other, "-o", out, "--no-resume").returncode, 0)

    def test_a_killed_rank_ends_the_job_and_the_next_one_goes_on(self):
        whole = self.save("whole.npy", np.random.default_rng(2).random((400000 if LARGE else 60000, 3)))
        out = self.path / "out"
        job = subprocess.Popen(mpirun(3, "delaunay", whole, "-o", out, "--tiles", 12), stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 120
        while len(list(out.glob("work/tile-*.json"))) < 3 and job.poll() is None and time.monotonic() < deadline:
            time.sleep(0.001)
        ranks = ranks_of(job)
        self.assertEqual(len(ranks), 3)
        os.kill(ranks[1], signal.SIGKILL)
        _, message = job.communicate(timeout=60)
        self.assertNotEqual(job.returncode, 0)
        self.assertIn("signal 9", message)
        self.assertFalse((out / "index.json").exists())
        finished = {out / record.name.replace("tile", "part").replace("json", "npz")
                    for record in out.glob("work/tile-*.json")}
        self.assertGreaterEqual(len(finished), 3)
        times = {part: part.stat().st_mtime_ns for part in finished}

        result = run(2, "delaunay", whole, "-o", out, "--stats")
        self.assertEqual(result.returncode, 0, result.stderr)
        report = json.loads(result.stdout)
        self.assertEqual(report["hash"], self.hash_of(whole))
        self.assertEqual(report["tiles"], 12)
        self.assertEqual(sum(rank["tiles"] for rank in report["ranks"]), 12 - len(finished))
        self.assertEqual({part: part.stat().st_mtime_ns for part in finished}, times)
        self.assertFalse((out / "work").exists())


if __name__ == "__main__":
    unittest.main()
