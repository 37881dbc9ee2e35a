// SPDX-License-Identifier: BSD-3-Clause
#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/natural_neighbors.hpp>
#include <delone/regular.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace delone::queries {
namespace {

using ::testing::ElementsAre;

struct Problem {
  explicit Problem(int dimension, std::uint64_t seed = 1) : d(static_cast<std::size_t>(dimension)) {
    test::Random random(seed);
    for (int i = 0; i < 60 * dimension; ++i) points.push_back(random.real());
    for (int i = 0; i < 20 * dimension; ++i) queries.push_back(0.3 + 0.4 * random.real());
  }
  template <class F>
  std::vector<double> values(F f) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < points.size(); i += d) result.push_back(f(points.data() + i));
    return result;
  }
  std::size_t d;
  std::vector<double> points, queries;
};

class NaturalNeighborsOfDimension : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, NaturalNeighborsOfDimension, ::testing::Range(1, 5));

// Values and gradients of linear functions, and with `smooth` of a + b·x + c·|x|² with the true gradients.
TEST_P(NaturalNeighborsOfDimension, ReproduceFunctions) {
  const Problem problem(GetParam());
  const std::size_t d = problem.d, n = problem.queries.size() / d;
  const Delaunay<> t(problem.points, GetParam());
  for (const double c : {0.0, 2.0}) {
    const auto f = [&](const double* x) {
      double sum = 1;
      for (std::size_t j = 0; j < d; ++j) sum += static_cast<double>(j + 1) * x[j] + c * x[j] * x[j];
      return sum;
    };
    std::vector<double> site_gradients;
    for (std::size_t i = 0; i < problem.points.size(); ++i)
      site_gradients.push_back(static_cast<double>(i % d + 1) + 2 * c * problem.points[i]);
    for (const bool smooth : {false, true}) {
      if (c != 0 && !smooth) continue;
      const auto values = problem.values(f);
      const NaturalNeighborInterpolator function(
          t, values, 1, smooth, c != 0 ? std::span<const double>(site_gradients) : std::span<const double>());
      std::vector<double> found(n), gradients(n * d);
      function.evaluate(problem.queries, found);
      function.gradients(problem.queries, gradients);
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(found[i], f(problem.queries.data() + i * d), 1e-9);
        for (std::size_t j = 0; j < d; ++j)
          EXPECT_NEAR(gradients[i * d + j], static_cast<double>(j + 1) + 2 * c * problem.queries[i * d + j],
                      1e-6);
      }
    }
  }
}

// Both interpolants of a wild function: gradients are those of difference quotients, and continuous.
TEST_P(NaturalNeighborsOfDimension, GradientsAreDerivatives) {
  const Problem problem(GetParam(), 5);
  const std::size_t d = problem.d, n = problem.queries.size() / d;
  const Delaunay<> t(problem.points, GetParam());
  const auto values = problem.values([](const double* x) { return std::sin(40 * x[0]); });
  for (const bool smooth : {false, true}) {
    const NaturalNeighborInterpolator function(t, values, 1, smooth);
    std::vector<double> gradients(n * d), before(n), after(n);
    function.gradients(problem.queries, gradients);
    for (std::size_t j = 0; j < d; ++j) {
      const double step = 1e-7;
      std::vector<double> moved = problem.queries;
      for (std::size_t i = 0; i < n; ++i) moved[i * d + j] -= step;
      function.evaluate(moved, before);
      for (std::size_t i = 0; i < n; ++i) moved[i * d + j] += 2 * step;
      function.evaluate(moved, after);
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(gradients[i * d + j], (after[i] - before[i]) / (2 * step), 2e-3) << smooth;
    }
  }
}

// The smooth interpolant near a vertex has the gradient there, the other has not.
TEST_P(NaturalNeighborsOfDimension, SmoothAtVertices) {
  const Problem problem(GetParam(), 7);
  const std::size_t d = problem.d;
  std::vector<double> points = problem.points;
  points.insert(points.end(), d, 0.5);
  std::vector<double> values;
  for (std::size_t i = 0; i < points.size(); i += d) values.push_back(std::cos(20 * points[i]));
  const Delaunay<> t(points, GetParam());
  const NaturalNeighborInterpolator function(t, values, 1, true);
  std::vector<double> at(d), near(d), value(1), query(d, 0.5);
  const VertexId v = t.vertex_at(values.size() - 1);
  function.site_gradient(v, at);
  function.gradients(query, near);
  EXPECT_EQ(at, near);
  function.evaluate(query, value);
  EXPECT_EQ(value[0], values.back());
  query[0] += 1e-9;
  function.gradients(query, near);
  for (std::size_t j = 0; j < d; ++j) EXPECT_NEAR(near[j], at[j], 1e-4);
}

