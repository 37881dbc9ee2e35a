// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/multiples_stage.hpp"

#include "kernel/integer_determinant.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace delone::kernel {
namespace {

constexpr double most_multiple = 1 << 10;

/// Whether x is m·unit for a whole m of at most most_multiple, which is then set.
bool is_multiple(double x, double unit, std::int64_t& m) {
  const double ratio = x / unit;
  if (!(std::fabs(ratio) <= most_multiple)) return false;
  m = std::llround(ratio);
  return std::fma(static_cast<double>(m), unit, -x) == 0;
}

}  // namespace

std::optional<Sign> orientation_of_multiples(std::span<const int> axes, const double* const* points,
                                             const double* base) {
  constexpr std::size_t most_columns = 10;
  const std::size_t n = axes.size();
  if (n > most_columns) return std::nullopt;
  std::vector<std::int64_t> entries(n * n);
  double differences[most_columns], bits = 1;
  for (std::size_t c = 0; c < n; ++c) {
    const auto axis = static_cast<std::size_t>(axes[c]);
    double unit = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = points[i][axis], y = base[axis], difference = x - y;
      // The rounding of a difference, after Knuth; not a number if the difference is infinite.
      const double part = difference - x;
      if (!((x - (difference - part)) - (y + part) == 0)) return std::nullopt;
      differences[i] = difference;
      if (difference != 0 && (unit == 0 || std::fabs(difference) < unit)) unit = std::fabs(difference);
    }
    if (unit == 0) return Sign::zero;
    std::int64_t most = 1;
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_multiple(differences[i], unit, entries[i * n + c])) return std::nullopt;
      most = std::max(most, std::abs(entries[i * n + c]));
    }
    // A minor of size s is at most s! times the product of its columns' largest entries.
    bits += std::log2(static_cast<double>(most) * static_cast<double>(c + 1));
  }
  const int size = static_cast<int>(n);
  if (bits <= 31) return sign_by_integer_elimination(std::move(entries), size);
  if (bits <= 62) return sign_by_integer_minors(entries, size);
  return std::nullopt;
}

}  // namespace delone::kernel
