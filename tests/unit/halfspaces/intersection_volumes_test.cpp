// SPDX-License-Identifier: BSD-3-Clause
// Volumes of intersections of hulls against boxes, whose intersections are known, and against the hull of the
// vertices of the intersection of all halfspaces.
#include <delone/convex_hulls.hpp>
#include <delone/halfspaces.hpp>

#include "degenerate.hpp"
#include "error_code.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone::halfspaces {
namespace {

using test::code_of;
using ::testing::ElementsAre;
using Numbers = std::vector<double>;
using Sizes = std::vector<std::size_t>;

Sizes all_pairs(std::size_t n) {
  Sizes pairs;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) pairs.insert(pairs.end(), {a, b});
  return pairs;
}

/// The corners of a box.
void add_box(const Numbers& low, const Numbers& high, Numbers& points) {
  for (std::size_t corner = 0; corner < std::size_t{1} << low.size(); ++corner)
    for (std::size_t j = 0; j < low.size(); ++j) points.push_back((corner >> j & 1) != 0 ? high[j] : low[j]);
}

TEST(IntersectionVolumes, BoxesOfALattice) {
  for (std::size_t d = 1; d <= 5; ++d) {
    test::Random random(d);
    std::vector<Numbers> lows, highs;
    Numbers points;
    Sizes offsets{0};
    for (int box = 0; box < 8; ++box) {
      Numbers low, high;
      for (std::size_t j = 0; j < d; ++j) {
        low.push_back(random.integer(0, 3));
        high.push_back(low.back() + random.integer(box == 7 ? 0 : 1, 3));  // the last may be flat
      }
      add_box(low, high, points);
      offsets.push_back(points.size() / d);
      lows.push_back(low);
      highs.push_back(high);
    }
    const Sizes pairs = all_pairs(8);
    const ConvexHulls hulls = convex_hulls(points, static_cast<int>(d), offsets);
    const Numbers volumes = intersection_volumes(points, hulls, pairs);
    EXPECT_EQ(volumes, intersection_volumes(points, hulls, pairs, {.threads = 3}));
    for (std::size_t i = 0; i < volumes.size(); ++i) {
      double expected = 1;
      for (std::size_t j = 0; j < d; ++j)
        expected *= std::max(0.0, std::min(highs[pairs[2 * i]][j], highs[pairs[2 * i + 1]][j]) -
                                      std::max(lows[pairs[2 * i]][j], lows[pairs[2 * i + 1]][j]));
      EXPECT_NEAR(volumes[i], expected, 1e-12 * std::pow(6.0, static_cast<double>(d)))
          << "dimension " << d << ", pair " << i;
    }
  }
}

TEST(IntersectionVolumes, AreThoseOfAllHalfspaces) {
  for (int d = 2; d <= 4; ++d)
    for (const double scale : {1.0, 1e-100, 1e60}) {
      const auto width = static_cast<std::size_t>(d);
      Numbers points = make_point_set("uniform", d, 60, 3);
      for (double& x : points) x *= scale;
      const Sizes offsets{0, 10, 20, 30, 40, 50, 60}, pairs = all_pairs(6);
      const ConvexHulls hulls = convex_hulls(points, d, offsets);
      const Numbers volumes = intersection_volumes(points, hulls, pairs);
      for (std::size_t i = 0; i < volumes.size(); ++i) {
        Numbers rows;
        for (const std::size_t hull : {pairs[2 * i], pairs[2 * i + 1]})
          rows.insert(
              rows.end(),
              hulls.equations.begin() + static_cast<std::ptrdiff_t>(hulls.cell_offsets[hull] * (width + 1)),
              hulls.equations.begin() +
                  static_cast<std::ptrdiff_t>(hulls.cell_offsets[hull + 1] * (width + 1)));
        const double expected = HalfspaceIntersection<>(rows, d).volume().value;
        EXPECT_NEAR(volumes[i], expected, 1e-11 * std::max(expected, hulls.volumes[pairs[2 * i]]))
            << d << ", " << i;
      }
    }
}

TEST(IntersectionVolumes, HullsThatTouchOrContainEachOther) {
  Numbers points;
  add_box({0, 0}, {2, 2}, points);
  add_box({2, 0}, {3, 2}, points);      // a common edge
  add_box({2, 2}, {3, 3}, points);      // a common corner
  add_box({0.5, 0.5}, {1, 1}, points);  // inside
  add_box({0, 0}, {1, 1}, points);      // inside, with a common corner
  points.insert(points.end(), {1, 1, 1, 1, 1, 1, 1, 1});
  const ConvexHulls hulls = convex_hulls(points, 2, Sizes{0, 4, 8, 12, 16, 20, 24, 24});
  const Sizes pairs{0, 1, 0, 2, 0, 3, 3, 0, 0, 4, 0, 5, 5, 5, 0, 6, 0, 0};
  EXPECT_THAT(intersection_volumes(points, hulls, pairs), ElementsAre(0, 0, 0.25, 0.25, 1, 0, 0, 0, 4));
}

TEST(IntersectionVolumes, BadInputIsAnError) {
  Numbers points;
  add_box({0, 0}, {1, 1}, points);
  const ConvexHulls hulls = convex_hulls(points, 2, Sizes{0, 4});
  EXPECT_EQ(code_of([&] { intersection_volumes(points, hulls, Sizes{0, 1}); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { intersection_volumes(points, hulls, Sizes{0}); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] {
              intersection_volumes(Numbers{0, 0, 1, 1}, hulls, Sizes{0, 0});
            }),
            Errc::invalid_argument);
  EXPECT_EQ(code_of([&] {
              intersection_volumes(points, hulls, Sizes(20000, 0),
                                   {.progress = [](double) { return false; }});
            }),
            Errc::cancelled);
  EXPECT_TRUE(intersection_volumes(points, hulls, Sizes()).empty());
}

}  // namespace
}  // namespace delone::halfspaces
