// SPDX-License-Identifier: BSD-3-Clause
// The sieve removes interior rows only, as the hull of all rows says, and most of them where that is easy.
// Equal rows stay or go together.
#include "hull/point_sieve.hpp"

#include "degenerate.hpp"
#include "hull/hull_analysis.hpp"
#include "scale.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

namespace delone::hull {
namespace {

std::size_t check(const std::vector<double>& rows, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  PointSieve sieve(rows, dimension);
  sieve.run();
  const std::vector<Index> remaining = sieve.remaining_rows();
  EXPECT_TRUE(std::is_sorted(remaining.begin(), remaining.end()));
  for (const Index row : sieve.shell_rows())
    EXPECT_TRUE(std::binary_search(remaining.begin(), remaining.end(), row));
  HullState state(dimension);
  Options as_given;  // without a sieve
  as_given.order = InsertionOrder::as_given;
  state.insert_range(rows, as_given);
  const HullAnalysis analysis(state);
  std::map<std::vector<double>, bool> stays;
  for (std::size_t row = 0; row < state.num_rows(); ++row) {
    const bool remains = std::binary_search(remaining.begin(), remaining.end(), row);
    const auto first = static_cast<std::size_t>(state.row(state.site_of_row(row)));
    if (!remains) {
      EXPECT_EQ(analysis.kinds()[first], PointKind::interior) << row;
    }
    std::vector<double> point(rows.begin() + static_cast<std::ptrdiff_t>(row * d),
                              rows.begin() + static_cast<std::ptrdiff_t>((row + 1) * d));
    for (double& x : point) x += 0.0;
    EXPECT_EQ(stays.emplace(point, remains).first->second, remains);
  }
  return remaining.size();
}

TEST(PointSieve, RemovesInteriorRowsOnly) {
  const int most = static_cast<int>(test::scaled_size(6, 3));
  for (int d = 2; d <= most; ++d) {
    const std::size_t n = d < 6 ? test::scaled_size(1500, 500) : 500;
    for (const char* kind : {"uniform", "ball", "sphere"}) check(make_point_set(kind, d, n, 3), d);
    check(test::small_integers(d, n, -2, 2, 5).points, d);
    check(test::small_integers(d, n, -20, 20, 6).points, d);
  }
}

TEST(PointSieve, RemovesMostOfManyRows) {
  EXPECT_LT(check(make_point_set("uniform", 2, 20000, 1), 2), 600u);
  EXPECT_LT(check(make_point_set("uniform", 3, 20000, 1), 3), 2500u);
  EXPECT_LT(check(make_point_set("ball", 3, 20000, 1), 3), 5000u);
}

// The larger the error of coordinates, the more rows remain: all, if it is as large as the points.
TEST(PointSieve, LeavesRoomForRoundedPoints) {
  const std::vector<double> rows = make_point_set("ball", 3, 3000, 1);
  std::size_t before = 0;
  for (const double relative_error : {0.0, 0x1p-50, 0.01, 0.1, 1.0}) {
    PointSieve sieve(rows, 3, relative_error);
    sieve.run();
    EXPECT_GE(sieve.num_remaining(), before);
    before = sieve.num_remaining();
  }
  EXPECT_EQ(before, 3000u);
}

TEST(PointSieve, HasNoShellForFlatAndExtremeInput) {
  std::vector<double> flat = make_point_set("uniform", 3, 500, 1);
  for (std::size_t i = 2; i < flat.size(); i += 3) flat[i] = 1;
  std::vector<double> tilted = flat, huge = make_point_set("uniform", 3, 500, 1);
  for (std::size_t i = 2; i < tilted.size(); i += 3) tilted[i] = tilted[i - 1];
  for (double& x : huge) x = (x - 0.5) * 0x1.fp1023;
  for (const auto& rows : {flat, tilted, huge}) {
    PointSieve sieve(rows, 3);
    sieve.run();
    EXPECT_FALSE(sieve.has_shell());
    EXPECT_EQ(sieve.remaining_rows().size(), 500u);
  }
}

}  // namespace
}  // namespace delone::hull
