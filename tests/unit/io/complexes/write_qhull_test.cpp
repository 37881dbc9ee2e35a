// SPDX-License-Identifier: BSD-3-Clause
// The outputs of Qhull, where little is free in them; tests/cli/test_qhull.py compares them with Qhull's
// programs.
#include "../io_support.hpp"

#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/halfspaces.hpp>
#include <delone/regular.hpp>
#include <delone/voronoi.hpp>

#include <algorithm>
#include <sstream>

namespace {

using namespace delone;
using delone_test::expect_error;

using Numbers = std::vector<double>;

class WriteQhull : public delone_test::TemporaryDirectory {
 protected:
  template <class Product>
  std::string text(const Product& product, const std::string& outputs) {
    write_qhull(path("a.txt"), product, outputs);
    return content("a.txt");
  }
  /// The numbers of each line.
  template <class Product>
  std::vector<Numbers> lines(const Product& product, const std::string& outputs) {
    std::istringstream in(text(product, outputs));
    std::vector<Numbers> all;
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      Numbers& numbers = all.emplace_back();
      for (double x = 0; words >> x;) numbers.push_back(x);
    }
    return all;
  }
};

Numbers cube(double low, double high) {
  Numbers points;
  for (int i = 0; i < 8; ++i)
    for (int j = 2; j >= 0; --j) points.push_back((i >> j) % 2 == 0 ? low : high);
  return points;
}

TEST_F(WriteQhull, TriangleWithAPointOnAnEdge) {
  const Numbers points{0, 0, 1, 0, 2, 0, 0, 2, 0.5, 0.5};
  const ConvexHull<> hull(points, 2);
  EXPECT_EQ(text(hull, "Fx p"), "3\n0\n2\n3\n2\n3\n0 0\n2 0\n0 2\n");
  const auto off = lines(hull, "o");
  ASSERT_EQ(off.size(), 10u);
  EXPECT_EQ(off[1], (Numbers{5, 3, 3}));
  // Counterclockwise.
  for (std::size_t i = 7; i < 10; ++i)
    EXPECT_TRUE(off[i] == (Numbers{2, 0, 2}) || off[i] == (Numbers{2, 2, 3}) || off[i] == (Numbers{2, 3, 0}));
  const auto both = lines(hull, " Fv,,Fn ");
  for (std::size_t i = 1; i <= 3; ++i)  // neighbor j has the other vertex
    for (std::size_t j = 1; j <= 2; ++j) {
      const Numbers& other = both[1 + static_cast<std::size_t>(both[4 + i][j])];
      EXPECT_NE(std::find(other.begin() + 1, other.end(), both[i][3 - j]), other.end());
    }
  EXPECT_EQ(lines(hull, "FS")[1][2], 2);
}

TEST_F(WriteQhull, FacetsOfACubeAreSquares) {
  const ConvexHull<> hull(cube(-1, 1), 3);
  const auto off = lines(hull, "o");
  EXPECT_EQ(off[1], (Numbers{8, 6, 12}));
  for (std::size_t f = 10; f < 16; ++f) {
    ASSERT_EQ(off[f].size(), 5u);
    double determinant = 0;  // of three corners in turn: clockwise seen from outside
    const auto x = [&](std::size_t corner) { return off[2 + static_cast<std::size_t>(off[f][1 + corner])]; };
    const Numbers a = x(0), b = x(1), c = x(2);
    determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]);
    EXPECT_LT(determinant, 0);
    for (std::size_t i = 0; i < 4; ++i) {  // along edges
      int differences = 0;
      for (std::size_t j = 0; j < 3; ++j) differences += x(i)[j] != x((i + 1) % 4)[j];
      EXPECT_EQ(differences, 1);
    }
  }
  EXPECT_EQ(lines(hull, "i").size(), 7u);
  EXPECT_EQ(lines(hull, "n")[0], Numbers{4});
  EXPECT_NE(text(hull, "FA").find("  Number of non-simplicial facets: 6\n"), std::string::npos);
  for (std::size_t f = 1; f <= 6; ++f) EXPECT_EQ(lines(hull, "Fn")[f][0], 4);
}

