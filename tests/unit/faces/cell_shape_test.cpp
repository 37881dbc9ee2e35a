// SPDX-License-Identifier: BSD-3-Clause
// Circumscribed spheres and qualities of cells: known shapes, and random, thin and extreme ones against
// rationals.
#include "faces/cell_shape.hpp"

#include <delone/delaunay.hpp>
#include <delone/measures.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace delone {
namespace {

using Real = boost::multiprecision::cpp_rational;

/// The root of a positive number, with 200 bits.
Real root(const Real& x) {
  using boost::multiprecision::cpp_int;
  cpp_int numerator = boost::multiprecision::numerator(x),
          denominator = boost::multiprecision::denominator(x);
  const int shift = 400 + 2 * std::abs(static_cast<int>(msb(numerator)) - static_cast<int>(msb(denominator)));
  const cpp_int scaled = (numerator << (2 * shift)) / denominator;
  return Real(cpp_int(sqrt(scaled)), cpp_int(cpp_int(1) << shift));
}

struct Shape {
  Real radius, sum_of_inverse_heights, power_of_mean_ratio, radius_edge_ratio;
};

/// By elimination: the Gram matrix beside the right side of the center and the unit matrix.
Shape shape_of(const double* const* points, std::size_t corners, std::size_t d) {
  const std::size_t n = corners - 1, width = 2 * n + 1;
  std::vector<Real> a(n * width, Real(0));
  const auto edge = [&](std::size_t i, std::size_t j) -> Real {
    return Real(points[i + 1][j]) - Real(points[0][j]);
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t m = 0; m < n; ++m)
      for (std::size_t j = 0; j < d; ++j) a[i * width + m] += edge(i, j) * edge(m, j);
    a[i * width + n] = a[i * width + i] / 2;
    a[i * width + n + 1 + i] = 1;
  }
  const std::vector<Real> given = a;
  Real determinant = 1;
  for (std::size_t s = 0; s < n; ++s) {
    const Real pivot = a[s * width + s];
    determinant *= pivot;
    for (std::size_t c = 0; c < width; ++c) a[s * width + c] /= pivot;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == s) continue;
      const Real factor = a[r * width + s];
      for (std::size_t c = 0; c < width; ++c) a[r * width + c] -= factor * a[s * width + c];
    }
  }
  Shape shape;
  Real square = 0, first = 0, squares = 0, shortest = -1;
  for (std::size_t i = 0; i < n; ++i) {
    square += a[i * width + n] * given[i * width + n];
    shape.sum_of_inverse_heights += root(a[i * width + n + 1 + i]);
    for (std::size_t m = 0; m < n; ++m) first += a[i * width + n + 1 + m];
  }
  for (std::size_t i = 0; i < corners; ++i)
    for (std::size_t m = 0; m < i; ++m) {
      Real length = 0;
      for (std::size_t j = 0; j < d; ++j)
        length += (Real(points[i][j]) - Real(points[m][j])) * (Real(points[i][j]) - Real(points[m][j]));
      squares += length;
      if (shortest < 0 || length < shortest) shortest = length;
    }
  shape.radius = root(square);
  shape.sum_of_inverse_heights += root(first);
  shape.power_of_mean_ratio = determinant / Real(n + 1);
  for (std::size_t i = 0; i < n; ++i) shape.power_of_mean_ratio *= Real(n * (n + 1)) / squares;
  shape.radius_edge_ratio = shape.radius / root(shortest);
  return shape;
}

void expect_near(double found, const Real& exact, double relative) {
  EXPECT_LE(abs(Real(Real(found) - exact)), Real(relative) * exact) << found << " for " << exact;
}

void expect_shapes(const Triangulation& t) {
  const ComplexData data = t.to_data();
  const auto d = static_cast<std::size_t>(data.dimension),
             corners = static_cast<std::size_t>(data.affine_dimension + 1);
  const std::vector<double> radii = circumradii(t), centers = circumcenters(t),
                            radius = qualities(t, QualityMeasure::radius_ratio),
                            mean = qualities(t, QualityMeasure::mean_ratio),
                            edge = qualities(t, QualityMeasure::radius_edge_ratio);
  ASSERT_EQ(radii.size(), data.num_cells());
  for (std::size_t cell = 0; cell < data.num_cells(); ++cell) {
    std::vector<const double*> points;
    for (std::size_t i = 0; i < corners; ++i)
      points.push_back(data.points.data() + static_cast<std::size_t>(data.cells[cell * corners + i]) * d);
    const Shape shape = shape_of(points.data(), corners, d);
    expect_near(radii[cell], shape.radius, 0x1p-52);
    expect_near(radius[cell], Real(corners - 1) / (shape.radius * shape.sum_of_inverse_heights), 1e-9);
    Real power = 1;
    for (std::size_t i = 1; i < corners; ++i) power *= Real(mean[cell]);
    EXPECT_LE(abs(Real(power - shape.power_of_mean_ratio)),
              Real(1e-9) * Real(corners - 1) * shape.power_of_mean_ratio);
    expect_near(edge[cell], shape.radius_edge_ratio, 1e-9);
    EXPECT_LE(radius[cell], 1.0);
    EXPECT_LE(mean[cell], 1.0);
    Real square = 0;
    for (std::size_t j = 0; j < d; ++j) {
      const Real x = Real(centers[cell * d + j]) - Real(points[0][j]);
      square += x * x;
    }
    expect_near(radii[cell], root(square), 1e-6);
  }
}

