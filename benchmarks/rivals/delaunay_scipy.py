#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scipy.spatial.Delaunay: Qhull with its options for Delaunay triangulations, and arrays. Its memory includes Python's."""
import rival
import scipy
import scipy.spatial


class Scipy:
    def __init__(self, points, arguments):
        self.points = points
        self.result = None

    def program(self):
        return {"program": "SciPy", "version": scipy.__version__, "flags": ""}

    def construct(self):
        try:
            self.result = scipy.spatial.Delaunay(self.points)
        except scipy.spatial.QhullError as error:
            raise rival.Refused(str(error).strip().splitlines()[0]) from None

    def num_cells(self):
        return len(self.result.simplices)

    def cells(self):
        return self.result.simplices


if __name__ == "__main__":
    rival.main(Scipy, rival.parser(__doc__).parse_args())
