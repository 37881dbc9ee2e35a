// SPDX-License-Identifier: BSD-3-Clause
// PointLocator: batches against one query at a time and against fractions without error; the nearest vertex
// against all of them.
#include <delone/point_locator.hpp>

#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/predicates.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

namespace delone {
namespace {

using Fraction = boost::multiprecision::cpp_rational;

/// Vertices, midpoints (exact where doubles hold them), centres, points between, and points outside, flat or
/// not.
std::vector<double> queries_for(const test::PointSet& set, std::size_t count, std::uint64_t seed) {
  test::Random random(seed);
  const auto d = static_cast<std::size_t>(set.dimension);
  const auto row = [&] { return set.points.data() + random.bits() % set.size() * d; };
  std::vector<double> queries;
  for (std::size_t i = 0; i < count && set.size() > 0; ++i) {
    const double *a = row(), *b = row(), *c = row(), *e = row();
    const double t = random.real();
    for (std::size_t j = 0; j < d; ++j)
      queries.push_back(i % 6 == 0   ? a[j]
                        : i % 6 == 1 ? a[j] / 2 + b[j] / 2
                        : i % 6 == 2 ? a[j] / 4 + b[j] / 4 + c[j] / 4 + e[j] / 4
                        : i % 6 == 3 ? a[j] + t * (b[j] / 2 - a[j] / 2)
                        : i % 6 == 4 ? a[j] / 2 + (a[j] / 4 - b[j] / 4)
                                     : std::nextafter(a[j], b[j]));
  }
  return queries;
}

/// Points so near to a line that most cells are thinner than rounding errors of their area.
test::PointSet nearly_on_a_line(int dimension, std::size_t n, std::uint64_t seed) {
  test::PointSet set{"nearly on a line", dimension, {}};
  test::Random random(seed);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = random.real();
    for (int j = 0; j < dimension; ++j) set.points.push_back(std::nextafter(x, random.integer(-1, 1)));
  }
  return set;
}

/// The barycentric coordinates of q in a cell, on the axes of the flat.
std::vector<Fraction> exact_weights(const Triangulation& t, CellId cell, std::span<const double> q) {
  const std::vector<int> axes = t.axes();
  const std::vector<VertexId> vertices = t.vertices(cell);
  const std::size_t k = axes.size();
  std::vector<std::vector<Fraction>> rows(k, std::vector<Fraction>(k + 1));
  for (std::size_t r = 0; r < k; ++r) {
    const auto axis = static_cast<std::size_t>(axes[r]);
    const Fraction base(t.point(vertices[0])[axis]);
    for (std::size_t j = 0; j < k; ++j) rows[r][j] = Fraction(t.point(vertices[j + 1])[axis]) - base;
    rows[r][k] = Fraction(q[axis]) - base;
  }
  for (std::size_t s = 0; s < k; ++s) {
    std::size_t pivot = s;
    while (rows[pivot][s] == 0) ++pivot;
    std::swap(rows[pivot], rows[s]);
    for (std::size_t r = 0; r < k; ++r) {
      if (r == s || rows[r][s] == 0) continue;
      const Fraction factor = rows[r][s] / rows[s][s];
      for (std::size_t c = s; c <= k; ++c) rows[r][c] -= factor * rows[s][c];
    }
  }
  std::vector<Fraction> weights{Fraction(1)};
  for (std::size_t r = 0; r < k; ++r) {
    weights.push_back(rows[r][k] / rows[r][r]);
    weights[0] -= weights.back();
  }
  return weights;
}

struct Answer {
  Location::Kind kind = Location::Kind::outside_affine_hull;
  CellId cell = invalid_cell;
  std::vector<double> weights;
  int visits = 0;
};

std::vector<Answer> locate_all(const PointLocator& locator, std::span<const double> queries, int dimension) {
  std::vector<Answer> answers(queries.size() / static_cast<std::size_t>(dimension));
  locator.locate(queries, [&](std::size_t query, const LocatedPoint& where) {
    answers[query] = {where.kind,
                      where.cell,
                      {where.barycentric.begin(), where.barycentric.end()},
                      answers[query].visits + 1};
  });
  return answers;
}

/// The smallest face that holds the query.
std::set<VertexId> face_of(const Triangulation& t, const Answer& answer) {
  std::set<VertexId> face;
  for (std::size_t i = 0; i < answer.weights.size(); ++i)
    if (answer.weights[i] > 0) face.insert(t.complex().vertex(answer.cell, static_cast<int>(i)));
  return face;
}

/// `with_fractions`: compare coordinates, too, which takes its time.
void expect_right_places(const test::PointSet& set, std::size_t num_queries, bool with_fractions) {
  SCOPED_TRACE(set.name + " in dimension " + std::to_string(set.dimension));
  const Delaunay<> t(set.points, set.dimension);
  const PointLocator locator(t);
  const std::vector<double> queries = queries_for(set, num_queries, 11);
  const auto d = static_cast<std::size_t>(set.dimension);
  const std::vector<Answer> answers = locate_all(locator, queries, set.dimension);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const auto q = std::span(queries).subspan(i * d, d);
    const Answer& answer = answers[i];
    ASSERT_EQ(answer.visits, 1);
    const Location expected = t.locate(q);
    ASSERT_EQ(answer.kind, expected.kind) << "query " << i;
    EXPECT_EQ(face_of(t, answer), std::set<VertexId>(expected.face.begin(), expected.face.end()))
        << "query " << i;
    if (answer.kind == Location::Kind::outside_affine_hull) {
      EXPECT_EQ(answer.cell, invalid_cell);
      continue;
    }
    const int apex = t.complex().infinite_index(answer.cell);
    if (answer.kind == Location::Kind::outside_hull) {
      ASSERT_GE(apex, 0);
      EXPECT_TRUE(answer.weights.empty());
      if (t.affine_dimension() != set.dimension) continue;
      // The query takes the place of the infinite vertex with the orientation of a finite cell.
      std::vector<double> simplex;
      for (const VertexId v : t.vertices(answer.cell)) {
        const auto p = v == infinite_vertex ? q : t.point(v);
        simplex.insert(simplex.end(), p.begin(), p.end());
      }
      EXPECT_EQ(orientation(simplex, set.dimension), Sign::positive);
      continue;
    }
    ASSERT_EQ(answer.weights.size(), static_cast<std::size_t>(t.affine_dimension()) + 1);
    EXPECT_LT(apex, 0);
    double sum = 0;
    for (const double w : answer.weights) sum += w;
    EXPECT_NEAR(sum, 1, 1e-10);
    if (answer.kind == Location::Kind::on_vertex) {
      EXPECT_EQ(*std::max_element(answer.weights.begin(), answer.weights.end()), 1);
    }
    if (!with_fractions) continue;
    const std::vector<Fraction> exact = exact_weights(t, answer.cell, q);
    for (std::size_t j = 0; j < exact.size(); ++j) {
      EXPECT_EQ(exact[j] == 0, answer.weights[j] == 0);
      EXPECT_LE(abs(exact[j] - Fraction(answer.weights[j])), Fraction(0x1p-36))
          << exact[j].convert_to<double>();
    }
  }
}

