// SPDX-License-Identifier: BSD-3-Clause
// Trimmed triangulations: every removed point is within the tolerance of what remains, in rationals; slivers
// of turned grids go, and their cells stay.
#include <delone/trim.hpp>

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/regular.hpp>

#include "scale.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>

namespace delone::triangulation {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// The squared distance of x from a simplex: the least among those of its projections on the flats of faces
/// that lie in the face.
template <class Number>
Number squared_distance(const std::vector<Number>& x, const std::vector<std::vector<Number>>& simplex) {
  const std::size_t d = x.size(), n = simplex.size();
  std::optional<Number> least;
  for (unsigned face = 1; face < 1u << n; ++face) {
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < n; ++i)
      if ((face >> i & 1u) != 0) corners.push_back(i);
    const std::size_t m = corners.size() - 1;
    // Normal equations of the coordinates of the projection, by elimination.
    std::vector<std::vector<Number>> a(m, std::vector<Number>(m + 1, Number(0)));
    const auto edge = [&](std::size_t i, std::size_t j) {
      return Number(simplex[corners[i + 1]][j] - simplex[corners[0]][j]);
    };
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < d; ++j) {
        for (std::size_t l = 0; l < m; ++l) a[i][l] += edge(i, j) * edge(l, j);
        a[i][m] += edge(i, j) * (x[j] - simplex[corners[0]][j]);
      }
    bool is_inside = true;
    for (std::size_t s = 0; s < m; ++s) {
      is_inside = is_inside && a[s][s] != 0;
      if (!is_inside) break;
      for (std::size_t r = 0; r < m; ++r) {
        if (r == s) continue;
        const Number factor = a[r][s] / a[s][s];
        for (std::size_t c = s; c <= m; ++c) a[r][c] -= factor * a[s][c];
      }
    }
    if (!is_inside) continue;
    Number rest = 1;
    std::vector<Number> to(d);
    for (std::size_t j = 0; j < d; ++j) to[j] = x[j] - simplex[corners[0]][j];
    for (std::size_t i = 0; i < m; ++i) {
      const Number coordinate = a[i][m] / a[i][i];
      is_inside = is_inside && coordinate >= 0;
      rest -= coordinate;
      for (std::size_t j = 0; j < d; ++j) to[j] -= coordinate * edge(i, j);
    }
    if (!is_inside || rest < 0) continue;
    Number square = 0;
    for (const Number& t : to) square += t * t;
    if (!least || square < *least) least = square;
  }
  return *least;
}

template <class Number>
std::vector<std::vector<Number>> corners_of(const ComplexData& data, std::size_t cell) {
  const auto d = static_cast<std::size_t>(data.dimension),
             k = static_cast<std::size_t>(data.affine_dimension);
  std::vector<std::vector<Number>> corners;
  for (std::size_t i = 0; i <= k; ++i) {
    const double* p = data.points.data() + static_cast<std::size_t>(data.cells[cell * (k + 1) + i]) * d;
    corners.emplace_back(p, p + d);
  }
  return corners;
}

/// Corners and inner points of the removed cells, exactly.
void expect_near(const Triangulation& triangulation, const TrimResult& result, double tolerance,
                 std::mt19937_64& random) {
  const ComplexData before = triangulation.to_data();
  const Rational limit = Rational(result.depth) * Rational(result.depth);
  EXPECT_LE(result.depth, tolerance);
  for (std::size_t cell = 0; cell < before.num_cells(); ++cell) {
    if (result.kept[cell] != 0) continue;
    const auto corners = corners_of<Rational>(before, cell);
    std::vector<std::vector<Rational>> samples = corners;
    for (int inner = 0; inner < 3; ++inner) {
      std::vector<Rational> x(corners[0].size(), Rational(0));
      std::vector<int> shares;
      for (std::size_t i = 0; i < corners.size(); ++i) shares.push_back(static_cast<int>(random() % 5));
      shares[0] += 1;
      Rational sum = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        sum += shares[i];
        for (std::size_t j = 0; j < x.size(); ++j) x[j] += shares[i] * corners[i][j];
      }
      for (Rational& r : x) r /= sum;
      samples.push_back(x);
    }
    for (const auto& x : samples) {
      std::vector<double> rounded;
      for (const Rational& r : x) rounded.push_back(r.convert_to<double>());
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t other = 0; other < result.data.num_cells(); ++other) {
        const double square = squared_distance(rounded, corners_of<double>(result.data, other));
        if (square < least) {
          least = square;
          nearest = other;
        }
      }
      EXPECT_LE(squared_distance(x, corners_of<Rational>(result.data, nearest)), limit);
    }
  }
}

