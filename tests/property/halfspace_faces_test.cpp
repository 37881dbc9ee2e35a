// SPDX-License-Identifier: BSD-3-Clause
// Polyhedra whose faces are known: cubes, cross-polytopes, simplices, duals of cyclic polytopes, cones and
// orthants; Euler's relation on any; points given back by the intersection of the facets of their hull,
// exactly.
#include "degenerate.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>
#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/halfspaces.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <random>
#include <set>
#include <vector>

namespace {

using namespace delone;
using namespace delone::test;
using Rows = std::vector<SignedIndex>;
using Counts = std::vector<std::int64_t>;

/// The number of faces of dimension 0 … k, the polyhedron itself the last, from the lists of rows alone: a
/// face is where all rows that two vertices, or a vertex and a direction, have in common hold with equality.
Counts f_vector(const IntersectionData& data) {
  std::vector<Rows> generators;
  std::set<Rows> faces;
  for (std::size_t v = 0; v < data.num_vertices(); ++v) {
    generators.emplace_back(data.halfspaces_of_vertex(v).begin(), data.halfspaces_of_vertex(v).end());
    faces.insert(generators.back());
  }
  for (std::size_t u = 0; u < data.num_directions(); ++u)
    generators.emplace_back(data.halfspaces_of_direction(u).begin(), data.halfspaces_of_direction(u).end());
  std::vector<Rows> next(faces.begin(), faces.end());
  while (!next.empty()) {
    const Rows face = next.back();
    next.pop_back();
    for (const Rows& other : generators) {
      Rows common;
      std::set_intersection(face.begin(), face.end(), other.begin(), other.end(), std::back_inserter(common));
      if (faces.insert(common).second) next.push_back(common);
    }
  }
  // Faces by the number of rows, falling: those within a face come before it.
  std::vector<Rows> sorted(faces.begin(), faces.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Rows& a, const Rows& b) { return a.size() > b.size(); });
  std::vector<std::size_t> dimension_of(sorted.size(), 0);
  Counts counts;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      if (sorted[j].size() > sorted[i].size() && dimension_of[j] >= dimension_of[i] &&
          std::includes(sorted[j].begin(), sorted[j].end(), sorted[i].begin(), sorted[i].end()))
        dimension_of[i] = dimension_of[j] + 1;
    counts.resize(std::max(counts.size(), dimension_of[i] + 1), 0);
    ++counts[dimension_of[i]];
  }
  return counts;
}

std::int64_t alternating_sum(const Counts& counts) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) sum += i % 2 == 0 ? counts[i] : -counts[i];
  return sum;
}

std::int64_t binomial(std::int64_t n, std::int64_t k) {
  std::int64_t result = 1;
  for (std::int64_t i = 0; i < k; ++i) result = result * (n - i) / (i + 1);
  return k < 0 || k > n ? 0 : result;
}

