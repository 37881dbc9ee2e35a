// SPDX-License-Identifier: BSD-3-Clause
// Simplices as integers: edges on their grid, weights on its square, and centers in flats.
#include "solve/integer_edges.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace delone::solve {
namespace {

using kernel::Integer;
using Integers = std::vector<Integer>;

IntegerEdges edges_of(const std::vector<std::vector<double>>& points,
                      const std::vector<double>& weights = {}) {
  std::vector<const double*> pointers;
  for (const auto& point : points) pointers.push_back(point.data());
  return IntegerEdges(pointers, weights, points[0].size());
}

/// The coordinates of twice the center, less twice the first point.
std::vector<double> twice(const IntegerEdges& edges, std::size_t k) {
  const kernel::Fractions found = edges.twice_center(k);
  std::vector<double> result;
  for (const Integer& x : found.numerators)
    result.push_back(kernel::nearest_double(x, found.denominator, edges.grid));
  return result;
}

TEST(IntegerEdges, AreOnTheGridOfAllPoints) {
  const IntegerEdges edges = edges_of({{1, 0.5}, {2, 0.5}, {1, 2}});
  EXPECT_EQ(edges.grid, -1);
  EXPECT_EQ(edges.edges, (Integers{2, 0, 0, 3}));
  EXPECT_EQ(edges.rights, (Integers{4, 9}));
  EXPECT_EQ(edges.dot(0, 1), 0);
  EXPECT_EQ(edges.gram(), (Integers{4, 0, 0, 9}));
  const IntegerEdges origin = edges_of({{0.0, -0.0}, {0, 0}});
  EXPECT_EQ(origin.grid, 0) << "zeros lie on every grid";
  EXPECT_EQ(origin.edges, (Integers{0, 0}));
  const IntegerEdges huge = edges_of({{0x1p1000}, {-0x1p1000}});
  EXPECT_EQ(huge.grid, 1000);
  EXPECT_EQ(huge.edges, Integers{-2});
}

TEST(IntegerEdges, WeightsAreOnItsSquare) {
  // 1/8 is no multiple of (1/2)², so the grid is 1/4.
  const IntegerEdges edges = edges_of({{0}, {0.5}}, {0, 0.125});
  EXPECT_EQ(edges.grid, -2);
  EXPECT_EQ(edges.edges, Integers{2});
  EXPECT_EQ(edges.rights, Integers{4 - 2});
  EXPECT_EQ(edges_of({{0}, {0.5}}, {0.25, 0.25}).rights, Integers{1});
}

TEST(IntegerEdges, CentersAreThoseOfTheFlat) {
  const IntegerEdges triangle = edges_of({{1, 1, 0}, {5, 1, 0}, {1, 3, 0}, {1, 1, 8}});
  EXPECT_EQ(twice(triangle, 1), (std::vector<double>{4, 0, 0})) << "the middle of an edge";
  EXPECT_EQ(twice(triangle, 2), (std::vector<double>{4, 2, 0})) << "in a plane of space";
  EXPECT_EQ(twice(triangle, 3), (std::vector<double>{4, 2, 8}));
  const IntegerEdges weighted = edges_of({{0, 0}, {4, 0}}, {0, 8});
  EXPECT_EQ(twice(weighted, 1), (std::vector<double>{2, 0})) << "nearer to the lighter one";
}

TEST(IntegerEdges, DependentOnesHaveNoSolution) {
  const IntegerEdges line = edges_of({{0, 0}, {1, 1}, {2, 2}});
  EXPECT_EQ(line.solve_gram(line.rights).denominator, 0);
  EXPECT_EQ(line.twice_center(2).denominator, 0);
}

}  // namespace
}  // namespace delone::solve
