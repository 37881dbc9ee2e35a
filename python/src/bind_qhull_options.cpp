// SPDX-License-Identifier: BSD-3-Clause
// Options of Qhull, for delone.spatial.
#include "module.hpp"

#include <delone/error.hpp>
#include <delone/qhull_options.hpp>

#include <pybind11/stl.h>

#include <map>
#include <string>

namespace delone::python {

namespace py = pybind11;

namespace {

py::dict qhull_options(const std::string& text, const std::string& kind) {
  static const std::map<std::string, QhullProgram> kinds{{"delaunay", QhullProgram::delaunay},
                                                         {"voronoi", QhullProgram::voronoi},
                                                         {"hull", QhullProgram::hull},
                                                         {"halfspaces", QhullProgram::halfspaces}};
  QhullOptions o;
  try {
    o = parse_qhull_options(text, kinds.at(kind));
  } catch (const Error& error) {  // SciPy raises a ValueError
    throw py::value_error(error.what());
  }
  using namespace py::literals;
  return py::dict("scaled"_a = o.scaled, "last_in_box"_a = o.last_in_box, "in_cube"_a = o.in_cube,
                  "at_infinity"_a = o.at_infinity, "keep_coplanar"_a = o.keep_coplanar,
                  "furthest"_a = o.furthest_site, "joggled"_a = o.joggled, "unmerged"_a = o.unmerged,
                  "good_visible"_a = o.good_visible, "good_row"_a = o.good_row, "centrum"_a = o.centrum,
                  "roundoff"_a = o.roundoff, "width"_a = o.width);
}

}  // namespace

void bind_qhull_options(py::module_& module) {
  module.def("_qhull_options", &qhull_options, py::arg("text"), py::arg("kind"),
             "What options of Qhull ask for: the members of delone.spatial._options.Options.");
}

}  // namespace delone::python
