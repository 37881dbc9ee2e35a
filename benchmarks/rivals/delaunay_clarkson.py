#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Clarkson's Hull (netlib.org/voronoi/hull.html), as an executable that the user names:  delaunay_clarkson.py points.npy --hull PATH

No distribution packages it. It rounds coordinates to integers, and is exact if those are small. As in the report, coordinates are
scaled so that seven decimal digits are left in dimensions up to 4, six beyond. Times are those of the whole process, including
reading but not output; cells are counted in a second run, which is not timed.
"""
import numpy as np
import rival


class Clarkson:
    def __init__(self, points, arguments):
        self.points, self.hull = points, arguments.hull
        self.folder = rival.temporary_folder()
        self.input, self.output = f"{self.folder.name}/points", f"{self.folder.name}/cells"
        largest = float(np.abs(points).max(initial=0.0)) or 1.0
        digits = 7 if points.shape[1] <= 4 else 6
        self.multiplier = 10.0 ** (digits - int(np.ceil(np.log10(largest))))
        np.savetxt(self.input, points, fmt="%.17g")

    def program(self):
        return {"program": "Hull", "version": self.hull, "flags": f"-d -m{self.multiplier:g}"}

    def command(self, *more):
        return [self.hull, "-d", f"-m{self.multiplier:g}", f"-i{self.input}", *more]

    def construct(self):
        with open(f"{self.folder.name}/nothing", "w", encoding="ascii") as out:
            return rival.run_command(self.command("-oN"), out)

    def cells(self):
        """Lines of point numbers; a line with −1, the point at infinity, is not a cell."""
        with open(self.output, "w", encoding="ascii") as out:
            rival.run_command(self.command("-fvn"), out)
        rows = []
        with open(self.output, encoding="ascii") as lines:
            for line in lines:
                words = line.split()
                if len(words) == self.points.shape[1] + 1 and "-1" not in words:
                    rows.append([int(word) for word in words])
        return np.array(rows, dtype=np.int64).reshape(len(rows), -1)

    def num_cells(self):
        return len(self.cells())


if __name__ == "__main__":
    options = rival.parser(__doc__)
    options.add_argument("--hull", required=True, metavar="PATH")
    rival.main(Clarkson, options.parse_args())
