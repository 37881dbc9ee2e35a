// SPDX-License-Identifier: BSD-3-Clause
// Points as programs hold them after a rotation: shapes with many points in their faces, turned and rounded.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace delone::test {

struct Shape {
  std::string name;
  int dimension = 0;
  std::vector<double> points;
  std::size_t vertices = 0, facets = 0;  // of the exact shape
};

/// n + 1 values per axis from 0 to each length; only those on the border unless `filled`.
inline Shape subdivided_box(std::string name, const std::vector<double>& lengths, int n, bool filled) {
  const std::size_t d = lengths.size();
  Shape shape{std::move(name), static_cast<int>(d), {}, std::size_t{1} << d, 2 * d};
  std::vector<int> at(d, 0);
  for (;;) {
    bool on_border = false;
    for (const int i : at) on_border |= i == 0 || i == n;
    for (std::size_t j = 0; j < d && (filled || on_border); ++j)
      shape.points.push_back(lengths[j] * at[j] / n);
    std::size_t j = 0;
    while (j < d && ++at[j] > n) at[j++] = 0;
    if (j == d) return shape;
  }
}

/// A prism over a polygon, given by its corners, with n + 1 points along each edge and n + 1 layers; the lids
/// have rays of points to their middle.
inline Shape prism(std::string name, const std::vector<std::pair<double, double>>& corners, double height,
                   int n) {
  Shape shape{std::move(name), 3, {}, 0, 0};
  const std::size_t m = corners.size();
  double x0 = 0, y0 = 0;
  for (const auto& [x, y] : corners) x0 += x / static_cast<double>(m), y0 += y / static_cast<double>(m);
  for (int layer = 0; layer <= n; ++layer)
    for (std::size_t i = 0; i < m; ++i)
      for (int step = 0; step < n; ++step) {
        const auto [xa, ya] = corners[i];
        const auto [xb, yb] = corners[(i + 1) % m];
        const double t = static_cast<double>(step) / n, x = xa + (xb - xa) * t, y = ya + (yb - ya) * t;
        shape.points.insert(shape.points.end(), {x, y, height * layer / n});
        for (int ring = 1; ring < n && (layer == 0 || layer == n); ++ring) {
          const double s = static_cast<double>(ring) / n;
          shape.points.insert(shape.points.end(), {x + (x0 - x) * s, y + (y0 - y) * s, height * layer / n});
        }
      }
  return shape;
}

/// An L, whose hull has one facet across the notch.
inline Shape l_prism() {
  Shape shape = prism("L", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2.5}, {0, 2.5}}, 0.7, 6);
  shape.vertices = 10;
  shape.facets = 7;
  return shape;
}

/// A hexagon whose upper edge is chamfered: the lid is smaller, and the slanted faces are subdivided, too.
inline Shape chamfered_hexagon() {
  std::vector<std::pair<double, double>> corners;
  constexpr double turn = 1.0471975511965976;  // 60°
  for (int i = 0; i < 6; ++i) corners.emplace_back(2 * std::cos(i * turn), 2 * std::sin(i * turn));
  Shape shape = prism("chamfered hexagon", corners, 1.5, 5);
  constexpr int n = 5;
  for (int layer = 1; layer <= n; ++layer) {
    const double inset = 1 - 0.2 * layer / n;
    for (std::size_t i = 0; i < 6; ++i)
      for (int step = 0; step < n; ++step) {
        const auto [xa, ya] = corners[i];
        const auto [xb, yb] = corners[(i + 1) % 6];
        const double t = static_cast<double>(step) / n;
        shape.points.insert(shape.points.end(), {(xa + (xb - xa) * t) * inset, (ya + (yb - ya) * t) * inset,
                                                 1.5 + 0.3 * layer / n});
      }
  }
  shape.vertices = 18;
  shape.facets = 14;
  return shape;
}

/// The shape, turned by a random rotation and moved, in rounded coordinates.
inline std::vector<double> turned(const Shape& shape, std::uint64_t seed) {
  const auto d = static_cast<std::size_t>(shape.dimension);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> axes;
  while (axes.size() < d) {  // Gram–Schmidt, twice
    std::vector<double> axis(d);
    for (double& x : axis) x = normal(random);
    for (int pass = 0; pass < 2; ++pass)
      for (const auto& other : axes) {
        double dot = 0;
        for (std::size_t j = 0; j < d; ++j) dot += axis[j] * other[j];
        for (std::size_t j = 0; j < d; ++j) axis[j] -= dot * other[j];
      }
    double square = 0;
    for (const double x : axis) square += x * x;
    for (double& x : axis) x /= std::sqrt(square);
    axes.push_back(std::move(axis));
  }
  std::vector<double> shift(d), result;
  for (double& x : shift) x = normal(random);
  for (std::size_t at = 0; at < shape.points.size(); at += d)
    for (std::size_t i = 0; i < d; ++i) {
      double x = shift[i];
      for (std::size_t j = 0; j < d; ++j) x += axes[i][j] * shape.points[at + j];
      result.push_back(x);
    }
  return result;
}

}  // namespace delone::test
