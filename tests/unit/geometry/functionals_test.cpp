// SPDX-License-Identifier: BSD-3-Clause
// The filter never lies: cached functionals of real triangulations, made by elimination and by the pencil,
// against exact signs and exact values, far from their cells as well as near.
#include "brute_force.hpp"
#include "engine/build.hpp"
#include "geometry/delaunay_geometry.hpp"
#include "kernel/predicates.hpp"
#include "scale.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace delone::geometry {
namespace {

/// A triangulation of points in full dimension, by the engine alone.
template <int K>
struct Built {
  Built(std::vector<double> coordinates)
      : points(K, 0.0),
        grid(K),
        build(K, cells::ids_for(coordinates.size() / K), all_axes(), K, points, grid, frame(coordinates)),
        geometry(build.geometry()) {
    kernel::AffineHull hull(K);
    std::vector<Index> simplex, others;
    points.insert(points.end(), coordinates.begin(), coordinates.end());
    const auto n = static_cast<Index>(coordinates.size() / K);
    for (Index v = 1; v <= n; ++v) {
      grid.include(geometry.point(v));
      (hull.add(geometry.point(v)) ? simplex : others).push_back(v);
    }
    if (geometry.orientation(simplex.data()) == Sign::negative) std::swap(simplex[0], simplex[1]);
    geometry.set_rows(n);
    build.seed(simplex);
    for (const Index v : others) build.insert(v);
    num_vertices = n;
  }

  static std::vector<int> all_axes() {
    std::vector<int> axes(K);
    std::iota(axes.begin(), axes.end(), 0);
    return axes;
  }
  static Frame frame(const std::vector<double>& coordinates) {
    std::vector<double> low(coordinates.begin(), coordinates.begin() + K), high = low;
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      low[i % K] = std::min(low[i % K], coordinates[i]);
      high[i % K] = std::max(high[i % K], coordinates[i]);
    }
    return {low, high};
  }

  std::vector<double> points;
  kernel::Grid grid;
  engine::Build<K, DelaunayGeometry<K>> build;
  DelaunayGeometry<K>& geometry;
  const engine::CellStore<K>& cells = build.cells();
  Index num_vertices = 0;
};

/// Pairs of a cell and a vertex that is not its own: what the filter says must be the exact sign, zero
/// included. Returns how often it says something.
template <int K>
double expect_certified_signs_are_right(const char* kind, std::size_t n, std::size_t pairs) {
  SCOPED_TRACE(testing::Message() << kind << " in dimension " << K);
  const Built<K> built(make_point_set(kind, K, n, 5));
  const std::size_t all = static_cast<std::size_t>(built.cells.num_slots()) * built.num_vertices;
  const std::size_t stride = std::max<std::size_t>(1, all / test::scaled_count(pairs));
  std::size_t certified = 0, tested = 0;
  StageCounts counts;
  for (std::size_t pair = 0; pair < all; pair += stride) {
    const auto cell = static_cast<Index>(pair / built.num_vertices);
    const auto v = static_cast<Index>(pair % built.num_vertices + 1);
    if (built.cells.is_vacant(cell)) continue;
    const auto q = built.geometry.make_query(built.geometry.point(v));
    if (engine::vertex_at(built.cells, built.geometry, cell, q) != invalid_index) continue;
    const double value = built.geometry.value(cell, q), threshold = built.geometry.threshold(cell);
    const Sign side = value < -threshold ? Sign::negative : value > threshold ? Sign::positive : Sign::zero;
    ++tested;
    if (side == Sign::zero && !built.geometry.proves_tie(cell, value, q)) continue;
    ++certified;
    const auto vertices = built.cells.vertices(cell);
    EXPECT_EQ(side, built.geometry.exact_side(vertices, built.cells.infinite_slot(cell), q, counts));
  }
  return static_cast<double>(certified) / static_cast<double>(tested);
}

TEST(Filter, NeverContradictsTheExactSignAndUsuallyKnowsIt) {
  for (const char* kind : {"uniform", "manifold", "clusters", "plummer", "offset"}) {
    EXPECT_GT(expect_certified_signs_are_right<2>(kind, 300, 20000), 0.95);
    EXPECT_GT(expect_certified_signs_are_right<3>(kind, 300, 20000), 0.95);
    EXPECT_GT(expect_certified_signs_are_right<4>(kind, 120, 20000), 0.95);
    EXPECT_GT(expect_certified_signs_are_right<5>(kind, 60, 20000), 0.95);
  }
  EXPECT_GT(expect_certified_signs_are_right<6>("uniform", 40, 20000), 0.99);
  EXPECT_GT(expect_certified_signs_are_right<7>("uniform", 30, 20000), 0.99);
}

