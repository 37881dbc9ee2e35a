// SPDX-License-Identifier: BSD-3-Clause
// The first of two translation units that include everything: definitions in headers must not clash.
#include <delone/delone.hpp>

#include <array>
#include <cstdio>
#include <vector>

std::size_t cells_of_the_other_unit(const std::vector<double>& coordinates, int dimension);

int main() {
  const std::vector<std::array<double, 2>> square = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  const delone::Delaunay<2> t(square);
  const std::size_t other = cells_of_the_other_unit({0, 0, 1, 0, 0, 1, 1, 1}, 2);
  std::printf("delone %s: %zu and %zu triangles\n", DELONE_VERSION,
              static_cast<std::size_t>(t.num_finite_cells()), other);
  return t.num_finite_cells() == 2 && other == 2 ? 0 : 1;
}
