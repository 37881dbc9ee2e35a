// SPDX-License-Identifier: BSD-3-Clause
// The distinct rows ("sites") that a boundary has as vertices: points, or homogeneous rows of halfspaces.
#pragma once

#include "kernel/flat.hpp"
#include "kernel/grid.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <vector>

namespace delone::sites {

/// Sites by id.
struct BoundarySites {
  explicit BoundarySites(int row_size, kernel::RowForm given = kernel::RowForm::point)
      : ambient(row_size), form(given), grid(row_size) {}

  std::size_t size() const { return coordinates.size() / static_cast<std::size_t>(ambient); }
  const double* point(Index site) const {
    return coordinates.data() + static_cast<std::size_t>(site) * static_cast<std::size_t>(ambient);
  }
  bool is_homogeneous() const { return form == kernel::RowForm::homogeneous; }
  kernel::Flat flat() const { return {ambient, axes, form}; }
  /// k, the dimension of the flat of points, or one less than that of the span of homogeneous rows.
  int dimension() const { return flat().dimension(); }
  /// The dual point of a homogeneous row.
  const double* dual(Index site) const {
    return duals.data() + static_cast<std::size_t>(site) * 2 * static_cast<std::size_t>(dimension());
  }
  /// Number r of what filters compare of a site: of its point, on the axes of the flat, or of its dual point.
  double image(Index site, std::size_t r) const {
    return is_homogeneous() ? dual(site)[r] : point(site)[axes[r]];
  }

  int ambient;  ///< numbers in a row
  kernel::RowForm form;
  std::vector<double> coordinates;  ///< the rows as given
  kernel::Grid grid;                ///< of points; that of homogeneous rows stays empty
  /// Coordinates on which the flat of the points, or the span of the rows, projects one-to-one; the last one
  /// of homogeneous rows (n, c) is that of c.
  std::vector<int> axes;
  /// Of homogeneous rows (n, c), seen from an interior point p: n_j/−(n·p + c) on the first k axes, rounded,
  /// and then the remainders of the rounding.
  std::vector<double> duals;
};

}  // namespace delone::sites
