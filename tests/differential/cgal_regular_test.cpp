// SPDX-License-Identifier: BSD-3-Clause
// Regular triangulations against CGAL's in 3 dimensions, which are exact too, by their documented interface.
// Only in general position, as CGAL decides ties in another way.
#include "compare.hpp"
#include "degenerate.hpp"

#include <delone/regular.hpp>

#include <gtest/gtest.h>

#if DELONE_HAVE_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#endif

#include <array>
#include <map>

namespace delone {
namespace {

TEST(CgalRegular, UniformWeightedPointsAgreeIn3D) {
#if DELONE_HAVE_CGAL
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Weighted = CGAL::Regular_triangulation_3<Kernel>;
  for (const double largest : {1e-4, 0.02, 1.0}) {
    test::Random random(3);
    std::vector<double> points, weights;
    std::vector<Kernel::Weighted_point_3> cgal_points;
    std::map<std::array<double, 3>, SignedIndex> row_of;
    for (SignedIndex row = 0; row < 600; ++row) {
      const std::array<double, 3> p{random.real(), random.real(), random.real()};
      points.insert(points.end(), p.begin(), p.end());
      weights.push_back((random.real() - 0.5) * largest);
      cgal_points.emplace_back(Kernel::Point_3(p[0], p[1], p[2]), weights.back());
      row_of.emplace(p, row);
    }
    const Weighted oracle(cgal_points.begin(), cgal_points.end());
    test::Cells expected;
    for (auto cell = oracle.finite_cells_begin(); cell != oracle.finite_cells_end(); ++cell) {
      expected.emplace_back();
      for (int i = 0; i < 4; ++i) {
        const auto p = cell->vertex(i)->point().point();
        expected.back().push_back(row_of.at({p.x(), p.y(), p.z()}));
      }
      std::sort(expected.back().begin(), expected.back().end());
    }
    std::sort(expected.begin(), expected.end());
    const Regular<> t(points, weights, 3);
    EXPECT_TRUE(test::same_cells(expected, test::sorted_cells(t.to_data()))) << largest;
    EXPECT_EQ(t.num_vertices(), oracle.number_of_vertices()) << largest;
  }
#else
  GTEST_SKIP() << "this build found no CGAL";
#endif
}

}  // namespace
}  // namespace delone
