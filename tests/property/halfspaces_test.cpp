// SPDX-License-Identifier: BSD-3-Clause
// What must hold for all intersections of halfspaces: nothing depends on the interior point, on the order of
// the rows or on their lengths; hulls and intersections are dual to each other; rows may come one after the
// other; the check finds what is wrong.
#include "scale.hpp"

#include <gtest/gtest.h>
#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/halfspaces.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace {

using namespace delone;
using namespace delone::test;
using Rows = std::vector<SignedIndex>;

Rows as_rows(std::span<const SignedIndex> items) { return {items.begin(), items.end()}; }

std::vector<double> rows_around_origin(std::mt19937& random, int d, int m, bool coarse) {
  std::normal_distribution<double> normal;
  std::vector<double> rows;
  for (int r = 0; r < m; ++r) {
    for (int j = 0; j < d; ++j) rows.push_back(coarse ? std::round(1.5 * normal(random)) : normal(random));
    rows.push_back(coarse ? -1 - static_cast<double>(random() % 2) : -1 - std::abs(normal(random)) / 4);
  }
  return rows;
}

/// Vertices by their facets; directions likewise.
std::map<Rows, std::vector<double>> vertices_by_rows(const IntersectionData& data, const Rows& rename) {
  std::map<Rows, std::vector<double>> result;
  for (std::size_t v = 0; v < data.num_vertices(); ++v) {
    Rows rows;
    for (const SignedIndex r : data.halfspaces_of_vertex(v))
      rows.push_back(rename[static_cast<std::size_t>(r)]);
    std::sort(rows.begin(), rows.end());
    result.emplace(rows, std::vector<double>(data.vertex(v).begin(), data.vertex(v).end()));
  }
  return result;
}
std::set<Rows> directions_by_rows(const IntersectionData& data, const Rows& rename) {
  std::set<Rows> result;
  for (std::size_t u = 0; u < data.num_directions(); ++u) {
    Rows rows;
    for (const SignedIndex r : data.halfspaces_of_direction(u))
      rows.push_back(rename[static_cast<std::size_t>(r)]);
    std::sort(rows.begin(), rows.end());
    result.insert(rows);
  }
  return result;
}
Rows rows_as_given(std::size_t m) {
  Rows rows(m);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// The same polyhedron, whose row rename[r] is row r here.
void expect_same_polyhedron(const IntersectionData& a, const IntersectionData& b, const Rows& rename) {
  ASSERT_EQ(a.state, b.state);
  EXPECT_EQ(a.bounded, b.bounded);
  EXPECT_EQ(vertices_by_rows(a, rows_as_given(a.kinds.size())), vertices_by_rows(b, rename));
  EXPECT_EQ(directions_by_rows(a, rows_as_given(a.kinds.size())), directions_by_rows(b, rename));
  EXPECT_EQ(a.num_edges(), b.num_edges());
  EXPECT_EQ(a.num_rays(), b.num_rays());
  for (std::size_t r = 0; r < rename.size(); ++r)
    EXPECT_EQ(a.kinds[static_cast<std::size_t>(rename[r])], b.kinds[r]);
}

std::vector<double> rows_in_order(const std::vector<double>& rows, std::size_t width, const Rows& order) {
  std::vector<double> result;
  for (const SignedIndex r : order)
    result.insert(result.end(),
                  rows.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(r) * width),
                  rows.begin() + static_cast<std::ptrdiff_t>((static_cast<std::size_t>(r) + 1) * width));
  return result;
}

