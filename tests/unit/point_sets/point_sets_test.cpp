// SPDX-License-Identifier: BSD-3-Clause
// Every kind of point set: its size, its reproducibility, and the exact property its name promises.
#include <delone/error.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace delone {
namespace {

__extension__ typedef __int128 Wide;
using Rows = std::vector<std::vector<double>>;

Rows rows_of(const std::vector<double>& x, int d) {
  Rows rows;
  for (auto i = x.begin(); i != x.end(); i += d) rows.emplace_back(i, i + d);
  return rows;
}

Rows make(std::string_view kind, int d, std::size_t n, std::uint64_t seed = 1) {
  return rows_of(make_point_set(kind, d, n, seed), d);
}

Errc error_of(std::string_view kind, int d, std::size_t n) {
  try {
    make_point_set(kind, d, n, 0);
  } catch (const Error& e) {
    return e.code();
  }
  ADD_FAILURE() << kind << " should have thrown";
  return Errc::cancelled;
}

std::uint64_t fingerprint(const std::vector<double>& x) {
  std::uint64_t h = 14695981039346656037u;
  for (double v : x) h = (h ^ std::bit_cast<std::uint64_t>(v)) * 1099511628211u;
  return h;
}

TEST(PointSets, AreListedInAlphabeticalOrder) {
  const auto& kinds = point_set_kinds();
  EXPECT_TRUE(std::is_sorted(kinds.begin(), kinds.end(), [](auto& a, auto& b) { return a.name < b.name; }));
  EXPECT_EQ(kinds.size(), 20u);
  for (const auto& kind : kinds) EXPECT_FALSE(kind.description.empty());
}

TEST(PointSets, HaveTheSizeAskedForFiniteCoordinatesAndDependOnTheSeedOnly) {
  for (const auto& kind : point_set_kinds())
    for (int d : {1, 2, 3, 6, 70})
      for (std::size_t n : {0u, 1u, 2u, 50u}) {
        const std::string name(kind.name);
        if (d == 1 && (name == "flat" || name == "cospherical" || name == "ulp_sphere")) {
          EXPECT_EQ(error_of(name, d, n), Errc::invalid_argument);
          continue;
        }
        const auto x = make_point_set(name, d, n, 7);
        const std::size_t expected =
            name == "cube01" && d < 6 ? std::min<std::size_t>(n, std::size_t{1} << d) : n;
        EXPECT_EQ(x.size(), expected * static_cast<std::size_t>(d)) << name << " " << d;
        for (double v : x) EXPECT_TRUE(std::isfinite(v)) << name;
        EXPECT_EQ(x, make_point_set(name, d, n, 7)) << name;
        if (n == 50 && name != "grid" && name != "cube01" && !(name == "sphere" && d == 1) &&
            !(name == "tilted_grid" && d == 1)) {
          EXPECT_NE(x, make_point_set(name, d, n, 8)) << name << " " << d;
        }
      }
}

TEST(PointSets, TheSameBitsOnEveryPlatform) {
  // Golden values: a change of a generator changes published data sets, and must be a decision.
  const std::map<std::string_view, std::uint64_t> golden{
      {"ball", 0x59d8a7771426e114u},       {"clusters", 0xa8b734b6cd71275cu},
      {"collinear", 0xd73e939c95ef4315u},  {"cospherical", 0x2bb9c092fe7f4315u},
      {"cube01", 0x68d23fd7003c2305u},     {"duplicates", 0xac10d031105ed1fcu},
      {"equal", 0x3c39e125653d6385u},      {"flat", 0x51d81b4197df4315u},
      {"gaussian", 0x10ad2153b4b37431u},   {"grid", 0x6cd11692fe7f4315u},
      {"manifold", 0x4882a055e9ee9b98u},   {"mixed_scales", 0x346ffa71df826bd6u},
      {"moment", 0x7c8ac017e752be29u},     {"nudged_grid", 0xa7040fecd441a82au},
      {"offset", 0x2494aa37038e6765u},     {"plummer", 0xc16b803f2f9c9a56u},
      {"sphere", 0xdb2b39c46842f859u},     {"tilted_grid", 0x1bd91692fe7f4315u},
      {"ulp_sphere", 0x85e46800667d119eu}, {"uniform", 0x671c3e2e9083c5adu}};
  for (const auto& kind : point_set_kinds()) {
    const auto found = golden.find(kind.name);
    ASSERT_NE(found, golden.end()) << kind.name;
    EXPECT_EQ(fingerprint(make_point_set(kind.name, 3, 100, 1)), found->second) << kind.name;
  }
}

TEST(PointSets, Errors) {
  EXPECT_EQ(error_of("no_such_kind", 3, 10), Errc::invalid_argument);
  EXPECT_EQ(error_of("uniform", 0, 10), Errc::invalid_argument);
  EXPECT_EQ(error_of("uniform", -1, 10), Errc::invalid_argument);
  EXPECT_EQ(error_of("cospherical", 2, 200000), Errc::invalid_argument);
  EXPECT_EQ(error_of("uniform", 1000, ~std::size_t{0} / 1000), Errc::too_many);
}

TEST(PointSets, CosphericalPointsAreExactlyOnASphereAndDistinct) {
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

TEST(PointSets, CosphericalPointsSpanTheSpace) {
  for (int d : {2, 3, 9}) {
    const Rows rows = make("cospherical", d, 500);
    for (std::size_t j = 0; j < static_cast<std::size_t>(d); ++j) {
      std::set<double> values;
      for (const auto& row : rows) values.insert(row[j]);
      EXPECT_GT(values.size(), 5u) << d << " " << j;
    }
  }
}

TEST(PointSets, FlatPointsAreExactlyInAHyperplane) {
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

TEST(PointSets, CollinearPointsAreExactlyOnALine) {
  const Rows rows = make("collinear", 4, 100);
  const auto integer = [](double v) { return static_cast<Wide>(v * 0x1p30); };
  for (const auto& row : rows)
    for (std::size_t j = 1; j < 4; ++j)
      EXPECT_TRUE((integer(row[0]) - integer(rows[0][0])) * (integer(rows[1][j]) - integer(rows[0][j])) ==
                  (integer(row[j]) - integer(rows[0][j])) * (integer(rows[1][0]) - integer(rows[0][0])));
}

TEST(PointSets, Lattices) {
  EXPECT_EQ(make("grid", 2, 9),
            (Rows{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}, {2, 0}, {2, 1}, {2, 2}}));
  EXPECT_EQ(make("grid", 3, 9).back(), (std::vector<double>{0, 2, 2}));  // side 3
  EXPECT_EQ(make("grid", 1, 4), (Rows{{0}, {1}, {2}, {3}}));
  EXPECT_EQ(make("grid", 3, 1000).back(), (std::vector<double>{9, 9, 9}));
  EXPECT_EQ(make("grid", 6, 4096).back(), std::vector<double>(6, 3));
  EXPECT_EQ(make("cube01", 3, 100),
            (Rows{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}, {1, 0, 0}, {1, 0, 1}, {1, 1, 0}, {1, 1, 1}}));
  const Rows tilted = make("tilted_grid", 3, 125);
  EXPECT_EQ(std::set<std::vector<double>>(tilted.begin(), tilted.end()).size(), 125u);
  for (const auto& row : tilted)
    for (double v : row) EXPECT_EQ(v, std::trunc(v));
}

TEST(PointSets, NudgedGridIsWithinOneUnitInTheLastPlace) {
  const Rows grid = make("grid", 3, 64), nudged = make("nudged_grid", 3, 64);
  int moved[3] = {};
  for (std::size_t i = 0; i < 64; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double v = grid[i][j] + 1, w = nudged[i][j];
      ASSERT_TRUE(w == v || w == std::nextafter(v, 0) || w == std::nextafter(v, 10)) << w;
      ++moved[w < v ? 0 : w > v ? 2 : 1];
    }
  for (int count : moved) EXPECT_GT(count, 30);
}

TEST(PointSets, SpheresAndBalls) {
  for (int d : {1, 2, 3, 10}) {
    std::vector<double> mean(static_cast<std::size_t>(d));
    for (const auto& row : make("sphere", d, 4000)) {
      double sum = 0;
      for (std::size_t j = 0; j < row.size(); ++j) sum += row[j] * row[j], mean[j] += row[j] / 4000;
      ASSERT_NEAR(sum, 1, 1e-14);
    }
    for (double m : mean) EXPECT_NEAR(m, 0, 5 / std::sqrt(4000.0 * d));
    int inner = 0;
    for (const auto& row : make("ball", d, 4000)) {
      double sum = 0;
      for (double v : row) sum += v * v;
      ASSERT_LE(sum, 1 + 1e-14);
      inner += std::pow(sum, d / 2.0) < 0.5;  // half of the volume
    }
    EXPECT_NEAR(inner, 2000, 160);
  }
  for (const auto& row : make("ulp_sphere", 3, 1000)) {
    double sum = 0;
    for (double v : row) sum += v * v;
    ASSERT_NEAR(sum, 1, 1e-15);
  }
}

TEST(PointSets, GaussianMoments) {
  double m1 = 0, m2 = 0, m4 = 0, beyond_2 = 0;
  const auto x = make_point_set("gaussian", 4, 50000, 3);
  for (double v : x) m1 += v, m2 += v * v, m4 += v * v * v * v, beyond_2 += std::abs(v) > 2;
  const double n = static_cast<double>(x.size());
  EXPECT_NEAR(m1 / n, 0, 0.01);
  EXPECT_NEAR(m2 / n, 1, 0.015);
  EXPECT_NEAR(m4 / n, 3, 0.1);
  EXPECT_NEAR(beyond_2 / n, 0.0455, 0.002);
}

TEST(PointSets, CurvesAndSurfaces) {
  for (const auto& row : make("manifold", 4, 2000)) {
    ASSERT_NEAR(row[3], std::sin(3.14159265358979323846 * row[0]), 4e-16);
    ASSERT_TRUE(row[0] >= 0 && row[0] < 1 && row[1] < 1 && row[2] < 1);
  }
  for (const auto& row : make("moment", 3, 100)) {
    EXPECT_EQ(row[1], row[0] * row[0]);
    EXPECT_EQ(row[2], row[0] * row[0] * row[0]);
  }
}

TEST(PointSets, PlummerHasHalfItsMassWithin1Point305AndBoundSpeeds) {
  int inner = 0;
  for (const auto& row : make("plummer", 6, 4000)) {
    const double r2 = row[0] * row[0] + row[1] * row[1] + row[2] * row[2],
                 v2 = row[3] * row[3] + row[4] * row[4] + row[5] * row[5];
    inner += r2 < 1.3048 * 1.3048;
    EXPECT_LE(v2 / 2, 1 / std::sqrt(1 + r2) * (1 + 1e-9));
  }
  EXPECT_NEAR(inner, 2000, 160);
}

TEST(PointSets, ScalesOffsetsAndRepetitions) {
  std::set<double> offset;
  for (double v : make_point_set("offset", 2, 1000, 1)) {
    ASSERT_TRUE(v >= 4e6 && v < 4001000);
    ASSERT_EQ(v, std::round(v * 1000) / 1000);
    offset.insert(v);
  }
  EXPECT_GT(offset.size(), 1900u);
  int denormal = 0, tiny = 0, huge = 0;
  for (double v : make_point_set("mixed_scales", 3, 3000, 1)) {
    ASSERT_LT(std::abs(v), 1e151);
    denormal += std::fpclassify(v) == FP_SUBNORMAL;
    tiny += std::abs(v) < 1e-200;
    huge += std::abs(v) > 1e100;
  }
  EXPECT_GT(denormal, 300);
  EXPECT_GT(tiny, 1000);
  EXPECT_GT(huge, 500);
  const Rows duplicates = make("duplicates", 3, 4000);
  const auto distinct = std::set<std::vector<double>>(duplicates.begin(), duplicates.end()).size();
  EXPECT_TRUE(distinct > 900 && distinct <= 1001) << distinct;
  const Rows equal = make("equal", 3, 100);
  EXPECT_EQ(std::set<std::vector<double>>(equal.begin(), equal.end()).size(), 1u);
}

}  // namespace
}  // namespace delone