TEST(Measures, OfRandomCells) {
  for (int d = 1; d <= 5; ++d) expect_shapes(Delaunay<>(make_point_set("uniform", d, d < 4 ? 20 : 7, 3), d));
  expect_shapes(Delaunay<>(make_point_set("flat", 3, 20, 1), 3));
  for (const double scale : {1e-200, 1e200, 1e-100}) {
    std::vector<double> points = make_point_set("uniform", 3, 8, 4);
    for (double& x : points) x *= scale;
    expect_shapes(Delaunay<>(points, 3));
  }
}

TEST(Measures, NoneDependsOnTheScale) {
  // Powers of two change no digit, so long as all coordinates stay normal.
  const double sliver = 0x1p-20;
  for (const std::vector<double>& points : {std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, sliver},
                                            {0.75, 0, 0, 1, 0, 0, 0.5, 1, 0, 1, 1, 1}})
    for (const int power : {-1000, -600, -500, -200, -140, 140, 200, 500, 600, 1000}) {
      std::vector<double> scaled = points;
      for (double& x : scaled) x = std::ldexp(x, power);
      const Delaunay<> t(points, 3), large(scaled, 3);
      expect_shapes(large);
      for (const auto measure :
           {QualityMeasure::radius_ratio, QualityMeasure::mean_ratio, QualityMeasure::radius_edge_ratio})
        EXPECT_NEAR(qualities(t, measure)[0] / qualities(large, measure)[0], 1, 2e-9);
    }
  // The radius is beyond the range of doubles; edges are, too; heights are below the normal numbers.
  const Delaunay<> flat(std::vector<double>{-1e308, 0, 1e308, 0, 0, 1e290}, 2);
  EXPECT_EQ(circumradii(flat)[0], std::numeric_limits<double>::infinity());
  EXPECT_NEAR(qualities(flat, QualityMeasure::radius_edge_ratio)[0], 0.5e18, 1e9);
  EXPECT_NEAR(qualities(flat, QualityMeasure::radius_ratio)[0], 2e-36, 1e-44);
  const Delaunay<> little(std::vector<double>{0, 0, 3 * 0x1p-1070, 0, 0, 4 * 0x1p-1070}, 2);
  EXPECT_NEAR(qualities(little, QualityMeasure::radius_ratio)[0], 0.8, 1e-9);
  EXPECT_NEAR(qualities(little, QualityMeasure::radius_edge_ratio)[0], 2.5 / 3, 1e-9);
  expect_shapes(Delaunay<>(std::vector<double>{0, 0, 1e-160, 0, 0.5e-160, 1e-310}, 2));
}

TEST(Measures, OfThinCells) {
  for (int power = 4; power < 300; power += 37) {
    const double little = std::ldexp(1.0, -power);
    expect_shapes(Delaunay<>(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1.5, little}, 3));
    expect_shapes(Delaunay<>(std::vector<double>{0, 0, 1, little, 2, 0}, 2));
    expect_shapes(Delaunay<>(std::vector<double>{0, 0, 1, 0, 0.5, little}, 2));
  }
}