TEST(Filter, NeverContradictsTheExactSignOfTies) {
  const bool is_small = test::scaled_count(10) < 10;  // then no more points than a cube has corners
  for (const char* kind : {"grid", "tilted_grid", "nudged_grid", "cospherical", "ulp_sphere"}) {
    expect_certified_signs_are_right<2>(kind, 256, 20000);
    expect_certified_signs_are_right<3>(kind, 216, 20000);
    expect_certified_signs_are_right<4>(kind, is_small ? 16 : 256, 20000);
    expect_certified_signs_are_right<5>(kind, is_small ? 32 : 243, 20000);
  }
}

TEST(Filter, ProvesTheTiesOfLattices) {
  // Nothing is left to the exact stages but where cells are so flat that their thresholds are large.
  EXPECT_GT(expect_certified_signs_are_right<2>("grid", 1024, 20000), 0.99);
  EXPECT_GT(expect_certified_signs_are_right<3>("grid", 1000, 20000), 0.99);
  EXPECT_GT(expect_certified_signs_are_right<4>("grid", 625, 20000), 0.99);
  EXPECT_GT(expect_certified_signs_are_right<5>("grid", 243, 20000), 0.95);
}

using Rational = boost::multiprecision::cpp_rational;

/// The power of x with respect to the sphere through the vertices: x's height above the hyperplane of the
/// lifted vertices.
template <int K>
Rational power(const Built<K>& built, const Index* vertices, const double* x) {
  std::vector<double> rows;
  for (int i = 0; i <= K; ++i)
    rows.insert(rows.end(), built.geometry.point(vertices[i]), built.geometry.point(vertices[i]) + K);
  rows.insert(rows.end(), x, x + K);
  rows.push_back(1);
  rows.resize(static_cast<std::size_t>((K + 3) * K), 0.0);
  test::Matrix points = test::scaled_to_integers(rows, K);
  const test::Integer one = points.back()[0];
  points.pop_back();
  test::Matrix lifted, up;
  for (const auto& row : points) {
    lifted.push_back(row);
    test::Integer square = 0;
    for (const auto& c : row) square += c * c;
    lifted.back().push_back(square);
    lifted.back().push_back(1);
  }
  up = lifted;
  for (auto& entry : up.back()) entry = 0;
  up.back()[K] = 1;
  test::Integer numerator = test::determinant(lifted), denominator = test::determinant(up) * one * one;
  if (denominator < 0) {  // Boost 1.74 takes positive denominators only
    numerator = -numerator;
    denominator = -denominator;
  }
  return Rational(numerator, denominator);
}

template <int K>
void expect_values_within_thresholds(const char* kind, std::size_t n) {
  SCOPED_TRACE(testing::Message() << kind << " in dimension " << K);
  const Built<K> built(make_point_set(kind, K, n, 9));
  const double scale = built.geometry.frame().lift_scale();
  std::size_t compared = 0;
  for (Index cell = 0; cell < built.cells.num_slots(); ++cell) {
    if (built.cells.is_vacant(cell) || built.cells.infinite_slot(cell) >= 0) continue;
    if (std::isinf(built.geometry.threshold(cell))) continue;  // claims nothing
    for (Index v = 1 + cell % 7; v <= built.num_vertices; v += 7) {
      const auto q = built.geometry.make_query(built.geometry.point(v));
      const auto vertices = built.cells.vertices(cell);
      const Rational exact = power(built, vertices, q.point) * Rational(scale) * Rational(scale);
      const Rational error = abs(Rational(built.geometry.value(cell, q)) - exact);
      ASSERT_LE(error, Rational(built.geometry.threshold(cell))) << "cell " << cell << ", vertex " << v;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100u);
}

TEST(Filter, ThresholdsBoundTheTrueError) {
  expect_values_within_thresholds<2>("uniform", 40);
  expect_values_within_thresholds<2>("clusters", 40);
  expect_values_within_thresholds<3>("uniform", 25);
  expect_values_within_thresholds<3>("nudged_grid", 27);
  expect_values_within_thresholds<4>("uniform", 15);
}

/// What insertions have found out of a grid must not outlive it: on a finer grid a value proves less.
TEST(Filter, ForgetsAGridThatHasBecomeFiner) {
  std::vector<double> lattice;
  for (int i = 0; i < 16; ++i) lattice.insert(lattice.end(), {i % 4 + 0.0, i / 4 + 0.0});
  Built<2> built(lattice);
  const double at[] = {0.125, 0.5};
  const LatticeBounds before = built.geometry.make_query(built.geometry.point(1)).bounds;
  built.grid.include(at);
  const LatticeBounds finer = built.geometry.make_query(at).bounds;
  EXPECT_GT(before.numerator, 0.0);
  EXPECT_EQ(finer.numerator, before.numerator * 0x1p-10);  // two axes and a square: 3, 1 and 2·3 bits
  EXPECT_EQ(finer.determinant, before.determinant * 0x1p-4);
}

}  // namespace
}  // namespace delone::geometry
