// SPDX-License-Identifier: BSD-3-Clause
// Hulls, envelopes, intersections of halfspaces and diagrams have two forms, of a fixed and of a dynamic
// dimension: they give the same, whatever the type of the points, and clones are independent.
#include "degenerate.hpp"

#include <delone/convex_hull.hpp>
#include <delone/halfspaces.hpp>
#include <delone/lower_hull.hpp>
#include <delone/point_sets.hpp>
#include <delone/voronoi.hpp>

#include <array>
#include <list>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace delone {
namespace {

template <std::size_t N>
std::vector<std::array<double, N>> as_arrays(std::span<const double> numbers) {
  std::vector<std::array<double, N>> rows(numbers.size() / N);
  for (std::size_t i = 0; i < numbers.size(); ++i) rows[i / N][i % N] = numbers[i];
  return rows;
}

template <std::size_t N>
std::list<std::vector<double>> as_list(const std::vector<std::array<double, N>>& rows) {
  std::list<std::vector<double>> list;
  for (const auto& row : rows) list.emplace_back(row.begin(), row.end());
  return list;
}

template <class T>
constexpr bool only_moves = std::is_nothrow_move_constructible_v<T>&& std::is_nothrow_move_assignable_v<T> &&
                            !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T>;
static_assert(only_moves<ConvexHull<3>> && only_moves<ConvexHull<>>);
static_assert(only_moves<LowerHull<3>> && only_moves<LowerHull<>>);
static_assert(only_moves<HalfspaceIntersection<3>> && only_moves<HalfspaceIntersection<>>);
static_assert(only_moves<Voronoi<3>> && only_moves<Voronoi<>>);
static_assert(only_moves<PowerDiagram<3>> && only_moves<PowerDiagram<>>);

template <class Base>
constexpr bool is_abstract_base = !std::is_default_constructible_v<Base> && !std::is_destructible_v<Base> &&
                                  !std::is_copy_constructible_v<Base> && !std::is_copy_assignable_v<Base>;
static_assert(is_abstract_base<ConvexHullBase> && is_abstract_base<LowerHullBase> &&
              is_abstract_base<HalfspaceIntersectionBase>);
static_assert(is_abstract_base<Diagram>);

TEST(ProductForms, HullsAreEqual) {
  const std::vector<double> numbers = make_point_set("ball", 3, 200, 5);
  const auto rows = as_arrays<3>(numbers);
  const ConvexHull hull(numbers, 3);
  static_assert(std::is_same_v<decltype(hull), const ConvexHull<dynamic>>);
  const ConvexHull view(PointsView(numbers, 3));
  const ConvexHull fixed(rows);
  static_assert(std::is_same_v<decltype(fixed), const ConvexHull<3>>);
  static_assert(decltype(fixed.point(0))::extent == 3);
  const ConvexHull<3> list(as_list(rows));
  for (const ConvexHullBase* other :
       {static_cast<const ConvexHullBase*>(&view), static_cast<const ConvexHullBase*>(&fixed),
        static_cast<const ConvexHullBase*>(&list)}) {
    EXPECT_EQ(other->hash(), hull.hash());
    EXPECT_EQ(other->dimension(), 3);
    EXPECT_TRUE(other->contains({0.0, 0.0, 0.0}));
  }
  EXPECT_FALSE(fixed.contains({2, 0, 0}));
  EXPECT_FALSE(fixed.visible_facets(std::array<double, 3>{2, 0, 0}).empty());
}

TEST(ProductForms, RowsOfAnotherSizeAreErrors) {
  std::list<std::vector<double>> rows{{0, 0, 0}, {1, 0}};
  try {
    const ConvexHull<3> hull(rows);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::bad_dimension);
    EXPECT_EQ(error.rows(), std::vector<std::size_t>{1});
  }
  const std::vector<std::array<double, 2>> plane{{0, 0}, {1, 0}};
  ConvexHull hull(3);
  EXPECT_THROW(hull.insert_range(plane), Error);
  EXPECT_THROW(hull.insert({1.0, 2.0}), Error);
  EXPECT_THROW(LowerHull(plane, 3), Error);
  EXPECT_THROW(HalfspaceIntersection(plane, 2), Error);
}

