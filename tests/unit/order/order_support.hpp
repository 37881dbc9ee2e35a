// SPDX-License-Identifier: BSD-3-Clause
// Points and checks for the tests of orders.
#pragma once

#include "base/random.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::order {

inline std::vector<double> uniform_points(int d, std::size_t n, std::uint64_t seed) {
  random::Generator generator(seed);
  std::vector<double> x(n * static_cast<std::size_t>(d));
  for (double& v : x) v = generator.uniform();
  return x;
}

inline bool is_permutation(std::vector<Index> rows, std::size_t n) {
  if (rows.size() != n) return false;
  std::sort(rows.begin(), rows.end());
  for (std::size_t i = 0; i < n; ++i)
    if (rows[i] != i) return false;
  return true;
}

}  // namespace delone::order
