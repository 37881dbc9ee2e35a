// SPDX-License-Identifier: BSD-3-Clause
#include "faces/shapes_of_cells.hpp"

#include "faces/cell_blocks.hpp"
#include "faces/cell_shape.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace delone::internal {

ShapesOfCells shapes_of_cells(std::span<const double> points, int dimension,
                              std::span<const SignedIndex> cells, int corners, unsigned threads) {
  const auto d = static_cast<std::size_t>(dimension), width = static_cast<std::size_t>(corners);
  const std::size_t count = cells.size() / width;
  ShapesOfCells shapes{std::vector<double>(count), std::vector<double>(count)};
  const auto corner_of = [&](std::size_t cell, std::size_t i) {
    return points.data() + static_cast<std::size_t>(cells[cell * width + i]) * d;
  };
  const auto take = [&](std::size_t cell, double radius, const double* const* of_cell) {
    shapes.radius[cell] = radius;
    shapes.ratio[cell] = std::isnan(radius) ? std::numeric_limits<double>::quiet_NaN()
                                            : radius_ratio(of_cell, width, d, radius);
  };
  for_blocks_of_cells(count, width, threads, corner_of,
                      radii_of_blocks(dimension, width, unit_of(points), take));
  return shapes;
}

}  // namespace delone::internal
