// SPDX-License-Identifier: BSD-3-Clause
// One function for each group of classes.
#pragma once

#include <pybind11/pybind11.h>

namespace delone::python {

void bind_triangulations(pybind11::module_& module);
void bind_trim(pybind11::module_& module);
void bind_faces(pybind11::module_& module);
void bind_interpolator(pybind11::module_& module);
void bind_natural_neighbors(pybind11::module_& module);
void bind_convex_hull(pybind11::module_& module);
void bind_convex_hulls(pybind11::module_& module);
void bind_voronoi(pybind11::module_& module);
void bind_site_cells(pybind11::module_& module);
void bind_density(pybind11::module_& module);
void bind_halfspaces(pybind11::module_& module);
void bind_cell_maps(pybind11::module_& module);
void bind_clough_tocher(pybind11::module_& module);
void bind_lists(pybind11::module_& module);
void bind_rounding(pybind11::module_& module);
void bind_tiles(pybind11::module_& module);
void bind_forecast(pybind11::module_& module);
void bind_files(pybind11::module_& module);
void bind_lower_hull(pybind11::module_& module);
void bind_polyhedra(pybind11::module_& module);
void bind_polyhedra_vertices(pybind11::module_& module);
void bind_periodic(pybind11::module_& module);
void bind_qhull_options(pybind11::module_& module);
void bind_periodic_queries(pybind11::module_& module);

/// After all of these: inspect.signature() works on everything.
void give_signatures(pybind11::module_& module);

}  // namespace delone::python
