# SPDX-License-Identifier: BSD-3-Clause
"""delone delaunay and delone regular with a folder as output, and --memory."""
import csv
import json
import os
import resource
import shutil
import signal
import subprocess
import time
import unittest

import numpy as np

from cli_support import Case, DELONE

STATS = {"command", "dimension", "affine_dimension", "points", "vertices", "duplicates", "hidden", "cells", "hull_facets", "hash", "parts",
         "foreign", "rounds", "seconds", "peak_rss_bytes", "threads", "version"}


def random():
    return np.random.default_rng(7)


def cells_of(folder):
    """The cells of all parts as sets of rows of the input, sorted."""
    cells = []
    with open(os.path.join(folder, "index.json")) as file:
        parts = json.load(file)["parts"]
    for part in parts:
        arrays = np.load(os.path.join(folder, part["file"]))
        cells.append(np.sort(arrays["rows"][arrays["cells"]], axis=1))
    cells = np.concatenate(cells)
    return cells[np.lexsort(cells.T)]


class TilesCase(Case):
    def tiles(self, *arguments, command="delaunay", out="out", **options):
        """The members of --stats of a folder that is made."""
        return json.loads(self.output(command, *arguments, "-o", self.path(out) + "/", "--quiet", "--stats", **options))


class Tiles(TilesCase):
    def require_same(self, points, *, tiles, weights=()):
        command = "regular" if weights else "delaunay"
        whole = json.loads(self.output(command, points, *weights, "-o", self.path("whole.npz"), "--stats"))
        for number in tiles:
            out = f"out{number}"
            made = self.tiles(points, *weights, "--tiles", number, command=command, out=out)
            self.assertEqual(made["parts"], number)
            for name in ("command", "dimension", "affine_dimension", "points", "vertices", "duplicates", "hidden", "cells", "hash"):
                self.assertEqual(made[name], whole[name], name)
            self.assertEqual(made["hull_facets"], whole["infinite_cells"])
            cells = np.sort(np.load(self.path("whole.npz"))["cells"].astype(np.int64), axis=1)
            np.testing.assert_array_equal(cells_of(self.path(out)), cells[np.lexsort(cells.T)])
            self.assertIn("exactly\n", self.output("check", self.path(out)))
        return whole

    def test_same_as_in_memory(self):
        self.require_same(self.uniform(3, 2000), tiles=(1, 2, 7))

    def test_duplicates(self):
        points = random().integers(0, 20, (2000, 2)).astype(float)
        self.assertGreater(self.require_same(self.file("grid.npy", points), tiles=(5,))["duplicates"], 1000)

    def test_flat(self):
        plane = random().random((800, 2)) @ np.array([[1.0, 2.0, 4.0], [0.0, 1.0, 0.5]])
        plane = np.round(plane * 2**20) / 2**20
        flat = np.c_[plane[:, 0], plane[:, 0] * 2, plane[:, 1]]
        self.assertEqual(self.require_same(self.file("flat.npy", flat), tiles=(4,))["affine_dimension"], 2)

    def test_weights(self):
        points = np.c_[random().random((1500, 3)), random().random(1500) * 0.02]
        self.assertGreater(self.require_same(self.file("weighted.npy", points), tiles=(1, 4), weights=("--weights", 3))["hidden"], 100)

    def test_nothing_and_little(self):
        for number, points in enumerate([np.zeros((0, 3)), np.zeros((4, 3)), np.eye(3)[:2]]):
            path = self.file(f"few{number}.npy", points)
            self.assertEqual(self.tiles(path, out=f"few{number}")["hash"], self.stats(path)["hash"])

    def test_stats_and_forecast(self):
        points = self.uniform(2, 3000)
        done = self.run_delone("delaunay", points, "-o", self.path("a/"), "--tiles", 3, "--stats")
        self.assertEqual(set(json.loads(done.stdout)), STATS)
        self.assertRegex(done.stderr.decode(), r"\A3000 points in 3 tiles, each with about \d+ MB of memory and \S+ % of points of other tiles\.\n\Z")
        done = self.run_delone("delaunay", self.uniform(6, 200), "-o", self.path("b/"), "--tiles", 4)
        self.assertEqual(done.stdout, b"")
        self.assertRegex(done.stderr.decode(), r"\nTiles do not pay here: each inserts \S+ times as many points of other tiles as of its own")

    def test_columns(self):
        rows = random().random((500, 4))
        with open(self.path("table.csv"), "w") as file:
            writer = csv.writer(file)
            writer.writerow(["name", "w", "z", "x", "y"])
            writer.writerows([f"point {i}", *map(float, row)] for i, row in enumerate(rows))
        table = self.path("table.csv")
        columns = ("--columns", "x,y,z")
        self.assertEqual(self.tiles(table, *columns, out="a")["hash"], self.stats(table, *columns)["hash"])
        arguments = (table, *columns, "--weights", "w")
        whole = json.loads(self.output("regular", *arguments, "--stats"))
        self.assertEqual(self.tiles(*arguments, "--tiles", 3, command="regular", out="b")["hash"], whole["hash"])
        npy = self.file("table.npy", rows)
        arguments = (npy, "--weights", "0")
        whole_npy = json.loads(self.output("regular", *arguments, "--stats"))
        self.assertEqual(self.tiles(*arguments, "--tiles", 3, command="regular", out="c")["hash"], whole_npy["hash"])
        self.assertEqual(self.tiles(npy, "--columns", "2,3", out="d")["hash"], self.stats(npy, "--columns", "2,3")["hash"])
        self.assertIn("there is no column 'v'", self.complaint("regular", table, "--weights", "v", "-o", self.path("e/")))
        self.assertIn("there is no column '4'; the columns are 0 to 3", self.complaint("delaunay", npy, "--columns", "4", "-o", self.path("e/")))

    def test_raw_and_streams(self):
        rows = random().random((1000, 3))
        whole = self.stats(self.file("p.npy", rows))["hash"]
        raw = self.file("p.dat", rows.tobytes())
        self.assertEqual(self.tiles(raw, "--raw", 3, "--tiles", 2, out="a")["hash"], whole)
        text = "\n".join(" ".join(map(repr, map(float, row))) for row in rows)
        for out in ("b", "b"):  # the second time it is there already
            self.assertEqual(self.tiles("-", "--format", "txt", "--tiles", 2, out=out, stdin=text)["hash"], whole)
        text = self.complaint("delaunay", "-", "--format", "txt", "-o", self.path("b/"), "--tiles", 2, "--quiet", stdin=text.replace("0.5", "0.6"))
        self.assertIn("of other points", text)
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["a", "b", "p.dat", "p.npy"])

    def test_formats_on_request(self):
        self.tiles(self.uniform(3, 500), "--tiles", 2, "--vtu")
        self.assertTrue({"tiles.pvtu", "part-0000.vtu", "part-0001.vtu"} < set(os.listdir(self.path("out"))))
        self.complaint("delaunay", self.uniform(4, 100), "-o", self.path("d4/"), "--vtu", "--quiet")
        self.assertFalse(os.path.exists(self.path("d4")))

    def test_usage(self):
        points = self.uniform(2, 100)
        for option in (["--tiles", 2], ["--vtu"], ["--no-resume"], ["--raw", 2]):
            for output in ([], ["-o", self.path("a.npz")]):
                text = self.complaint("delaunay", points, *output, *option, status=64)
                self.assertIn(f"{option[0]} is for tiles, which go to a folder", text)
        for option in (["--trim", 1], ["--furthest-site"], ["--order", "shuffled"], ["--seed", 1], ["--output-format", "npz"], ["--force"],
                       ["--runtime-dimension"], ["--max-stream", "1G"]):
            self.assertIn("tiles", self.complaint("delaunay", points, "-o", self.path("out/"), *option, status=64))
        self.complaint("delaunay", points, "-o", self.path("out/"), "--raw", 2, "--format", "npy", status=64)
        self.assertIn("column of the points", self.complaint("regular", points, "--weights", points, "-o", self.path("out/"), status=64))
        for size in ("2X", "-1", "1.5", "", "0", "0G"):
            for output in ([], ["-o", self.path("out/")]):
                self.assertIn("--memory: ", self.complaint("delaunay", points, *output, "--memory", size, status=64))
        self.assertFalse(os.path.exists(self.path("out")))
        os.mkdir(self.path("there"))
        self.output("delaunay", points, "-o", self.path("there"), "--quiet")
        self.assertTrue(os.path.exists(self.path("there/index.json")))

    def test_folders_of_others(self):
        points = self.uniform(2, 300)
        self.file("text", "")
        self.assertIn("Not a directory", self.complaint("delaunay", points, "-o", self.path("text") + "/", "--quiet"))
        os.mkdir(self.path("mine"))
        self.file("mine/notes", "")
        self.assertIn("it holds notes", self.complaint("delaunay", points, "-o", self.path("mine"), "--quiet"))
        self.complaint("delaunay", points, "-o", "/proc/self/out/", "--quiet")
        self.assertIn("Not a directory", self.complaint("delaunay", self.file("no.csv", "1,nan"), "-o", self.path("text/a/"), "--quiet"))
        os.mkdir(self.path("read"), 0o500)
        if os.geteuid() != 0:
            self.assertIn("Permission denied", self.complaint("delaunay", points, "-o", self.path("read"), "--quiet"))


