# SPDX-License-Identifier: BSD-3-Clause
"""The programs that are measured: the adapters of benchmarks/rivals, by a short key. Those that were not built are left out."""
import dataclasses
import pathlib
import shutil
import sys

RIVALS = pathlib.Path(__file__).resolve().parents[1] / "rivals"


@dataclasses.dataclass(frozen=True)
class Program:
    key: str
    name: str
    adapter: str  # an executable of the build, or a script of benchmarks/rivals; "{d}" is the dimension
    options: tuple = ()
    dimensions: range = range(1, 100)
    command: str = ""  # an executable that the script needs

    def command_line(self, build, points, dimension):
        """The command line, or None if the program is not there or not for this dimension."""
        if dimension not in self.dimensions:
            return None
        adapter = self.adapter.format(d=dimension)
        if adapter.endswith(".py"):
            if self.command and not shutil.which(self.command):
                return None
            return [sys.executable, str(RIVALS / adapter), str(points), *self.options]
        executable = pathlib.Path(build) / "rivals" / adapter
        return [str(executable), str(points), *self.options] if executable.exists() else None


def catalogue(clarkson_hull=""):
    """key -> Program; `clarkson_hull` is the user's executable of Clarkson's Hull, which no distribution packages."""
    programs = [
        Program("delone", "delone", "delone_delaunay"),
        Program("delone:report", "delone, rounds along a curve as in 2008", "delone_delaunay", ("--order", "report")),
        Program("delone:curve", "delone, one curve", "delone_delaunay", ("--order", "curve")),
        Program("delone:shuffled", "delone, shuffled", "delone_delaunay", ("--order", "shuffled")),
        Program("cgal_2", "CGAL 2D", "delaunay_cgal_2", dimensions=range(2, 3)),
        Program("cgal_3", "CGAL 3D", "delaunay_cgal_3", dimensions=range(3, 4)),
        Program("cgal_3_parallel", "CGAL 3D, 2 threads", "delaunay_cgal_3_parallel", ("--threads", "2"), range(3, 4)),
        Program("triangle", "Triangle", "delaunay_triangle", dimensions=range(2, 3)),
        Program("delaunator", "delaunator-cpp", "delaunay_delaunator", dimensions=range(2, 3)),
        Program("geogram", "Geogram", "delaunay_geogram", dimensions=range(2, 4)),
        Program("hxt", "HXT", "delaunay_hxt", dimensions=range(3, 4)),
        Program("tetgen", "TetGen", "delaunay_tetgen", dimensions=range(3, 4)),
        Program("cgal_d", "CGAL dD", "delaunay_cgal_d{d}", dimensions=range(2, 8)),
        Program("qhull", "Qhull", "delaunay_qhull"),
        Program("qhull_qt", "Qhull, Qt", "delaunay_qhull", ("--options", "d Qbb Qc Q12 Qz Qt")),
        Program("scipy", "SciPy", "delaunay_scipy.py"),
        Program("cddlib", "cddlib, floating point", "delaunay_cddlib"),
        Program("cddlib_gmp", "cddlib, rational", "delaunay_cddlib_gmp"),
        Program("lrs", "lrs", "delaunay_lrs.py", command="lrs"),
        Program("hull_delone", "delone", "hull_delone"),
        Program("hull_qhull", "Qhull", "hull_qhull"),
        Program("hull_cgal", "CGAL dD", "hull_cgal_d{d}"),
        Program("hull_cddlib", "cddlib, floating point", "hull_cddlib"),
        Program("hull_cddlib_gmp", "cddlib, rational", "hull_cddlib_gmp"),
        Program("hull_lrs", "lrs", "hull_lrs.py", command="lrs"),
    ]
    if clarkson_hull:
        programs.append(Program("clarkson", "Hull", "delaunay_clarkson.py", ("--hull", clarkson_hull), command=clarkson_hull))
    return {program.key: program for program in programs}
