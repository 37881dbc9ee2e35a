// SPDX-License-Identifier: BSD-3-Clause
// The engine against CGAL's dD Delaunay triangulation, which is exact too, by its documented interface. One
// dimension takes a compiler about a gigabyte, so the tests are spread over several files.
#pragma once

#include "compare.hpp"
#include "degenerate.hpp"

#include <delone/delaunay.hpp>

#include <gtest/gtest.h>

#if DELONE_HAVE_CGAL
#include <CGAL/Delaunay_triangulation.h>
#include <CGAL/Epick_d.h>

#include <map>
#endif

namespace delone::test {

template <int D>
void expect_cgal(std::size_t n, std::uint64_t seed) {
#if DELONE_HAVE_CGAL
  using Kernel = CGAL::Epick_d<CGAL::Dimension_tag<D>>;
  using Point = typename Kernel::Point_d;
  std::vector<double> points;
  std::vector<Point> cgal_points;
  std::map<std::vector<double>, SignedIndex> row_of;
  Random random(seed);
  for (std::size_t row = 0; row < n; ++row) {
    std::vector<double> point;
    for (int j = 0; j < D; ++j) point.push_back(random.real());
    points.insert(points.end(), point.begin(), point.end());
    cgal_points.emplace_back(point.begin(), point.end());
    row_of.emplace(point, static_cast<SignedIndex>(row));
  }
  CGAL::Delaunay_triangulation<Kernel> oracle(D);
  oracle.insert(cgal_points.begin(), cgal_points.end());

  Cells expected;
  for (auto cell = oracle.finite_full_cells_begin(); cell != oracle.finite_full_cells_end(); ++cell) {
    expected.emplace_back();
    for (int i = 0; i <= D; ++i) {
      const Point& p = cell->vertex(i)->point();
      expected.back().push_back(row_of.at(std::vector<double>(p.cartesian_begin(), p.cartesian_end())));
    }
    std::sort(expected.back().begin(), expected.back().end());
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_TRUE(same_cells(expected, sorted_cells(Delaunay<>(points, D).to_data()))) << to_text(points, D);
#else
  static_cast<void>(n), static_cast<void>(seed);
  GTEST_SKIP() << "this build found no CGAL";
#endif
}

}  // namespace delone::test
