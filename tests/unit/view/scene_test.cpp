// SPDX-License-Identifier: BSD-3-Clause
// What a page shows: names of columns, vertices that are used, and the places of values.
#include "view/scene.hpp"

#include "error_code.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <vector>

namespace delone::view {
namespace {

using ::testing::ElementsAre;
using Strings = std::vector<std::string>;

TEST(Scene, ColumnsHaveNames) {
  EXPECT_EQ(scene_of({}, 3, "k").columns, (Strings{"x", "y", "z"}));
  EXPECT_EQ(scene_of({}, 4, "k").columns, (Strings{"x0", "x1", "x2", "x3"}));
  EXPECT_EQ(scene_of({}, 2, "k", {"a", "b"}).columns, (Strings{"a", "b"}));
  EXPECT_EQ(scene_of({.column_names = {"c", "d"}}, 2, "k", {"a", "b"}).columns, (Strings{"c", "d"}));
  for (const Strings& wrong : {Strings{"a"}, Strings{"a", "b", "c"}})
    EXPECT_EQ(test::code_of([&] { scene_of({.column_names = wrong}, 2, "k"); }), Errc::invalid_argument);
}

TEST(Scene, HasTheVerticesThatAreUsed) {
  Scene scene;
  scene.dimension = 2;
  scene.cells = {4, 0, 2};
  scene.segments = {2, 4};
  const std::vector<double> points{0, 0, 9, 9, 1, 0, 8, 8, 0, 1};
  take_vertices(scene, points);
  ASSERT_EQ(scene.num_vertices(), 3u);
  std::vector<double> seen;
  for (const SignedIndex v : scene.cells) seen.push_back(scene.vertices[2 * static_cast<std::size_t>(v)]);
  EXPECT_THAT(seen, ElementsAre(0, 0, 1)) << "the cell has the same points";
  EXPECT_EQ(scene.segments[0], scene.cells[2]);
  EXPECT_EQ(scene.segments[1], scene.cells[0]);
  for (std::size_t v = 0; v < 3; ++v)
    EXPECT_EQ(scene.vertices[2 * v], points[2 * static_cast<std::size_t>(scene.rows[v])]);
}

TEST(Scene, PointsThatRoundToOnePlaceMerge) {
  const std::vector<double> points{0, 0, 1, 1, 1e-12, 0, 0.5, 0.5};
  for (const bool merge : {false, true}) {
    Scene scene;
    scene.dimension = 2;
    scene.cells = {0, 1, 2, 3};
    take_vertices(scene, points, merge);
    EXPECT_EQ(scene.num_vertices(), merge ? 3u : 4u);
    EXPECT_EQ(scene.cells[0] == scene.cells[2], merge);
  }
}

TEST(Scene, ValuesGoWhereTheyFit) {
  const auto scene = [] {
    Scene made;
    made.num_cells = 3;
    return made;
  };
  const std::vector<SignedIndex> rows{4, 0, 1}, groups{1, 0, 1};
  const ValuePlaces places{
      .num_rows = 5, .row_of = rows, .of_vertices = true, .num_facets = 2, .group_of_cell = groups};
  Scene none = scene();
  take_values(none, {}, places);
  EXPECT_TRUE(none.values.empty());
  Scene of_points = scene();
  take_values(of_points, {.values = {10, 11, 12, 13, 14}}, places);
  EXPECT_THAT(of_points.values, ElementsAre(14, 10, 11));
  EXPECT_TRUE(of_points.values_of_vertices);
  Scene of_cells = scene();
  take_values(of_cells, {.values = {1, 2, 3}}, places);
  EXPECT_THAT(of_cells.values, ElementsAre(1, 2, 3));
  EXPECT_FALSE(of_cells.values_of_vertices);
  Scene of_facets = scene();
  take_values(of_facets, {.values = {7, 8}}, places);
  EXPECT_THAT(of_facets.values, ElementsAre(8, 7, 8));
  Scene facets_themselves = scene();
  take_values(facets_themselves, {.values = {7, 8}}, {.num_rows = 5, .num_facets = 2});
  EXPECT_THAT(facets_themselves.values, ElementsAre(7, 8));
}

TEST(Scene, ValuesAreWhereTheyAreSaidToBe) {
  const std::vector<SignedIndex> rows{2, 1, 0};
  const ValuePlaces places{.num_rows = 3, .row_of = rows, .num_facets = 3};
  const auto values_at = [&](ValuesAt at) {
    Scene scene;
    scene.num_cells = 3;
    take_values(scene, {.values = {1, 2, 3}, .values_at = at}, places);
    return scene.values;
  };
  EXPECT_THAT(values_at(ValuesAt::automatic), ElementsAre(3, 2, 1)) << "points come first";
  EXPECT_THAT(values_at(ValuesAt::cells), ElementsAre(1, 2, 3));
  EXPECT_THAT(values_at(ValuesAt::facets), ElementsAre(1, 2, 3));
  const auto refused = [&](const std::vector<double>& values, ValuesAt at) {
    Scene scene;
    scene.num_cells = 4;
    return test::code_of([&] { take_values(scene, {.values = values, .values_at = at}, places); });
  };
  EXPECT_EQ(refused({1, 2, 3}, ValuesAt::cells), Errc::invalid_argument);
  EXPECT_EQ(refused({1, 2, 3, 4}, ValuesAt::points), Errc::invalid_argument);
  EXPECT_EQ(refused({1, std::numeric_limits<double>::infinity(), 3}, ValuesAt::points),
            Errc::invalid_argument);
}

}  // namespace
}  // namespace delone::view