class Damage(TilesCase):
    """A finished folder of which files are damaged or missing."""

    def contents(self):
        found = {}
        for name in os.listdir(self.path("out")):
            with open(self.path("out/" + name), "rb") as file:
                found[name] = file.read()
        return found

    def flip(self, name, at):
        with open(self.path("out/" + name), "r+b") as file:
            file.seek(at)
            byte = file.read(1)[0]
            file.seek(at)
            file.write(bytes([byte ^ 16]))

    def swap(self, a, b):
        a, b, other = self.path("out/" + a), self.path("out/" + b), self.path("other")
        os.rename(a, other)
        os.rename(b, a)
        os.rename(other, b)

    def require_repaired(self, arguments, damages, names):
        """The same command makes just these again, and says so."""
        whole = self.contents()
        for damage in damages:
            damage()
            times = {name: os.stat(self.path("out/" + name)).st_mtime_ns for name in whole if name not in names}
            self.assertIn(names[0], self.run_delone("check", self.path("out"), status=1).stdout.decode())
            done = self.run_delone(*arguments)
            said = done.stderr.decode().splitlines()
            self.assertEqual(len(said), len(names))
            for line, name in zip(said, names):
                self.assertRegex(line, rf"\Adelone: \S+out/{name}: [^;]+; made again\Z")
            self.assertEqual(json.loads(done.stdout)["hash"], json.loads(whole["index.json"])["hash"])
            self.assertEqual(self.contents(), whole)
            self.assertEqual({name: os.stat(self.path("out/" + name)).st_mtime_ns for name in times}, times)
            self.assertIn("exactly\n", self.output("check", self.path("out")))
        self.output(*arguments)  # says nothing

    def test_is_made_again(self):
        points = self.uniform(3, 1000)
        weighted = self.file("weighted.npy", np.c_[random().random((600, 3)), random().random(600) * 0.02])
        for command in (["delaunay", points], ["regular", weighted, "--weights", 3]):
            for tiles in (1, 3):
                arguments = [*command, "-o", self.path("out/"), "--tiles", tiles, "--quiet", "--stats"]
                self.output(*arguments)
                for name in (f"part-000{tiles - 1}.npz", f"part-000{tiles - 1}.seams.npy"):
                    path = self.path("out/" + name)
                    size = os.stat(path).st_size
                    self.require_repaired(arguments, [lambda: os.truncate(path, size // 2), lambda: os.truncate(path, 0), lambda: os.remove(path),
                                                      lambda: self.flip(name, 12), lambda: self.flip(name, size - 1)], [name])
                if tiles > 1:
                    for kind in ("npz", "seams.npy"):
                        both = [f"part-0000.{kind}", f"part-0002.{kind}"]
                        self.require_repaired(arguments, [lambda: self.swap(*both)], both)
                shutil.rmtree(self.path("out"))

    def test_of_the_index(self):
        points = self.uniform(2, 500)
        arguments = ["delaunay", points, "-o", self.path("out/"), "--tiles", 2, "--quiet"]
        self.output(*arguments)
        whole = self.contents()
        os.truncate(self.path("out/index.json"), 200)
        text = self.complaint(*arguments)
        self.assertIn("index.json", text)
        self.assertIn("make the tiles again with --no-resume", text)
        self.output(*arguments, "--no-resume")
        self.assertEqual(self.contents(), whole)


class GoingOn(TilesCase):
    """A folder of 24 tiles, of which some are done."""
    number = 24

    def setUp(self):
        super().setUp()
        self.points = self.uniform(3, 24000)
        self.arguments = [self.points, "-o", self.path("out/"), "--tiles", str(self.number), "--threads", "1"]

    def finished(self):
        work = self.path("out/work")
        return sorted(name for name in os.listdir(work) if name.startswith("tile-")) if os.path.isdir(work) else []

    def stop(self, number):
        """Sends a signal once some tiles are done, and returns what is said."""
        process = subprocess.Popen([DELONE, "delaunay", *self.arguments, "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.kill)
        while len(self.finished()) < 3:
            self.assertIsNone(process.poll(), "it was over before the signal")
            time.sleep(0.001)
        process.send_signal(number)
        out, err = process.communicate(timeout=30)
        self.assertEqual(process.returncode, -number if number == signal.SIGKILL else 128 + number)
        self.assertEqual(out, b"")
        self.assertFalse(os.path.exists(self.path("out/index.json")))
        return err.decode()

    def changes(self):
        """The parts that are done, and when they were written."""
        return {name: os.stat(self.path("out/" + name)).st_mtime_ns for name in sorted(os.listdir(self.path("out"))) if name.endswith(".npz")}

    def go_on(self, same, damaged=()):
        done = self.run_delone("delaunay", *self.arguments, "--quiet", "--stats")
        made, said = json.loads(done.stdout), done.stderr.decode().splitlines()
        self.assertEqual(len(said), len(damaged), said)
        for line, name in zip(said, damaged):
            self.assertRegex(line, rf"\Adelone: \S+/{name}: [^;]+; made again\Z")
        self.assertEqual(made["hash"], self.stats(self.points)["hash"])
        after = self.changes()
        self.assertEqual({name: after[name] for name in same}, same)
        self.assertFalse([name for name in os.listdir(self.path("out")) if "partial" in name or name == "work"])

    def done(self):
        return {name: when for name, when in self.changes().items() if name.replace("part", "tile").replace("npz", "json") in self.finished()}

    def test_after_sigkill(self):
        self.stop(signal.SIGKILL)
        done = self.done()
        self.assertGreaterEqual(len(done), 3)
        self.go_on(done)

    def test_after_ctrl_c(self):
        self.assertRegex(self.stop(signal.SIGINT), r"\Adelone: interrupted; the same command continues with .*out/: \d+ of 24 tiles are done\n\Z")
        self.go_on(self.done())

    def test_damaged_parts_are_made_again(self):
        self.stop(signal.SIGTERM)
        done = self.done()
        truncated, changed = sorted(done)[:2]
        os.truncate(self.path("out/" + truncated), 1000)
        with open(self.path("out/" + changed), "r+b") as file:
            file.seek(5000)
            file.write(b"?!")
        del done[truncated], done[changed]
        self.go_on(done, [truncated, changed])
        self.assertIn("exactly\n", self.output("check", self.path("out")))

    def test_another_plan(self):
        self.stop(signal.SIGTERM)
        before = self.done()
        text = self.complaint("delaunay", self.points, "-o", self.path("out/"), "--tiles", 5, "--quiet")
        self.assertIn("unfinished tiles", text)
        stat = os.stat(self.points)
        np.save(self.points, np.load(self.points) + 1)
        self.assertIn("of other points", self.complaint("delaunay", *self.arguments, "--quiet"))
        self.assertEqual(self.done(), before)
        made = json.loads(self.output("delaunay", *self.arguments, "--no-resume", "--quiet", "--stats"))
        self.assertEqual(made["hash"], self.stats(self.points)["hash"])
        self.assertNotEqual(stat.st_mtime_ns, os.stat(self.points).st_mtime_ns)
        self.assertIn("finished tiles", self.complaint("delaunay", self.points, "-o", self.path("out/"), "--tiles", 5, "--quiet"))

    def test_full_disk(self):
        self.arguments[self.arguments.index("--tiles") + 1] = "2"

        def limited():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1200000, 1200000))

        text = self.complaint("delaunay", *self.arguments, "--quiet", preexec_fn=limited)
        self.assertIn("part-0000.npz: File too large", text)
        self.assertFalse([name for name in os.listdir(self.path("out")) if "partial" in name])
        self.go_on({})


class Memory(Case):
    def peak(self, *arguments, status):
        """The peak of the resident memory in bytes, and what is said."""
        process = subprocess.Popen([DELONE, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        text = process.stderr.read().decode()
        _, found, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(found)
        process.stdout.close()
        process.stderr.close()
        self.assertEqual(process.returncode, status, text)
        return usage.ru_maxrss * 1024, text

    def test_ends_at_the_limit(self):
        points = self.uniform(3, 150000)  # needs 140 MB
        weighted = self.file("weighted.npy", np.c_[np.load(points), np.zeros(150000)])
        limit = 100 << 20
        commands = [["delaunay", points], ["delaunay", points, "-o", self.path("out.npz")], ["regular", weighted, "--weights", 3]]
        for command in commands:
            peak, text = self.peak(*command, "--memory", "100M", status=3)
            self.assertLess(peak, limit)
            self.assertRegex(text, r"\Adelone: (\S+: stopped at the limit of 105 MB (with|while) [^\n]+|more memory is needed than "
                             r"--memory allows, 104857600 bytes); with a folder as output[^\n]+\n\Z")
        self.assertFalse(os.path.exists(self.path("out.npz")))
        self.output("delaunay", points, "--memory", "1G")

    def test_tiles_stay_below_the_limit(self):
        points = self.uniform(3, 150000)
        peak, text = self.peak("delaunay", points, "-o", self.path("out/"), "--memory", "100M", status=0)
        self.assertLess(peak, 100 << 20)
        self.assertRegex(text, r"\A150000 points in \d+ tiles")
        self.assertIn(self.stats(points)["hash"], self.output("info", self.path("out")))


if __name__ == "__main__":
    unittest.main()
