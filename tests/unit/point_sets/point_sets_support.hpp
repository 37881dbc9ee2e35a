// SPDX-License-Identifier: BSD-3-Clause
// Point sets as rows.
#pragma once

#include <delone/point_sets.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace delone {

using Rows = std::vector<std::vector<double>>;

inline Rows rows_of(const std::vector<double>& x, int d) {
  Rows rows;
  for (auto i = x.begin(); i != x.end(); i += d) rows.emplace_back(i, i + d);
  return rows;
}

inline Rows make(std::string_view kind, int d, std::size_t n, std::uint64_t seed = 1) {
  return rows_of(make_point_set(kind, d, n, seed), d);
}

}  // namespace delone
