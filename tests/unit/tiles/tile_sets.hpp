// SPDX-License-Identifier: BSD-3-Clause
// Sets of points for the tests of tiles, most of them degenerate, and the way from points to pages.
#pragma once

#include "base/random.hpp"
#include "scale.hpp"
#include "tiles/page_file.hpp"
#include "tiles/survey.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace delone::test {

struct TileSet {
  std::string name;
  int row_size = 0;  ///< a weight included
  bool weighted = false;
  std::vector<double> rows;

  PointsView view() const { return {rows, row_size}; }
  int dimension() const { return row_size - (weighted ? 1 : 0); }
};

/// Sets of about n points or fewer.
inline std::vector<TileSet> tile_sets(std::size_t n) {
  random::Generator random(7);
  std::vector<TileSet> sets;
  const auto add = [&](const std::string& name, int row_size, std::size_t count, const auto& coordinate,
                       bool weighted = false) {
    TileSet set{name, row_size, weighted, {}};
    for (std::size_t i = 0; i < count; ++i)
      for (int axis = 0; axis < row_size; ++axis) set.rows.push_back(coordinate(i, axis));
    sets.push_back(set);
  };
  const auto uniform = [&](std::size_t, int) { return random.uniform(); };
  add("none", 3, 0, uniform);
  add("one", 2, 1, uniform);
  add("two", 3, 2, uniform);
  for (const int d : {1, 2, 3, 5}) add("uniform" + std::to_string(d), d, n, uniform);
  add("equal", 3, n, [](std::size_t, int) { return 0.25; });
  add("zeros", 2, n, [&](std::size_t, int) { return random.coin() ? 0.0 : -0.0; });
  add("few", 2, n, [&](std::size_t, int) { return static_cast<double>(random.below(3)); });
  add("lattice", 3, n, [&](std::size_t i, int axis) {
    return static_cast<double>(i / (axis == 0 ? 1 : axis == 1 ? 10 : 100) % 10);
  });
  add("collinear", 3, n,
      [](std::size_t i, int axis) { return static_cast<double>(i * i % 1009) * (axis + 1); });
  add("flat", 3, n, [&](std::size_t, int axis) { return axis == 1 ? 5.0 : random.uniform(); });
  add("clusters", 2, n, [&](std::size_t i, int) {
    return static_cast<double>(i % 5) + 1e-9 * random.uniform() * random.uniform();
  });
  add("denormals", 2, n, [&](std::size_t, int) { return 5e-324 * static_cast<double>(random.below(9)); });
  add("huge", 3, n, [&](std::size_t, int) { return (random.uniform() - 0.5) * 2 * 1.7e308; });
  add("wide", 2, n, [&](std::size_t i, int) {
    return (random.coin() ? 1 : -1) * std::pow(10.0, static_cast<double>(i % 601) - 300);
  });
  add(
      "weighted", 4, n,
      [&](std::size_t, int axis) { return axis < 3 ? random.uniform() : 1e-3 * random.uniform(); }, true);
  add(
      "weighted equal", 3, n, [&](std::size_t, int) { return static_cast<double>(random.below(4)); }, true);
  return sets;
}

}  // namespace delone::test
