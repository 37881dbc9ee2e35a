// SPDX-License-Identifier: BSD-3-Clause
// The ridges of a star: linking by hash gives what rotating about every ridge gives.
#include "engine/ridge_table.hpp"

#include "engine/build.hpp"
#include "engine/seed.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "kernel/predicates.hpp"
#include "random.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace delone::engine {
namespace {

/// The links of all cells after the insertion of points one by one, ridges hashed `rounds` times.
template <int K>
std::vector<Index> links(Index n, double grid_size, int rounds) {
  std::vector<double> points(K, 0.0);
  kernel::Grid grid(K);
  kernel::AffineHull hull(K);
  std::vector<Index> simplex, others;
  random::Generator random(7);
  for (Index v = 1; v <= n; ++v) {
    std::vector<double> x(K);
    for (double& c : x) c = grid_size > 0 ? std::floor(random.uniform() * grid_size) : random.uniform();
    points.insert(points.end(), x.begin(), x.end());
    grid.include(x.data());
    (hull.add(x.data()) ? simplex : others).push_back(v);
  }
  std::vector<int> axes(K);
  std::iota(axes.begin(), axes.end(), 0);
  CellMemory<K> memory(K);
  CellStore<K> cells(memory);
  geometry::DelaunayGeometry<K> geometry(memory, axes, K, points, grid,
                                         {std::vector<double>(K, 0.0), std::vector<double>(K, std::max(1.0, grid_size))});
  geometry.set_rows(n);
  if (geometry.orientation(simplex.data()) == Sign::negative) std::swap(simplex[0], simplex[1]);
  seed(cells, geometry, simplex);
  Workspace work;
  work.ridges = RidgeTable(rounds);
  Effort effort;
  Index start = 0;
  for (const Index v : others)
    if (insert(cells, geometry, v, geometry.make_query(geometry.point(v)), start, work, effort) == v)
      start = work.star().back().created;
  std::vector<Index> all;
  for (Index cell = 0; cell < cells.num_slots(); ++cell)
    if (!cells.is_vacant(cell)) all.insert(all.end(), cells.vertices(cell), cells.vertices(cell) + 2 * (K + 1));
  return all;
}

template <int K>
void expect_hashing_finds_what_rotation_finds(Index n, double grid_size) {
  SCOPED_TRACE(testing::Message() << "dimension " << K << ", " << n << " points");
  const auto by_rotation = links<K>(n, grid_size, 0);
  EXPECT_GT(by_rotation.size(), static_cast<std::size_t>(n));
  EXPECT_EQ(by_rotation, links<K>(n, grid_size, 1));  // what one round leaves, by rotation
  EXPECT_EQ(by_rotation, links<K>(n, grid_size, 6));
}

TEST(RidgeTable, FindsWhatRotationFinds) {
  expect_hashing_finds_what_rotation_finds<1>(30, 0);
  expect_hashing_finds_what_rotation_finds<2>(200, 0);
  expect_hashing_finds_what_rotation_finds<3>(300, 0);
  expect_hashing_finds_what_rotation_finds<3>(300, 6);
  expect_hashing_finds_what_rotation_finds<4>(150, 0);
  expect_hashing_finds_what_rotation_finds<5>(80, 3);
  expect_hashing_finds_what_rotation_finds<6>(40, 0);
  expect_hashing_finds_what_rotation_finds<8>(20, 0);  // a cell's ids in more than one vector
  expect_hashing_finds_what_rotation_finds<9>(18, 2);
}

// More half-ridges in a star than half of the bits of an entry can number.
TEST(RidgeTable, FindsWhatRotationFindsInLargeStars) {
  expect_hashing_finds_what_rotation_finds<7>(static_cast<Index>(std::max<std::size_t>(test::scaled_count(150), 40)), 0);
}

}  // namespace
}  // namespace delone::engine
