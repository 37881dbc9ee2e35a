// SPDX-License-Identifier: BSD-3-Clause
// Intersections of halfspaces against their definition in rational numbers: general and degenerate, bounded
// and not, flat, empty.
#include "halfspace_brute_force.hpp"
#include "scale.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <delone/check.hpp>
#include <delone/halfspaces.hpp>

#include <cmath>
#include <random>
#include <string>

namespace {

using namespace delone;
using namespace delone::test;
using Rows = HalfspaceBruteForce::Rows;
using testing::ElementsAreArray;

Rows list(std::span<const SignedIndex> items) { return {items.begin(), items.end()}; }
Rows sorted(std::span<const SignedIndex> items) {
  Rows rows = list(items);
  std::sort(rows.begin(), rows.end());
  return rows;
}

void expect_same(const std::vector<double>& halfspaces, int dimension, const IntersectionData& data) {
  const auto d = static_cast<std::size_t>(dimension);
  HalfspaceBruteForce truth(halfspaces, dimension);
  ASSERT_EQ(data.state, truth.state());
  if (data.state != IntersectionState::full) {
    EXPECT_LE(data.witness.size(), d + 1);
    EXPECT_TRUE(HalfspaceBruteForce::has_no_interior(halfspaces, dimension, data.witness));
    return;
  }
  ASSERT_EQ(static_cast<std::size_t>(data.rank), truth.rank());
  EXPECT_EQ(data.lineality.size(), (d - truth.rank()) * d);
  if (data.rank == 0) return;
  truth.solve(data.axes);
  EXPECT_EQ(data.bounded, truth.rank() == d && truth.directions.empty());

  const std::size_t m = data.num_halfspaces();
  Rows facets;
  for (std::size_t r = 0; r < m; ++r) {
    EXPECT_EQ(data.kinds[r], truth.kind(r)) << "row " << r;
    EXPECT_EQ(static_cast<std::size_t>(data.first_of_halfspace[r]), truth.first_of(r)) << "row " << r;
    if (truth.kind(r) == HalfspaceKind::facet) facets.push_back(static_cast<SignedIndex>(r));
  }
  EXPECT_THAT(data.facet_halfspaces, ElementsAreArray(facets));

  // Vertices and directions are identified by the facets they are on.
  std::map<Rows, std::size_t> vertex_at, direction_at;
  for (std::size_t v = 0; v < data.num_vertices(); ++v)
    vertex_at.emplace(list(data.halfspaces_of_vertex(v)), v);
  for (std::size_t u = 0; u < data.num_directions(); ++u)
    direction_at.emplace(list(data.halfspaces_of_direction(u)), u);
  ASSERT_EQ(data.num_vertices(), truth.vertices.size());
  ASSERT_EQ(data.num_directions(), truth.directions.size());
  for (const auto& [x, tight] : truth.vertices) {
    const auto found = vertex_at.find(truth.facets_among(tight));
    ASSERT_NE(found, vertex_at.end());
    for (std::size_t j = 0; j < data.axes.size(); ++j)
      EXPECT_TRUE(is_nearest(data.vertex(found->second)[static_cast<std::size_t>(data.axes[j])], x[j]));
  }
  for (const auto& [u, tight] : truth.directions) {
    const auto found = direction_at.find(truth.facets_among(tight));
    ASSERT_NE(found, direction_at.end());
    double largest = 0;
    for (const double x : data.direction(found->second)) largest = std::max(largest, std::abs(x));
    for (std::size_t j = 0; j < data.axes.size(); ++j)
      EXPECT_NEAR(data.direction(found->second)[static_cast<std::size_t>(data.axes[j])] / largest,
                  static_cast<double>(u[j]), 1e-14);
  }

  std::set<std::pair<SignedIndex, SignedIndex>> edges, rays, true_edges, true_rays;
  for (std::size_t e = 0; e < data.num_edges(); ++e)
    edges.insert(std::minmax(data.edges[2 * e], data.edges[2 * e + 1]));
  for (std::size_t e = 0; e < data.num_rays(); ++e) rays.emplace(data.rays[2 * e], data.rays[2 * e + 1]);
  EXPECT_EQ(edges.size(), data.num_edges());
  EXPECT_EQ(rays.size(), data.num_rays());
  for (const auto& [x, tight] : truth.vertices) {
    const auto here = static_cast<SignedIndex>(vertex_at.at(truth.facets_among(tight)));
    for (const auto& [y, other] : truth.vertices)
      if (x < y && truth.is_edge(tight, other))
        true_edges.insert(
            std::minmax(here, static_cast<SignedIndex>(vertex_at.at(truth.facets_among(other)))));
    for (const auto& [u, other] : truth.directions)
      if (truth.is_edge(tight, other))
        true_rays.emplace(here, static_cast<SignedIndex>(direction_at.at(truth.facets_among(other))));
  }
  EXPECT_EQ(edges, true_edges);
  EXPECT_EQ(rays, true_rays);

  for (std::size_t f = 0; f < data.num_facets(); ++f) {
    Rows vertices, directions;
    for (const auto& [on, v] : vertex_at)
      if (std::count(on.begin(), on.end(), data.facet_halfspaces[f]) > 0)
        vertices.push_back(static_cast<SignedIndex>(v));
    for (const auto& [on, u] : direction_at)
      if (std::count(on.begin(), on.end(), data.facet_halfspaces[f]) > 0)
        directions.push_back(static_cast<SignedIndex>(u));
    std::sort(vertices.begin(), vertices.end());
    std::sort(directions.begin(), directions.end());
    EXPECT_EQ(sorted(data.facet(f)), vertices);
    EXPECT_EQ(sorted(data.directions_of_facet(f)), directions);
    if (dimension != 3 || data.rank != 3) continue;
    // Along the border: neighbors share an edge, and the turn is to the left seen from outside.
    const auto border = data.facet(f);
    for (std::size_t i = 0; i + 1 < border.size(); ++i)
      EXPECT_EQ(true_edges.count(std::minmax(border[i], border[i + 1])), 1u);
    if (border.size() < 3) continue;
    const double* n = &halfspaces[static_cast<std::size_t>(data.facet_halfspaces[f]) * 4];
    const auto a = data.vertex(static_cast<std::size_t>(border[0])),
               b = data.vertex(static_cast<std::size_t>(border[1])),
               c = data.vertex(static_cast<std::size_t>(border[2]));
    double turn = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t p = (j + 1) % 3, q = (j + 2) % 3;
      turn += n[j] * ((b[p] - a[p]) * (c[q] - a[q]) - (b[q] - a[q]) * (c[p] - a[p]));
    }
    EXPECT_GT(turn, 0);
  }
}

