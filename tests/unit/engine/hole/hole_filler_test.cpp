// SPDX-License-Identifier: BSD-3-Clause
// A hole around a vertex is filled with the cells that there were without the vertex.
#include "engine/hole/refill.hpp"

#include "../engine_support.hpp"

#include "base/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace delone::engine {
namespace {

/// Simplex corners first, then others: 0 in general, 1 on a coarse grid, 2 on one that is off by an ulp here
/// and there.
template <int K>
std::vector<double> rows_of(Index n, int kind) {
  random::Generator random(static_cast<std::uint64_t>(10 * K + kind));
  std::vector<double> rows;
  for (int i = 0; i <= K; ++i)
    for (int j = 0; j < K; ++j) rows.push_back(i == j + 1 ? 4 : 0);
  std::set<std::vector<double>> seen;
  while (seen.size() < n) {
    std::vector<double> x(K);
    for (double& c : x) {
      c = 4 * random.uniform();
      if (kind > 0) c = std::floor(c);
      if (kind == 2 && random.uniform() < 0.3) c = std::nextafter(c, 9.0);
    }
    if (std::count(x.begin(), x.end(), 0.0) >= K - 1 && std::count(x.begin(), x.end(), 4.0) > 0) continue;
    if (std::count(x.begin(), x.end(), 0.0) == K) continue;
    if (seen.insert(x).second) rows.insert(rows.end(), x.begin(), x.end());
  }
  return rows;
}

template <int K>
std::set<std::vector<Index>> cells_without(const std::vector<double>& rows, const std::vector<Index>& gone) {
  Points<K> points(rows, K, 0, 5);
  points.seed();
  const auto n = static_cast<Index>(rows.size() / K);
  for (Index v = K + 2; v <= n; ++v)
    if (std::find(gone.begin(), gone.end(), v) == gone.end()) points.build.insert(v);
  return points.sphere();
}

template <int K>
void expect_filled(Index n, int kind) {
  SCOPED_TRACE(testing::Message() << K << "D, kind " << kind);
  const std::vector<double> rows = rows_of<K>(n, kind);
  Points<K> points(rows, K, 0, 5);
  points.seed();
  const auto last = static_cast<Index>(rows.size() / K);
  for (Index v = K + 2; v <= last; ++v) points.build.insert(v);
  HoleFiller<K, typename Points<K>::Geometry> filler(points.build.cells(), points.build.geometry());
  std::vector<Index> gone;
  const auto cell_of = [&](Index v) {
    for (Index cell = 0;; ++cell)
      if (!points.build.cells().is_vacant(cell)) {
        const std::vector<Index> corners = points.corners(cell);
        if (std::find(corners.begin(), corners.end(), v) != corners.end()) return cell;
      }
  };
  for (Index v = last; v > K + 1; v -= 2) {
    ASSERT_EQ(remove(points.build, v, cell_of(v), filler), Outcome::done);
    for (const Index cell : filler.created()) EXPECT_FALSE(points.build.cells().is_vacant(cell));
    gone.push_back(v);
    ASSERT_EQ(points.sphere(), cells_without<K>(rows, gone)) << "without vertex " << v;
    if (v <= K + 3) break;
  }
}

TEST(HoleFiller, LeavesTheCellsOfTheOtherVertices) {
  for (int kind = 0; kind < 3; ++kind) {
    expect_filled<2>(kind == 1 ? 12 : 40, kind);
    expect_filled<3>(kind == 1 ? 20 : 30, kind);
    expect_filled<4>(18, kind);
    expect_filled<5>(14, kind);
    expect_filled<6>(10, kind);
    expect_filled<7>(8, kind);
  }
}

TEST(HoleFiller, DoesNotRemoveTheApexOfAPyramid) {
  // Four points of a plane, and one above.
  Points<3> points({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 0}, 3, 0, 2);
  points.seed();
  points.build.insert(5);
  HoleFiller<3, Points<3>::Geometry> filler(points.build.cells(), points.build.geometry());
  const auto before = points.sphere();
  Index cell = 0;
  while (points.build.cells().is_vacant(cell) || points.build.cells().slot_of_vertex(cell, 4) < 0 ||
         points.build.cells().slot_of_vertex(cell, 4) > 3)
    ++cell;
  EXPECT_EQ(remove(points.build, 4, cell, filler), Outcome::flat);
  EXPECT_EQ(points.sphere(), before);
  for (Index c = 0; c < points.build.cells().num_slots(); ++c)
    EXPECT_TRUE(points.build.cells().is_vacant(c) || points.build.cells().mark(c) == Mark::unseen);
}

}  // namespace
}  // namespace delone::engine
