// SPDX-License-Identifier: BSD-3-Clause
// Sets of halfspaces around the origin that tests against other libraries share.
#pragma once

#include "degenerate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace delone::test {

/// m halfspaces in general position, one in four of them far enough away to be redundant as a rule; multiples
/// of 2⁻²⁰.
inline std::vector<double> halfspaces_around_a_ball(int d, int m, std::uint64_t seed) {
  Random random(seed + static_cast<std::uint64_t>(d));
  std::vector<double> rows;
  for (int r = 0; r < m; ++r) {
    std::vector<double> row;
    double square = 0;
    while (square < 0.01 || square > 1) {
      row.clear();
      square = 0;
      for (int j = 0; j < d; ++j) {
        row.push_back(2 * random.real() - 1);
        square += row.back() * row.back();
      }
    }
    const double distance = (r % 4 == 3 ? 2 : 1) * (1 + random.real() / 16);
    for (double& x : row) x = std::nearbyint(std::ldexp(x / std::sqrt(square), 20)) * 0x1p-20;
    row.push_back(-std::nearbyint(std::ldexp(distance, 20)) * 0x1p-20);
    rows.insert(rows.end(), row.begin(), row.end());
  }
  return rows;
}

/// Up to m halfspaces with entries −2 … 2 and the offsets −1 and −2, no two the same: many meet in a vertex,
/// some touch.
inline std::vector<double> halfspaces_of_small_integers(int d, int m, std::uint64_t seed) {
  Random random(seed * 1000 + static_cast<std::uint64_t>(d));
  std::set<std::vector<int>> seen;  // divided by their offsets, times 2
  std::vector<double> rows;
  for (int r = 0; r < m; ++r) {
    std::vector<int> row, key;
    const int offset = random.integer(1, 2);
    for (int j = 0; j < d; ++j) {
      row.push_back(random.integer(-2, 2));
      key.push_back(2 * row.back() / offset);
    }
    if (std::all_of(row.begin(), row.end(), [](int x) { return x == 0; }) || !seen.insert(key).second)
      continue;
    rows.insert(rows.end(), row.begin(), row.end());
    rows.push_back(-offset);
  }
  return rows;
}

}  // namespace delone::test