void expect_right(const std::vector<double>& halfspaces, int dimension) {
  const HalfspaceIntersection found(halfspaces, dimension);
  expect_same(halfspaces, dimension, found.data());
  if (testing::Test::HasFailure()) {
    std::string text;
    for (std::size_t i = 0; i < halfspaces.size(); ++i)
      text +=
          std::to_string(halfspaces[i]) +
          (i % static_cast<std::size_t>(dimension + 1) == static_cast<std::size_t>(dimension) ? "\n" : " ");
    FAIL() << "dimension " << dimension << ":\n" << text;
  }
  const CheckReport report = check(found.to_data());
  ASSERT_TRUE(report.ok) << report.violation;
}

std::vector<double> random_rows(std::mt19937& random, int dimension, int count, int range, int offset_low,
                                int offset_high) {
  std::uniform_int_distribution<int> entry(-range, range), offset(offset_low, offset_high);
  std::vector<double> rows;
  for (int r = 0; r < count; ++r) {
    for (int j = 0; j < dimension; ++j) rows.push_back(entry(random));
    rows.push_back(offset(random));
  }
  return rows;
}

std::vector<double> cube(int d) {
  std::vector<double> rows;
  for (int j = 0; j < d; ++j)
    for (const double sign : {-1.0, 1.0}) {
      for (int c = 0; c < d; ++c) rows.push_back(c == j ? sign : 0.0);
      rows.push_back(-1);
    }
  return rows;
}

std::vector<double> cross_polytope(int d) {
  std::vector<double> rows;
  for (int signs = 0; signs < 1 << d; ++signs) {
    for (int j = 0; j < d; ++j) rows.push_back(signs >> j & 1 ? 1.0 : -1.0);
    rows.push_back(-1);
  }
  return rows;
}

TEST(HalfspacesBruteForce, SmallIntegersAroundTheOrigin) {
  std::mt19937 random(1);
  for (int d = 1; d <= 4; ++d)
    for (int repeat = 0; repeat < static_cast<int>(scaled_count(d < 4 ? 60 : 25)); ++repeat) {
      expect_right(random_rows(random, d, static_cast<int>(random() % 10) + 1,
                               1 + static_cast<int>(random() % 3), -4, -1),
                   d);
      if (HasFatalFailure() || HasFailure()) return;
    }
}

TEST(HalfspacesBruteForce, SmallIntegersAnywhere) {
  std::mt19937 random(2);
  for (int d = 1; d <= 4; ++d)
    for (int repeat = 0; repeat < static_cast<int>(scaled_count(d < 4 ? 60 : 25)); ++repeat) {
      expect_right(
          random_rows(random, d, static_cast<int>(random() % 8), 1 + static_cast<int>(random() % 3), -3, 2),
          d);
      if (HasFatalFailure() || HasFailure()) return;
    }
}

TEST(HalfspacesBruteForce, GeneralPosition) {
  std::mt19937 random(3);
  for (int d = 2; d <= 4; ++d)
    for (int repeat = 0; repeat < static_cast<int>(scaled_count(20)); ++repeat) {
      expect_right(random_rows(random, d, 10, 1000, -1000, -1), d);
      if (HasFatalFailure() || HasFailure()) return;
    }
}

