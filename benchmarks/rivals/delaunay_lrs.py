#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The command lrs (reverse search, exact) on the lifted points and the upward direction: the facets that are not vertical are the
cells. The time is that of the whole process, reading included."""
import subprocess

import numpy as np
import rival


class Lrs:
    def __init__(self, points, arguments):
        self.points = points
        self.folder = rival.temporary_folder()
        self.input, self.output = f"{self.folder.name}/lifted.ext", f"{self.folder.name}/facets.ine"
        n, d = points.shape
        rows = [" ".join(["1", *row]) for row in rival.lifted_fractions(points)]
        rows.append(" ".join(["0"] * (d + 1) + ["1"]))
        body = "\n".join(rows)
        with open(self.input, "w", encoding="ascii") as out:
            out.write(f"lifted\nV-representation\nbegin\n{n + 1} {d + 2} rational\n{body}\nend\nincidence\n")

    def program(self):
        said = subprocess.run(["lrs", "/dev/null"], capture_output=True, text=True).stdout
        return {"program": "lrs", "version": next((word for word in said.split() if word.startswith("v.")), "unknown"), "flags": "incidence"}

    def construct(self):
        with open(self.output, "w", encoding="ascii") as out:
            return rival.run_command(["lrs", self.input], out)

    def facets(self):
        """The points of every facet that is not vertical, as lrs numbers them, from 1."""
        incident, inside = [], False
        with open(self.output, encoding="ascii") as lines:
            for line in lines:
                words = line.split()
                if not words:
                    continue
                if words[0] == "begin":
                    inside = True
                elif words[0] == "end":
                    inside = False
                elif inside and words[0].startswith("F#"):
                    # A star marks the vertex of the simplex at hand that is not on the facet.
                    named = line.split("vertices/rays", 1)[1].split("I#")[0].replace(":", " ").split()
                    incident = [word for word in named if not word.endswith("*")]
                elif inside and len(words) == self.points.shape[1] + 2 and words[-1] != "0":
                    yield incident

    def num_cells(self):
        return sum(1 for _ in self.facets())

    def cells(self):
        """For points that span less than their space, each equation lowers the size of a cell by one; equal points stand for the first."""
        size = self.points.shape[1] + 1 - self.num_equations()
        first = {}
        meant = [first.setdefault(tuple(point), row) for row, point in enumerate(self.points.tolist())]
        rows = [sorted({meant[int(word) - 1] for word in facet}) for facet in self.facets()]
        if any(len(row) != size for row in rows):
            raise rival.Refused("a cell is no simplex")
        return np.array(rows, dtype=np.int64).reshape(len(rows), size)

    def num_equations(self):
        with open(self.output, encoding="ascii") as lines:
            return next((int(line.split()[1]) for line in lines if line.startswith("linearity")), 0)


if __name__ == "__main__":
    rival.main(Lrs, rival.parser(__doc__).parse_args())