class PointLocatorOfDimension : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, PointLocatorOfDimension, ::testing::Range(1, 8));

TEST_P(PointLocatorOfDimension, PlacesOfDegenerateInput) {
  const int d = GetParam();
  for (const test::PointSet& set : test::degenerate_sets(d, d <= 3 ? 40 : d <= 5 ? 20 : 11, 5))
    expect_right_places(set, test::scaled_count(20), d <= 4);
}

TEST_P(PointLocatorOfDimension, ThinCells) {
  const int d = GetParam();
  expect_right_places(nearly_on_a_line(d, d <= 4 ? 40 : 16, 3), test::scaled_count(60), true);
}

TEST_P(PointLocatorOfDimension, NeitherOrderNorBatchMatters) {
  const int d = GetParam();
  const auto size = static_cast<std::size_t>(d);
  const test::PointSet set = test::small_integers(d, d <= 4 ? 200 : 30, -3, 3, 8);
  const Delaunay<> t(set.points, d);
  const PointLocator locator(t);
  const std::vector<double> queries = queries_for(set, 120, 21);
  const std::vector<Answer> together = locate_all(locator, queries, d);
  const auto order = test::random_order(together.size(), 4);
  const std::vector<Answer> shuffled = locate_all(locator, test::reordered(queries, d, order), d);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Answer& a = together[order[i]];
    const Answer alone = locate_all(locator, std::span(queries).subspan(order[i] * size, size), d)[0];
    for (const Answer& b : {shuffled[i], alone}) {
      EXPECT_EQ(a.kind, b.kind);
      EXPECT_EQ(face_of(t, a), face_of(t, b));
    }
  }
}

