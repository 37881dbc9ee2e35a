// SPDX-License-Identifier: BSD-3-Clause
// What samples say of larger sets, and what they cannot say.
#include "forecast/growth.hpp"

#include "forecast/model/cell_counts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace delone::cost_model {
namespace {

/// Samples in k dimensions whose cells per point are those of points spread evenly, times a function.
std::vector<SampleCost> grown_samples(int k, double (*factor)(double)) {
  std::vector<SampleCost> samples;
  for (double v = 32; v <= 2048; v *= 2) {
    const Cost spread = cost_of_spread(k, v);
    samples.push_back({v, k, spread.cells * factor(v), spread.infinite_cells, spread.created_cells, 1e-3});
  }
  return samples;
}

TEST(Growth, CellsBesideThoseOfPointsSpreadEvenlyGoOnAsSeen) {
  constexpr double v = 1e6;
  const double spread = cost_of_spread(3, v).cells;
  const auto grown = [&](double (*factor)(double)) {
    return grown_cells(grown_samples(3, factor), v).cells / spread;
  };
  EXPECT_NEAR(grown([](double) { return 1.0; }), 1, 1e-9);
  EXPECT_NEAR(grown([](double x) { return std::exp(3 / std::cbrt(x)); }), std::exp(0.03), 0.02);
  EXPECT_NEAR(grown([](double x) { return std::sqrt(x); }), std::sqrt(v), 0.05 * std::sqrt(v));
}

TEST(Growth, SamplesOfEquallyManyDistinctPointsTellNoGrowth) {
  const SampleCost sample{20, 3, 70, 30, 150, 1e-3};
  const std::vector<SampleCost> samples{sample, sample};
  EXPECT_TRUE(std::isfinite(grown_cells(samples, 900).cells));
  EXPECT_TRUE(std::isfinite(grown_cost(samples, 3, 1000, 900, 5000).bytes));
}

TEST(Growth, IsCertainWhereAllLawsAgree) {
  for (const int k : {2, 3, 8, 11}) {
    const std::vector<SampleCost> samples = grown_samples(k, [](double) { return 1.0; });
    const double doublings = 3, spread = k <= largest_measured_dimension ? 0 : 0.15 * doublings * std::log(2);
    EXPECT_NEAR(std::log(grown_cells(samples, 2048 * 8).factor), 0.02 + 0.03 * doublings + spread, 1e-6) << k;
    EXPECT_NEAR(std::log(grown_cells(samples, 2048).factor), 0.02, 1e-6) << k;
  }
}

TEST(Growth, FewPointsTellNothing) {
  // 2k + 1 points in space: what they have beyond points spread evenly vanishes like v^(−1/3), or it stays.
  const double points = 7, spread = cost_of_spread(3, points).cells;
  const std::vector<SampleCost> samples{{points - 1, 3, spread, 10, 20, 1e-6},
                                        {points, 3, 2 * spread, 10, 20, 1e-6}};
  const GrownCells grown = grown_cells(samples, 8 * points);
  EXPECT_NEAR(grown.cells, std::sqrt(2.0) * cost_of_spread(3, 8 * points).cells, 1e-6 * grown.cells);
  EXPECT_NEAR(std::log(grown.factor), 0.5 * std::log(2.0) + 0.02 + 0.03 * 3, 1e-6);
}

TEST(Growth, HasTheLimitOfAnyTriangulation) {
  const auto steep = [](double x) { return x * x; };
  EXPECT_EQ(grown_cells(grown_samples(3, steep), 1e5).cells, most_cells(3, 1e5));
}

TEST(GrownCost, OfTheSampleIsThatOfTheSample) {
  for (const bool is_hard : {false, true}) {
    std::vector<SampleCost> samples = grown_samples(3, [](double) { return 1.5; });
    SampleCost& last = samples.back();
    last.is_hard = is_hard;
    last.created_cells = 10 * last.cells;
    const Cost cost = grown_cost(samples, 3, last.points, last.points, last.cells);
    EXPECT_EQ(cost.cells, last.cells);
    EXPECT_EQ(cost.vertices, last.points);
    EXPECT_NEAR(cost.infinite_cells, last.infinite_cells, 1e-9 * last.infinite_cells);
    EXPECT_NEAR(cost.created_cells, last.created_cells, 1e-9 * last.created_cells);
    EXPECT_NEAR(cost.seconds, last.seconds, 1e-12);
  }
}

TEST(GrownCost, CreatesEveryCellOnceAtLeast) {
  std::vector<SampleCost> samples = grown_samples(3, [](double) { return 1.0; });
  samples.back().created_cells = 1;
  const Cost cost = grown_cost(samples, 3, 1e6, 1e6, 5e6);
  EXPECT_EQ(cost.created_cells, cost.cells + cost.infinite_cells);
  // As many infinite cells as there are at all, if the samples had nearly none but them.
  samples.back().infinite_cells = samples.back().cells * 1e9;
  const Cost full = grown_cost(samples, 3, 1e6, 1e6, most_cells(3, 1e6) - 100);
  EXPECT_NEAR(full.infinite_cells, 100, 1e-3);
}

}  // namespace
}  // namespace delone::cost_model
