// SPDX-License-Identifier: BSD-3-Clause
// What the boundary of a hull, or of a cone of homogeneous rows, is seen from.
#pragma once

#include "kernel/grid.hpp"

#include <vector>

namespace delone::geometry {

struct CentralView {
  explicit CentralView(kernel::Grid of_sites) : grid(std::move(of_sites)) {}

  std::vector<double> center;          ///< a row
  std::vector<double> dual_of_center;  ///< of a homogeneous row, as in BoundarySites
  bool is_inside = false;  ///< whether the centre is strictly inside the simplex that the boundary began with
  kernel::Grid grid;       ///< one for the points and the centre
  std::vector<double> low, high;  ///< a box for all points, or for all dual points: k numbers each, by axis
};

}  // namespace delone::geometry
