// SPDX-License-Identifier: BSD-3-Clause
#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/natural_neighbors.hpp>
#include <delone/regular.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace delone {
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
  EXPECT_THROW(function.evaluate(many, found, {.progress = [](std::size_t) { return false; }}), Error);
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

}  // namespace
}  // namespace delone