/// Examines the intersection, and returns what its faces count.
Counts counts_of(const std::vector<double>& rows, int d) {
  const HalfspaceIntersection found(rows, d);
  const IntersectionData data = found.to_data();
  const CheckReport report = check(data);
  EXPECT_TRUE(report.ok) << report.violation;
  Counts counts = f_vector(data);
  const auto k = static_cast<std::size_t>(data.rank);
  EXPECT_EQ(counts.size(), k + 1);
  counts.resize(k + 1, 0);
  EXPECT_EQ(alternating_sum(counts), data.bounded ? 1 : 0);  // Euler, Poincaré
  EXPECT_EQ(static_cast<std::size_t>(counts[0]), data.num_vertices());
  EXPECT_EQ(static_cast<std::size_t>(counts[k - 1]), data.num_facets());
  if (k > 1) {
    EXPECT_EQ(static_cast<std::size_t>(counts[1]), data.num_edges() + data.num_rays());
  }
  return counts;
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

TEST(HalfspaceFaces, Cubes) {
  for (int d = 1; d <= 5; ++d) {
    Counts expected;
    for (int i = 0; i <= d; ++i) expected.push_back((std::int64_t{1} << (d - i)) * binomial(d, i));
    EXPECT_EQ(counts_of(cube(d), d), expected) << d;
    // Without one of its rows a cube is a prism without a lid: half of all that is on that facet is gone.
    if (d < 2) continue;
    std::vector<double> open = cube(d);
    open.resize(open.size() - static_cast<std::size_t>(d) - 1);
    for (int i = 0; i < d; ++i)
      expected[static_cast<std::size_t>(i)] -= (std::int64_t{1} << (d - 1 - i)) * binomial(d - 1, i);
    EXPECT_EQ(counts_of(open, d), expected) << d;
  }
}

TEST(HalfspaceFaces, CrossPolytopes) {
  for (int d = 1; d <= 5; ++d) {
    std::vector<double> rows;
    for (int signs = 0; signs < 1 << d; ++signs) {
      for (int j = 0; j < d; ++j) rows.push_back(signs >> j & 1 ? 1.0 : -1.0);
      rows.push_back(-1);
    }
    Counts expected;
    for (int i = 0; i < d; ++i) expected.push_back((std::int64_t{1} << (i + 1)) * binomial(d, i + 1));
    expected.push_back(1);
    EXPECT_EQ(counts_of(rows, d), expected) << d;
  }
}

TEST(HalfspaceFaces, SimplicesAndOrthants) {
  for (int d = 1; d <= 7; ++d) {
    std::vector<double> rows;
    for (int j = 0; j < d; ++j) {
      for (int c = 0; c < d; ++c) rows.push_back(c == j ? -1.0 : 0.0);
      rows.push_back(0);
    }
    Counts orthant, simplex;
    for (int i = 0; i <= d; ++i) {
      orthant.push_back(binomial(d, i));
      simplex.push_back(binomial(d + 1, i + 1));
    }
    EXPECT_EQ(counts_of(rows, d), orthant) << d;
    rows.insert(rows.end(), static_cast<std::size_t>(d), 1.0);
    rows.push_back(-3);
    EXPECT_EQ(counts_of(rows, d), simplex) << d;
  }
}

/// Dual to n points of the moment curve, whose polytope is neighborly: every ⌊d/2⌋ points span a face (Gale
/// 1963).
TEST(HalfspaceFaces, DualsOfCyclicPolytopes) {
  for (int d = 2; d <= 6; ++d)
    for (const std::int64_t n : {d + 1, d + 2, d + 4}) {
      std::vector<double> rows;
      std::vector<std::int64_t> sum(static_cast<std::size_t>(d), 0);
      const auto power = [](std::int64_t t, int e) {
        std::int64_t result = 1;
        while (e-- > 0) result *= t;
        return result;
      };
      for (std::int64_t t = 0; t < n; ++t)
        for (int j = 0; j < d; ++j) sum[static_cast<std::size_t>(j)] += power(t - n / 2, j + 1);
      for (std::int64_t t = 0; t < n; ++t) {
        for (int j = 0; j < d; ++j)
          rows.push_back(static_cast<double>(n * power(t - n / 2, j + 1) - sum[static_cast<std::size_t>(j)]));
        rows.push_back(-1);
      }
      const Counts counts = counts_of(rows, d);
      const std::int64_t m = d / 2;
      EXPECT_EQ(counts[0], d % 2 == 0 ? binomial(n - m, m) * n / (n - m) : 2 * binomial(n - m - 1, m))
          << d << " " << n;
      for (int i = 1; i <= m; ++i)
        EXPECT_EQ(counts[static_cast<std::size_t>(d - i)], binomial(n, i)) << d << " " << n;
    }
}

TEST(HalfspaceFaces, EulerOnRandomPolyhedra) {
  std::mt19937 random(21);
  for (std::size_t repeat = 0; repeat < scaled_count(40); ++repeat) {
    const int d = 2 + static_cast<int>(repeat % 3), range = 1 + static_cast<int>(random() % 4);
    std::uniform_int_distribution<int> entry(-range, range);
    std::vector<double> rows;
    for (std::size_t m = 2 + random() % 10; m > 0; --m) {
      for (int j = 0; j < d; ++j) rows.push_back(entry(random));
      rows.push_back(-1 - static_cast<double>(random() % 2));
    }
    if (HalfspaceIntersection(rows, d).rank() < 1) continue;
    counts_of(rows, d);
    if (HasFailure()) FAIL() << "dimension " << d << ", repeat " << repeat;
  }
}

/// The determinant of the edges of a cell and one more row of unit vectors, expanded: an exact outward
/// normal, as integers.
std::vector<double> facet_row(const std::vector<double>& points, std::size_t d,
                              std::span<const SignedIndex> cell) {
  const auto coordinate = [&](std::size_t i, std::size_t j) {
    return static_cast<std::int64_t>(points[static_cast<std::size_t>(cell[i]) * d + j]);
  };
  std::vector<double> row;
  std::int64_t offset = 0;
  for (std::size_t left_out = 0; left_out < d; ++left_out) {
    std::vector<std::size_t> columns;
    for (std::size_t j = 0; j < d; ++j)
      if (j != left_out) columns.push_back(j);
    std::int64_t minor = 0;
    do {  // Leibniz
      std::int64_t product = 1;
      for (std::size_t i = 0; i + 1 < d; ++i) {
        product *= coordinate(i + 1, columns[i]) - coordinate(0, columns[i]);
        for (std::size_t j = i + 1; j + 1 < d; ++j)
          if (columns[i] > columns[j]) product = -product;
      }
      minor += product;
    } while (std::next_permutation(columns.begin(), columns.end()));
    if (left_out % 2 == 1) minor = -minor;
    row.push_back(static_cast<double>(minor));
    offset -= minor * coordinate(0, left_out);
  }
  row.push_back(static_cast<double>(offset));
  return row;
}

TEST(HalfspaceFaces, FacetsOfAHullGiveItsPointsBack) {
  test::Random random(22);
  for (std::size_t repeat = 0; repeat < scaled_count(30); ++repeat) {
    const std::size_t d = 2 + repeat % 4;
    std::vector<double> points;
    const int range = repeat % 3 == 0 ? 1 : 20;  // facets of a lattice, or simplices
    for (std::size_t i = 0; i < (d + 3) * d * 2; ++i) points.push_back(random.integer(-range, range));
    const ConvexHull hull(points, static_cast<int>(d));
    if (hull.affine_dimension() < static_cast<int>(d)) continue;
    const HullData& data = hull.data();
    std::vector<double> rows;
    std::set<SignedIndex> seen;
    for (std::size_t c = 0; c < data.num_cells(); ++c) {
      if (!seen.insert(data.facet_of_cell[c]).second) continue;
      std::vector<double> row = facet_row(points, d, std::span(data.cells).subspan(c * d, d));
      for (const SignedIndex v : data.vertices) {
        double side = row[d];
        for (std::size_t j = 0; j < d; ++j) side += row[j] * points[static_cast<std::size_t>(v) * d + j];
        if (side > 0) {
          for (double& x : row) x = -x;
          break;
        }
      }
      rows.insert(rows.end(), row.begin(), row.end());
    }
    const HalfspaceIntersection back(rows, static_cast<int>(d));
    std::set<std::vector<double>> expected, found;
    for (const SignedIndex v : data.vertices) {
      const auto p = hull.point(static_cast<std::size_t>(v));
      expected.emplace(p.begin(), p.end());
    }
    for (std::size_t v = 0; v < back.num_vertices(); ++v)
      found.emplace(back.data().vertex(v).begin(), back.data().vertex(v).end());
    EXPECT_EQ(found, expected);
    EXPECT_EQ(back.num_facets(), hull.num_facets());
    EXPECT_TRUE(back.is_bounded());
    const std::vector<std::size_t> faces = hull.f_vector();
    const Counts counts = f_vector(back.data());
    for (std::size_t i = 0; i < d; ++i) EXPECT_EQ(static_cast<std::size_t>(counts[i]), faces[i]) << i;
    if (d <= 3) {
      EXPECT_NEAR(back.volume().value / hull.volume().value, 1, 1e-12);
    }
    if (HasFailure()) FAIL() << "dimension " << d << ", repeat " << repeat;
  }
}

}  // namespace
