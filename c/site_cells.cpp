// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites as an object of arrays.
#include "object.hpp"
#include "options.hpp"
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
    const Triangulation& of = as_made(triangulation).product()->common();
    const auto d = static_cast<std::size_t>(of.dimension());
    SiteCellsOptions wanted{
        .faces = given(options).proper_faces ? CellFaces::proper : CellFaces::triangulated,
        .neighbors = true};
    if (low != nullptr || high != nullptr) {
      const std::span<const double> from = matrix(low, d, 1, "low"), to = matrix(high, d, 1, "high");
      wanted.box = Box{{from.begin(), from.end()}, {to.begin(), to.end()}};
    }
    const std::span<const double> rows = matrix(halfspaces, num_halfspaces, d + 1, "halfspaces");
    wanted.halfspaces.assign(rows.begin(), rows.end());
    SiteCells cells = site_cells(of, wanted, execution(options));
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
    return result;
  });
}