TEST(Halfspaces, NothingDependsOnInteriorPointOrderAndLength) {
  std::mt19937 random(11);
  for (std::size_t repeat = 0; repeat < scaled_count(40); ++repeat) {
    const int d = 1 + static_cast<int>(repeat % 5);
    const auto width = static_cast<std::size_t>(d) + 1;
    std::vector<double> rows = rows_around_origin(random, d, 6 + 4 * d, repeat % 2 == 0);
    // Duplicates have numbers that depend on the order: each row once.
    const IntersectionData given =
        HalfspaceIntersection(rows, d, std::vector<double>(static_cast<std::size_t>(d), 0.0)).data();
    Rows first;
    for (std::size_t r = 0; r < given.kinds.size(); ++r)
      if (given.kinds[r] != HalfspaceKind::duplicate) first.push_back(static_cast<SignedIndex>(r));
    rows = rows_in_order(rows, width, first);
    const IntersectionData data = HalfspaceIntersection(rows, d).to_data();
    std::vector<double> near(static_cast<std::size_t>(d));
    for (double& x : near) x = std::ldexp(1.0 + static_cast<double>(random() % 100), -12);
    if (const CheckReport report = check(data); !report.ok) FAIL() << report.violation;
    bool inside = true;
    for (std::size_t r = 0; r < first.size(); ++r) {
      double sum = rows[r * width + width - 1];
      for (std::size_t j = 0; j < near.size(); ++j) sum += rows[r * width + j] * near[j];
      inside = inside && sum < -0.01;
    }
    if (inside)
      expect_same_polyhedron(data, HalfspaceIntersection(rows, d, near).data(), rows_as_given(first.size()));

    Rows order = rows_as_given(first.size());
    std::shuffle(order.begin(), order.end(), random);
    expect_same_polyhedron(data, HalfspaceIntersection(rows_in_order(rows, width, order), d).data(), order);

    std::vector<double> longer = rows;
    for (std::size_t r = 0; r < first.size(); ++r) {
      const int exponent = static_cast<int>(random() % 1990) - 995;
      bool exact = true;
      for (std::size_t j = 0; j < width; ++j)
        exact =
            exact && std::ldexp(std::ldexp(rows[r * width + j], exponent), -exponent) == rows[r * width + j];
      for (std::size_t j = 0; exact && j < width; ++j)
        longer[r * width + j] = std::ldexp(rows[r * width + j], exponent);
    }
    expect_same_polyhedron(data, HalfspaceIntersection(longer, d).data(), rows_as_given(first.size()));
    Options options;
    options.force_runtime_dimension = true;
    options.order = InsertionOrder::shuffled;
    options.seed = repeat;
    expect_same_polyhedron(data, HalfspaceIntersection(longer, d, options).data(),
                           rows_as_given(first.size()));
    if (HasFailure()) FAIL() << "dimension " << d << ", repeat " << repeat;
  }
}

TEST(Halfspaces, RowsMayComeOneAfterTheOther) {
  std::mt19937 random(12);
  for (std::size_t repeat = 0; repeat < scaled_count(30); ++repeat) {
    const int d = 1 + static_cast<int>(repeat % 4);
    const auto width = static_cast<std::size_t>(d) + 1;
    const std::vector<double> rows = rows_around_origin(random, d, 5 + 4 * d, repeat % 3 != 0);
    const std::vector<double> origin(static_cast<std::size_t>(d), 0.0);
    HalfspaceIntersection growing(std::vector<double>{}, d, origin);
    for (std::size_t at = 0; at < rows.size();) {
      const std::size_t next = std::min(rows.size(), at + width * (1 + random() % 3));
      growing.insert_range(std::span(rows).subspan(at, next - at));
      at = next;
      const IntersectionData whole = HalfspaceIntersection(std::span(rows).first(at), d, origin).data();
      expect_same_polyhedron(whole, growing.data(), rows_as_given(at / width));
      EXPECT_EQ(whole.rank, growing.rank());
    }
    if (const CheckReport report = check(growing.to_data()); !report.ok) FAIL() << report.violation;
    if (HasFailure()) return;
  }
}

