// SPDX-License-Identifier: BSD-3-Clause
#include "construction/landmarks.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace delone {
namespace {

using construction::Landmarks;

constexpr auto any = [](Index) { return true; };

geometry::Frame box_of(const std::vector<double>& points, std::size_t dimension) {
  std::vector<double> low(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(dimension)),
      high = low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    low[i % dimension] = std::min(low[i % dimension], points[i]);
    high[i % dimension] = std::max(high[i % dimension], points[i]);
  }
  return {low, high};
}

double distance(const double* p, const double* q, std::size_t dimension) {
  double square = 0;
  for (std::size_t j = 0; j < dimension; ++j) square += (p[j] - q[j]) * (p[j] - q[j]);
  return std::sqrt(square);
}

/// Vertex i + 1 at the i-th point.
Landmarks landmarks_at(const std::vector<double>& points, std::size_t dimension) {
  Landmarks landmarks(box_of(points, dimension), dimension);
  for (std::size_t i = 0; i < points.size() / dimension; ++i)
    landmarks.add(static_cast<Index>(i + 1), points.data() + i * dimension);
  return landmarks;
}

/// How far near() is from uniform queries on average, divided by how far the nearest point is.
double mean_distance(const char* kind, int dimension, std::size_t n) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::vector<double> points = make_point_set(kind, dimension, n, 1),
                            queries = make_point_set(kind, dimension, 300, 2);
  const Landmarks landmarks = landmarks_at(points, d);
  double found = 0, least = 0;
  for (std::size_t i = 0; i < queries.size(); i += d) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); j += d)
      nearest = std::min(nearest, distance(&points[j], &queries[i], d));
    least += nearest;
    found += distance(&points[(landmarks.near(&queries[i], any) - 1) * d], &queries[i], d);
  }
  return found / least;
}

TEST(Landmarks, AreCloseToAnyPoint) {
  for (const std::size_t n : {100, 3000, 20000}) {  // through several sizes of the table
    SCOPED_TRACE(n);
    EXPECT_LT(mean_distance("uniform", 2, n), 3);
    EXPECT_LT(mean_distance("uniform", 3, n), 3);
    EXPECT_LT(mean_distance("uniform", 5, n), 3);
    EXPECT_LT(mean_distance("clusters", 3, n), 3);
    EXPECT_LT(mean_distance("manifold", 3, n), 3);
  }
}

TEST(Landmarks, AreAllFoundIfNoOtherIsAccepted) {
  for (const char* kind : {"uniform", "clusters", "grid"}) {
    SCOPED_TRACE(kind);
    const std::vector<double> points = make_point_set(kind, 3, 3375, 1);
    const Landmarks landmarks = landmarks_at(points, 3);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
      const auto vertex = static_cast<Index>(i + 1);
      lost += landmarks.near(&points[3 * i], [&](Index other) { return other == vertex; }) != vertex;
    }
    EXPECT_EQ(lost, 0u);
  }
}

TEST(Landmarks, OfNoPointOrOfNoneThatIsAccepted) {
  const double point[] = {0.5, 0.5};
  Landmarks landmarks(geometry::Frame({0, 0}, {1, 1}), 2);
  EXPECT_EQ(landmarks.near(point, any), invalid_index);
  landmarks.add(7, point);
  EXPECT_EQ(landmarks.near(point, any), 7u);
  EXPECT_EQ(landmarks.near(point, [](Index) { return false; }), invalid_index);
}

TEST(Landmarks, OfEqualPointsFillAllCubesAndNoMore) {
  const double point[] = {0.3, 0.7};
  Landmarks landmarks(geometry::Frame({0, 0}, {1, 1}), 2);
  for (Index v = 1; v <= 1000; ++v) landmarks.add(v, point);
  std::set<Index> asked;
  EXPECT_EQ(landmarks.near(point, [&](Index v) { return asked.insert(v).second && false; }), invalid_index);
  EXPECT_EQ(asked.size(), 53u);
  EXPECT_EQ(*asked.rbegin(), 53u);
}

TEST(Landmarks, OfPointsBeyondTheBoxAndOfBoxesOfAnySize) {
  constexpr double huge = std::numeric_limits<double>::max(),
                   tiny = std::numeric_limits<double>::denorm_min();
  for (const double size : {0.0, tiny, 1e-300, 1.0, 1e300, huge}) {
    SCOPED_TRACE(size);
    Landmarks landmarks(geometry::Frame({-size, 0}, {size, size}), 2);
    const double points[][2] = {{0, 0},        {size, size},  {-size, size},
                                {huge, -huge}, {-huge, huge}, {tiny, tiny}};
    Index v = 0;
    for (const auto& point : points) landmarks.add(++v, point);
    v = 0;
    for (const auto& point : points) {
      ++v;
      EXPECT_EQ(landmarks.near(point, [&](Index other) { return other == v; }), v);
    }
  }
}

}  // namespace
}  // namespace delone