TEST(NaturalNeighborInterpolator, HasAPolicyOutside) {
  const std::vector<double> points = {0, 0, 4, 0, 0, 4, 4, 4, 0, 0}, values = {1, 2, 3, 4, 99};
  const std::vector<double> queries = {2, 2, 5, 5, 0, 0, 1, 0};
  const Delaunay<> t(points, 2);
  const NaturalNeighborInterpolator function(t, values);
  std::vector<double> found(4), gradients(8);
  function.evaluate(queries, found, {.outside = Outside::nearest});
  EXPECT_THAT(found, ElementsAre(2.5, 4, 1, 1.25));
  const std::vector<double> fill = {-7};
  function.evaluate(queries, found, {.fill = fill});
  EXPECT_EQ(found[1], -7);
  function.evaluate(queries, found);
  EXPECT_TRUE(std::isnan(found[1]));
  function.gradients(queries, gradients, {.outside = Outside::nearest});
  EXPECT_EQ(gradients[2], 0);
  function.gradients(queries, gradients);
  EXPECT_TRUE(std::isnan(gradients[2]));
  try {
    function.evaluate(queries, found, {.outside = Outside::error});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::invalid_argument);
    EXPECT_THAT(error.rows(), ElementsAre(1u));
  }
}

TEST(NaturalNeighborInterpolator, RefusesWhatDoesNotFit) {
  const std::vector<double> points = {0, 0, 4, 0, 0, 4}, values = {1, 2, 3};
  const Delaunay<> t(points, 2);
  EXPECT_THROW(NaturalNeighborInterpolator(t, std::vector<double>{1}), Error);
  EXPECT_THROW(NaturalNeighborInterpolator(t, values, 1, true, std::vector<double>{1}), Error);
  EXPECT_THROW(NaturalNeighborInterpolator(Regular<>(points, values, 2), values), Error);
  std::vector<double> small(1);
  const NaturalNeighborInterpolator function(t, values);
  EXPECT_THROW(function.evaluate(points, small), Error);
  EXPECT_THROW(function.gradients(points, small), Error);
  EXPECT_THROW(function.evaluate(points, small, {.fill = points}), Error);
}

TEST(NaturalNeighborInterpolator, CanBeStopped) {
  const Problem problem(2);
  const Delaunay<> t(problem.points, 2);
  const NaturalNeighborInterpolator function(t, problem.values([](const double*) { return 1; }));
  std::vector<double> many;
  for (int i = 0; i < 600; ++i) many.push_back(0.5);
  std::vector<double> found(300);
  EXPECT_THROW(function.evaluate(many, found, {}, {.progress = [](double) { return false; }}), Error);
}

TEST(NaturalNeighborCoordinates, OfFewPoints) {
  const Delaunay<> t(std::vector<double>{1, 1, 3, 1}, 2);
  std::vector<int> found;
  NaturalNeighborCoordinates(t).find(std::vector<double>{1, 1, 2.5, 1, 4, 1, 2, 2},
                                     [&](std::size_t query, const NaturalNeighbors& neighbors) {
                                       found.resize(4);
                                       found[query] = static_cast<int>(neighbors.vertices.size());
                                       if (query != 1) return;
                                       for (std::size_t i = 0; i < 2; ++i)
                                         EXPECT_EQ(neighbors.weights[i],
                                                   t.row_of(neighbors.vertices[i]) == 0 ? 0.25 : 0.75);
                                     });
  EXPECT_THAT(found, ElementsAre(1, 2, 0, 0));
  NaturalNeighborCoordinates(Delaunay<>(2))
      .find(std::vector<double>{1, 1},
            [](std::size_t, const NaturalNeighbors& none) { EXPECT_TRUE(none.vertices.empty()); });
}