TEST_F(WriteQhull, TriangulationOfASquareWithItsCenter) {
  const Delaunay<> t(Numbers{0, 0, 2, 0, 2, 2, 0, 2, 1, 1, 0, 0}, 2);
  EXPECT_EQ(lines(t, "o")[1], (Numbers{6, 4, 6}));
  EXPECT_EQ(lines(t, "o")[6], (Numbers{1, 1, 0.5}));  // scaled to the largest coordinate
  EXPECT_EQ(text(t, "Fx FS"), "4\n0\n1\n2\n3\n0\n2 4 0\n");
  for (const Numbers& row : lines(t, "Fn"))
    EXPECT_TRUE(row.size() == 1 || std::count(row.begin(), row.end(), -1) == 1);
  const auto regions = lines(Voronoi(t), "o");
  EXPECT_EQ(regions[1], (Numbers{5, 6, 1}));
  EXPECT_EQ(regions[2], (Numbers{-10.101, -10.101}));
  EXPECT_EQ(regions[7], (Numbers{3, 0, regions[7][2], regions[7][3]}));
  EXPECT_EQ(regions[11].size(), 5u);   // the center
  EXPECT_EQ(regions[12], Numbers{0});  // the duplicate
  EXPECT_EQ(lines(Voronoi(t), "Fv").size(), 9u);
  expect_error(Errc::unsupported, {"regular"}, [&] {
    write_qhull(path("b.txt"), Regular<>(Numbers{0, 0}, Numbers{1}, 2), "o");
  });
  expect_error(Errc::unsupported, {"without ridges"},
               [&] { write_qhull(path("b.txt"), Voronoi(t, {.parts = DiagramParts::regions}), "p"); });
}

TEST_F(WriteQhull, IntersectionOfTheFacetsOfAnOctahedron) {
  Numbers halfspaces;  // of x + y + z ≤ 1 and so on: each of the 6 vertices has four facets
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 3; ++j) halfspaces.push_back((i >> j) % 2 == 0 ? 1 : -1);
    halfspaces.push_back(-1);
  }
  const HalfspaceIntersection<> found(halfspaces, 3, Numbers{0, 0, 0});
  EXPECT_EQ(lines(found, "o")[1], (Numbers{8, 6, 12}));
  EXPECT_EQ(lines(found, "Fx").size(), 9u);
  for (const Numbers& row : lines(found, "i")) {
    if (row.size() < 4) continue;
    for (std::size_t i = 0; i < 4; ++i) {  // one facet after the other across an edge: one bit differs
      const int changed = static_cast<int>(row[i]) ^ static_cast<int>(row[(i + 1) % 4]);
      EXPECT_EQ(changed & (changed - 1), 0);
    }
  }
  for (const Numbers& row : lines(found, "Fn")) EXPECT_TRUE(row.size() == 1 || row[0] == 4);
  const HalfspaceIntersection<> quadrant(Numbers{-1, 0, 0, 0, -1, 0}, 2);
  expect_error(Errc::unsupported, {"bounded"}, [&] { write_qhull(path("b.txt"), quadrant, "Fp"); });
}

TEST_F(WriteQhull, SmallInput) {
  for (int d = 1; d <= 4; ++d)
    for (std::size_t n = 0; n <= 3; ++n) {
      const Numbers points(n * static_cast<std::size_t>(d), 1.5);
      EXPECT_FALSE(text(ConvexHull<>(points, d), "o n p i Fv Fx Fn FA FS").empty());
      EXPECT_FALSE(text(Delaunay<>(points, d), "o p i Fv Fx Fn FA FS").empty());
      EXPECT_FALSE(text(FurthestSite<>(points, d), "o p i Fv Fx Fn FA FS").empty());
      EXPECT_FALSE(text(Voronoi(Delaunay<>(points, d)), "o p Fv Fx Fn").empty());
    }
  const Numbers line{0, 0, 1, 1, 3, 3};
  EXPECT_EQ(text(ConvexHull<>(line, 2), "Fx"), "2\n0\n2\n");
  EXPECT_EQ(text(Delaunay<>(line, 2), "Fx"), "2\n0\n2\n");
  expect_error(Errc::invalid_argument, {"'Fz' is none of the outputs of a convex hull", "o n p i"},
               [&] { write_qhull(path("b.txt"), ConvexHull<>(line, 2), "o Fz"); });
  expect_error(Errc::invalid_argument, {"no output"},
               [&] { write_qhull(path("b.txt"), ConvexHull<>(line, 2), " "); });
  EXPECT_FALSE(std::filesystem::exists(path("b.txt")));
}

}  // namespace
