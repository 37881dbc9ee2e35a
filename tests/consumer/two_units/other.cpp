// SPDX-License-Identifier: BSD-3-Clause
// The second of two translation units that include everything.
#include <delone/delone.hpp>

#include <vector>

std::size_t cells_of_the_other_unit(const std::vector<double>& coordinates, int dimension) {
  const delone::Delaunay<> t(coordinates, dimension);
  return t.to_data().num_cells();
}