TEST(ProductForms, ClonesOfHullsAreIndependent) {
  ConvexHull<2> hull(std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {0, 1}});
  ConvexHull<2> copy = hull.clone();
  EXPECT_EQ(copy.hash(), hull.hash());
  copy.insert({1, 1});
  EXPECT_EQ(copy.num_vertices(), 4u);
  EXPECT_EQ(hull.num_vertices(), 3u);
  hull = std::move(copy);
  EXPECT_EQ(hull.num_vertices(), 4u);
}

TEST(ProductForms, LowerHullsAreEqual) {
  const std::vector<double> numbers = make_point_set("uniform", 3, 100, 7);
  const auto rows = as_arrays<3>(numbers);
  const LowerHull lower(numbers, 3);
  const LowerHull fixed(rows);
  static_assert(std::is_same_v<decltype(fixed), const LowerHull<3>>);
  const LowerHull<3> copy = fixed.clone();
  EXPECT_EQ(canonical_hash(fixed.to_data()), canonical_hash(lower.to_data()));
  EXPECT_EQ(copy.heights(std::vector<std::array<double, 2>>{{0.5, 0.5}}),
            lower.heights(std::vector<double>{0.5, 0.5}));
  EXPECT_EQ(copy.find_cell({0.5, 0.5}).has_value(), lower.find_cell({0.5, 0.5}).has_value());
  EXPECT_EQ(copy.height_above(rows), lower.height_above(numbers));
  EXPECT_EQ(copy.polytope().hash(), lower.polytope().hash());
  EXPECT_EQ(LowerHull(rows, HullSide::upper).side(), HullSide::upper);
}

TEST(ProductForms, IntersectionsAreEqual) {
  const std::vector<std::array<double, 3>> square{{1, 0, -1}, {-1, 0, -1}, {0, 1, -1}, {0, -1, -1}};
  const std::vector<double> numbers(square.front().data(), square.front().data() + 12);
  HalfspaceIntersection fixed(square, {0.25, 0.0});
  static_assert(std::is_same_v<decltype(fixed), HalfspaceIntersection<2>>);
  const HalfspaceIntersection found(numbers, 2), given(numbers, 2, std::vector<double>{0.25, 0.0});
  EXPECT_EQ(found.data().vertices, fixed.data().vertices);
  EXPECT_EQ(given.data().dual_points, fixed.data().dual_points);
  const HalfspaceIntersection<2> copy = fixed.clone();
  fixed.insert({1, 1, -1});
  fixed.insert_range(std::vector<std::array<double, 3>>{{1, -1, -1}});
  EXPECT_EQ(fixed.num_halfspaces(), 6u);
  EXPECT_EQ(fixed.num_facets(), 5u);  // x ≤ 1 touches in a corner only
  EXPECT_EQ(copy.num_facets(), 4u);
  EXPECT_EQ(copy.volume().value, 4);
}

TEST(ProductForms, DiagramsAreEqual) {
  const std::vector<double> numbers = make_point_set("uniform", 2, 60, 3);
  const Delaunay triangulation(numbers, 2);
  const Delaunay fixed_triangulation(as_arrays<2>(numbers));
  const Voronoi diagram(triangulation);
  static_assert(std::is_same_v<decltype(diagram), const Voronoi<dynamic>>);
  const Voronoi fixed(fixed_triangulation);
  static_assert(std::is_same_v<decltype(fixed), const Voronoi<2>>);
  static_assert(decltype(fixed.vertex(0))::extent == 2);
  const Voronoi<2> copy = fixed.clone();
  const Regular<2> regular(as_arrays<2>(numbers), std::vector<double>(60, 0.5));
  const PowerDiagram power(regular);
  static_assert(std::is_same_v<decltype(power), const PowerDiagram<2>>);
  const PowerDiagram<2> power_copy = power.clone();
  for (const Diagram* other : {static_cast<const Diagram*>(&fixed), static_cast<const Diagram*>(&copy),
                               static_cast<const Diagram*>(&power_copy)}) {
    EXPECT_EQ(other->num_vertices(), diagram.num_vertices());
    EXPECT_EQ(other->num_regions(), 60u);
    EXPECT_EQ(other->region_volumes().size(), 60u);
    EXPECT_EQ(other->to_data().weights.empty(), other != &power_copy);
  }
  EXPECT_EQ(Voronoi(triangulation, {.parts = DiagramParts::regions}).num_ridges(), 0u);
}

}  // namespace
}  // namespace delone
