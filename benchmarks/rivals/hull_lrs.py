#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The command lrs (reverse search, exact) on the points as vertices: every facet of a simplicial polytope once, and one with more
vertices once for each of the simplices that it is divided into. The time is that of the whole process, reading included."""
import subprocess
from fractions import Fraction

import numpy as np
import rival


class Lrs:
    def __init__(self, points, arguments):
        self.points = points
        self.folder = rival.temporary_folder()
        self.input, self.output = f"{self.folder.name}/points.ext", f"{self.folder.name}/facets.ine"
        n, d = points.shape
        body = "\n".join(" ".join(["1", *(str(Fraction(float(x))) for x in row)]) for row in points)
        with open(self.input, "w", encoding="ascii") as out:
            out.write(f"points\nV-representation\nbegin\n{n} {d + 1} rational\n{body}\nend\nincidence\n")

    def program(self):
        said = subprocess.run(["lrs", "/dev/null"], capture_output=True, text=True).stdout
        return {"program": "lrs", "version": next((word for word in said.split() if word.startswith("v.")), "unknown"), "flags": "incidence"}

    def construct(self):
        with open(self.output, "w", encoding="ascii") as out:
            return rival.run_command(["lrs", self.input], out)

    def facets(self):
        """The points of every facet, as lrs numbers them, from 1."""
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
                elif inside and len(words) == self.points.shape[1] + 1:
                    yield incident

    def num_cells(self):
        return sum(1 for _ in self.facets())

    def cells(self):
        rows = [[int(word) - 1 for word in facet] for facet in self.facets()]
        if any(len(row) != self.points.shape[1] for row in rows):
            raise rival.Refused("a facet is no simplex")
        return np.array(rows, dtype=np.int64).reshape(len(rows), -1)


if __name__ == "__main__":
    rival.main(Lrs, rival.parser(__doc__).parse_args())