// A grid turned about its corner has slivers along its border. Queries computed on it are outside, in slivers
// or beside them. With a tolerance, or projected, none is lost, and what is found is that of the point that
// is reported. With a tolerance moved ones have near neighbors only.
TEST(NaturalNeighborCoordinates, WithAToleranceSliversDoNotCount) {
  constexpr int side = 12;
  constexpr double c = 0.8526401643540922, s = 0.5224985647159488;
  std::vector<double> points, queries;
  const auto add = [&](std::vector<double>& to, double x, double y) {
    to.push_back(c * x - s * y);
    to.push_back(s * x + c * y);
  };
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) add(points, i, j);
  test::Random random(3);
  for (int i = 0; i < 60; ++i) {
    const double at = random.real() * (side - 1);
    add(queries, at, 0);
    add(queries, 0, at);
    add(queries, at, side - 1);
    add(queries, at, at);
  }
  const Delaunay<> t(points, 2);
  const NaturalNeighborCoordinates coordinates(t);
  int lost = 0;
  coordinates.find(queries,
                   [&](std::size_t, const NaturalNeighbors& found) { lost += found.vertices.empty(); });
  EXPECT_GT(lost, 10);
  for (const double tolerance : {1e-9, 1e-12, 0.0}) {
    int moved = 0;
    const auto visit = [&](std::size_t query, const NaturalNeighbors& found) {
      const double* const q = queries.data() + 2 * query;
      ASSERT_FALSE(found.vertices.empty());
      EXPECT_LE(std::hypot(found.point[0] - q[0], found.point[1] - q[1]),
                tolerance == 0 ? 1e-11 : tolerance + 1e-14);
      double sum[2] = {0, 0};
      for (std::size_t i = 0; i < found.vertices.size(); ++i)
        for (std::size_t j = 0; j < 2; ++j) sum[j] += found.weights[i] * t.point(found.vertices[i])[j];
      EXPECT_NEAR(sum[0], found.point[0], 1e-9);
      EXPECT_NEAR(sum[1], found.point[1], 1e-9);
      EXPECT_NE(t.locate(found.point).kind, Location::Kind::outside_hull);
      coordinates.find(found.point, [&](std::size_t, const NaturalNeighbors& again) {
        EXPECT_TRUE(std::equal(found.vertices.begin(), found.vertices.end(), again.vertices.begin(),
                               again.vertices.end()));
        EXPECT_TRUE(std::equal(found.weights.begin(), found.weights.end(), again.weights.begin(),
                               again.weights.end()));
      });
      if (found.point[0] == q[0] && found.point[1] == q[1]) return;
      ++moved;
      for (const VertexId v : found.vertices)
        EXPECT_TRUE(tolerance == 0 || std::hypot(t.point(v)[0] - q[0], t.point(v)[1] - q[1]) < 3);
    };
    coordinates.find(queries, {.tolerance = tolerance, .project = tolerance == 0}, visit);
    EXPECT_GT(moved, 10);
  }
}

