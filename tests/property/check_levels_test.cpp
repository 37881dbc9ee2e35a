// SPDX-License-Identifier: BSD-3-Clause
// Every triangulation passes every level of check, exactly and canonically: sizes that exercise filters and
// memory, and all kinds of point sets.
#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>

#include <gtest/gtest.h>

namespace delone {
namespace {

using test::PointSet;

// Triangulates and checks; returns the report for more questions.
CheckReport expect_correct(const PointSet& set, const Options& options = {}) {
  const Delaunay<> triangulation(set.points, set.dimension, options);
  const ComplexData data = triangulation.to_data();
  CheckOptions all;
  all.canonical = true;
  const CheckReport report = check(data, all);
  EXPECT_TRUE(report.ok) << set.name << " in " << set.dimension << "D, " << set.size() << " points: level "
                         << report.reached.number << ": " << report.violation;
  EXPECT_EQ(data.num_cells(), triangulation.num_finite_cells());
  EXPECT_EQ(triangulation.num_points(), set.size());
  return report;
}

TEST(CheckLevels, UniformPoints) {
  const struct {
    int dimension;
    std::size_t n;
  } cases[] = {{1, 20000}, {2, 40000}, {3, 40000}, {4, 4000}, {5, 800}, {6, 200},
               {7, 80},    {8, 50},    {9, 30},    {10, 22},  {11, 19}, {12, 18}};
  for (const auto& [d, n] : cases) {
    const CheckReport report =
        expect_correct({"uniform", d, make_point_set("uniform", d, test::scaled_count(n), 1)});
    EXPECT_EQ(report.ties, 0u);
  }
}

TEST(CheckLevels, UniformPointsOneAfterTheOther) {
  Options options;
  options.order = InsertionOrder::as_given;
  for (const int d : {2, 3, 4, 5, 6})
    expect_correct({"uniform", d,
                    make_point_set("uniform", d,
                                   test::scaled_count(d <= 3   ? 3000
                                                      : d == 4 ? 1000
                                                               : 200),
                                   2)},
                   options);
}

TEST(CheckLevels, LatticesAreAllTies) {
  const struct {
    int d;
    std::size_t usual_side, small_side;
  } cases[] = {{1, 1000, 1000}, {2, 120, 50}, {3, 24, 11}, {4, 8, 5}, {5, 4, 3}, {6, 3, 2}};
  for (const auto& [d, usual_side, small_side] : cases) {
    const int side = static_cast<int>(test::scaled_size(usual_side, small_side));
    const CheckReport report = expect_correct(test::lattice(d, side));
    EXPECT_TRUE(d == 1 || report.ties > 0);
    // A lattice far from the origin, where |x|² leaves binary64.
    expect_correct(test::shifted(test::lattice(d, std::min(side, 12)), {1e8, -3e7, 5e9}, 1.0));
    // And one unit in the last place beside every tie: nearly every decision is exact and costs accordingly.
    const PointSet part = test::sampled(test::lattice(d, std::min(side, 12)),
                                        d <= 3   ? 2000
                                        : d == 4 ? 250
                                        : d == 5 ? 100
                                                 : 40,
                                        3);
    expect_correct(test::nudged(test::shifted(part, {1, 3, 2}, 1.0), 4));
  }
}

TEST(CheckLevels, ZeroOneVectors) {
  for (int d = 1; d <= static_cast<int>(test::scaled_size(7, 6)); ++d) expect_correct(test::lattice(d, 2));
  // Samples of 8 … 10 dimensions: all vectors together have some 10^5 … 10^7 cells.
  for (int d = 8; d <= 10; ++d)
    expect_correct(test::sampled(test::lattice(d, 2),
                                 d == 8 ? test::scaled_size(40, 24) : test::scaled_size(24, 18), 5));
}

TEST(CheckLevels, EveryNamedKind) {
  for (const PointSetKind& kind : point_set_kinds())
    for (int d = 1; d <= 6; ++d) {
      static constexpr std::size_t usual[] = {1000, 1000, 500, 150, 60, 30};
      std::vector<double> points;
      try {
        // Exact determinants over many scales have thousands of bits each.
        const std::size_t n = kind.name == "mixed_scales" ? 60 / static_cast<std::size_t>(d) : usual[d - 1];
        points = make_point_set(kind.name, d, test::scaled_count(n), 6);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Errc::invalid_argument)
            << kind.name << ' ' << d;  // kinds that do not exist in d dimensions
        continue;
      }
      expect_correct({std::string(kind.name), d, std::move(points)});
    }
}

TEST(CheckLevels, DegenerateSets) {
  static constexpr std::size_t usual[] = {400, 400, 200, 100, 50, 24}, small[] = {200, 200, 100, 50, 25, 16};
  for (int d = 1; d <= 6; ++d)
    for (const PointSet& set : test::degenerate_sets(d, test::scaled_size(usual[d - 1], small[d - 1]), 11)) {
      const CheckReport report = expect_correct(set);
      ASSERT_TRUE(report.ok) << test::to_text(set.points, d);
    }
}

TEST(CheckLevels, FlatsInHighDimensions) {
  for (const int d : {9, 12, 20, 40})
    for (int k = 1; k <= 3; ++k) {
      const PointSet flat = test::small_integers(k, 60, -9, 9, 1);
      expect_correct(test::embedded(flat, d, true, static_cast<std::uint64_t>(d)));
    }
}

}  // namespace
}  // namespace delone
