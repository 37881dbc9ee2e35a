// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites of a Triangulation, the arrays of a delone.SiteCells; and densities of particles at the
// points of a triangulation and on grids.
#include "arrays.hpp"
#include "held_periodic.hpp"
#include "module.hpp"
#include "site_cells.hpp"
#include "triangulation.hpp"

#include <delone/density.hpp>
#include <delone/site_cells.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;
using Held = HeldTriangulation;

py::tuple site_cells_of(const Held& held, bool neighbors, bool vertices, bool proper, const py::object& box,
                        const py::object& halfspaces) {
  SiteCellsOptions options{.faces = proper ? CellFaces::proper : CellFaces::triangulated,
                           .neighbors = neighbors,
                           .vertices = vertices};
  options.box = as_box(box);
  if (!halfspaces.is_none()) {
    const auto rows = as_doubles(halfspaces, "halfspaces");
    const auto of_rows = numbers(rows);
    options.halfspaces.assign(of_rows.begin(), of_rows.end());
  }
  // Whatever numbers cells have, so they need none.
  return as_tuple(count(
      held, [&](const Triangulation& t) { return site_cells(t, options, {.threads = held.threads()}); }));
}

py::array densities_of(const Held& held, const py::object& masses) {
  const auto given = as_doubles(masses, "masses");
  // Whatever numbers cells have, so they need none.
  return list_view(count(held, [&](const Triangulation& t) {
    return dtfe_densities(t, numbers(given), {.threads = held.threads()});
  }));
}

py::array periodic_densities_of(const HeldPeriodic& held, const py::object& masses) {
  const auto given = as_doubles(masses, "masses");
  return list_view(held.ask([&](const PeriodicTriangulation& t) {
    return dtfe_densities(t, numbers(given), {.threads = held.threads()});
  }));
}

DensityGrid as_grid(const py::object& origin, const py::object& sides, std::vector<std::size_t> shape) {
  const auto at = as_doubles(origin, "origin"), vectors = as_doubles(sides, "sides");
  DensityGrid grid;
  grid.origin.assign(numbers(at).begin(), numbers(at).end());
  grid.sides.assign(numbers(vectors).begin(), numbers(vectors).end());
  grid.shape = std::move(shape);
  return grid;
}

py::array on_grid(const Held& held, const py::object& densities, const py::object& origin,
                  const py::object& sides, std::vector<std::size_t> shape, std::size_t samples) {
  const auto values = as_doubles(densities, "densities");
  const DensityGrid grid = as_grid(origin, sides, std::move(shape));
  return list_view(ask(held, [&](const Triangulation& t) {
    return density_on_grid(t, numbers(values), grid, samples, {.threads = held.threads()});
  }));
}

py::array periodic_on_grid(const HeldPeriodic& held, const py::object& densities, const py::object& origin,
                           const py::object& sides, std::vector<std::size_t> shape, std::size_t samples) {
  const auto values = as_doubles(densities, "densities");
  const DensityGrid grid = as_grid(origin, sides, std::move(shape));
  return list_view(held.ask([&](const PeriodicTriangulation& t) {
    return density_on_grid(t, numbers(values), grid, samples, {.threads = held.threads()});
  }));
}

template <class Densities, class OnGrid>
void give_members(py::type owner, Densities densities, OnGrid grid) {
  owner.attr("_dtfe_densities") =
      py::cpp_function(densities, py::name("_dtfe_densities"), py::is_method(owner), "masses"_a);
  owner.attr("_density_on_grid") =
      py::cpp_function(grid, py::name("_density_on_grid"), py::is_method(owner), "densities"_a, "origin"_a,
                       "sides"_a, "shape"_a, "samples"_a);
}

}  // namespace

void bind_site_cells(py::module_&) {
  py::type triangulation = py::type::of<Held>();
  triangulation.attr("_site_cells") =
      py::cpp_function(&site_cells_of, py::name("_site_cells"), py::is_method(triangulation), "neighbors"_a,
                       "vertices"_a, "proper"_a, "box"_a, "halfspaces"_a);
}

void bind_density(py::module_&) {
  give_members(py::type::of<Held>(), &densities_of, &on_grid);
  give_members(py::type::of<HeldPeriodic>(), &periodic_densities_of, &periodic_on_grid);
}

}  // namespace delone::python
