// SPDX-License-Identifier: BSD-3-Clause
// Rows computed where they are needed are those of the frame, bit for bit.
#include "geometry/vertex_rows.hpp"

#include "base/random.hpp"
#include "geometry/frame.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace delone::geometry {
namespace {

/// In boxes of all sizes and places, down to denormal numbers.
TEST(VertexRows, AreThoseOfTheFrame) {
  constexpr int K = 2;
  static_assert(can_compute_rows(K));
  constexpr auto k = static_cast<std::size_t>(K);
  constexpr std::size_t n = 20;
  random::Generator generator(1);
  for (std::size_t round = 0; round < test::scaled_count(300); ++round) {
    std::vector<double> points((n + 1) * k);
    std::vector<double> low(k), high(k);
    for (std::size_t r = 0; r < k; ++r) {
      const double extent = std::ldexp(1.0, static_cast<int>(generator.below(1600)) - 1074);
      const double place = generator.below(2) == 0 ? 0.0 : (2 * generator.uniform() - 1) * extent * 1e3;
      for (std::size_t v = 0; v <= n; ++v) points[v * k + r] = place + generator.uniform() * extent;
      low[r] = high[r] = points[r];
      for (std::size_t v = 0; v <= n; ++v) {
        low[r] = std::min(low[r], points[v * k + r]);
        high[r] = std::max(high[r], points[v * k + r]);
      }
    }
    const Frame frame(low, high);
    const VertexRows rows(points.data(), frame.center().data(), frame.scale().data(), frame.lift_scale());
    std::vector<double> array;
    for (Index v = 0; v <= n; ++v) {
      const double* point = &points[v * k];
      const auto row = rows.row<K>(v, K);
      for (std::size_t r = 0; r < k; ++r) {
        array.push_back(frame.image(point, static_cast<int>(r)));
        EXPECT_EQ(std::bit_cast<std::uint64_t>(row[r]), std::bit_cast<std::uint64_t>(array.back()));
      }
      array.push_back(frame.lift(point));
      EXPECT_EQ(std::bit_cast<std::uint64_t>(row[k]), std::bit_cast<std::uint64_t>(array.back()));
    }
    const VertexRows kept(array.data());
    for (Index v = 0; v <= n; ++v) {
      const auto row = kept.row<K>(v, K);
      EXPECT_TRUE(
          std::equal(row.begin(), row.end(), array.begin() + static_cast<std::ptrdiff_t>(v * (k + 1))));
    }
  }
}

TEST(VertexRows, OfManyDimensionsAreAnArray) {
  const std::vector<double> array{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  EXPECT_EQ(VertexRows(array.data()).row<5>(1, 5), array.data() + 6);
  EXPECT_EQ(VertexRows(array.data()).row<0>(2, 3), array.data() + 8);
}

}  // namespace
}  // namespace delone::geometry
