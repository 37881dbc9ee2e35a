# SPDX-License-Identifier: BSD-3-Clause
"""delone voronoi: its files, and the two forms of the same lists."""
import json
import unittest
import xml.etree.ElementTree

from cli_support import CUBE, Case, STATS, np


class Voronoi(Case):
    def test_npz_and_json_have_the_same_lists(self):
        for kind, d, n in (("uniform", 2, 40), ("grid", 3, 27), ("uniform", 4, 30), ("flat", 3, 20), ("collinear", 2, 5),
                           ("equal", 2, 3)):
            points = self.path("points.npy")
            self.output("generate", kind, "-d", d, "-n", n, "-o", points)
            self.output("voronoi", points, "-o", self.path("out.npz"))
            self.output("voronoi", points, "-o", self.path("out.json"))
            with open(self.path("out.json")) as f:
                data = json.load(f)
            with np.load(self.path("out.npz")) as arrays:
                for name in ("vertices", "ridge_points", "point_region", "ray_vertices", "ray_directions", "points"):
                    np.testing.assert_array_equal(np.array(data[name]).ravel(), arrays[name].ravel(), name)
                for json_name, name in (("ridge_vertices", "ridge"), ("regions", "region")):
                    offsets = arrays[name + "_offsets"]
                    self.assertEqual(data[json_name], [arrays[name + "_vertices"][a:b].tolist()
                                                       for a, b in zip(offsets, offsets[1:])])
                sites = arrays["points"]
                for vertices, (a, b) in zip(data["ridge_vertices"], data["ridge_points"]):
                    for v in vertices:
                        if v >= 0:
                            self.assertAlmostEqual(np.linalg.norm(arrays["vertices"][v] - sites[a]),
                                                   np.linalg.norm(arrays["vertices"][v] - sites[b]))

    def test_pictures_volumes_and_stats(self):
        points = self.path("points.npy")
        np.save(points, CUBE)
        self.output("voronoi", points, "-o", self.path("out.vtu"), "--box", "-1,-1,-1,2,2,2")
        with open(self.path("out.vtu"), "rb") as f:
            head = f.read().split(b"<AppendedData")[0] + b"</VTKFile>"
        piece = xml.etree.ElementTree.fromstring(head).find(".//Piece")
        self.assertEqual((piece.get("NumberOfPoints"), piece.get("NumberOfCells")), ("64", "8"))
        self.assertIn("8 of them unbounded", self.output("voronoi", points))
        rows = self.output("voronoi", points, "--volumes", "-", "--box", "-1,-1,-1,2,2,2").split()
        self.assertEqual((rows[0], len(rows)), ("point,volume", 9))
        for row in rows[1:]:
            self.assertAlmostEqual(float(row.split(",")[1]), 27 / 8)
        stats = json.loads(self.output("voronoi", points, "--stats"))
        self.assertEqual((stats["command"], stats["voronoi_vertices"], stats["regions"], stats["unbounded_regions"],
                          stats["ridges"], stats["rays"]), ("voronoi", 1, 8, 8, 12, 6))
        self.assertEqual(set(STATS) - set(stats), set())
        np.save(points, CUBE[:, :2])
        self.output("voronoi", points, "-o", self.path("out.svg"))
        self.assertTrue(xml.etree.ElementTree.parse(self.path("out.svg")).getroot().tag.endswith("svg"))

    def test_tolerance(self):
        points = self.path("points.npy")
        grid = np.stack(np.meshgrid(np.arange(8.0), np.arange(8.0), indexing="ij"), -1).reshape(-1, 2)
        np.save(points, grid @ np.array([[np.cos(0.55), np.sin(0.55)], [-np.sin(0.55), np.cos(0.55)]]))
        exact = json.loads(self.output("voronoi", points, "--stats"))
        self.assertNotIn("tolerance", exact)
        for name in ("out.npz", "out.json"):
            stats = json.loads(self.output("voronoi", points, "--tolerance", "1e-12", "--stats", "-o", self.path(name)))
            self.assertEqual(stats["tolerance"], 1e-12)
            self.assertTrue(0 < stats["max_displacement"] <= 1e-12)
            self.assertLess(stats["ridges"], exact["ridges"])
            self.output("check", self.path(name))
        with np.load(self.path("out.npz")) as arrays:
            self.assertEqual(arrays["tolerance"].tolist(), [1e-12])
            without = {key: arrays[key] for key in arrays.files if key != "tolerance"}
        np.savez(self.path("without.npz"), **without)
        self.run_delone("check", self.path("without.npz"), status=1)
        np.savez(self.path("negative.npz"), **without, tolerance=np.array([-1.0]))
        self.assertIn("tolerance", self.run_delone("check", self.path("negative.npz"), status=1).stdout.decode())
        self.assertIn("none moved further than", self.output("voronoi", points, "--tolerance", "1e-12"))
        for wrong in ("-1", "nan", "inf"):
            self.complaint("voronoi", points, f"--tolerance={wrong}", status=64)
        self.assertIn("larger than the set", self.complaint("voronoi", points, "--tolerance", "100"))

    def test_refusals(self):
        points = self.uniform(3, 20)
        self.complaint("voronoi", points, "--box", "0,0,1,1", status=64)
        self.complaint("voronoi", points, "--box", "0,0,0,1,1,0", status=64)
        self.complaint("voronoi", points, "--stats", "-o", "-", "--output-format", "json", status=64)
        text = self.complaint("voronoi", points, "-o", self.path("out.svg"))
        self.assertIn(self.path("out.svg"), text)
        self.assertNotIn("/dev/null", text)
        self.complaint("voronoi", points, "-o", self.path("no/such.npz"))


if __name__ == "__main__":
    unittest.main()