TEST(PointLocator, OtherTriangulations) {
  const test::PointSet set = test::small_integers(3, 80, -4, 4, 9);
  std::vector<double> weights;
  test::Random random(2);
  for (std::size_t i = 0; i < set.size(); ++i) weights.push_back(random.integer(0, 9));
  const Regular<> regular(set.points, weights, 3);
  const FurthestSite<> furthest(set.points, 3);
  const std::vector<double> queries = queries_for(set, 200, 5);
  for (const Triangulation* t :
       {static_cast<const Triangulation*>(&regular), static_cast<const Triangulation*>(&furthest)}) {
    const std::vector<Answer> answers = locate_all(PointLocator(*t), queries, 3);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const Location expected = t->locate(std::span(queries).subspan(3 * i, 3));
      EXPECT_EQ(answers[i].kind, expected.kind);
      EXPECT_EQ(face_of(*t, answers[i]), std::set<VertexId>(expected.face.begin(), expected.face.end()));
    }
  }
  EXPECT_THROW(PointLocator(furthest).nearest(queries, [](std::size_t, VertexId) {}), Error);
}

TEST(PointLocator, EdgesAreThoseOfTheCells) {
  for (const int d : {1, 2, 4}) {
    const test::PointSet set = test::small_integers(d, 40, -3, 3, 77);
    const Delaunay<> t(set.points, d);
    std::set<std::pair<VertexId, VertexId>> expected, found;
    for (const CellId c : t.finite_cells())
      for (const VertexId a : t.vertices(c))
        for (const VertexId b : t.vertices(c))
          if (a != b) expected.emplace(a, b);
    const PointLocator locator(t);
    const PointLocator::Edges& edges = locator.edges();
    ASSERT_EQ(edges.offsets.size(), t.complex().num_vertex_slots() + 1u);
    for (Index v = 0; v + 1 < edges.offsets.size(); ++v)
      for (std::size_t e = edges.offsets[v]; e < edges.offsets[v + 1]; ++e)
        EXPECT_TRUE(found.emplace(VertexId{v}, edges.vertices[e]).second);
    EXPECT_EQ(found, expected);
  }
}

TEST(PointLocator, BadAndEmptyQueries) {
  const std::vector<double> square{0, 0, 1, 0, 0, 1, 1, 1};
  const Delaunay<> t(square, 2);
  const PointLocator locator(t);
  const auto never = [](std::size_t, const LocatedPoint&) { FAIL(); };
  const std::vector<double> bad{0.5, 0.5, NAN, 0, 0, 0, 1, INFINITY};
  try {
    locator.locate(bad, never);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Errc::not_finite);
    EXPECT_EQ(e.rows(), (std::vector<std::size_t>{1, 3}));
  }
  try {
    locator.locate(std::span(square).first(3), never);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Errc::bad_dimension);
  }
  locator.locate({}, never);
  EXPECT_THROW(
      locator.locate(square, [](std::size_t, const LocatedPoint&) { throw std::domain_error("enough"); }),
      std::domain_error);

  const Delaunay<> empty(2);
  int visits = 0;
  PointLocator(empty).locate(square, [&](std::size_t, const LocatedPoint& where) {
    ++visits;
    EXPECT_EQ(where.kind, Location::Kind::outside_affine_hull);
  });
  PointLocator(empty).nearest(square, [&](std::size_t, VertexId v) {
    ++visits;
    EXPECT_EQ(v, invalid_vertex);
  });
  EXPECT_EQ(visits, 8);
}

TEST(PointLocator, ManyThreadsOneLocator) {
  const test::PointSet set = test::small_integers(2, 300, -9, 9, 4);
  const Delaunay<> t(set.points, 2);
  const PointLocator locator(t);
  const std::vector<double> queries = queries_for(set, 400, 6);
  std::vector<std::vector<VertexId>> nearest(4, std::vector<VertexId>(queries.size() / 2));
  std::vector<std::thread> threads;
  for (auto& result : nearest)
    threads.emplace_back(
        [&] { locator.nearest(queries, [&](std::size_t i, VertexId v) { result[i] = v; }); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : nearest) EXPECT_EQ(result, nearest[0]);
}

Fraction power(std::span<const double> q, std::span<const double> p, double weight) {
  Fraction sum(-weight);
  for (std::size_t j = 0; j < q.size(); ++j)
    sum += (Fraction(q[j]) - Fraction(p[j])) * (Fraction(q[j]) - Fraction(p[j]));
  return sum;
}

/// Against all vertices; of several nearest ones the first row counts.
template <class Weight>
void expect_nearest(const Triangulation& t, const std::vector<double>& queries, Weight weight) {
  const auto d = static_cast<std::size_t>(t.dimension());
  const PointLocator locator(t);
  std::vector<int> visits(queries.size() / d, 0);
  std::vector<VertexId> vertices;
  for (const VertexId v : t.complex().finite_vertices()) vertices.push_back(v);
  std::sort(vertices.begin(), vertices.end(),
            [&](VertexId a, VertexId b) { return t.row_of(a) < t.row_of(b); });
  locator.nearest(queries, [&](std::size_t i, VertexId found) {
    ++visits[i];
    const auto q = std::span(queries).subspan(i * d, d);
    VertexId best = vertices[0];
    Fraction least = power(q, t.point(best), weight(best));
    for (const VertexId v : vertices)
      if (Fraction at = power(q, t.point(v), weight(v)); at < least) {
        best = v;
        least = at;
      }
    EXPECT_EQ(t.row_of(found), t.row_of(best)) << "query " << i;
  });
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(visits.size()));
}

