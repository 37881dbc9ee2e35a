// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/dependent_points.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/direct.hpp"
#include "kernel/grid.hpp"
#include "kernel/minors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace delone::kernel {
namespace {

constexpr int most_dimensions = 6;

/// The finest exponent of the coordinates of a point.
int finest_exponent(const double* point, int dimension) {
  int finest = trailing_exponent(point[0]);
  for (int j = 1; j < dimension; ++j) finest = std::min(finest, trailing_exponent(point[j]));
  return finest;
}

/// Whether points of R^k on the grid of 2^exponent are proved to be affinely dependent: k + 1 that are
/// lifted, or k as they are.
template <int K, bool Lifted>
bool are_dependent(const double* const* points, int exponent) {
  constexpr std::size_t size = Lifted ? K : K - 1, columns = size + 1, dimension = K;
  std::array<double, size * columns> rows;
  double largest = 1, largest_lift = 1;
  const double per_unit = std::ldexp(1.0, -exponent);
  for (std::size_t i = 0; i < size; ++i) {
    double lift = 0;
    for (std::size_t j = 0; j < dimension; ++j) {
      const double difference = (points[i + 1][j] - points[0][j]) * per_unit;
      rows[i * columns + j] = difference;
      largest = std::max(largest, std::fabs(difference));
      lift += difference * difference;
    }
    if constexpr (Lifted) {
      rows[i * columns + dimension] = lift;
      largest_lift = std::max(largest_lift, lift);
    }
  }
  double bound = std::max(largest, largest_lift);
  for (std::size_t i = 1; i < size; ++i) bound *= static_cast<double>(i + 1) * largest;
  if (!(bound < 0x1p52)) return false;
  for (std::size_t omitted = 0; omitted <= size; ++omitted) {
    std::array<double, size * size> minor;
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) minor[i * size + j] = rows[i * columns + j + (j >= omitted)];
    if (determinant_by_minors<size>(minor.data()) != 0) return false;
  }
  return true;
}

/// Whether x and y are 2^18 units or more apart, whatever grid both are on. The unit of the coarsest is that
/// of the finer of the two; a difference of less than 2^18 of these is exact.
bool are_far_apart(double x, double y) {
  const double difference = x - y;
  return difference != 0 &&
         detail::upper_exponent(difference) > std::min(trailing_exponent(x), trailing_exponent(y)) + 18;
}

/// Whether all of three points are far apart from each other along the first axis: then are_dependent() is
/// false. It leaves out one of them at most, so one of the others is 2^17 units or more from its points[0].
/// With that, largest_lift ≥ 2^34 and bound ≥ 2^34·2·2^17 = 2^52.
bool are_three_far_apart(const double* const* points) {
  const double x = points[0][0], y = points[1][0], z = points[2][0];
  return are_far_apart(x, y) && are_far_apart(x, z) && are_far_apart(y, z);
}

/// Whether `count` points of R^k are proved to be dependent without the one on the finest grid.
template <bool Lifted>
bool are_dependent_without_one(const double** all, int count, int k) {
  std::array<int, most_dimensions + 2> exponents;
  const auto last = static_cast<std::size_t>(count) - 1;
  std::size_t finest = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    exponents[i] = finest_exponent(all[i], k);
    if (exponents[i] < exponents[finest]) finest = i;
  }
  std::swap(all[finest], all[last]);
  std::swap(exponents[finest], exponents[last]);
  const int exponent =
      *std::min_element(exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(last));
  constexpr int moderate = 500;  // 2^−exponent is a double, and no entry underflows
  if (exponent == exponents[last] || exponent < -moderate || exponent > moderate) return false;
  return internal::with_compiled_dimension<2, most_dimensions>(static_cast<std::size_t>(k), [&](auto size) {
    if constexpr (size() > 0) return are_dependent<size(), Lifted>(all, exponent);
    return false;
  });
}

}  // namespace

bool is_on_sphere_of_others(const Flat& flat, const double* const* points, const double* q) {
  const int k = flat.ambient;
  if (k < 2 || k > most_dimensions || flat.dimension() != k || flat.weighted()) return false;
  if (are_three_far_apart(points)) return false;  // most are: there is no lattice
  std::array<const double*, most_dimensions + 2> all;
  *std::copy_n(points, k + 1, all.begin()) = q;
  return are_dependent_without_one<true>(all.data(), k + 2, k);
}

bool is_flat_without_one(const Flat& flat, const double* const* points, const double* base) {
  const int k = flat.ambient;
  if (k < 2 || k > most_dimensions || flat.dimension() != k) return false;
  std::array<const double*, most_dimensions + 2> all;
  *std::copy_n(points, k, all.begin()) = base;
  return are_dependent_without_one<false>(all.data(), k + 1, k);
}

}  // namespace delone::kernel
