// SPDX-License-Identifier: BSD-3-Clause
// check() of damaged diagrams: every level must be seen to fail.
#include <delone/check.hpp>

#include "small_results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace delone {
namespace {

using ::testing::HasSubstr;

template <class Damage>
void expect_failure(std::string_view level, const char* message, Damage damage) {
  VoronoiData data = test::small_diagram();
  damage(data);
  const CheckReport report = check(data);
  EXPECT_FALSE(report.ok) << message;
  EXPECT_EQ(report.reached.name, level) << report.violation;
  EXPECT_THAT(report.violation, HasSubstr(message));
}

TEST(CheckVoronoi, OtherNumbersPass) {
  VoronoiData data = test::small_diagram();
  std::swap(data.vertices[0], data.vertices[1]);
  data.ridge_vertices = {1, 0};
  data.region_vertices = {-1, 1, 1, 0, -1, 0};
  data.ray_vertices = {1, 0};
  EXPECT_TRUE(check(data).ok) << check(data).violation;
}

TEST(CheckVoronoi, Storage) {
  expect_failure("storage", "dimensions", [](VoronoiData& data) { data.affine_dimension = 2; });
  expect_failure("storage", "points: 3 entries were expected, not 2",
                 [](VoronoiData& data) { data.points.pop_back(); });
  expect_failure("storage", "ray_directions", [](VoronoiData& data) { data.ray_directions.pop_back(); });
  expect_failure("storage", "region_offsets: not increasing",
                 [](VoronoiData& data) { data.region_offsets[1] = 5; });
  expect_failure("storage", "region 1: a vertex appears twice",
                 [](VoronoiData& data) { data.region_vertices[2] = 1; });
  expect_failure("storage", "region 0: -1 is not first",
                 [](VoronoiData& data) { std::swap(data.region_vertices[0], data.region_vertices[1]); });
  expect_failure("storage", "ridge 0: there is no vertex 2",
                 [](VoronoiData& data) { data.ridge_vertices[0] = 2; });
  expect_failure("storage", "point_region: entry 2 is 3, of 3",
                 [](VoronoiData& data) { data.point_region[2] = 3; });
}

TEST(CheckVoronoi, LaterLevels) {
  expect_failure("regions", "hidden", [](VoronoiData& data) { data.point_region[1] = -1; });
  expect_failure("regions", "", [](VoronoiData& data) { std::swap(data.points[0], data.points[1]); });
  expect_failure("vertices", "vertex 1: coordinate 0",
                 [](VoronoiData& data) { data.vertices[1] = std::nextafter(4.0, 5.0); });
  expect_failure("ridges", "ridge 1", [](VoronoiData& data) { data.ridge_points[2] = 0; });
  expect_failure("rays", "ray 0: not the outward direction",
                 [](VoronoiData& data) { data.ray_directions[0] = 1; });
  expect_failure("rays", "ray 1", [](VoronoiData& data) { data.ray_points[1] = 0; });
  expect_failure("rays", "there is no ray", [](VoronoiData& data) {
    data.ray_vertices.pop_back();
    data.ray_points.pop_back();
    data.ray_directions.pop_back();
  });
}

TEST(CheckVoronoi, NumbersThatAreNotFinite) {
  expect_failure("storage", "point 1 has a coordinate that is not finite",
                 [](VoronoiData& data) { data.points[1] = std::numeric_limits<double>::quiet_NaN(); });
  expect_failure("storage", "the weight of point 2 is not finite", [](VoronoiData& data) {
    data.weights.assign(data.num_points(), 0);
    data.weights[2] = std::numeric_limits<double>::infinity();
  });
}

}  // namespace
}  // namespace delone
