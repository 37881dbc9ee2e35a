// SPDX-License-Identifier: BSD-3-Clause
// The compiled module delone._core.
#include "module.hpp"

#include "running.hpp"

PYBIND11_MODULE(_core, module) {
  namespace python = delone::python;
  module.doc() = "The compiled part of delone.";
  module.attr("__version__") = DELONE_VERSION;
  python::bind_errors(module);
  python::bind_triangulations(module);
  python::bind_trim(module);
  python::bind_interpolator(module);
  python::bind_natural_neighbors(module);
  python::bind_convex_hull(module);
  python::bind_convex_hulls(module);
  python::bind_voronoi(module);
  python::bind_halfspaces(module);
  python::bind_cell_maps(module);
  python::bind_clough_tocher(module);
}
