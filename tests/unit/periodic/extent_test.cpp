// SPDX-License-Identifier: BSD-3-Clause
#include "periodic/extent.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace delone::periodic {
namespace {

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
