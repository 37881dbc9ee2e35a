// SPDX-License-Identifier: BSD-3-Clause
// check() of damaged intersections: every level must be seen to fail, naming the right rows.
#include <delone/check.hpp>

#include "small_results.hpp"

#include <delone/halfspaces.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace delone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Damage>
CheckReport damaged(Damage damage) {
  IntersectionData data = test::small_intersection();
  damage(data);
  return check(data);
}

template <class Damage>
void expect_failure(std::string_view level, const char* message, Damage damage) {
  const CheckReport report = damaged(damage);
  EXPECT_FALSE(report.ok) << message;
  EXPECT_EQ(report.reached.name, level) << report.violation;
  EXPECT_THAT(report.violation, HasSubstr(message));
}

TEST(CheckHalfspaces, Storage) {
  expect_failure("storage", "dimension", [](IntersectionData& data) { data.dimension = 0; });
  expect_failure("storage", "halfspaces", [](IntersectionData& data) { data.halfspaces.pop_back(); });
  expect_failure("storage", "not finite", [](IntersectionData& data) {
    data.halfspaces[1] = std::numeric_limits<double>::infinity();
  });
  expect_failure("storage", "a row is out of range",
                 [](IntersectionData& data) { data.first_of_halfspace[0] = 3; });
  expect_failure("storage", "offsets", [](IntersectionData& data) { data.vertex_offsets[1] = 3; });
  expect_failure("storage", "axes", [](IntersectionData& data) { data.axes[0] = 1; });
  expect_failure("storage", "another size", [](IntersectionData& data) { data.kinds.pop_back(); });
  expect_failure("storage", "out of range", [](IntersectionData& data) { data.edges[1] = 2; });
  expect_failure("storage", "not increasing", [](IntersectionData& data) { data.facet_halfspaces = {1, 0}; });
  expect_failure("storage", "has a witness", [](IntersectionData& data) { data.witness = {0}; });
}

TEST(CheckHalfspaces, Support) {
  expect_failure("support", "nearest double",
                 [](IntersectionData& data) { data.vertices[1] = std::nextafter(1.0, 2.0); });
  expect_failure("support", "interior point", [](IntersectionData& data) { data.interior_point[0] = 1; });
  expect_failure("support", "listed twice", [](IntersectionData& data) {
    data.vertices = {1, 1};
    data.vertex_halfspaces = {0, 0};
  });
  // The vertex of x ≤ 2 is outside x ≤ 1.
  const CheckReport report = damaged([](IntersectionData& data) {
    data.vertices[1] = 2;
    data.vertex_halfspaces[1] = 2;
  });
  EXPECT_THAT(report.violation, HasSubstr("vertex 1 is outside of halfspace 0"));
  EXPECT_THAT(report.vertices, ElementsAre(1));
  EXPECT_THAT(report.halfspaces, ElementsAre(0));
}

TEST(CheckHalfspaces, Completeness) {
  expect_failure("completeness", "bounded", [](IntersectionData& data) { data.bounded = false; });
  expect_failure("completeness", "edges at vertex 0", [](IntersectionData& data) { data.edges.clear(); });
  expect_failure("completeness", "halfspace 2 has the wrong kind",
                 [](IntersectionData& data) { data.kinds[2] = HalfspaceKind::touching; });
  expect_failure("completeness", "no duplicate", [](IntersectionData& data) {
    data.kinds[2] = HalfspaceKind::duplicate;
    data.first_of_halfspace[2] = 0;
  });
  expect_failure("completeness", "vertices on its facet", [](IntersectionData& data) {
    data.facet_vertices = {0, 1};
  });
}

TEST(CheckHalfspaces, AWitnessProvesThatNothingIsInside) {
  IntersectionData data;
  data.dimension = 1;
  data.state = IntersectionState::empty;
  data.halfspaces = {1, 1, -1, 0};  // x ≤ −1 and x ≥ 0
  data.first_of_halfspace = {0, 1};
  data.witness = {0, 1};
  EXPECT_TRUE(check(data).ok) << check(data).violation;
  data.state = IntersectionState::flat;
  EXPECT_EQ(check(data).reached.name, "support");
  data.state = IntersectionState::empty;
  data.witness = {0};
  EXPECT_THAT(check(data).violation, HasSubstr("witness"));
  EXPECT_THAT(check(data).halfspaces, ElementsAre(0));
  data.edges = {0, 0};
  EXPECT_EQ(check(data).reached.name, "storage");
}

TEST(CheckHalfspaces, DirectionsWithEntriesThatRoundToZero) {
  // The direction along the second row is (−1.8e-605, 1).
  const std::vector<double> rows{7.5e-228, -3.3e-115, -1, 1.6e286, 2.9e-319, -1};
  const HalfspaceIntersection<> intersection(rows, 2);
  ASSERT_EQ(intersection.data().num_directions(), 2u);
  const CheckReport report = check(intersection.to_data());
  EXPECT_TRUE(report.ok) << report.violation;
}

TEST(CheckHalfspaces, InteriorPointsBeyondTheRangeOfDoubles) {
  const std::vector<double> rows{1e-300, 1e300, -1e-300, -1e301};  // x ≤ −1e600, x ≥ −1e601
  const HalfspaceIntersection<> intersection(rows, 1);
  ASSERT_EQ(intersection.state(), IntersectionState::full);
  const CheckReport report = check(intersection.to_data());
  EXPECT_TRUE(report.ok) << report.violation;
}

}  // namespace
}  // namespace delone