/// The halfspaces n·x ≤ 1 of points n of a lattice are dual to the hull of these points: the facets are the
/// rows of the extreme points, the vertices are dual to the facets of the hull.
TEST(Halfspaces, DualOfTheHullHasTheExtremePointsAsFacets) {
  std::mt19937 random(13);
  for (std::size_t repeat = 0; repeat < scaled_count(24); ++repeat) {
    const int d = 2 + static_cast<int>(repeat % 4);
    const auto size = static_cast<std::size_t>(d);
    std::uniform_int_distribution<int> coordinate(-3, 3);
    std::vector<double> points;
    for (std::size_t j = 0; j < size; ++j)
      for (const double sign : {-1.0, 1.0})  // the origin is inside
        for (std::size_t c = 0; c < size; ++c) points.push_back(c == j ? sign : 0.0);
    for (int i = 0; i < 30; ++i)
      for (std::size_t j = 0; j < size; ++j) points.push_back(coordinate(random));
    std::vector<double> rows;
    for (std::size_t i = 0; i < points.size(); i += size) {
      rows.insert(rows.end(), points.begin() + static_cast<std::ptrdiff_t>(i),
                  points.begin() + static_cast<std::ptrdiff_t>(i + size));
      rows.push_back(-1);
    }
    const ConvexHull hull(points, d);
    const HullData& polytope = hull.data();
    const HalfspaceIntersection dual(rows, d, std::vector<double>(size, 0.0));
    const IntersectionData& data = dual.data();
    EXPECT_TRUE(data.bounded);
    EXPECT_EQ(data.facet_halfspaces, polytope.vertices);
    EXPECT_EQ(data.num_vertices(), polytope.num_facets());
    EXPECT_EQ(data.num_edges(), polytope.num_ridges());
    std::set<Rows> facets, vertices;
    for (std::size_t f = 0; f < polytope.num_facets(); ++f)
      facets.insert(as_rows(
          std::span(polytope.facet_vertices)
              .subspan(static_cast<std::size_t>(polytope.facet_offsets[f]),
                       static_cast<std::size_t>(polytope.facet_offsets[f + 1] - polytope.facet_offsets[f]))));
    for (std::size_t v = 0; v < data.num_vertices(); ++v)
      vertices.insert(as_rows(data.halfspaces_of_vertex(v)));
    EXPECT_EQ(facets, vertices);
    for (std::size_t r = 0; r < polytope.point_kinds.size(); ++r)
      EXPECT_EQ(static_cast<int>(data.kinds[r] == HalfspaceKind::touching),
                static_cast<int>(polytope.point_kinds[r] == PointKind::boundary))
          << r;
    EXPECT_NEAR(dual.dual_volume().value / hull.volume().value, 1, 1e-12);
    EXPECT_NEAR(dual.dual_area().value / hull.area().value, 1, 1e-12);
    EXPECT_EQ(data.dual_points, points);
    if (HasFailure()) return;
  }
}

TEST(Halfspaces, ExtremeRanges) {
  constexpr double tiny = std::numeric_limits<double>::denorm_min(),
                   huge = std::numeric_limits<double>::max();
  for (const double size : {tiny, 1e-300, 1e-160, 1e160, 1e300, huge / 2})
    for (int d = 1; d <= 3; ++d) {
      std::vector<double> rows;
      for (int j = 0; j < d; ++j)
        for (const double sign : {-1.0, 1.0}) {
          for (int c = 0; c < d; ++c) rows.push_back(c == j ? sign : 0.0);
          rows.push_back(-size);
        }
      const HalfspaceIntersection box(rows, d);
      ASSERT_EQ(box.state(), IntersectionState::full) << size;
      EXPECT_EQ(box.num_vertices(), std::size_t{1} << d) << size;
      for (const double x : box.data().vertices) EXPECT_EQ(std::abs(x), size);
      const CheckReport report = check(box.to_data());
      EXPECT_TRUE(report.ok) << report.violation << " " << size;
    }
  // Beyond the doubles: x ≤ huge/tiny.
  const HalfspaceIntersection far(std::vector<double>{tiny, 0, -huge, -1, 0, -1, 0, 1, -1, 0, -1, -1}, 2);
  EXPECT_EQ(far.num_vertices(), 4u);
  EXPECT_TRUE(far.is_bounded());
}

