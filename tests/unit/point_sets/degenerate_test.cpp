// SPDX-License-Identifier: BSD-3-Clause
// Sets that are exactly degenerate: spheres, hyperplanes, lines, repetitions.
#include "point_sets_support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

namespace delone {
namespace {

__extension__ typedef __int128 Wide;

TEST(DegeneratePointSets, CosphericalPointsAreExactlyOnASphereAndDistinct) {
  for (int d : {2, 3, 4, 5, 8, 33})
    for (std::size_t n : {1u, 10u, 3000u}) {
      const Rows rows = make("cospherical", d, n);
      std::set<std::vector<double>> distinct(rows.begin(), rows.end());
      EXPECT_EQ(distinct.size(), n) << d;
      std::set<Wide> norms;
      for (const auto& row : rows) {
        Wide sum = 0;
        for (double v : row) {
          ASSERT_EQ(v, std::trunc(v));
          ASSERT_LT(std::abs(v), 0x1p53);
          sum += static_cast<Wide>(v) * static_cast<Wide>(v);
        }
        norms.insert(sum);
      }
      EXPECT_EQ(norms.size(), 1u) << d << " " << n;
    }
}

TEST(DegeneratePointSets, CosphericalPointsSpanTheSpace) {
  for (int d : {2, 3, 9}) {
    const Rows rows = make("cospherical", d, 500);
    for (std::size_t j = 0; j < static_cast<std::size_t>(d); ++j) {
      std::set<double> values;
      for (const auto& row : rows) values.insert(row[j]);
      EXPECT_GT(values.size(), 5u) << d << " " << j;
    }
  }
}

TEST(DegeneratePointSets, FlatPointsAreExactlyInAHyperplane) {
  for (int d : {2, 3, 7}) {
    // Coordinates are multiples of 2^−30: integers after scaling. The slopes are recovered by trying all that
    // are possible.
    const Rows rows = make("flat", d, 200);
    const auto integer = [](double v) { return static_cast<std::int64_t>(v * 0x1p30); };
    std::vector<std::int64_t> slope(static_cast<std::size_t>(d) - 1, -3);
    bool found = false;
    while (!found) {
      found = std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
        std::int64_t rest = integer(row.back());
        for (std::size_t j = 0; j < slope.size(); ++j) rest -= slope[j] * integer(row[j]);
        return rest == 0;
      });
      if (found) break;
      std::size_t j = 0;
      while (j < slope.size() && ++slope[j] > 3) slope[j++] = -3;
      if (j == slope.size()) break;
    }
    EXPECT_TRUE(found) << d;
    for (const auto& row : rows)
      for (double v : row) EXPECT_EQ(v * 0x1p30, std::trunc(v * 0x1p30));
  }
}

TEST(DegeneratePointSets, CollinearPointsAreExactlyOnALine) {
  const Rows rows = make("collinear", 4, 100);
  const auto integer = [](double v) { return static_cast<Wide>(v * 0x1p30); };
  for (const auto& row : rows)
    for (std::size_t j = 1; j < 4; ++j)
      EXPECT_TRUE((integer(row[0]) - integer(rows[0][0])) * (integer(rows[1][j]) - integer(rows[0][j])) ==
                  (integer(row[j]) - integer(rows[0][j])) * (integer(rows[1][0]) - integer(rows[0][0])));
}

TEST(DegeneratePointSets, Repetitions) {
  const Rows duplicates = make("duplicates", 3, 4000);
  const auto distinct = std::set<std::vector<double>>(duplicates.begin(), duplicates.end()).size();
  EXPECT_TRUE(distinct > 900 && distinct <= 1001) << distinct;
  const Rows equal = make("equal", 3, 100);
  EXPECT_EQ(std::set<std::vector<double>>(equal.begin(), equal.end()).size(), 1u);
}

TEST(DegeneratePointSets, RoundedPointsOfTheUnitSphere) {
  for (const auto& row : make("ulp_sphere", 3, 1000)) {
    double sum = 0;
    for (double v : row) sum += v * v;
    ASSERT_NEAR(sum, 1, 1e-15);
  }
}

}  // namespace
}  // namespace delone
