// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites as an object of arrays.
#include "object.hpp"
#include "options.hpp"
#include "periodic.hpp"
#include "triangulation.hpp"

#include <delone/site_cells.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>

using namespace delone;
using namespace delone::c;

int delone_site_cells(const delone_object* triangulation, const double* low, const double* high,
                      const double* halfspaces, size_t num_halfspaces, const delone_options* options,
                      delone_object** object) {
  return make(object, [&] {
    const auto* const periodic = dynamic_cast<const PeriodicObject*>(triangulation);
    const auto d =
        static_cast<std::size_t>(periodic != nullptr ? periodic->triangulation().dimension()
                                                     : as_made(triangulation).triangulation().dimension());
    SiteCellsOptions wanted{
        .faces = given(options).proper_faces ? CellFaces::proper : CellFaces::triangulated,
        .neighbors = true,
        .vertices = given(options).vertices};
    if (low != nullptr || high != nullptr) {
      const std::span<const double> from = matrix(low, d, 1, "low"), to = matrix(high, d, 1, "high");
      wanted.box = Box{{from.begin(), from.end()}, {to.begin(), to.end()}};
    }
    const std::span<const double> rows = matrix(halfspaces, num_halfspaces, d + 1, "halfspaces");
    wanted.halfspaces.assign(rows.begin(), rows.end());
    SiteCells cells = periodic != nullptr ? site_cells(periodic->triangulation(), wanted, execution(options))
                                          : site_cells(as_made(triangulation).product()->common(), wanted,
                                                       execution(options));
    auto result = std::make_unique<Results>("site_cells");
    result->add("dimension", static_cast<std::int64_t>(cells.dimension));
    result->add("volumes", std::move(cells.volumes));
    result->add("centroids", std::move(cells.centroids), cells.dimension);
    result->add("areas", std::move(cells.areas));
    result->add("num_faces", std::move(cells.num_faces));
    result->add("neighbor_offsets", std::move(cells.neighbor_offsets));
    result->add("neighbors", std::move(cells.neighbors));
    result->add("face_areas", std::move(cells.face_areas));
    result->add("distances", std::move(cells.distances));
    result->add("num_edges", std::move(cells.num_edges));
    if (periodic != nullptr) result->add("neighbor_lattice", std::move(cells.neighbor_lattice), cells.rank);
    if (wanted.vertices) {
      result->add("vertex_offsets", std::move(cells.vertex_offsets));
      result->add("vertices", std::move(cells.vertices), cells.dimension);
      result->add("face_vertex_offsets", std::move(cells.face_vertex_offsets));
      result->add("face_vertices", std::move(cells.face_vertices));
    }
    return result;
  });
}
