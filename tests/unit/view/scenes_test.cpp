// SPDX-License-Identifier: BSD-3-Clause
// to_html(): the description in the page, the blocks it names, and what is refused. What browsers make of it:
// tests/site/test_viewer.py.
#include "error_code.hpp"
#include "stops_at.hpp"

#include <delone/alpha.hpp>
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/halfspaces.hpp>
#include <delone/html.hpp>
#include <delone/progress.hpp>
#include <delone/voronoi.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace delone;

nlohmann::json description(const std::string& page) {
  const std::string opening = "<script type=\"application/json\" id=\"delone-scene\">";
  const std::size_t begin = page.find(opening) + opening.size();
  const auto scene = nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  for (const auto& [name, block] : scene["blocks"].items())
    EXPECT_NE(page.find("id=\"delone-" + name + "\">"), std::string::npos) << name;
  EXPECT_EQ(page.substr(0, 15), "<!doctype html>");
  EXPECT_NE(page.rfind("</html>"), std::string::npos);
  return scene;
}

const std::vector<double> square{0, 0, 1, 0, 0, 1, 1, 1, 0.5, 0.25, 1, 1};  // the last one is a duplicate

TEST(ToHtml, Triangulations) {
  const Delaunay<> t(square, 2);
  HtmlOptions options{.title = "</script> & \"more\"", .values = {1, 2, 3, 4, 5, 6}, .value_name = "w"};
  const auto scene = description(to_html(t.to_data(), options));
  EXPECT_EQ(scene["title"], options.title);
  EXPECT_EQ(scene["kind"], "triangulation");
  EXPECT_EQ(scene["numCells"], 4);
  EXPECT_EQ(scene["numVertices"], 5);
  EXPECT_EQ(scene["columns"], (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(scene["low"], (std::vector<double>{0, 0}));
  EXPECT_EQ(scene["blocks"]["value"]["high"], 5);  // of the vertices; row 5 is none
  EXPECT_TRUE(scene["dual"] && scene["valueOfVertices"]);
  options.values = {1, 2, 3, 4};
  EXPECT_FALSE(description(to_html(t.to_data(), options))["valueOfVertices"]);
}

TEST(ToHtml, OtherResults) {
  const auto hull = description(to_html(ConvexHull<>(square, 2).to_data()));
  EXPECT_EQ(hull["numCells"], 4);
  EXPECT_EQ(hull["blocks"]["sites"]["items"], 12);
  const Voronoi<> diagram{Delaunay<>(square, 2)};
  const auto regions = description(to_html(diagram, {.values = {0, 1, 2, 3, 4, 5}}));
  EXPECT_EQ(regions["numCells"], 5);
  EXPECT_EQ(regions["blocks"]["cells"]["items"], 5);
  EXPECT_FALSE(regions["valueOfVertices"]);
  // A corner of space, unbounded: its three facets are cut off.
  const HalfspaceIntersection<> corner(std::vector<double>{-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0}, 3);
  const auto polyhedron = description(to_html(corner.to_data()));
  EXPECT_EQ(polyhedron["numCells"], 3);
  EXPECT_EQ(polyhedron["numVertices"], 4);
}

TEST(ToHtml, NamesOfCoordinates) {
  const std::vector<std::string> names{"lon", "lat"}, others{"a", "b"};
  auto cells = Delaunay<>(square, 2).to_data();
  auto hull = ConvexHull<>(square, 2).to_data();
  cells.column_names = hull.column_names = names;
  EXPECT_EQ(description(to_html(cells))["columns"], names);
  EXPECT_EQ(description(to_html(hull))["columns"], names);
  EXPECT_EQ(description(to_html(cells, {.column_names = others}))["columns"], others);
}

TEST(ToHtml, FlatCellsOfFiles) {
  ComplexData data;
  data.dimension = data.affine_dimension = 2;
  data.points = {0, 0, 1, 1, 2, 2, 1, 0};
  data.cells = {0, 1, 2, 0, 3, 1, 2, 0, 2};
  const auto scene = description(to_html(data));
  EXPECT_EQ(scene["numCells"], 3);
  EXPECT_EQ(scene["blocks"]["radius"]["low"], scene["blocks"]["radius"]["high"]);  // of the one good cell
}

TEST(ToHtml, CoordinatesAtTheEndOfTheRange) {
  auto wide = square;
  for (double& x : wide) x = (2 * x - 1) * 1.7e308;
  EXPECT_EQ(description(to_html(Delaunay<>(wide, 2).to_data()))["numCells"], 4);
  // The corner of a quadrant, and rays from there that end where doubles do.
  auto corner = HalfspaceIntersection<>(std::vector<double>{-1, 0, 0, 0, -1, 0}, 2).to_data();
  ASSERT_EQ(corner.num_rays(), 2u);
  corner.vertices = {1.5e308, -1.7e308};
  EXPECT_EQ(description(to_html(corner))["numVertices"], 3);
  corner.vertices[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(test::code_of([&] { to_html(corner); }), Errc::not_finite);
  corner.vertices[0] = 0;
  corner.rays[1] = 7;
  EXPECT_EQ(test::code_of([&] { to_html(corner); }), Errc::invalid_argument);
}

TEST(ToHtml, CanBeStopped) {
  std::vector<double> points;
  for (int i = 0; i < 20000; ++i) points.push_back(i * i % 4999), points.push_back(i);
  const ComplexData data = Delaunay<>(points, 2).to_data();
  const ProgressScope scope(test::stops_at(2));
  EXPECT_EQ(test::code_of([&] { to_html(data); }), Errc::cancelled);
}

TEST(ToHtml, TellsHowMuchIsDone) {
  ComplexData data;
  data.dimension = data.affine_dimension = 2;
  std::uint64_t state = 1;
  const auto next = [&] { return (state = state * 6364136223846793005u + 1442695040888963407u) >> 40; };
  for (int i = 0; i < 60000; ++i) data.points.push_back(static_cast<double>(next()));
  for (int i = 0; i < 900000; ++i) data.cells.push_back(static_cast<SignedIndex>(next() % 30000));
  std::vector<double> fractions;
  to_html(data, {}, {.progress = [&](double fraction) {
            fractions.push_back(fraction);
            return true;
          }});
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  const auto between =
      std::count_if(fractions.begin(), fractions.end(), [](double f) { return f > 0 && f < 1; });
  EXPECT_GT(between, 2);
}

TEST(ToHtml, RemovedRowsAreLeftOut) {
  Regular<> t(square, std::vector<double>(6, 0.0), 2);
  const std::vector<double> values{1, 2, 3, 4, 5, 6};
  t.remove(Index{0});
  t.remove(Index{4});
  const auto scene = description(to_html(t.to_data(), {.values = values}));
  EXPECT_EQ(scene["numCells"], 1);
  EXPECT_EQ(scene["numVertices"], 3);
  EXPECT_EQ(scene["low"], (std::vector<double>{0, 0}));
  EXPECT_EQ(scene["high"], (std::vector<double>{1, 1}));
  EXPECT_EQ(scene["blocks"]["value"]["low"], 2);
  EXPECT_EQ(description(to_html(PowerDiagram<>(t), {.values = values}))["numCells"], 3);
  // A row that is there has to have a place.
  auto wrong = t.to_data();
  wrong.points[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(test::code_of([&] { to_html(wrong); }), Errc::not_finite);
  wrong = t.to_data();
  wrong.weights[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(test::code_of([&] { to_html(wrong); }), Errc::not_finite);
}

TEST(ToHtml, AlphaComplexes) {
  const Delaunay<> t(square, 2);
  const auto scene = description(to_html(AlphaComplex(t, 0.52).to_data()));
  EXPECT_EQ(scene["kind"], "alpha");
  EXPECT_EQ(scene["title"], "Alpha complex");
  EXPECT_FALSE(scene["dual"]);
  EXPECT_LT(scene["numCells"], 4);
  EXPECT_GT(scene["numCells"], 0);
}

TEST(ToHtml, NothingAndOnePoint) {
  EXPECT_EQ(description(to_html(Delaunay<>(3).to_data()))["numVertices"], 0);
  const auto one = description(to_html(Delaunay<>(std::vector<double>{1, 2, 3}, 3).to_data()));
  EXPECT_EQ(one["numVertices"], 1);
  EXPECT_EQ(description(to_html(Voronoi{Delaunay<>(2)}))["numCells"], 0);
  EXPECT_EQ(description(to_html(ConvexHull<>(2).to_data()))["numCells"], 0);
}

TEST(ToHtml, WhatIsRefused) {
  const auto data = Delaunay<>(square, 2).to_data();
  EXPECT_EQ(test::code_of([&] { to_html(data, {.values = {1, 2, 3}}); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] {
              to_html(data, {.values = std::vector<double>(6, std::numeric_limits<double>::infinity())});
            }),
            Errc::invalid_argument);
  EXPECT_EQ(
      test::code_of([&] { to_html(data, {.values = std::vector<double>(6), .values_at = ValuesAt::cells}); }),
      Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { to_html(data, {.column_names = {"x"}}); }), Errc::invalid_argument);
  auto wrong = data;
  wrong.cells[0] = 99;
  EXPECT_EQ(test::code_of([&] { to_html(wrong); }), Errc::invalid_argument);
  auto hull = ConvexHull<>(square, 2).to_data();
  hull.facet_of_cell[0] = 99;
  EXPECT_EQ(test::code_of([&] { to_html(hull, {.values = {1, 2, 3, 4}}); }), Errc::invalid_argument);
  const HalfspaceIntersection<> empty(std::vector<double>{1, 0, 1, -1, 0, 1}, 2);
  EXPECT_EQ(test::code_of([&] { to_html(empty.to_data()); }), Errc::invalid_argument);
  const Voronoi<> four{Delaunay<>(std::vector<double>{0, 0, 0, 0, 1, 0, 0, 0}, 4)};
  EXPECT_EQ(test::code_of([&] { to_html(four); }), Errc::unsupported);
}

}  // namespace