void expect_consistent(const Triangulation& triangulation, const TrimResult& result) {
  const ComplexData before = triangulation.to_data();
  const auto corners = static_cast<std::size_t>(before.affine_dimension + 1);
  EXPECT_EQ(result.kept.size(), before.num_cells());
  EXPECT_EQ(result.data.num_cells() + result.num_removed, before.num_cells());
  EXPECT_GE(result.data.num_cells(), before.num_cells() == 0 ? 0u : 1u);
  std::vector<SignedIndex> number(before.num_cells(), -1);
  SignedIndex count = 0;
  for (std::size_t cell = 0; cell < before.num_cells(); ++cell)
    if (result.kept[cell] != 0) number[cell] = count++;
  std::vector<SignedIndex> cells, neighbors;
  for (std::size_t item = 0; item < before.cells.size(); ++item) {
    if (result.kept[item / corners] == 0) continue;
    const SignedIndex neighbor = before.neighbors[item];
    cells.push_back(before.cells[item]);
    neighbors.push_back(neighbor < 0 ? -1 : number[static_cast<std::size_t>(neighbor)]);
  }
  EXPECT_EQ(result.data.cells, cells);
  EXPECT_EQ(result.data.neighbors, neighbors);
  std::set<SignedIndex> orphans(before.cells.begin(), before.cells.end());
  for (const SignedIndex row : cells) orphans.erase(row);
  EXPECT_EQ(std::set<SignedIndex>(result.orphans.begin(), result.orphans.end()), orphans);
  EXPECT_TRUE(std::is_sorted(result.orphans.begin(), result.orphans.end()));
}

double volume(const ComplexData& data) {
  double sum = 0;
  for (std::size_t cell = 0; cell < data.num_cells(); ++cell) {
    const auto p = corners_of<double>(data, cell);
    if (p.size() == 3)
      sum +=
          std::abs((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) / 2;
    if (p.size() != 4) continue;
    double a[3][3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) a[i][j] = p[i + 1][j] - p[0][j];
    sum += std::abs(a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
                    a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
                    a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0])) /
           6;
  }
  return sum;
}

std::vector<double> turned_grid(std::size_t d, int side, double degrees) {
  const double c = std::cos(degrees * 3.14159265358979 / 180), s = std::sin(degrees * 3.14159265358979 / 180);
  std::vector<double> points;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < (d == 3 ? side : 1); ++z) {
        std::vector<double> p{c * x - s * y, s * x + c * y};
        if (d == 3) {
          p = {p[0], c * p[1] - s * z, s * p[1] + c * z};
          p = {c * p[0] - s * p[2], p[1], s * p[0] + c * p[2]};
        }
        points.insert(points.end(), p.begin(), p.end());
      }
  return points;
}

TEST(Trim, SliversOfTurnedGrids) {
  std::mt19937_64 random(1);
  for (const std::size_t d : {2u, 3u})
    for (const double degrees : {7.77, 31.5}) {
      const int side = d == 2 ? 20 : 7;
      const Delaunay<> triangulation(turned_grid(d, side, degrees), static_cast<int>(d));
      const TrimResult result = trim(triangulation, 1e-12);
      expect_consistent(triangulation, result);
      EXPECT_GT(result.num_removed, 0u);
      EXPECT_TRUE(result.orphans.empty());
      EXPECT_LT(result.depth, 1e-13);
      EXPECT_LT(result.lost_volume, 1e-11);
      EXPECT_NEAR(volume(result.data), std::pow(side - 1, d), 1e-9);
      if (d == 2) {
        EXPECT_EQ(result.data.num_cells(), 2u * 19 * 19);
        expect_near(triangulation, result, 1e-12, random);
      }
      for (std::size_t cell = 0; cell < result.data.num_cells(); ++cell) {
        ComplexData one = result.data;
        one.cells = {result.data.cells.begin() + static_cast<std::ptrdiff_t>(cell * (d + 1)),
                     result.data.cells.begin() + static_cast<std::ptrdiff_t>((cell + 1) * (d + 1))};
        if (d == 2) {
          EXPECT_GT(volume(one), 0.4);
        }
      }
    }
}

TEST(Trim, EveryRemovedPointIsNear) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t removed = 0;
  const std::size_t trials = 3 + test::scaled_count(15);
  for (std::size_t trial = 0; trial < trials; ++trial) {
    const std::size_t d = 1 + trial % 3;
    std::vector<double> points(d * 14);
    for (double& x : points) x = trial % 2 == 0 ? uniform(random) : std::floor(4 * uniform(random)) / 4;
    if (trial % 5 == 0)  // elongated, so that cells are thin in one direction
      for (std::size_t i = 0; i < points.size(); i += d) points[i] *= 8;
    const Delaunay<> triangulation(points, static_cast<int>(d));
    for (const double tolerance : {0.05, 0.2, 0.7}) {
      const TrimResult result = trim(triangulation, tolerance);
      expect_consistent(triangulation, result);
      expect_near(triangulation, result, tolerance, random);
      removed += result.num_removed;
    }
  }
  EXPECT_GT(removed, 3 * trials);
}

