// SPDX-License-Identifier: BSD-3-Clause
// The result is a function of the set of points: neither the order of the input, nor the order of insertion,
// nor the seed, nor the engine that was compiled for the dimension changes it.
#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace delone {
namespace {

using test::PointSet;

Delaunay<> one_by_one(const PointSet& set, const Options& options) {
  Delaunay<> result(set.dimension, options);
  const auto d = static_cast<std::size_t>(set.dimension);
  for (std::size_t row = 0; row < set.size(); ++row) result.insert(std::span(set.points).subspan(row * d, d));
  return result;
}

Options with(InsertionOrder order, std::uint64_t seed, bool force_runtime_dimension) {
  Options options;
  options.order = order;
  options.seed = seed;
  options.force_runtime_dimension = force_runtime_dimension;
  return options;
}

void expect_same_by_all_routes(const PointSet& set) {
  SCOPED_TRACE(set.name + "\n" + test::to_text(set.points, set.dimension));
  const Delaunay<> reference(set.points, set.dimension);
  const CanonicalHash hash = reference.hash();
  EXPECT_EQ(canonical_hash(reference.to_data()).hex(), hash.hex()) << "hash of the plain data";

  const auto expect_same = [&](const Delaunay<>& other, const char* route) {
    EXPECT_EQ(other.hash().hex(), hash.hex()) << route;
    EXPECT_EQ(other.num_finite_cells(), reference.num_finite_cells()) << route;
    EXPECT_EQ(other.num_infinite_cells(), reference.num_infinite_cells()) << route;
    EXPECT_EQ(other.num_vertices(), reference.num_vertices()) << route;
    EXPECT_EQ(other.affine_dimension(), reference.affine_dimension()) << route;
  };
  const int d = set.dimension;
  expect_same({set.points, d, with(InsertionOrder::automatic, 12345, false)}, "another seed");
  expect_same({set.points, d, with(InsertionOrder::as_given, 0, false)}, "as given");
  expect_same({set.points, d, with(InsertionOrder::shuffled, 7, false)}, "shuffled");
  expect_same({set.points, d, with(InsertionOrder::automatic, 0, true)}, "run-time dimension");
  expect_same(one_by_one(set, {}), "one by one");
  const PointSet permuted = test::permuted(set, 99);
  expect_same({permuted.points, d}, "permuted input");
  expect_same({permuted.points, d, with(InsertionOrder::as_given, 0, true)},
              "permuted input, as given, run-time dimension");
  expect_same(one_by_one(permuted, with(InsertionOrder::automatic, 0, true)),
              "permuted, one by one, run-time dimension");

  // The vertices are the first rows of equal points in every route, so the rows of the cells agree as well.
  EXPECT_TRUE(test::same_cells(test::sorted_cells(reference.to_data()),
                               test::sorted_cells(one_by_one(set, {}).to_data())));
}

class OrderIndependenceIn : public ::testing::TestWithParam<int> {
 protected:
  std::size_t num_points() const {
    static constexpr std::size_t usual[] = {1000, 1000, 600, 200, 80, 40, 25};
    return test::scaled_count(usual[GetParam() - 1]);
  }
};
INSTANTIATE_TEST_SUITE_P(Dimensions, OrderIndependenceIn, ::testing::Range(1, 8),
                         ::testing::PrintToStringParamName());

TEST_P(OrderIndependenceIn, UniformPoints) {
  expect_same_by_all_routes({"uniform", GetParam(), make_point_set("uniform", GetParam(), num_points(), 5)});
}

TEST_P(OrderIndependenceIn, DegenerateSets) {
  static constexpr std::size_t usual[] = {300, 200, 120, 50, 30, 18, 14};
  for (const PointSet& set :
       test::degenerate_sets(GetParam(), test::scaled_count(usual[GetParam() - 1]), 3)) {
    expect_same_by_all_routes(set);
    if (HasFailure()) return;
  }
}

TEST_P(OrderIndependenceIn, DuplicatesInAnyNumber) {
  PointSet set = test::small_integers(GetParam(), num_points(), 0, 2, 8);
  for (std::size_t i = 0; i < set.points.size(); i += 3) set.points[i] *= -0.0;  // −0 and +0 are one number
  expect_same_by_all_routes(set);
}

TEST(OrderIndependence, HashTellsTriangulationsApart) {
  // The same points with another diagonal, another point, or another sign of nothing.
  const auto square = [](std::vector<double> points, std::vector<SignedIndex> cells) {
    return canonical_hash({2, 2, std::move(points), std::move(cells), {}, {}}).hex();
  };
  const std::string one = square({0, 0, 1, 0, 0, 1, 1, 1}, {0, 1, 2, 1, 3, 2});
  EXPECT_EQ(one, square({0, 0, 1, 0, 0, 1, 1, 1}, {3, 2, 1, 2, 0, 1}));
  EXPECT_EQ(one, square({1, 1, 0, 1, 1, 0, -0.0, 0}, {3, 2, 1, 2, 0, 1}));
  EXPECT_EQ(one, square({0, 0, 1, 0, 0, 1, 1, 1, 1, -0.0}, {0, 1, 2, 4, 3, 2})) << "a duplicate is no vertex";
  EXPECT_NE(one, square({0, 0, 1, 0, 0, 1, 1, 1}, {0, 1, 3, 0, 3, 2}));
  EXPECT_NE(one, square({0, 0, 1, 0, 0, 1, 1, 1}, {0, 1, 2}));
  EXPECT_NE(one, square({0, 0, 1, 0, 0, 1, 1, 1, 2, 2}, {0, 1, 2, 1, 3, 2}));
  EXPECT_NE(one, square({0, 0, 1, 0, 0, 1, 1, 1 + 0x1p-52}, {0, 1, 2, 1, 3, 2}));
}

RC_GTEST_PROP(OrderIndependence, SmallIntegersInAnyOrder, ()) {
  const int d = *rc::gen::inRange(1, 6);
  const auto coordinates = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-3, 4));
  PointSet set{"integers", d, {coordinates.begin(), coordinates.end()}};
  set.points.resize(set.points.size() - set.points.size() % static_cast<std::size_t>(d));
  const PointSet permuted = test::permuted(set, *rc::gen::arbitrary<std::uint64_t>());
  RC_ASSERT(one_by_one(set, {}).hash() == one_by_one(permuted, {}).hash());
  RC_ASSERT(one_by_one(set, {}).hash() == Delaunay<>(permuted.points, d).hash());
}

}  // namespace
}  // namespace delone
