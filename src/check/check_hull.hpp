// SPDX-License-Identifier: BSD-3-Clause
// What the levels of check() of a hull hand to each other.
#pragma once

#include "base/axis_scale.hpp"
#include "check/check_stages.hpp"
#include "compiled/simplicial_hull.hpp"
#include "hull/hull_normal.hpp"
#include "hull/scaled_sites.hpp"
#include "hull/tolerance/cover.hpp"
#include "kernel/predicates.hpp"

#include <delone/data.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace delone::internal {

using compiled::SimplicialHull;

/// The hull as the engine's front end sees it: rows are sites.
class ExaminedHull {
 public:
  ExaminedHull(const HullData& data, const std::vector<double>& points)
      : sites(data.dimension), scale(data.tolerance, data.axis_tolerances, data.dimension), data_(data) {
    sites.coordinates = points;
    for (std::size_t row = 0; row < sites.size(); ++row)
      sites.grid.include(sites.point(static_cast<Index>(row)));
    hull.dimension = data.affine_dimension;
    hull.cells.assign(data.cells.begin(), data.cells.end());
  }

  bool is_tolerant() const { return data_.tolerance > 0; }

  /// The affine hull of the points, which must have the dimension that was given; with a tolerance, of the
  /// vertices, on the axes that were given.
  void find_flat() {
    if (is_tolerant())
      find_projection();
    else
      find_affine_hull();
    normals.emplace(hull.dimension < 1 ? 1 : hull.dimension);
    records.resize(hull.num_cells() * normals->stride());
    for (std::size_t c = 0; c < hull.num_cells(); ++c)
      normals->compute(sites, hull.cell(c), hull.dimension == 1 && c == 0,
                       records.data() + c * normals->stride());
  }
  /// The rows of the vertices, increasing.
  std::vector<Index> vertices() const {
    std::vector<Index> rows = hull.cells;
    if (hull.dimension == 0 && !data_.vertices.empty()) rows = {static_cast<Index>(data_.vertices[0])};
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  }
  /// The rows whose distance from the hull of the vertices exceeds the bound that is given with a tolerance.
  /// In full dimension a point that is beyond no cell is not looked at.
  void check_distances() {
    const std::vector<Index> corners = vertices();
    if (corners.empty()) {
      if (sites.size() > 0) throw Violation{"there is no vertex"};
      return;
    }
    const hull::ScaledSites scaled(sites, scale);
    const sites::BoundarySites& where_distances_count = scaled.get();
    std::vector<const double*> points;
    for (const Index row : corners) points.push_back(where_distances_count.point(row));
    hull::Cover distances({}, sites.ambient, data_.max_distance, {}, {});
    for (Index row = 0; row < sites.size(); ++row) {
      if (hull.dimension == sites.ambient) {
        std::size_t c = 0;
        while (c < hull.num_cells() && side(c, row) != Sign::negative) ++c;
        if (c == hull.num_cells()) continue;
      }
      if (distances.exceeds(points, where_distances_count.point(row)))
        throw Violation{
            fmt::format("the point {} is farther from the hull than {}", row, data_.max_distance), {}, {row}};
    }
  }

 private:
  void find_projection() {
    sites.axes = data_.axes;
    if (sites.axes.empty() && hull.dimension == sites.ambient)
      for (int axis = 0; axis < sites.ambient; ++axis) sites.axes.push_back(axis);
    const std::size_t k = sites.axes.size();
    bool are_axes = static_cast<int>(k) == hull.dimension || hull.dimension < 1;
    for (std::size_t j = 0; j < k; ++j)
      are_axes = are_axes && sites.axes[j] >= 0 && sites.axes[j] < sites.ambient &&
                 (j == 0 || sites.axes[j] > sites.axes[j - 1]);
    if (!are_axes) throw Violation{"the axes are not as many axes, increasing, as the affine dimension"};
    kernel::AffineHull projected(static_cast<int>(std::max<std::size_t>(k, 1)));
    std::vector<double> projection(k + 1, 0.0);
    for (const Index row : vertices()) {
      for (std::size_t j = 0; j < k; ++j) projection[j] = sites.point(row)[sites.axes[j]];
      if (projected.add(projection.data())) basis.push_back(row);
    }
    if (static_cast<int>(basis.size()) != hull.dimension + 1)
      throw Violation{fmt::format("the affine dimension is given as {}, but the vertices span {} on the axes",
                                  hull.dimension, static_cast<int>(basis.size()) - 1)};
  }
  void find_affine_hull() {
    kernel::AffineHull affine_hull(sites.ambient);
    for (Index row = 0; row < sites.size() && affine_hull.dimension() < sites.ambient; ++row)
      if (affine_hull.add(sites.point(row))) basis.push_back(row);
    if (affine_hull.dimension() != hull.dimension)
      throw Violation{fmt::format("the affine dimension is given as {}, but the points span {}",
                                  hull.dimension, affine_hull.dimension())};
    sites.axes = affine_hull.axes();
  }

 public:
  Sign side(std::size_t c, Index row) {
    const auto cell = hull.cell(c);
    if (std::find(cell.begin(), cell.end(), row) != cell.end()) return Sign::zero;
    const double* q = sites.point(row);
    const Sign sign = normals->side(sites, records.data() + c * normals->stride(), sites.point(cell[0]), q);
    return sign != Sign::zero ? sign : compiled::side_of_cell(sites, hull, c, q, sites.grid, scratch);
  }
  /// The sign of det(v_i − base) for the cell with vertex i replaced.
  Sign replaced(std::size_t c, std::size_t i, Index row, Index base) {
    scratch.assign(1, sites.point(base));
    for (const Index v : hull.cell(c)) scratch.push_back(sites.point(v));
    scratch[i + 1] = sites.point(row);
    return kernel::orientation<0>(sites.flat(), scratch.data(), sites.grid);
  }

  std::string text(std::size_t c) const {
    const auto corners = hull.corners();
    return braces(std::span<const SignedIndex>(data_.cells).subspan(c * corners, corners));
  }

  sites::BoundarySites sites;
  internal::AxisScale scale;
  SimplicialHull hull;
  std::vector<Index> basis;
  std::optional<hull::HullNormals> normals;
  std::vector<double> records;
  std::vector<const double*> scratch;

 private:
  const HullData& data_;
};

/// The vertex opposite the ridge that cell c shares across its vertex i.
inline Index apex_across(const SimplicialHull& hull, std::size_t c, std::size_t i) {
  const auto cell = hull.cell(c);
  const auto other = hull.cell(hull.neighbors_of(c)[i]);
  return *std::find_if(other.begin(), other.end(), [&](Index v) {
    const auto at = std::find(cell.begin(), cell.end(), v);
    return at == cell.end() || at == cell.begin() + static_cast<std::ptrdiff_t>(i);
  });
}

/// Level 5: what the file says of facets, ridges, equations, extreme rows, duplicates and kinds of points,
/// where it says so.
void check_hull_faces(ExaminedHull& examined, const HullData& data);

}  // namespace delone::internal