TEST(Halfspaces, Errors) {
  const std::vector<double> origin{0, 0};
  const auto error_of = [](auto work) {
    try {
      work();
    } catch (const Error& e) {
      return e;
    }
    return Error(Errc::unsupported, "none");
  };
  EXPECT_EQ(error_of([] { HalfspaceIntersection(std::vector<double>{}, 0); }).code(), Errc::bad_dimension);
  EXPECT_EQ(error_of([] {
              HalfspaceIntersection(std::vector<double>{1, 2, 3, 4}, 2);
            }).code(),
            Errc::bad_dimension);
  const Error nan = error_of([] { HalfspaceIntersection(std::vector<double>{1, 2, 3, 1, NAN, 2}, 2); });
  EXPECT_EQ(nan.code(), Errc::not_finite);
  EXPECT_EQ(nan.rows(), std::vector<std::size_t>{1});
  const Error outside = error_of([&] {
    HalfspaceIntersection(std::vector<double>{1, 0, -1, 0, 1, 0, 1, 1, 2}, 2, origin);
  });
  EXPECT_EQ(outside.code(), Errc::invalid_argument);
  EXPECT_EQ(outside.rows(), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(error_of([&] {
              HalfspaceIntersection(std::vector<double>{1, 0, -1}, 2, std::vector<double>{0, 0, 0});
            }).code(),
            Errc::bad_dimension);
  HalfspaceIntersection half(std::vector<double>{1, 0, -1}, 2, origin);
  // Rows are those of the call, not of the intersection.
  const Error later = error_of([&] { half.insert_range(std::vector<double>{0, 1, 1}); });
  EXPECT_EQ(later.code(), Errc::invalid_argument);
  EXPECT_EQ(later.rows(), std::vector<std::size_t>{0});
  EXPECT_EQ(error_of([&] {
              half.insert_range(std::vector<double>{0, 1, -1, 0, 1, 1});
            }).rows(),
            std::vector<std::size_t>{1});
  EXPECT_EQ(half.num_halfspaces(), 1u);
  Options cancelling;
  cancelling.progress = [](double) { return false; };
  EXPECT_EQ(
      error_of([&] {
        HalfspaceIntersection(std::vector<double>{1, 0, -1, 0, 1, -1, -1, -1, -1}, 2, origin, cancelling);
      }).code(),
      Errc::cancelled);
}

TEST(Halfspaces, TheCheckFindsWhatIsWrong) {
  std::mt19937 random(14);
  const std::vector<double> rows = rows_around_origin(random, 3, 14, true);
  const IntersectionData data = HalfspaceIntersection(rows, 3).to_data();
  ASSERT_TRUE(check(data).ok);
  const auto level_of = [](const IntersectionData& wrong) {
    const CheckReport report = check(wrong);
    EXPECT_FALSE(report.ok);
    EXPECT_FALSE(report.violation.empty());
    return report.reached.name;
  };
  IntersectionData wrong = data;
  wrong.vertices.pop_back();
  EXPECT_EQ(level_of(wrong), "storage");
  wrong = data;
  wrong.vertices[0] = std::nextafter(wrong.vertices[0], 10.0);
  EXPECT_EQ(level_of(wrong), "support");
  wrong = data;
  wrong.vertex_halfspaces[0] = wrong.vertex_halfspaces[1];
  EXPECT_EQ(level_of(wrong), "support");
  wrong = data;
  wrong.edges.resize(wrong.edges.size() - 2);
  EXPECT_EQ(level_of(wrong), "completeness");
  wrong = data;
  wrong.bounded = !wrong.bounded;
  EXPECT_EQ(level_of(wrong), "completeness");
  for (std::size_t r = 0; r < data.kinds.size(); ++r) {
    wrong = data;
    wrong.kinds[r] =
        data.kinds[r] == HalfspaceKind::redundant ? HalfspaceKind::touching : HalfspaceKind::redundant;
    EXPECT_EQ(level_of(wrong), "completeness");
  }
  wrong = data;
  wrong.facet_halfspaces[1] = wrong.facet_halfspaces[0];
  EXPECT_EQ(level_of(wrong), "storage");
  wrong = data;
  for (std::size_t j = 0; j < 3; ++j)
    wrong.interior_point[j] = 2 * data.vertex(0)[j];  // the origin is inside
  EXPECT_EQ(level_of(wrong), "support");
  // A strip, of rank 1; a square that is said to be one.
  wrong = HalfspaceIntersection(std::vector<double>{1, 0, -1, -1, 0, -1}, 2).to_data();
  EXPECT_TRUE(check(wrong).ok);
  wrong.vertices[1] = 1;
  EXPECT_EQ(level_of(wrong), "support");
  wrong.vertices[1] = 0;
  for (const double x : {0.0, 1.0, -2.0, 0.0, -1.0, -2.0}) wrong.halfspaces.push_back(x);
  for (const SignedIndex r : {2, 3}) {
    wrong.first_of_halfspace.push_back(r);
    wrong.kinds.push_back(HalfspaceKind::redundant);
  }
  EXPECT_EQ(level_of(wrong), "support");
  IntersectionData flat =
      HalfspaceIntersection(std::vector<double>{1, 0, -1, -1, 0, 1, 0, 1, 0}, 2).to_data();
  EXPECT_TRUE(check(flat).ok);
  flat.bounded = true;
  EXPECT_EQ(level_of(flat), "storage");
  flat.bounded = false;
  flat.state = IntersectionState::empty;
  EXPECT_EQ(level_of(flat), "support");
}

}  // namespace
