// SPDX-License-Identifier: BSD-3-Clause
// Furthest-site triangulations: against the definition in exact integers, against the upper hull of the
// lifted points, in any order of insertion; hidden are exactly the points that are not extreme.
#include "brute_force.hpp"
#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/lower_hull.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <vector>

namespace delone {
namespace {

using test::BruteForce;
using test::PointSet;
using test::sorted_cells;

constexpr CheckOptions strictly{.canonical = true, .furthest_site = true};

std::string describe(const PointSet& set) {
  return set.name + "\n" + test::to_text(set.points, set.dimension);
}

/// The set with its first and its last point once more.
PointSet with_duplicates(PointSet set) {
  const std::vector<double> first(set.points.begin(), set.points.begin() + set.dimension);
  const std::vector<double> last(set.points.end() - set.dimension, set.points.end());
  set.points.insert(set.points.end(), first.begin(), first.end());
  set.points.insert(set.points.end(), last.begin(), last.end());
  set.name += ", two duplicates";
  return set;
}

void expect_definition(const PointSet& set) {
  const int d = set.dimension;
  const BruteForce oracle(set.points, d, {}, {}, true);
  const ComplexData expected = oracle.to_data();
  const FurthestSite<> t(set.points, d);
  const ComplexData data = t.to_data();
  ASSERT_EQ(t.affine_dimension(), oracle.affine_dimension()) << describe(set);
  ASSERT_TRUE(test::same_cells(sorted_cells(expected), sorted_cells(data))) << describe(set);
  EXPECT_EQ(data.vertex_of_point, expected.vertex_of_point) << describe(set);
  EXPECT_EQ(t.hash(), canonical_hash(expected));
  const CheckReport report = check(data, strictly);
  EXPECT_TRUE(report.ok) << report.violation << describe(set);
  EXPECT_EQ(t.num_hidden(), t.hidden_rows().size());
  EXPECT_EQ(t.num_points(), t.num_vertices() + t.num_duplicates() + t.num_hidden());

  const auto width = static_cast<std::size_t>(d);
  for (const CellId c : t.finite_cells()) {
    BruteForce::Rows simplex;
    for (const VertexId v : t.vertices(c)) simplex.push_back(static_cast<SignedIndex>(t.row_of(v)));
    for (std::size_t row = 0; row < set.size(); ++row) {
      // The oracle's lifts are negated.
      const Side side = t.in_sphere(c, std::span(set.points).subspan(row * width, width));
      ASSERT_NE(side, Side::outside) << describe(set);
      ASSERT_EQ(static_cast<int>(side),
                static_cast<int>(oracle.in_sphere(simplex, static_cast<SignedIndex>(row))))
          << describe(set);
    }
  }
}

/// The hidden points are those that the convex hull calls neither extreme nor duplicates of such.
void expect_extreme_vertices(const PointSet& set) {
  const FurthestSite<> t(set.points, set.dimension);
  const ConvexHull hull(set.points, set.dimension);
  if (t.affine_dimension() < 1) return;
  std::set<std::vector<double>> extreme;
  const auto point = [&](std::size_t row) {
    const auto at = set.points.begin() + static_cast<std::ptrdiff_t>(row) * set.dimension;
    std::vector<double> p(at, at + set.dimension);
    for (double& x : p) x += 0.0;
    return p;
  };
  for (const SignedIndex row : hull.data().vertices) extreme.insert(point(static_cast<std::size_t>(row)));
  EXPECT_EQ(t.num_vertices(), extreme.size()) << describe(set);
  for (std::size_t row = 0; row < set.size(); ++row)
    ASSERT_EQ(t.is_hidden(row), !extreme.contains(point(row))) << row << describe(set);
}

TEST(FurthestSite, FollowsTheDefinition) {
  for (int d = 1; d <= 4; ++d)
    for (std::uint64_t seed = 0; seed < test::scaled_count(4); ++seed) {
      const std::size_t n = d < 4 ? 11 : 9;
      const PointSet flat = test::small_integers(std::max(d - 1, 1), n, 0, 3, seed);
      for (const PointSet& set :
           {test::small_integers(d, n, 0, 2, seed), test::mixed_exponents(d, n, -3, 3, seed + 7),
            test::embedded(flat, d, true, seed), test::sampled(test::cospherical(d, d == 1 ? 4 : 5), n, seed),
            test::nudged(test::sampled(test::cospherical(d, d == 1 ? 4 : 5), n, seed), seed),
            test::scaled(test::small_integers(d, n, -2, 2, seed), 1e300),
            test::scaled(test::small_integers(d, n, -2, 2, seed), 0x1p-1070)})
        expect_definition(with_duplicates(set));
    }
  expect_definition({"one place", 3, {1, 2, 3, 1, 2, 3}});
}

TEST(FurthestSite, VerticesAreTheExtremePoints) {
  for (int d = 1; d <= 4; ++d)
    for (const PointSet& set : test::degenerate_sets(d, 40, 3)) expect_extreme_vertices(set);
}

/// Sets of vertices of cells that share a sphere.
test::Cells merged(std::size_t cells, std::size_t corners, std::span<const SignedIndex> vertices,
                   const std::function<std::size_t(std::size_t)>& group) {
  std::vector<std::set<SignedIndex>> sets(cells);
  for (std::size_t i = 0; i < cells * corners; ++i) sets[group(i / corners)].insert(vertices[i]);
  test::Cells result;
  for (const auto& rows : sets)
    if (!rows.empty()) result.emplace_back(rows.begin(), rows.end());
  std::sort(result.begin(), result.end());
  return result;
}

TEST(FurthestSite, IsTheUpperHullOfTheLiftedPoints) {
  for (int d = 1; d <= 5; ++d)
    for (std::uint64_t seed = 0; seed < test::scaled_count(3); ++seed)
      for (const int range : {2, 6, 1000}) {
        const std::size_t n = d < 4 ? 120 : 40, width = static_cast<std::size_t>(d);
        const PointSet set = test::small_integers(d, n, -range, range, seed);
        std::vector<double> lifted;
        for (std::size_t row = 0; row < set.size(); ++row) {
          const auto p = std::span(set.points).subspan(row * width, width);
          lifted.insert(lifted.end(), p.begin(), p.end());
          lifted.push_back(std::inner_product(p.begin(), p.end(), p.begin(), 0.0));
        }
        const LowerHull upper(lifted, d + 1, HullSide::upper);
        const FurthestSite<> t(set.points, d);
        const ComplexData data = t.to_data();
        ASSERT_EQ(t.affine_dimension(), upper.composition_dimension());

        // Cells of one sphere are connected.
        std::vector<std::size_t> group(data.num_cells());
        std::iota(group.begin(), group.end(), std::size_t{0});
        const std::function<std::size_t(std::size_t)> root = [&](std::size_t c) {
          while (group[c] != c) c = group[c] = group[group[c]];
          return c;
        };
        std::vector<CellId> cells;
        for (const CellId c : t.finite_cells()) cells.push_back(c);
        for (std::size_t at = 0; at < data.neighbors.size(); ++at) {
          const std::size_t c = at / (width + 1);
          if (data.neighbors[at] < 0) continue;
          const auto other = static_cast<std::size_t>(data.neighbors[at]);
          const VertexId apex = t.complex().vertex(
              cells[other], t.complex().mirror_index(cells[c], static_cast<int>(at % (width + 1))));
          if (t.in_sphere(cells[c], t.point(apex)) == Side::on)
            group[std::max(root(c), root(other))] = std::min(root(c), root(other));
        }
        // Of equal points the hull may name another row.
        std::vector<SignedIndex> hull_cells(upper.cells().begin(), upper.cells().end());
        for (SignedIndex& row : hull_cells) row = data.vertex_of_point[static_cast<std::size_t>(row)];
        const auto facet = upper.facet_of_cell();
        EXPECT_TRUE(
            test::same_cells(merged(upper.num_cells(), width + 1, hull_cells,
                                    [&](std::size_t c) { return static_cast<std::size_t>(facet[c]); }),
                             merged(data.num_cells(), width + 1, data.cells, root)))
            << describe(set);
      }
}

TEST(FurthestSite, DoesNotDependOnTheOrder) {
  for (int d = 1; d <= 4; ++d)
    for (const PointSet& set : test::degenerate_sets(d, 40, 5)) {
      const FurthestSite<> batch(set.points, d);
      const auto hash = batch.hash();
      for (const InsertionOrder order : {InsertionOrder::as_given, InsertionOrder::shuffled})
        EXPECT_EQ(FurthestSite<>(set.points, d, {.seed = 7, .order = order, .force_runtime_dimension = true})
                      .hash(),
                  hash)
            << describe(set);
      FurthestSite<> t(d);
      const auto width = static_cast<std::size_t>(d);
      for (const std::size_t row : test::random_order(set.size(), 11)) {
        const auto point = std::span(set.points).subspan(row * width, width);
        const bool in_flat = t.affine_dimension() == d;
        const bool in_conflict = in_flat && !t.conflict_zone(point).empty();
        const InsertResult result = t.insert(point);
        if (in_flat) {
          ASSERT_EQ(result.inserted, in_conflict) << describe(set);
        }
      }
      EXPECT_EQ(t.hash(), hash) << describe(set);
      EXPECT_EQ(t.num_hidden(), batch.num_hidden());
      EXPECT_EQ(t.num_duplicates(), batch.num_duplicates());
      for (const VertexId v : t.complex().finite_vertices())
        EXPECT_GE(t.complex().index_of(t.complex().incident_cell(v), v), 0);
      const CheckReport report = check(t.to_data(), strictly);
      EXPECT_TRUE(report.ok) << report.violation << describe(set);
    }
}

TEST(FurthestSite, ManyPointsPassTheCheck) {
  for (int d = 2; d <= 5; ++d) {
    test::Random random(static_cast<std::uint64_t>(d));
    // In a cube, where most are hidden, and near a sphere, where none is.
    for (const bool spherical : {false, true}) {
      std::vector<double> points;
      for (int i = 0; i < (d < 4 ? 1000 : 150); ++i) {
        std::vector<double> x;
        double square = 0;
        for (int j = 0; j < d; ++j) {
          x.push_back(random.real() + random.real() + random.real() - 1.5);
          square += x.back() * x.back();
        }
        for (const double xj : x) points.push_back(spherical ? xj / std::sqrt(square) : xj);
      }
      const FurthestSite<> t(points, d);
      const CheckReport report = check(t.to_data(), strictly);
      EXPECT_TRUE(report.ok) << report.violation;
      if (spherical) continue;
      // The cached functionals serve here, too.
      EXPECT_GT(t.num_hidden(), 0u);
      EXPECT_LT(t.statistics().direct + t.statistics().exact,
                t.statistics().filter / 10 + 100 * static_cast<unsigned>(d))
          << d;
    }
  }
}

TEST(FurthestSite, CheckFindsWhatIsWrong) {
  const std::vector<double> points{0, 0, 4, 0, 5, 3, 0, 4, 2, 2};
  const FurthestSite<> t(points, 2);
  const ComplexData good = t.to_data();
  ASSERT_EQ(t.num_hidden(), 1u);
  ASSERT_TRUE(check(good, strictly).ok);
  EXPECT_TRUE(check(good).ok) << "they say what they are";
  const auto unknown = [](ComplexData data) {
    data.kind = DataKind::unknown;
    return data;
  };
  EXPECT_FALSE(check(unknown(good)).ok);
  EXPECT_TRUE(check(unknown(good), strictly).ok);
  EXPECT_FALSE(check(unknown(Delaunay<>(points, 2).to_data()), strictly).ok);
  ComplexData bad = good;
  bad.vertex_of_point[4] = 0;
  EXPECT_EQ(check(bad, strictly).reached.name, "completeness");
  bad = good;
  bad.points[8] = 9;  // outside the hull
  EXPECT_FALSE(check(bad, strictly).ok);
  bad = good;
  bad.weights.assign(5, 0.0);
  EXPECT_EQ(check(bad, strictly).reached.name, "storage");
  // The other diagonal of the quadrangle.
  const std::vector<double> corners(points.begin(), points.begin() + 8);
  const FurthestSite<> four(corners, 2);
  const Delaunay<> nearest(corners, 2);
  EXPECT_NE(four.hash(), nearest.hash());
  EXPECT_FALSE(check(unknown(nearest.to_data()), strictly).ok);
}

TEST(FurthestSite, CompiledDimensionsAndBadInput) {
  const std::vector<std::array<double, 3>> points{
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2, 0.2, 0.2}};
  const FurthestSite<3> t(points);
  EXPECT_EQ(t.num_finite_cells(), 1u);
  EXPECT_TRUE(t.is_hidden(4));
  EXPECT_EQ(t.hidden_rows(), (std::vector<std::size_t>{4}));
  EXPECT_THROW(static_cast<void>(t.is_hidden(5)), Error);
  EXPECT_THROW(FurthestSite<>(0), Error);
  const std::vector<double> nan{0, std::nan("")};
  EXPECT_THROW(FurthestSite<>(nan, 2), Error);
  EXPECT_EQ(t.locate(std::vector<double>{0.1, 0.1, 0.1}).kind, Location::Kind::in_cell);
}

}  // namespace
}  // namespace delone
