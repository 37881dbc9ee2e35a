// SPDX-License-Identifier: BSD-3-Clause
// RegularTriangulation: weights, and what is hidden. Insertion is in triangulation_impl.cpp.
#include <delone/regular.hpp>

#include "base/guarded.hpp"
#include "triangulation/triangulation_impl.hpp"

#include <string>

namespace delone {
RegularTriangulation::RegularTriangulation(int dimension, const Options& options)
    : Triangulation(dimension < 1 ? throw Error(Errc::bad_dimension, "the dimension must be at least 1")
                                  : internal::guarded("the triangulation", [&] {
                                      return std::make_unique<Impl>(dimension,
                                                                    kernel::RowForm::weighted_point, options);
                                    })) {}
RegularTriangulation::RegularTriangulation(std::span<const double> coordinates,
                                           std::span<const double> weights, int dimension,
                                           const Options& options)
    : RegularTriangulation(dimension, options) {
  insert_range(coordinates, weights);
}
RegularTriangulation::RegularTriangulation(PointsView points, std::span<const double> weights,
                                           const Options& options)
    : RegularTriangulation(points.coordinates(), weights, points.dimension(), options) {}

void RegularTriangulation::insert_range(std::span<const double> coordinates,
                                        std::span<const double> weights) {
  if (weights.empty() && coordinates.size() >= impl().ambient())
    throw Error(Errc::bad_dimension,
                "0 weights for " + std::to_string(coordinates.size() / impl().ambient()) + " points");
  internal::guarded("the triangulation", [&] { impl().insert_range(coordinates, weights); });
}

InsertResult RegularTriangulation::insert(std::span<const double> point, double weight,
                                          std::optional<CellId> hint) {
  return internal::guarded("the triangulation", [&] { return impl().insert(point, weight, hint); });
}

double RegularTriangulation::weight(VertexId v) const {
  return impl().points.point(impl().checked_vertex(v))[impl().ambient()];
}

bool RegularTriangulation::is_hidden(std::size_t row) const { return impl().is_hidden(row); }
std::size_t RegularTriangulation::num_hidden() const { return impl().num_hidden(); }
std::vector<std::size_t> RegularTriangulation::hidden_rows() const { return impl().hidden_rows(); }

CellId RegularTriangulation::hiding_cell(std::size_t row, std::optional<CellId> hint) const {
  if (!is_hidden(row)) throw Error(Errc::invalid_argument, "row " + std::to_string(row) + " is not hidden");
  return locate({impl().points.point(index(impl().vertex_of_row[row])), impl().ambient()}, hint).cell;
}

std::vector<CellId> RegularTriangulation::conflict_zone(std::span<const double> query, double weight,
                                                        std::optional<CellId> hint) const {
  return impl().conflict_zone(query, weight, hint);
}

Sign RegularTriangulation::in_power_sphere(CellId cell, std::span<const double> query, double weight) const {
  return impl().in_sphere(cell, query, weight);
}

}  // namespace delone
