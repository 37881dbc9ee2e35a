// SPDX-License-Identifier: BSD-3-Clause
// Hulls whose faces are known, answers about queries, and what must not depend on anything but the set of
// points.
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/check.hpp>
#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/predicates.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone {
namespace {

using test::PointSet;
using Counts = std::vector<std::size_t>;

std::size_t binomial(std::size_t n, std::size_t r) {
  std::size_t result = 1;
  for (std::size_t i = 0; i < r; ++i) result = result * (n - i) / (i + 1);
  return result;
}

void expect_euler_poincare(const Counts& f) {
  long sum = 0;
  for (std::size_t j = 0; j < f.size(); ++j) sum += (j % 2 == 0 ? 1 : -1) * static_cast<long>(f[j]);
  EXPECT_EQ(sum, f.size() % 2 == 0 ? 0 : 2);
}

void expect_valid(const ConvexHullBase& hull) {
  const CheckReport report = check(hull.to_data());
  EXPECT_TRUE(report.ok) << report.violation;
  const Counts f = hull.f_vector();
  expect_euler_poincare(f);
  if (f.size() >= 2) {
    EXPECT_EQ(f[0], hull.num_vertices());
    EXPECT_EQ(f.back(), hull.num_facets());
    EXPECT_EQ(f[f.size() - 2], hull.num_ridges());
  }
}

class HullIn : public ::testing::TestWithParam<int> {
 protected:
  int d() const { return GetParam(); }
  std::size_t size() const { return static_cast<std::size_t>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Dimensions, HullIn, ::testing::Range(2, 7), ::testing::PrintToStringParamName());

TEST_P(HullIn, CubesAreKnown) {
  const PointSet cube = test::permuted(test::lattice(d(), d() <= 4 ? 3 : 2), 1);
  const ConvexHull hull(cube.points, d());
  Counts expected;
  for (std::size_t j = 0; j < size(); ++j) expected.push_back(binomial(size(), j) << (size() - j));
  EXPECT_EQ(hull.f_vector(), expected);
  EXPECT_EQ(hull.num_vertices(), std::size_t{1} << d());
  if (d() <= 4) {
    EXPECT_EQ(hull.count(PointKind::interior), 1u);  // 1^d
    EXPECT_EQ(hull.count(PointKind::boundary), cube.size() - 1 - (std::size_t{1} << d()));
  }
  expect_valid(hull);
  const double side = d() <= 4 ? 2 : 1;
  const Measure volume = hull.volume(), area = hull.area();
  EXPECT_NEAR(volume.value, std::pow(side, d()), volume.error);
  EXPECT_NEAR(area.value, 2 * d() * std::pow(side, d() - 1), area.error);
  EXPECT_LT(volume.error, 1e-9 * volume.value);
  EXPECT_LT(area.error, 1e-9 * area.value);
  for (std::size_t f = 0; f < hull.num_facets(); ++f) {
    const double* equation = hull.data().equations.data() + f * (size() + 1);
    double length = 0;
    for (int j = 0; j < d(); ++j) length += std::fabs(equation[j]);
    EXPECT_NEAR(length, 1, 1e-14);  // along an axis
    EXPECT_LT(hull.data().equation_errors[f], 1e-12);
    EXPECT_TRUE(std::fabs(equation[d()]) < 1e-14 || std::fabs(equation[d()] + side) < 1e-13) << equation[d()];
  }
}

TEST_P(HullIn, CrossPolytopesAreKnown) {
  std::vector<double> points;
  for (int i = 0; i < 2 * d(); ++i)
    for (int j = 0; j < d(); ++j) points.push_back(i / 2 == j ? (i % 2 == 0 ? 1 : -1) : 0);
  points.insert(points.end(), size(), 0.0);  // the centre
  const ConvexHull hull(points, d());
  Counts expected;
  for (std::size_t j = 0; j < size(); ++j) expected.push_back(binomial(size(), j + 1) << (j + 1));
  EXPECT_EQ(hull.f_vector(), expected);
  EXPECT_EQ(hull.num_cells(), std::size_t{1} << d());
  EXPECT_EQ(hull.kind(2 * size()), PointKind::interior);
  double volume = 1;
  for (int j = 1; j <= d(); ++j) volume *= 2.0 / j;
  EXPECT_NEAR(hull.volume().value, volume, hull.volume().error);
  expect_valid(hull);
}

TEST_P(HullIn, CyclicPolytopesHaveTheMostFaces) {
  const int n = d() + 5;
  std::vector<double> points;
  for (int t = 0; t < n; ++t)
    for (int j = 1; j <= d(); ++j) points.push_back(std::pow(t - n / 2, j));
  const ConvexHull hull(points, d());
  // McMullen's upper bound; all faces of up to ⌊d/2⌋ vertices are there.
  const std::size_t N = static_cast<std::size_t>(n), h = size() / 2;
  const std::size_t facets =
      d() % 2 == 0 ? binomial(N - h, h) + binomial(N - h - 1, h - 1) : 2 * binomial(N - h - 1, h);
  EXPECT_EQ(hull.num_facets(), facets);
  EXPECT_EQ(hull.num_cells(), facets);
  const Counts f = hull.f_vector();
  for (std::size_t j = 0; j < h; ++j) EXPECT_EQ(f[j], binomial(N, j + 1));
  expect_valid(hull);
}

TEST_P(HullIn, ProductsOfSimplicesAreKnown) {
  const std::size_t a = size() / 2, b = size() - a;  // Δ_a × Δ_b has faces Δ_i × Δ_j
  std::vector<double> points;
  for (std::size_t v = 0; v <= a; ++v)
    for (std::size_t w = 0; w <= b; ++w) {
      for (std::size_t j = 1; j <= a; ++j) points.push_back(v == j);
      for (std::size_t j = 1; j <= b; ++j) points.push_back(w == j);
    }
  const ConvexHull hull(points, d());
  Counts expected(size(), 0);
  for (std::size_t i = 0; i <= a; ++i)
    for (std::size_t j = 0; j <= b && i + j < size(); ++j)
      expected[i + j] += binomial(a + 1, i + 1) * binomial(b + 1, j + 1);
  EXPECT_EQ(hull.f_vector(), expected);
  expect_valid(hull);
}

TEST_P(HullIn, TheOrderOfThePointsDoesNotMatter) {
  for (std::uint64_t seed = 0; seed < test::scaled_count(2); ++seed)
    for (const PointSet& set : test::degenerate_sets(d(), d() <= 4 ? 20 : 12, seed)) {
      SCOPED_TRACE(set.name);
      const ConvexHull hull(set.points, d());
      const PointSet other = test::permuted(set, seed + 1);
      Options options;
      options.order = InsertionOrder::as_given;
      const ConvexHull shuffled(other.points, d(), options);
      EXPECT_EQ(hull.hash(), shuffled.hash());
      EXPECT_EQ(hull.num_facets(), shuffled.num_facets());
      EXPECT_EQ(hull.num_vertices(), shuffled.num_vertices());
      ConvexHull grown(d());  // in three parts
      const std::size_t third = set.size() / 3 * size();
      grown.insert_range(std::span(set.points).first(third));
      grown.insert_range(std::span(set.points).subspan(third, third));
      grown.insert_range(std::span(set.points).subspan(2 * third));
      EXPECT_EQ(hull.hash(), grown.hash());
      EXPECT_EQ(hull.data().point_kinds, grown.data().point_kinds);
      if (HasFailure()) return;
    }
}

TEST_P(HullIn, QueriesAreAnsweredAsTheCellsSay) {
  for (const PointSet& set : test::degenerate_sets(d(), d() <= 4 ? 20 : 12, 3)) {
    SCOPED_TRACE(set.name + "\n");
    const ConvexHull hull(set.points, d());
    const HullData data = hull.to_data();
    if (data.affine_dimension != d()) continue;
    test::Random random(5);
    for (int i = 0; i < 30; ++i) {
      // Points of the set, midpoints of two of them, and points beyond one as seen from another.
      std::vector<double> q;
      const auto a = static_cast<std::size_t>(random.bits() % set.size()),
                 b = static_cast<std::size_t>(random.bits() % set.size());
      for (std::size_t j = 0; j < size(); ++j) {
        const double x = set.points[a * size() + j], y = set.points[b * size() + j];
        q.push_back(i % 3 == 0 ? x : i % 3 == 1 ? x / 2 + y / 2 : std::clamp(2 * y - x, -1e308, 1e308));
      }
      bool on = false;
      std::vector<SignedIndex> beyond;
      for (std::size_t c = 0; c < data.num_cells(); ++c) {
        std::vector<double> simplex = q;
        for (std::size_t v = 0; v < size(); ++v) {
          const auto row = static_cast<std::size_t>(data.cells[c * size() + v]);
          simplex.insert(simplex.end(), data.points.begin() + static_cast<std::ptrdiff_t>(row * size()),
                         data.points.begin() + static_cast<std::ptrdiff_t>((row + 1) * size()));
        }
        const Sign sign = orientation(simplex, d());
        on |= sign == Sign::zero;
        if (sign == Sign::negative) beyond.push_back(static_cast<SignedIndex>(c));
      }
      const Containment where = hull.locate(q);
      EXPECT_EQ(where.kind, !beyond.empty() ? Containment::Kind::outside
                            : on            ? Containment::Kind::on_boundary
                                            : Containment::Kind::inside);
      EXPECT_EQ(hull.contains(q), beyond.empty());
      EXPECT_EQ(hull.visible_cells(q), beyond);
      EXPECT_EQ(hull.visible_facets(q).empty(), beyond.empty());
      if (where.kind == Containment::Kind::on_boundary) {
        // The smallest face: q is in it, so it adds no dimension, and it is in no facet of the face's own
        // hull.
        ASSERT_FALSE(where.face.empty());
        std::vector<double> face;
        for (const SignedIndex row : where.face)
          face.insert(face.end(), hull.point(static_cast<std::size_t>(row)).begin(),
                      hull.point(static_cast<std::size_t>(row)).end());
        const ConvexHull inner(face, d());
        const Containment::Kind kind = inner.locate(q).kind;
        EXPECT_EQ(kind, where.face.size() == 1 ? Containment::Kind::on_boundary : Containment::Kind::inside);
      }
      if (i % 3 == 0) {
        const PointKind point_kind = data.point_kinds[static_cast<std::size_t>(data.vertex_of_point[a])];
        EXPECT_EQ(where.kind, point_kind == PointKind::interior ? Containment::Kind::inside
                                                                : Containment::Kind::on_boundary);
        EXPECT_EQ(where.face.size() == 1, point_kind == PointKind::extreme);
      }
      if (HasFailure()) return;
    }
  }
}

TEST_P(HullIn, TheVolumeIsThatOfTheTriangulation) {
  const PointSet set = test::small_integers(d(), 40, -50, 50, 7);
  const ConvexHull hull(set.points, d());
  const Delaunay<> triangulation(set.points, d());
  EXPECT_EQ(hull.affine_dimension(), d());
  double sum = 0;
  for (const CellId cell : triangulation.finite_cells()) {
    std::vector<double> simplex;
    for (const VertexId v : triangulation.vertices(cell)) {
      const auto point = triangulation.point(v);
      simplex.insert(simplex.end(), point.begin(), point.end());
    }
    sum += ConvexHull(simplex, d()).volume().value;
  }
  EXPECT_NEAR(hull.volume().value, sum, 1e-9 * sum);
  expect_valid(hull);
}

TEST_P(HullIn, FlatInputHasTheHullOfItsFlat) {
  for (int k = 2; k < d(); ++k) {
    const PointSet flat = test::lattice(k, 3);
    const ConvexHull inside(flat.points, k), outside(test::embedded(flat, d(), true, 9).points, d());
    EXPECT_EQ(outside.affine_dimension(), k);
    EXPECT_EQ(outside.f_vector(), inside.f_vector());
    EXPECT_EQ(outside.data().point_kinds, inside.data().point_kinds);
    expect_valid(outside);
    std::vector<double> off(outside.point(0).begin(), outside.point(0).end());
    EXPECT_TRUE(outside.contains(off));
    for (double& x : off) x += 0.125;
    off[0] += 1000;
    EXPECT_FALSE(outside.contains(off));
    for (std::size_t f = 0; f < outside.num_facets(); ++f)  // normals look outwards
      for (std::size_t row = 0; row < flat.size(); ++row) {
        const double* equation = outside.data().equations.data() + f * (size() + 1);
        double distance = equation[d()];
        for (std::size_t j = 0; j < size(); ++j) distance += equation[j] * outside.point(row)[j];
        EXPECT_LT(distance, 1e-10);
      }
  }
}

TEST(Hull, OfAFewPointsIsAResult) {
  EXPECT_EQ(ConvexHull(3).affine_dimension(), -1);
  EXPECT_EQ(ConvexHull(3).f_vector(), Counts{});
  EXPECT_EQ(ConvexHull(3).volume().value, 0);
  const ConvexHull point(std::vector<double>{1, 2, 1, 2, 1, 2}, 2);
  EXPECT_EQ(point.affine_dimension(), 0);
  EXPECT_EQ(point.num_vertices(), 1u);
  EXPECT_EQ(point.num_facets(), 0u);
  EXPECT_EQ(point.count(PointKind::duplicate), 2u);
  EXPECT_EQ(point.locate(std::vector<double>{1, 2}).kind, Containment::Kind::on_boundary);
  EXPECT_EQ(point.locate(std::vector<double>{1, 3}).kind, Containment::Kind::outside_affine_hull);
  const ConvexHull segment(std::vector<double>{3, 3, 1, 1, 2, 2, 3, 3}, 2);
  EXPECT_EQ(segment.affine_dimension(), 1);
  EXPECT_EQ(segment.data().vertices, (std::vector<SignedIndex>{0, 1}));
  EXPECT_EQ(segment.kind(2), PointKind::interior);
  EXPECT_EQ(segment.num_facets(), 2u);
  EXPECT_DOUBLE_EQ(segment.volume().value, std::sqrt(8.0));
  EXPECT_EQ(segment.area().value, 2);
  EXPECT_EQ(segment.locate(std::vector<double>{2.5, 2.5}).kind, Containment::Kind::inside);
  EXPECT_EQ(segment.locate(std::vector<double>{1, 1}).face, (std::vector<SignedIndex>{1}));
  EXPECT_EQ(segment.visible_facets(std::vector<double>{0, 0}).size(), 1u);
}

TEST(Hull, InTheCompiledDimensionIsTheSame) {
  const std::vector<std::array<double, 3>> points = {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {.25, .25, .25}};
  ConvexHull<3> hull(points);
  EXPECT_EQ(hull.num_facets(), 4u);
  EXPECT_FALSE(hull.insert({0.1, 0.1, 0.1}).inserted);
  EXPECT_TRUE(hull.insert({1, 1, 1}).inserted);
  EXPECT_TRUE(hull.insert({1, 1, 1}).duplicate);
  EXPECT_EQ(hull.num_vertices(), 5u);
}

TEST(Hull, ErrorsChangeNothing) {
  ConvexHull hull(std::vector<double>{0, 0, 1, 0, 0, 1}, 2);
  const CanonicalHash before = hull.hash();
  EXPECT_THROW(hull.insert_range(std::vector<double>{5, 5, std::nan(""), 1}), Error);
  EXPECT_THROW(hull.insert(std::vector<double>{5}), Error);
  EXPECT_THROW(ConvexHull(0), Error);
  EXPECT_EQ(hull.hash(), before);
  EXPECT_EQ(hull.num_points(), 3u);
  Options options;
  options.progress = [](double) { return false; };
  try {
    const ConvexHull cancelled(test::lattice(3, 6).points, 3, options);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Errc::cancelled);
  }
}

TEST(CheckHull, FindsWhatIsWrong) {
  const ConvexHull hull(test::lattice(3, 3).points, 3);
  const HullData good = hull.to_data();
  EXPECT_TRUE(check(good).ok);
  const auto reached = [](const HullData& data) {
    const CheckReport report = check(data);
    EXPECT_FALSE(report.ok);
    EXPECT_FALSE(report.violation.empty());
    return report.reached.name;
  };
  HullData bad = good;
  bad.cells[4] = 99;
  EXPECT_EQ(reached(bad), "storage");
  bad = good;
  std::swap(bad.cells[0], bad.cells[1]);
  std::swap(bad.neighbors[0], bad.neighbors[1]);
  EXPECT_EQ(reached(bad), "incidence");
  bad = good;
  bad.cells.resize(bad.cells.size() - 3);  // a hole
  bad.neighbors.clear();
  bad.facet_of_cell.clear();
  EXPECT_EQ(reached(bad), "incidence");
  bad = good;
  for (std::size_t c = 0; c < bad.num_cells(); ++c)
    std::swap(bad.cells[3 * c], bad.cells[3 * c + 1]);  // inside out
  bad.neighbors.clear();
  EXPECT_EQ(reached(bad), "convexity");
  bad = good;
  bad.points[3 * 13] = 1.0 + 0x1p-52;  // still inside
  EXPECT_TRUE(check(bad).ok);
  bad.points[3 * 13] = 2.0 + 0x1p-51;  // beyond a facet, by one unit in the last place
  EXPECT_EQ(reached(bad), "support");
  bad = good;
  bad.point_kinds[13] = PointKind::boundary;
  EXPECT_EQ(reached(bad), "completeness");
  bad = good;
  bad.vertices.pop_back();
  EXPECT_EQ(reached(bad), "completeness");
  bad = good;
  bad.facet_of_cell[0] = bad.facet_of_cell[0] == 0 ? 1 : 0;
  EXPECT_EQ(reached(bad), "completeness");
  bad = good;
  for (SignedIndex& facet : bad.facet_of_cell) facet = std::min<SignedIndex>(facet, 4);  // two facets as one
  EXPECT_EQ(reached(bad), "completeness");
  bad = good;
  bad.ridge_facets.resize(22), bad.ridge_offsets.pop_back(), bad.ridge_vertices.resize(22);  // 11 ridges
  EXPECT_EQ(reached(bad), "completeness");
  bad.ridge_facets.push_back(0);
  bad.ridge_facets.push_back(6);
  EXPECT_EQ(reached(bad), "storage");
  bad = good;
  std::swap(bad.facet_vertices[0], bad.facet_vertices[1]);
  EXPECT_EQ(reached(bad), "completeness");
  bad = good;
  bad.equations[3] += 16 * (bad.equation_errors[0] + 0x1p-52);
  EXPECT_EQ(reached(bad), "completeness");
  bad.equation_errors.clear();  // nothing is promised
  EXPECT_TRUE(check(bad).ok);
}

}  // namespace
}  // namespace delone
