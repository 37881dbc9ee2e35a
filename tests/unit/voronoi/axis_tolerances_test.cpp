// SPDX-License-Identifier: BSD-3-Clause
// Diagrams with a tolerance for each axis.
#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/voronoi.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace delone {
namespace {

using testing::ElementsAre;

Voronoi<> diagram_of(const std::vector<double>& points, const std::vector<double>& tolerances) {
  return Voronoi<>(Delaunay<>(points, 2), {.axis_tolerances = tolerances});
}

TEST(AxisTolerances, OfADiagramBoundEachAxis) {
  // The two circumcenters differ by delta/2 along each axis.
  constexpr double delta = 0x1p-10;
  const std::vector<double> points{0, 0, 1, 0, 0, 1 + delta, 1, 1};
  for (const auto& [tolerances, count] : {std::pair{std::vector<double>{0.5, delta}, 1u},
                                          {{delta, 0.5}, 1u},
                                          {{0.5, delta / 4}, 2u},
                                          {{delta / 4, 0.5}, 2u},
                                          {{0, 0}, 2u}}) {
    const Voronoi<> diagram = diagram_of(points, tolerances);
    EXPECT_EQ(diagram.num_vertices(), count) << tolerances[0] << ' ' << tolerances[1];
    EXPECT_LE(diagram.max_displacement(), diagram.tolerance());
    EXPECT_TRUE(check(diagram.to_data()).ok);
  }
  const Voronoi<> own = diagram_of(points, {0.75, delta}), same = diagram_of(points, {0.5, 0.5});
  EXPECT_THAT(own.axis_tolerances(), ElementsAre(0.5, delta));
  EXPECT_THAT(same.axis_tolerances(), ElementsAre());
  EXPECT_EQ(same.tolerance(), 0.5);
}

TEST(AxisTolerances, NoVertexOfADiagramMovesFurtherAlongAnAxis) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> jitter(-1e-3, 1e-3);
  std::vector<double> points;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) points.insert(points.end(), {i + jitter(random), j + jitter(random)});
  const std::vector<double> tolerances{2e-3, 2e-4};
  const Voronoi<> exact = diagram_of(points, {}), diagram = diagram_of(points, tolerances);
  EXPECT_LT(diagram.num_vertices(), exact.num_vertices());
  for (std::size_t v = 0; v < exact.num_vertices(); ++v) {
    bool is_near_one = false;
    for (std::size_t w = 0; w < diagram.num_vertices() && !is_near_one; ++w)
      is_near_one = std::fabs(exact.vertex(v)[0] - diagram.vertex(w)[0]) <= tolerances[0] &&
                    std::fabs(exact.vertex(v)[1] - diagram.vertex(w)[1]) <= tolerances[1];
    EXPECT_TRUE(is_near_one) << v;
  }
}

TEST(AxisTolerances, OfADiagramAreExamined) {
  const std::vector<double> points{0, 0, 1, 0, 0, 1, 1, 1};
  for (const std::vector<double>& bad :
       {std::vector<double>{0.1}, {0.1, 0}, {0.1, -1}, {4, 4}, {0x1p600, 0x1p-600}})
    EXPECT_THROW(diagram_of(points, bad), Error);
}

}  // namespace
}  // namespace delone