TEST(Measures, OfKnownShapes) {
  const Delaunay<> regular(std::vector<double>{1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1}, 3);
  EXPECT_NEAR(circumradii(regular)[0], std::sqrt(3.0), 1e-15);
  EXPECT_EQ(circumcenters(regular), (std::vector<double>{0, 0, 0}));
  EXPECT_NEAR(qualities(regular, QualityMeasure::radius_ratio)[0], 1, 1e-9);
  EXPECT_NEAR(qualities(regular, QualityMeasure::mean_ratio)[0], 1, 1e-9);
  EXPECT_NEAR(qualities(regular, QualityMeasure::radius_edge_ratio)[0], std::sqrt(3.0 / 8), 1e-9);
  const Delaunay<> right(std::vector<double>{0, 0, 3, 0, 0, 4}, 2);
  EXPECT_EQ(circumradii(right)[0], 2.5);
  EXPECT_NEAR(qualities(right, QualityMeasure::radius_ratio)[0], 0.8, 1e-9);
  EXPECT_NEAR(qualities(right, QualityMeasure::mean_ratio)[0], 4 * std::sqrt(3.0) * 6 / 50, 1e-9);
  const Delaunay<> point(std::vector<double>{3, 4, 3, 4}, 2), none(2);
  EXPECT_EQ(circumradii(point), std::vector<double>{0});
  EXPECT_EQ(circumcenters(point), (std::vector<double>{3, 4}));
  EXPECT_EQ(qualities(point, QualityMeasure::mean_ratio), std::vector<double>{1});
  EXPECT_TRUE(circumradii(none).empty() && circumcenters(none).empty());
  EXPECT_TRUE(qualities(none, QualityMeasure::radius_ratio).empty());
  // Weights do not count.
  const Regular<> weighted(std::vector<double>{0, 0, 3, 0, 0, 4}, std::vector<double>{0, 1, 2}, 2);
  EXPECT_EQ(circumradii(weighted), circumradii(right));
  EXPECT_EQ(circumcenters(weighted), circumcenters(right));
}

/// Random points, the last one moved to within `height` of the flat of the others, each axis in its own unit.
std::vector<double> random_cell(std::size_t corners, std::size_t d, double height, double units,
                                std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> points(corners * d);
  for (double& x : points) x = uniform(random);
  double* const last = points.data() + (corners - 1) * d;
  for (std::size_t j = 0; j < d; ++j) {
    double middle = 0;
    for (std::size_t i = 0; i + 1 < corners; ++i)
      middle += points[i * d + j] / static_cast<double>(corners - 1);
    last[j] = middle + height * last[j];
  }
  for (std::size_t i = 0; i < corners; ++i)
    for (std::size_t j = 0; j < d; ++j) points[i * d + j] *= j % 3 == 1 ? units : j % 3 == 2 ? 1 / units : 1;
  return points;
}

TEST(Measures, StagesAgreeWithRationals) {
  using internal::ShapeStage;
  std::mt19937_64 random(5);
  std::size_t count[3] = {0, 0, 0};
  for (std::size_t d = 2; d <= 8; ++d)
    for (std::size_t corners = std::max<std::size_t>(d, 3); corners <= d + 1; ++corners)
      for (const double height : {1.0, 1e-4, 1e-8, 1e-13, 1e-15})
        for (const double units : {1.0, 1e6}) {
          if (d > 5 && (height == 1e-8 || height == 1e-4 || units == 1)) continue;  // rationals are slow
          const std::vector<double> cell = random_cell(corners, d, height, units, random);
          std::vector<const double*> points;
          for (std::size_t i = 0; i < corners; ++i) points.push_back(cell.data() + i * d);

          const Shape shape = shape_of(points.data(), corners, d);
          const auto radius = static_cast<double>(shape.radius);
          ShapeStage stage{};
          expect_near(internal::radius_ratio(points.data(), corners, d, radius, &stage),
                      Real(corners - 1) / (shape.radius * shape.sum_of_inverse_heights), 1e-9);
          ++count[static_cast<std::size_t>(stage)];
          const double mean = internal::mean_ratio(points.data(), corners, d, &stage);
          ++count[static_cast<std::size_t>(stage)];
          Real power = 1;
          for (std::size_t i = 1; i < corners; ++i) power *= Real(mean);
          EXPECT_LE(abs(Real(power - shape.power_of_mean_ratio)),
                    Real(1e-9) * Real(corners - 1) * shape.power_of_mean_ratio);
        }
  for (const std::size_t decided : count) EXPECT_GE(decided, 10u);
}

TEST(Measures, RandomCellsNeedNoIntegers) {
  using internal::ShapeStage;
  std::mt19937_64 random(6);
  for (std::size_t d = 2; d <= 8; ++d)
    for (const double units : {1.0, 1e6})
      for (int round = 0; round < 30; ++round) {
        const std::vector<double> cell = random_cell(d + 1, d, 1, units, random);
        std::vector<const double*> points;
        for (std::size_t i = 0; i <= d; ++i) points.push_back(cell.data() + i * d);
        ShapeStage stage{};
        internal::radius_ratio(points.data(), d + 1, d, 1, &stage);
        EXPECT_NE(stage, ShapeStage::integers);
        internal::mean_ratio(points.data(), d + 1, d, &stage);
        EXPECT_NE(stage, ShapeStage::integers);
      }
}

}  // namespace
}  // namespace delone