TEST(Trim, TheOrderOfRowsDoesNotMatter) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int trial = 0; trial < 12; ++trial) {
    const std::size_t d = 2 + static_cast<std::size_t>(trial % 2);
    std::vector<std::vector<double>> rows(30, std::vector<double>(d));
    for (auto& row : rows)
      for (double& x : row) x = trial % 3 == 0 ? std::floor(4 * uniform(random)) : uniform(random);
    std::optional<std::set<std::set<std::vector<double>>>> first;
    std::optional<std::pair<double, double>> figures;
    for (int shuffle = 0; shuffle < 4; ++shuffle) {
      std::vector<double> points;
      for (const auto& row : rows) points.insert(points.end(), row.begin(), row.end());
      const TrimResult result = trim(Delaunay<>(points, static_cast<int>(d)), 0.3);
      std::set<std::set<std::vector<double>>> cells;
      for (std::size_t cell = 0; cell < result.data.num_cells(); ++cell) {
        const auto corners = corners_of<double>(result.data, cell);
        cells.emplace(corners.begin(), corners.end());
      }
      if (!first) first = cells;
      if (!figures) figures = {result.depth, result.lost_volume};
      EXPECT_EQ(cells, *first) << trial;
      EXPECT_EQ(figures, std::pair(result.depth, result.lost_volume));
      std::shuffle(rows.begin(), rows.end(), random);
    }
  }
}

// An ear with a far apex: thin over its two exposed edges, but its apex is far from the rest.
TEST(Trim, APointedCornerIsDeep) {
  const Delaunay<2> triangulation(
      std::vector<std::array<double, 2>>{{0, 0}, {0, 0.01}, {-1, 1}, {-1, -1}, {10, 0.005}});
  const TrimResult result = trim(triangulation, 0.5);
  for (const SignedIndex row : result.orphans) EXPECT_NE(row, 4);
}

TEST(Trim, TheLastCellStays) {
  const Delaunay<2> one(std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {0, 1}});
  EXPECT_EQ(trim(one, 1).num_removed, 0u);
  const Delaunay<1> line(std::vector<std::array<double, 1>>{{0}, {1}, {3}, {6}});
  const TrimResult rest = trim(line, 5);
  EXPECT_EQ(rest.data.num_cells(), 1u);
  EXPECT_EQ(rest.depth, 3);  // 0…1, then 1…3, which comes before 3…6
  EXPECT_EQ(rest.lost_volume, 3);
  EXPECT_EQ(rest.orphans, (std::vector<SignedIndex>{0, 1}));
}

TEST(Trim, FlatDuplicateHiddenAndEmptyInput) {
  std::mt19937_64 random(4);
  std::vector<double> flat;  // a turned grid in a plane of space, twice
  for (int copy = 0; copy < 2; ++copy)
    for (int x = 0; x < 5; ++x)
      for (int y = 0; y < 5; ++y) flat.insert(flat.end(), {0.1 * x, 0.1 * y, 0.1 * x + 0.3 * y});
  const Delaunay<3> triangulation(flat);
  const TrimResult result = trim(triangulation, 0.05);
  expect_consistent(triangulation, result);
  EXPECT_EQ(trim(Delaunay<2>(), 1).data.num_cells(), 0u);
  const Regular<2> regular(std::vector<std::array<double, 2>>{{0, 0}, {4, 0}, {0, 4}, {1, 1}, {2, -0.01}},
                           std::vector<double>{0, 0, 0, -9, -4.5});
  const TrimResult of_regular = trim(regular, 0.1);
  expect_consistent(regular, of_regular);
  EXPECT_EQ(of_regular.num_removed, 1u);
  EXPECT_EQ(of_regular.orphans, std::vector<SignedIndex>{4});
  EXPECT_NEAR(of_regular.depth, 0.01, 1e-12);
  EXPECT_NEAR(of_regular.lost_volume, 0.02, 1e-12);
}

TEST(Trim, ToleranceOutOfRange) {
  const Delaunay<2> triangulation(std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {0, 2}});
  for (const double tolerance : {-1.0, std::nan(""), std::numeric_limits<double>::infinity(), 2.1})
    EXPECT_THROW(trim(triangulation, tolerance), Error) << tolerance;
  EXPECT_EQ(trim(triangulation, 0).num_removed, 0u);
}

TEST(Trim, ExtremeScales) {
  for (const double scale : {1e-300, 1e150, 1e300}) {
    std::vector<double> points = turned_grid(2, 8, 31.5);
    for (double& x : points) x *= scale;
    const TrimResult result = trim(Delaunay<2>(points), 1e-12 * scale);
    EXPECT_EQ(result.data.num_cells(), 2u * 7 * 7) << scale;
    EXPECT_GT(result.num_removed, 0u);
  }
}

}  // namespace
}  // namespace delone::triangulation
