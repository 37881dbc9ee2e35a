// SPDX-License-Identifier: BSD-3-Clause
// Directions, ranges, the points that make the frame, and extents of several parts.
#include "periodic/extent.hpp"

#include "made_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace delone::periodic {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Extent extent_of(const PeriodicSet& set) {
  Extent extent(set);
  for (std::size_t row = 0; row < set.num_points(); ++row)
    extent.add(set.row(row), static_cast<std::int64_t>(row));
  return extent;
}

std::vector<std::int64_t> extreme_rows(const Extent& extent) {
  std::vector<std::int64_t> rows;
  for (const Extent::Extreme& one : extent.extremes()) rows.push_back(one.row);
  return rows;
}

TEST(Extent, DirectionsAreOrthonormalAndRangesHoldAllPoints) {
  // Two skewed vectors in space.
  const PeriodicSet set =
      set_of({0.5, 0.5, 2, 0.25, 0.25, -7, 0.75, 0.5, 0.5}, {1, 0.25, 0, 0.25, 1, 0.5}, 3);
  const Extent extent = extent_of(set);
  ASSERT_EQ(extent.num_free_directions(), 1u);
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      double product = 0;
      for (std::size_t j = 0; j < 3; ++j)
        product += extent.lattice_direction(a)[j] * extent.lattice_direction(b)[j];
      EXPECT_NEAR(product, a == b ? 1 : 0, 1e-15);
    }
    double least = 1e9, largest = -1e9;
    for (std::size_t row = 0; row < set.num_points(); ++row) {
      double along = 0;
      for (std::size_t j = 0; j < 3; ++j) along += extent.lattice_direction(a)[j] * set.row(row)[j];
      least = std::min(least, along);
      largest = std::max(largest, along);
    }
    const double low = a < 2 ? extent.lattice_low(a) : extent.low(0),
                 high = a < 2 ? extent.lattice_high(a) : extent.high(0);
    EXPECT_LE(low, least);
    EXPECT_GE(high, largest);
    EXPECT_NEAR(low, least, 1e-11);
    EXPECT_NEAR(high, largest, 1e-11);
  }
  // Free of the lattice.
  for (std::size_t i = 0; i < 2; ++i) {
    double product = 0;
    for (std::size_t j = 0; j < 3; ++j) product += extent.free_direction(0)[j] * set.period.vector(i)[j];
    EXPECT_NEAR(product, 0, 1e-15);
  }
}

TEST(Extent, ExtremePointsAreInTheMiddleAndAtTheEnds) {
  EXPECT_THAT(extreme_rows(extent_of(set_of({}, {1, 0}, 2))), IsEmpty());
  EXPECT_THAT(extreme_rows(extent_of(set_of({0.1, 5}, {1, 0}, 2))), ElementsAre(0));
  // Middle 1, lowest 3, highest 2; of equally high ones the first.
  EXPECT_THAT(extreme_rows(extent_of(set_of({0.1, 0, 0.5, 0, 0.2, 9, 0.3, -2, 0.9, 9}, {1, 0}, 2))),
              ElementsAre(1, 2, 3));
  EXPECT_THAT(extreme_rows(extent_of(set_of({0.1, 0.1, 0.75, 0.75, 0.5, 0.9}, {1, 0, 0, 1}, 2))),
              ElementsAre(1))
      << "no free direction";
}

TEST(Extent, OfEqualPointsTheHeaviestCounts) {
  const std::vector<double> points{0.5, 0, 0.5, 0, 0.1, 1, 0.1, 1, 0.2, 0.5};
  const Extent extent = extent_of(set_of(points, {1, 0}, 2, {1, 4, 2, 3, -8}));
  EXPECT_THAT(extreme_rows(extent), ElementsAre(1, 3));
  EXPECT_EQ(extent.largest_weight(), 4);
  EXPECT_EQ(extent.weight_range(), 8);
  for (const Extent::Extreme& one : extent.extremes()) EXPECT_EQ(one.point.back(), one.row == 1 ? 4 : 3);
  // The heaviest of all, wherever it is.
  EXPECT_THAT(extreme_rows(extent_of(set_of(points, {1, 0}, 2, {1, 4, 2, 3, 8}))), ElementsAre(1, 3, 4));
}

TEST(Extent, FrameShiftsAreCornersOrAxes) {
  for (std::size_t rank = 1; rank <= 5; ++rank) {
    std::vector<double> lattice(rank * rank, 0), point(rank, 0.5);
    for (std::size_t i = 0; i < rank; ++i) lattice[i * rank + i] = 1;
    const PeriodicSet set = set_of(point, lattice, rank);
    const auto shifts = Extent(set).frame_shifts();
    const std::size_t nonzero = rank <= 4 ? rank : 1;
    EXPECT_EQ(shifts.size(), rank <= 4 ? std::size_t{1} << rank : 2 * rank);
    EXPECT_EQ(std::set<std::vector<std::int32_t>>(shifts.begin(), shifts.end()).size(), shifts.size());
    for (const auto& shift : shifts) {
      ASSERT_EQ(shift.size(), rank);
      std::size_t ones = 0;
      for (const std::int32_t k : shift) ones += std::abs(k) == 1 ? 1 : 0;
      EXPECT_EQ(ones, nonzero);
      EXPECT_EQ(ones + static_cast<std::size_t>(std::count(shift.begin(), shift.end(), 0)), rank);
    }
  }
}

// The extent of the witnesses of several parts is that of all points.
TEST(Extent, WitnessesStandForTheirPoints) {
  const std::vector<double> lattice{1, 0.25, 0, 0, 1, 0.5};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const bool weighted : {false, true}) {
    SetInput input;
    input.lattice = lattice;
    input.dimension = 3;
    input.is_weighted = weighted;
    const std::size_t width = weighted ? 4 : 3, n = 200;
    std::vector<double> points(n * width);
    for (double& x : points) x = uniform(random) - 0.5;
    const PeriodicSet set = make_set_without_rows(input, std::vector<double>(3, 1.0));
    Extent whole(set), merged(set);
    for (std::size_t i = 0; i < n; ++i) whole.add(&points[i * width], static_cast<std::int64_t>(i));
    std::vector<double> witnesses;
    for (std::size_t first = 0; first < n; first += 50) {
      Extent part(set);
      for (std::size_t i = first; i < first + 50; ++i) part.add(&points[i * width], 0);
      const std::vector<double> some = part.witnesses();
      witnesses.insert(witnesses.end(), some.begin(), some.end());
    }
    EXPECT_TRUE(Extent(set).witnesses().empty());
    EXPECT_LT(witnesses.size(), points.size() / 2);
    for (std::size_t at = 0; at < witnesses.size(); at += width)
      merged.add(&witnesses[at], static_cast<std::int64_t>(at));
    EXPECT_EQ(merged.largest_weight(), whole.largest_weight());
    EXPECT_EQ(merged.weight_range(), whole.weight_range());
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(merged.lattice_low(i), whole.lattice_low(i));
      EXPECT_EQ(merged.lattice_high(i), whole.lattice_high(i));
    }
    EXPECT_EQ(merged.low(0), whole.low(0));
    EXPECT_EQ(merged.high(0), whole.high(0));
    const auto found = merged.frame_points(), expected = whole.frame_points();
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(found[i].point, expected[i].point);
  }
}

}  // namespace
}  // namespace delone::periodic
