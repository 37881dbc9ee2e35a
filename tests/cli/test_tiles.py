# SPDX-License-Identifier: BSD-3-Clause
"""delone info and delone check of folders of tiles."""
import json
import os
import unittest
import zlib

import numpy as np

from cli_support import Case


class Tiles(Case):
    def write_folder(self, num_parts=3):
        """A triangulation whose cells are dealt into parts."""
        points = self.uniform(2, 60)
        self.output("delaunay", points, "-o", self.path("t.npz"))
        whole = np.load(self.path("t.npz"))
        cells, neighbors = whole["cells"].astype(np.int64), whole["neighbors"].astype(np.int64)
        n, m = len(whole["points"]), len(cells)
        bounds = np.linspace(0, m, num_parts + 1).astype(int)
        folder = self.path("out")
        os.makedirs(folder, exist_ok=True)
        parts = []
        for t in range(num_parts):
            first, last = bounds[t], bounds[t + 1]
            rows, local = np.unique(cells[first:last], return_inverse=True)
            near = neighbors[first:last].copy()
            across = (near >= 0) & ((near < first) | (near >= last))
            seams = near[across]
            near[(near >= first) & ~across] -= first
            near[across] = -2 - np.arange(len(seams))
            own = np.arange(t, n, num_parts)
            np.savez(os.path.join(folder, f"part-{t:04}.npz"), dimension=np.int64(2), affine_dimension=np.int64(2), rows=rows.astype(np.int64),
                     points=whole["points"][rows], cells=local.reshape(-1, 3).astype(np.int32), neighbors=near.astype(np.int32), own_rows=own,
                     vertex_of_row=own)
            np.save(os.path.join(folder, f"part-{t:04}.seams.npy"), seams)
            parts.append(dict(file=f"part-{t:04}.npz", first_cell=int(first), num_cells=int(last - first), num_points=len(own),
                              num_vertices=len(own), num_foreign=0, num_rounds=1))
            for name, size, crc32 in ((f"part-{t:04}.npz", "num_bytes", "crc32"), (f"part-{t:04}.seams.npy", "num_seam_bytes", "seam_crc32")):
                with open(os.path.join(folder, name), "rb") as file:
                    content = file.read()
                parts[-1].update({size: len(content), crc32: zlib.crc32(content)})
        index = dict(format="delone tiles", version=1, dimension=2, affine_dimension=2, weighted=False, num_points=n, num_vertices=n,
                     num_duplicates=0, num_hidden=0, num_cells=m, num_hull_facets=int((neighbors == -1).sum()), hash=self.stats(points)["hash"],
                     input="", parts=parts)
        self.file("out/index.json", json.dumps(index))
        return folder, index

    def test_info(self):
        folder, index = self.write_folder()
        text = self.output("info", folder)
        self.assertIn(": a triangulation in tiles\n", text)
        self.assertIn(index["hash"], text)
        self.assertRegex(text, r"\n  parts +3\n")
        self.assertRegex(text, rf"\n  cells +{index['num_cells']}\n")

    def test_check(self):
        folder, index = self.write_folder()
        text = self.output("check", folder)
        self.assertIn("in 3 parts\n", text)
        self.assertEqual(text.count("  ok  "), 6)
        self.assertIn("a Delaunay triangulation of its vertices, each point in one part, exactly\n", text)
        self.assertIn("a Delaunay triangulation of all its points, ", self.output("check", "--points", self.uniform(2, 60), folder))
        self.assertIn("other coordinates in the input", self.output("check", "--points", self.file("p.npy", np.ones((60, 2))), folder, status=1))
        self.complaint("check", "--points", self.file("p.npy", np.ones((60, 3))), folder)
        self.assertIn("ties are decided", self.output("check", "--canonical", folder))
        self.assertNotIn("level 3", self.output("check", "--level", 2, folder))
        self.complaint("check", "--furthest-site", folder, status=64)
        self.assertEqual(sorted(os.listdir(folder)), sorted(["index.json"] + [f"part-000{t}.{kind}" for t in range(3) for kind in ("npz", "seams.npy")]))

    def test_damage(self):
        folder, _ = self.write_folder()
        os.truncate(os.path.join(folder, "part-0001.npz"), 300)
        text = self.output("check", folder, status=1)
        self.assertIn("level 1  storage          FAILED", text)
        self.assertIn("part-0001.npz: truncated: 300 bytes, not ", text)
        os.remove(os.path.join(folder, "index.json"))
        self.assertIn("index.json", self.complaint("check", folder))
        self.assertIn("index.json", self.complaint("info", folder))

    def test_unfinished(self):
        os.makedirs(self.path("out/work"))
        self.file("out/work/plan.json", json.dumps(dict(format="delone plan of tiles", version=1, dimension=2, affine_dimension=2, weighted=False,
                                                        num_points=10, num_tiles=7, input="")))
        self.assertRegex(self.output("info", self.path("out")), r"not finished\n  tiles +7\n  tiles done +0\n")
        self.assertIn("0 of 7 tiles are done", self.complaint("check", self.path("out")))


if __name__ == "__main__":
    unittest.main()
