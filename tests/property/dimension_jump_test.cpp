// SPDX-License-Identifier: BSD-3-Clause
// Points inserted one by one through all affine dimensions: every prefix is a correct triangulation inside
// its own flat.
#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/predicates.hpp>

#include <gtest/gtest.h>

namespace delone {
namespace {

using test::PointSet;

void expect_correct(const Triangulation& triangulation, const char* what) {
  CheckOptions all;
  all.canonical = true;
  const CheckReport report = check(triangulation.to_data(), all);
  EXPECT_TRUE(report.ok) << what << ": level " << report.reached.number << ": " << report.violation;
}

void expect_every_prefix_correct(const PointSet& set, bool force_runtime_dimension) {
  SCOPED_TRACE(set.name + "\n" + test::to_text(set.points, set.dimension));
  Options options;
  options.force_runtime_dimension = force_runtime_dimension;
  Delaunay<> triangulation(set.dimension, options);
  const auto d = static_cast<std::size_t>(set.dimension);
  for (std::size_t row = 0; row < set.size(); ++row) {
    triangulation.insert(std::span(set.points).subspan(row * d, d));
    const std::span prefix(set.points.data(), (row + 1) * d);
    ASSERT_EQ(triangulation.affine_dimension(), affine_dimension(prefix, set.dimension)) << "row " << row;
    ASSERT_EQ(triangulation.axes().size(), static_cast<std::size_t>(triangulation.affine_dimension()));
    expect_correct(triangulation, "one by one");
    if (::testing::Test::HasFailure()) {
      ADD_FAILURE() << "after row " << row;
      return;
    }
  }
  EXPECT_EQ(triangulation.hash(), Delaunay<>(set.points, set.dimension).hash());
}

class DimensionJumpIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, DimensionJumpIn, ::testing::Range(1, 7),
                         ::testing::PrintToStringParamName());

// A few points of every flat before the first point beyond it.
TEST_P(DimensionJumpIn, ThroughAllFlats) {
  const int d = GetParam();
  for (std::uint64_t seed = 0; seed < test::scaled_count(6); ++seed)
    for (const bool tilted : {false, true}) {
      PointSet set{tilted ? "tilted flats" : "coordinate flats", d, {}};
      const auto append = [&](const PointSet& more) {
        set.points.insert(set.points.end(), more.points.begin(), more.points.end());
      };
      test::Random random(seed);
      for (int k = 1; k <= d; ++k) {
        // The same embedding, with the coordinates after the k-th at zero.
        PointSet flat = test::small_integers(d, static_cast<std::size_t>(random.integer(1, k < 4 ? 6 : 3)),
                                             -2, 2, seed * 10 + static_cast<unsigned>(k));
        for (std::size_t i = 0; i < flat.points.size(); ++i)
          if (static_cast<int>(i) % d >= k) flat.points[i] = 0;
        append(flat);
      }
      expect_every_prefix_correct(tilted ? test::embedded(set, d + 1, true, seed) : set, seed % 2 == 1);
      if (HasFailure()) return;
    }
}

TEST_P(DimensionJumpIn, LatticeRowByRow) {
  const int d = GetParam();
  expect_every_prefix_correct(test::lattice(d, d <= 2 ? 6 : d == 3 ? 4 : d == 4 ? 3 : 2), false);
}

TEST_P(DimensionJumpIn, BatchesJumpToo) {
  // The points of a flat first, then the rest, each as one range: the second range finds an engine of a lower
  // dimension.
  const int d = GetParam();
  for (int k = 0; k < d; ++k) {
    PointSet flat = test::small_integers(d, 40, -5, 5, 3);
    for (std::size_t i = 0; i < flat.points.size(); ++i)
      if (static_cast<int>(i) % d >= k) flat.points[i] = 1;
    const PointSet rest = test::small_integers(d, 20, -5, 5, 4);
    Delaunay<> triangulation(flat.points, d);
    EXPECT_EQ(triangulation.affine_dimension(), k);
    expect_correct(triangulation, "flat range");
    triangulation.insert_range(rest.points);
    EXPECT_EQ(triangulation.affine_dimension(), d);
    expect_correct(triangulation, "second range");
    std::vector<double> all = rest.points;
    all.insert(all.end(), flat.points.begin(), flat.points.end());
    EXPECT_EQ(triangulation.hash(), Delaunay<>(all, d).hash());
  }
}

TEST_P(DimensionJumpIn, NoPointOnePointTwoPoints) {
  const int d = GetParam();
  const auto size = static_cast<std::size_t>(d);
  Delaunay<> none(d);
  EXPECT_EQ(none.affine_dimension(), -1);
  EXPECT_EQ(none.num_vertices(), 0u);
  EXPECT_EQ(none.num_finite_cells(), 0u);
  EXPECT_EQ(none.num_infinite_cells(), 0u);
  expect_correct(none, "no point");
  EXPECT_EQ(none.locate(std::vector<double>(size, 0.5)).kind, Location::Kind::outside_affine_hull);
  EXPECT_EQ(Delaunay<>(std::vector<double>{}, d).hash(), none.hash());

  const std::vector<double> equal(7 * size, 0.25);
  const Delaunay<> one(equal, d);
  EXPECT_EQ(one.affine_dimension(), 0);
  EXPECT_EQ(one.num_vertices(), 1u);
  EXPECT_EQ(one.num_duplicates(), 6u);
  EXPECT_EQ(one.num_finite_cells(), 1u);
  expect_correct(one, "seven equal points");
  EXPECT_EQ(one.locate(std::vector<double>(size, 0.25)).kind, Location::Kind::on_vertex);
  EXPECT_EQ(one.locate(std::vector<double>(size, 0.5)).kind, Location::Kind::outside_affine_hull);

  std::vector<double> pair(2 * size, 3.0);
  pair.back() = 4.0;
  const Delaunay<> two(pair, d);
  EXPECT_EQ(two.affine_dimension(), 1);
  EXPECT_EQ(two.num_finite_cells(), 1u);
  EXPECT_EQ(two.num_infinite_cells(), 2u);
  expect_correct(two, "two points");
}

TEST_P(DimensionJumpIn, AnErrorLeavesTheTriangulationAsItWas) {
  const int d = GetParam();
  Delaunay<> triangulation(make_point_set("uniform", d, 30, 1), d);
  const CanonicalHash before = triangulation.hash();
  std::vector<double> bad(3 * static_cast<std::size_t>(d), 0.5);
  bad.back() = std::numeric_limits<double>::quiet_NaN();
  try {
    triangulation.insert_range(bad);
    ADD_FAILURE() << "a coordinate that is not a number went unnoticed";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows(), std::vector<std::size_t>{2}) << error.what();
  }
  EXPECT_EQ(triangulation.hash(), before);
  EXPECT_EQ(triangulation.num_points(), 30u);
  expect_correct(triangulation, "after the error");
}

}  // namespace
}  // namespace delone
