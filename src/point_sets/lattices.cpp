// SPDX-License-Identifier: BSD-3-Clause
// Lattices, as in pixel, voxel and decimal data: every sphere through a cell has further points on it.
#include "point_sets/kinds.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace delone::point_sets {
namespace {

/// side^d ≥ n, without overflow.
bool holds(std::size_t side, std::size_t d, std::size_t n) {
  std::size_t room = 1;
  for (std::size_t j = 0; j < d && room < n; ++j) {
    if (side > 1 && room > n / side) return true;
    room *= side;
    if (side == 1) break;
  }
  return room >= n;
}

/// The least side of a grid of n points.
std::size_t grid_side(std::size_t d, std::size_t n) {
  std::size_t low = 1, high = std::max<std::size_t>(n, 1);
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (holds(middle, d, n))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/// The first n points of {0 … side−1}^d, the last coordinate running fastest.
Coordinates counted(std::size_t d, std::size_t n, std::size_t side) {
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t rest = i;
    for (std::size_t j = d; j-- > 0 && rest > 0; rest /= side)
      x[i * d + j] = static_cast<double>(rest % side);
  }
  return x;
}

/// The next double above or below a positive normal number.
double nudge(double v, int ulps) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(v) +
                               static_cast<std::uint64_t>(std::int64_t{ulps}));
}

}  // namespace

Coordinates make_grid(std::size_t d, std::size_t n, Generator&) { return counted(d, n, grid_side(d, n)); }

Coordinates make_tilted_grid(std::size_t d, std::size_t n, Generator& generator) {
  // The image of the grid under L·U, bidiagonal integer matrices with ones on the diagonal: determinant 1, no
  // right angles.
  Coordinates x = make_grid(d, n, generator);
  std::vector<double> lower(d), upper(d);
  for (double& v : lower) v = static_cast<double>(1 + generator.below(3)) * (generator.coin() ? 1 : -1);
  for (double& v : upper) v = static_cast<double>(1 + generator.below(2)) * (generator.coin() ? 1 : -1);
  for (std::size_t i = 0; i < n; ++i) {
    double* p = x.data() + i * d;
    for (std::size_t j = 0; j + 1 < d; ++j) p[j] += upper[j] * p[j + 1];
    for (std::size_t j = d; j-- > 1;) p[j] += lower[j] * p[j - 1];
  }
  return x;
}

Coordinates make_nudged_grid(std::size_t d, std::size_t n, Generator& generator) {
  Coordinates x = make_grid(d, n, generator);
  // From 1 upwards: at 0 the next double is a denormal, which is another test (mixed_scales).
  for (double& v : x) v = nudge(v + 1, static_cast<int>(generator.below(3)) - 1);
  return x;
}

Coordinates make_cube01(std::size_t d, std::size_t n, Generator&) {
  if (d < 64) n = std::min(n, std::size_t{1} << d);
  return counted(d, n, 2);
}

}  // namespace delone::point_sets