class NearestOfDimension : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, NearestOfDimension, ::testing::Range(1, 6));

TEST_P(NearestOfDimension, AgainstAllVertices) {
  const int d = GetParam();
  for (const test::PointSet& set : test::degenerate_sets(d, d <= 3 ? 25 : 12, 6)) {
    SCOPED_TRACE(set.name);
    const Delaunay<> t(set.points, d);
    if (t.num_vertices() == 0) continue;
    std::vector<double> queries = queries_for(set, test::scaled_count(20), 31);
    // Beside the flat, where squared distances differ by a constant only.
    for (int j = 0; j < d; ++j) queries.push_back(j == 0 ? 0.25 : -1.5);
    expect_nearest(t, queries, [](VertexId) { return 0.0; });
  }
}

TEST_P(NearestOfDimension, LeastPower) {
  const int d = GetParam();
  test::Random random(static_cast<std::uint64_t>(d));
  for (int run = 0; run < 8; ++run) {
    const int width = run % 3 == 0 ? 1 : 4;
    test::PointSet set = test::small_integers(d, 40, -width, width, random.bits());
    if (run % 4 == 3 && d > 1)
      set = test::embedded(test::small_integers(d - 1, 30, -3, 3, 5), d, true, random.bits());
    std::vector<double> weights;
    for (std::size_t i = 0; i < set.size(); ++i)
      weights.push_back(run % 2 == 0 ? random.integer(-3, 9) : 0.1 * random.integer(0, 40));
    const Regular<> t(set.points, weights, d);
    expect_nearest(t, queries_for(set, test::scaled_count(30), random.bits()),
                   [&](VertexId v) { return t.weight(v); });
  }
}

// The middle of every cube of a lattice is as near to all its corners: the first row in any order of the
// rows.
TEST(Nearest, TiesGoToTheFirstRow) {
  for (const int d : {1, 2, 3, 4}) {
    const test::PointSet set = test::permuted(test::lattice(d, 3), 17);
    const Delaunay<> t(set.points, d);
    std::vector<double> middles = test::lattice(d, 2).points;
    for (double& x : middles) x += 0.5;
    expect_nearest(t, middles, [](VertexId) { return 0.0; });
  }
  const test::PointSet sphere = test::cospherical(3, 9);
  expect_nearest(Delaunay<>(sphere.points, 3), {0, 0, 0}, [](VertexId) { return 0.0; });
}

TEST(CompareDistances, AgainstFractions) {
  test::Random random(12);
  for (int d = 1; d <= 4; ++d)
    for (const auto& [low, high] : {std::pair{-3, 3}, {-1070, -1000}, {900, 1020}, {-1070, 1020}})
      for (int run = 0; run < 60; ++run) {
        const auto points = test::mixed_exponents(d, 3, low, high, random.bits()).points;
        const auto size = static_cast<std::size_t>(d);
        const auto q = std::span(points).first(size);
        auto a = std::vector<double>(points.begin() + d, points.begin() + 2 * d);
        auto b = std::vector<double>(points.begin() + 2 * d, points.end());
        if (run % 3 == 0) {  // mirror images, one of them perhaps nudged
          b = a;
          std::reverse(b.begin(), b.end());
          if (run % 2 == 0) b[0] = std::nextafter(b[0], 0);
        }
        const double w = run % 4 == 0 ? a[0] : 0;
        const Fraction difference = power(q, a, w) - power(q, b, 0);
        const Sign expected = difference < 0 ? Sign::negative : difference > 0 ? Sign::positive : Sign::zero;
        EXPECT_EQ(compare_distances(q, a, b, w, 0), expected);
        EXPECT_EQ(compare_distances(q, b, a, 0, w), -expected);
      }
  const std::vector<double> one{1}, two{1, 2}, bad{NAN};
  EXPECT_THROW(compare_distances(one, two, one), Error);
  EXPECT_THROW(compare_distances(one, bad, one), Error);
}

}  // namespace
}  // namespace delone