TEST(HalfspacesBruteForce, CubesAndCrossPolytopes) {
  for (int d = 1; d <= 4; ++d) expect_right(cube(d), d);
  for (int d = 1; d <= 3; ++d) expect_right(cross_polytope(d), d);
}

TEST(HalfspacesBruteForce, PyramidOverManySides) {
  for (int sides = 3; sides <= 9; ++sides) {
    std::vector<double> rows{0, 0, -1, 0};  // z ≥ 0, and sides through the apex (0, 0, 5)
    const int at[9][2] = {{5, 0}, {4, 3}, {3, 4}, {0, 5}, {-4, 3}, {-5, 0}, {-3, -4}, {0, -5}, {4, -3}};
    for (int i = 0; i < sides; ++i)
      for (const double x : {1.0 * at[i * 9 / sides][0], 1.0 * at[i * 9 / sides][1], 1.0, -5.0})
        rows.push_back(x);
    expect_right(rows, 3);
    if (HasFatalFailure()) return;
  }
}

TEST(HalfspacesBruteForce, ProportionalRowsAndRedundantOnes) {
  std::vector<double> rows = cube(3);
  for (const double x : {3.0, 0.0, 0.0, -3.0, 0.0, 2.0, 0.0, -6.0, 1.0, 1.0, 1.0, -3.0,
                         1.0, 1.0, 0.0, -2.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0})
    rows.push_back(x);
  const HalfspaceIntersection found(rows, 3);
  expect_same(rows, 3, found.data());
  const auto& kinds = found.data().kinds;
  EXPECT_EQ(kinds[6], HalfspaceKind::duplicate);
  EXPECT_EQ(kinds[7], HalfspaceKind::redundant);
  EXPECT_EQ(kinds[8], HalfspaceKind::touching);
  EXPECT_EQ(kinds[9], HalfspaceKind::touching);
  EXPECT_EQ(kinds[10], HalfspaceKind::trivial);
  EXPECT_EQ(kinds[11], HalfspaceKind::trivial);
}

TEST(HalfspacesBruteForce, WedgesSlabsAndHalfspaces) {
  expect_right({1, 0, -1}, 2);
  expect_right({1, 0, -1, -1, 0, -1}, 2);                               // a slab
  expect_right({1, 0, -1, -1, 0, -1, 0, 1, -1}, 2);                     // half a slab
  expect_right({1, 0, -1, 1, 0, -2, 0, 1, -1, 0, 1, -2}, 2);            // a wedge with redundant parallels
  expect_right({1, 0, 0, -1, 0, 1, 0, -1}, 3);                          // a wedge that contains lines
  expect_right({-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0}, 3);             // an orthant
  expect_right({1, 1, 0, 0, -1, 1, 0, 0, 0, 1, 1, 0, 0, 1, -1, 0}, 3);  // a cone of four sides
  expect_right({}, 3);
  expect_right({0, 0, -1}, 2);
}

TEST(HalfspacesBruteForce, FlatAndEmpty) {
  expect_right({1, 0, -1, -1, 0, 1, 0, 1, -1, 0, -1, -1}, 2);
  expect_right({1, 0, -1, -1, 0, 2}, 2);
  expect_right({1, 0, 0, 0, 1, 0, -1, -1, 0}, 2);  // one point
  expect_right({0, 0, 1}, 2);
  expect_right({1, 2, 3, -1, -2, -3}, 2);
}

TEST(HalfspacesBruteForce, OneUlp) {
  // The apex of a pyramid splits where one of its sides moves by one ulp, whichever way it moves.
  const std::vector<double> pyramid{0, 0, -1, 0, 1, 0, 1, -1, -1, 0, 1, -1, 0, 1, 1, -1, 0, -1, 1, -1};
  expect_right(pyramid, 3);
  EXPECT_EQ(HalfspaceIntersection(pyramid, 3).num_vertices(), 5u);
  for (const double to : {-2.0, 0.0}) {
    std::vector<double> moved = pyramid;
    moved[7] = std::nextafter(-1.0, to);
    expect_right(moved, 3);
    EXPECT_EQ(HalfspaceIntersection(moved, 3).num_vertices(), 6u);
  }
  // An interval of one ulp has interior points, none of them a double.
  const double low = 0.1, high = std::nextafter(0.1, 1.0);
  for (int d = 1; d <= 3; ++d) {
    std::vector<double> rows = cube(d);
    rows[static_cast<std::size_t>(d)] = low;
    rows[static_cast<std::size_t>(2 * d + 1)] = -high;
    expect_right(rows, d);
    EXPECT_FALSE(HalfspaceIntersection(rows, d).data().interior_point_is_exact);
  }
}

}  // namespace
