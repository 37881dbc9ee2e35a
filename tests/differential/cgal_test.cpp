// SPDX-License-Identifier: BSD-3-Clause
// The engine against CGAL's dD Delaunay triangulation, which is exact too, by its documented interface. Its
// kernel is the one whose dimension is a variable: compiled once, for all dimensions.
#include "compare.hpp"
#include "degenerate.hpp"

#include <delone/delaunay.hpp>

#include <gtest/gtest.h>

#if DELONE_HAVE_CGAL
#include <CGAL/Delaunay_triangulation.h>
#include <CGAL/Epick_d.h>
#endif

#include <algorithm>
#include <map>
#include <vector>

namespace delone {
namespace {

void expect_cgal(int dimension, std::size_t n, std::uint64_t seed) {
#if DELONE_HAVE_CGAL
  using Kernel = CGAL::Epick_d<CGAL::Dynamic_dimension_tag>;
  using Point = Kernel::Point_d;
  std::vector<double> points;
  std::vector<Point> cgal_points;
  std::map<std::vector<double>, SignedIndex> row_of;
  test::Random random(seed);
  for (std::size_t row = 0; row < n; ++row) {
    std::vector<double> point;
    for (int j = 0; j < dimension; ++j) point.push_back(random.real());
    points.insert(points.end(), point.begin(), point.end());
    cgal_points.emplace_back(point.begin(), point.end());
    row_of.emplace(point, static_cast<SignedIndex>(row));
  }
  CGAL::Delaunay_triangulation<Kernel> oracle(dimension);
  oracle.insert(cgal_points.begin(), cgal_points.end());

  test::Cells expected;
  for (auto cell = oracle.finite_full_cells_begin(); cell != oracle.finite_full_cells_end(); ++cell) {
    expected.emplace_back();
    for (int i = 0; i <= dimension; ++i) {
      const Point& p = cell->vertex(i)->point();
      expected.back().push_back(row_of.at(std::vector<double>(p.cartesian_begin(), p.cartesian_end())));
    }
    std::sort(expected.back().begin(), expected.back().end());
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_TRUE(test::same_cells(expected, test::sorted_cells(Delaunay<>(points, dimension).to_data())))
      << test::to_text(points, dimension);
#else
  static_cast<void>(dimension), static_cast<void>(n), static_cast<void>(seed);
  GTEST_SKIP() << "this build found no CGAL";
#endif
}

TEST(CgalIn, UniformPointsAgreeIn2D) { expect_cgal(2, 1000, 2); }
TEST(CgalIn, UniformPointsAgreeIn3D) { expect_cgal(3, 500, 3); }
TEST(CgalIn, UniformPointsAgreeIn4D) { expect_cgal(4, 250, 4); }
TEST(CgalIn, UniformPointsAgreeIn5D) { expect_cgal(5, 120, 5); }
TEST(CgalIn, UniformPointsAgreeIn6D) { expect_cgal(6, 60, 6); }
TEST(CgalIn, UniformPointsAgreeIn7D) { expect_cgal(7, 30, 7); }

}  // namespace
}  // namespace delone
