// SPDX-License-Identifier: BSD-3-Clause
#include "hull/cell_cones.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace delone::hull {

const double* CellCones::inverse(std::size_t cell) {
  double* const result = inverses_.data() + cell * d_ * d_;
  if (std::exchange(is_known_[cell], 1) == 0) invert(cell, result);
  return result;
}

void CellCones::invert(std::size_t cell, double* result) {
  matrix_.resize(d_ * 2 * d_);
  const std::size_t width = 2 * d_;
  for (std::size_t r = 0; r < d_; ++r)
    for (std::size_t c = 0; c < d_; ++c) {
      matrix_[r * width + c] = edge(cell, c, r);
      matrix_[r * width + d_ + c] = r == c ? 1 : 0;
    }
  for (std::size_t s = 0; s < d_; ++s) {
    std::size_t pivot = s;
    for (std::size_t r = s + 1; r < d_; ++r)
      if (std::fabs(matrix_[r * width + s]) > std::fabs(matrix_[pivot * width + s])) pivot = r;
    if (pivot != s)
      std::swap_ranges(matrix_.begin() + static_cast<std::ptrdiff_t>(s * width),
                       matrix_.begin() + static_cast<std::ptrdiff_t>((s + 1) * width),
                       matrix_.begin() + static_cast<std::ptrdiff_t>(pivot * width));
    double* const row = matrix_.data() + s * width;
    const double factor = 1 / row[s];
    for (std::size_t c = s; c < width; ++c) row[c] *= factor;
    for (std::size_t r = 0; r < d_; ++r) {
      double* const other = matrix_.data() + r * width;
      const double part = other[s];
      if (r == s || part == 0) continue;
      for (std::size_t c = s; c < width; ++c) other[c] -= part * row[c];
    }
  }
  for (std::size_t r = 0; r < d_; ++r) std::copy_n(matrix_.data() + r * width + d_, d_, result + r * d_);
}

}  // namespace delone::hull