// Projected, linear functions continue constant at right angles to a cube, and to flats of any direction.
TEST(NaturalNeighborInterpolator, Projects) {
  for (const bool smooth : {false, true}) {
    std::vector<double> cube;
    for (int i = 0; i < 27; ++i)
      for (const int x : {i % 3, i / 3 % 3, i / 9}) cube.push_back(x / 2.0);
    const std::vector<double> square = {0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1, 0.25, 0.5, 1};
    const std::vector<double> tilted = {0, 0, 0, 4, 1, 3, 1, 4, 3, 5, 5, 6, 2, 2, 3};  // normal (9, 9, −15)
    for (const auto& points : {cube, square, tilted}) {
      const Delaunay<> t(points, 3);
      std::vector<double> values;
      const auto f = [](const double* x) { return 1 + x[0] - 2 * x[1] + 4 * x[2]; };
      for (std::size_t i = 0; i < points.size(); i += 3) values.push_back(f(points.data() + i));
      const NaturalNeighborInterpolator function(t, values, 1, smooth);
      test::Random random(5);
      std::vector<double> queries, expected;
      for (int i = 0; i < 40; ++i) {
        double at[3];
        for (double& x : at) x = 3 * random.real() - 1;
        queries.insert(queries.end(), at, at + 3);
        for (double& x : at) x = std::clamp(x, 0.0, 1.0);
        if (points == square) at[2] = 1;
        expected.push_back(f(at));
      }
      std::vector<double> found(40), gradients(120);
      const LinearInterpolator linear(t, values);
      if (points == tilted) linear.evaluate(queries, expected, {.outside = Outside::project});
      function.evaluate(queries, found, {.outside = Outside::project});
      for (std::size_t i = 0; i < 40; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
      function.gradients(queries, gradients, {.outside = Outside::project});
      for (const double g : gradients) EXPECT_TRUE(std::isfinite(g));
      std::vector<double> sites(values.size());
      function.evaluate(points, sites, {.outside = Outside::project, .tolerance = 0.1});
      EXPECT_EQ(sites, values);
    }
  }
}

// In a flat parallel to axes a projected query has the coordinates of its foot.
TEST(NaturalNeighborCoordinates, OfFeetInAFlat) {
  std::vector<double> points, plane;
  test::Random random(8);
  for (int i = 0; i < 30; ++i) {
    const double x = random.real(), y = random.real();
    plane.insert(plane.end(), {x, y});
    points.insert(points.end(), {x, 0.1, y});
  }
  const Delaunay<> flat(points, 3), t(plane, 2);
  const std::vector<double> query = {0.5, 7, 0.5};
  NaturalNeighborCoordinates(flat).find(
      query, {.project = true}, [&](std::size_t, const NaturalNeighbors& a) {
        ASSERT_GT(a.vertices.size(), 3u);
        const std::vector<double> foot = {a.point[0], a.point[2]};
        EXPECT_EQ(a.point[1], 0.1);
        EXPECT_NEAR(foot[0], 0.5, 1e-15);
        std::map<std::size_t, double> expected;
        NaturalNeighborCoordinates(t).find(foot, [&](std::size_t, const NaturalNeighbors& b) {
          for (std::size_t i = 0; i < b.vertices.size(); ++i)
            expected[t.row_of(b.vertices[i])] = b.weights[i];
        });
        ASSERT_EQ(a.vertices.size(), expected.size());
        for (std::size_t i = 0; i < a.vertices.size(); ++i)
          EXPECT_NEAR(a.weights[i], expected.at(flat.row_of(a.vertices[i])), 1e-13);
      });
}

// Where all cells are thinner than the tolerance, the nearest point of the hull answers, not one far inside.
TEST(NaturalNeighborCoordinates, OfThinCells) {
  std::vector<double> points, queries;
  for (int i = 1; i < 9; ++i) points.insert(points.end(), {i * 0.7, i * 0.3});
  test::Random random(9);
  for (int i = 0; i < 100; ++i) {
    const double at = 1 + 7 * random.real();
    queries.insert(queries.end(), {at * 0.7 + (random.real() - 0.5) * 1e-12, at * 0.3});
  }
  const Delaunay<> t(points, 2);
  ASSERT_EQ(t.affine_dimension(), 2);
  NaturalNeighborCoordinates(t).find(
      queries, {.tolerance = 1e-9},
      [&](std::size_t query, const NaturalNeighbors& found) {
        ASSERT_FALSE(found.vertices.empty());
        double sum[2] = {0, 0};
        for (std::size_t j = 0; j < 2; ++j) {
          for (std::size_t i = 0; i < found.vertices.size(); ++i)
            sum[j] += found.weights[i] * t.point(found.vertices[i])[j];
          EXPECT_NEAR(found.point[j], queries[2 * query + j], 1e-9);
          EXPECT_NEAR(sum[j], found.point[j], 1e-9);
        }
        EXPECT_EQ(found.gradients.size(),
                  found.kind == Location::Kind::on_vertex ? 0 : 2 * found.vertices.size());
      },
      true);
}

TEST(NaturalNeighborInterpolator, RefusesBadTolerances) {
  const std::vector<double> points = {0, 0, 4, 0, 0, 4}, values = {1, 2, 3};
  const Delaunay<> t(points, 2);
  const NaturalNeighborInterpolator function(t, values);
  std::vector<double> found(3);
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(function.evaluate(points, found, {.tolerance = bad}), Error);
}

}  // namespace
}  // namespace delone::queries
