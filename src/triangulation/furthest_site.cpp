// SPDX-License-Identifier: BSD-3-Clause
// FurthestSiteTriangulation: points whose lifts are negated, and what is hidden. Insertion is in
// triangulation_impl.cpp.
#include <delone/furthest_site.hpp>

#include "triangulation/triangulation_impl.hpp"

namespace delone {

FurthestSiteTriangulation::FurthestSiteTriangulation(int dimension, const Options& options)
    : Triangulation(dimension < 1
                        ? throw Error(Errc::bad_dimension, "the dimension must be at least 1")
                        : std::make_unique<Impl>(dimension, kernel::RowForm::furthest_point, options)) {}
FurthestSiteTriangulation::FurthestSiteTriangulation(std::span<const double> coordinates, int dimension,
                                                     const Options& options)
    : FurthestSiteTriangulation(dimension, options) {
  insert_range(coordinates);
}
FurthestSiteTriangulation::FurthestSiteTriangulation(PointsView points, const Options& options)
    : FurthestSiteTriangulation(points.coordinates(), points.dimension(), options) {}

bool FurthestSiteTriangulation::is_hidden(std::size_t row) const { return impl().is_hidden(row); }
std::size_t FurthestSiteTriangulation::num_hidden() const { return impl().num_hidden(); }
std::vector<std::size_t> FurthestSiteTriangulation::hidden_rows() const { return impl().hidden_rows(); }

}  // namespace delone
