// SPDX-License-Identifier: BSD-3-Clause
// Coordinates of Sibson against volumes of polytopes in exact rationals, which know no triangulation.
#include "queries/natural_search.hpp"

#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/regular.hpp>

#include "scale.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

namespace delone::queries {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Row = std::vector<Rational>;  // a·x ≤ b: the entries of a, then b

/// Constraints scaled such that the first entry of a is ±1, each once; nothing if they exclude everything.
std::optional<std::set<Row>> tidied(const std::vector<Row>& rows) {
  std::set<Row> result;
  for (Row row : rows) {
    const auto first = std::find_if(row.begin(), row.end() - 1, [](const Rational& x) { return x != 0; });
    if (first == row.end() - 1) {
      if (row.back() < 0) return std::nullopt;
      continue;
    }
    const Rational scale = abs(*first);
    for (Rational& x : row) x /= scale;
    result.insert(row);
  }
  // Of parallel constraints only the tightest.
  std::map<Row, Rational> tightest;
  for (const Row& row : result) {
    Row normal(row.begin(), row.end() - 1);
    const auto [at, is_new] = tightest.try_emplace(normal, row.back());
    if (!is_new) at->second = std::min(at->second, row.back());
  }
  result.clear();
  for (const auto& [normal, b] : tightest) {
    Row row = normal;
    row.push_back(b);
    result.insert(std::move(row));
  }
  return result;
}

/// The volume of a bounded polytope (Lasserre 1983, doi:10.1007/BF00934543).
Rational volume(const std::vector<Row>& given) {
  const auto rows = tidied(given);
  if (!rows || rows->empty()) return 0;
  const std::size_t n = rows->begin()->size() - 1;
  if (n == 1) {
    std::optional<Rational> low, high;
    for (const Row& row : *rows) {
      if (row[0] > 0 && (!high || row[1] < *high)) high = row[1];
      if (row[0] < 0 && (!low || -row[1] > *low)) low = -row[1];
    }
    return !low || !high || *high <= *low ? Rational(0) : Rational(*high - *low);
  }
  Rational sum = 0;
  for (const Row& row : *rows) {
    if (row.back() == 0) continue;
    std::size_t pivot = 0;
    while (row[pivot] == 0) ++pivot;
    std::vector<Row> face;
    for (const Row& other : *rows) {
      if (&other == &row) continue;
      Row reduced;
      for (std::size_t j = 0; j <= n; ++j)
        if (j != pivot) reduced.push_back(other[j] - other[pivot] / row[pivot] * row[j]);
      face.push_back(std::move(reduced));
    }
    sum += row.back() / abs(row[pivot]) * volume(face);
  }
  return sum / static_cast<int>(n);
}

/// |x − a|² ≤ |x − b|², x relative to q.
Row nearer(const std::vector<Rational>& a, const std::vector<Rational>& b) {
  Row row;
  Rational right = 0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    row.push_back(2 * (b[j] - a[j]));
    right += b[j] * b[j] - a[j] * a[j];
  }
  row.push_back(right);
  return row;
}

/// The coordinates of q by row; `d` numbers per row.
std::vector<Rational> coordinates(const std::vector<double>& points, std::size_t d, const double* q) {
  const std::size_t n = points.size() / d;
  std::vector<std::vector<Rational>> sites(n, std::vector<Rational>(d));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < d; ++j) sites[i][j] = Rational(points[i * d + j]) - Rational(q[j]);
  const std::vector<Rational> origin(d, Rational(0));
  std::vector<Rational> result(n);
  Rational total = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Row> rows;
    for (std::size_t other = 0; other < n; ++other) {
      rows.push_back(nearer(origin, sites[other]));
      if (other != i) rows.push_back(nearer(sites[i], sites[other]));
    }
    result[i] = volume(rows);
    total += result[i];
  }
  for (Rational& x : result) x /= total;
  return result;
}

struct Found {
  std::map<std::size_t, double> weights;  // by row
  std::map<std::size_t, std::vector<double>> gradients;
  bool was_exact;
};

Found find(const Triangulation& t, const std::vector<double>& q, bool stored = true) {
  const NaturalCenters centers(t, stored);
  NaturalSearch search(centers);
  const Location where = t.locate(q);
  search.find(q.data(), where.cell, true);
  Found found{{}, {}, search.was_exact};
  for (std::size_t i = 0; i < search.vertices.size(); ++i) {
    const std::size_t row = t.row_of(search.vertices[i]);
    found.weights[row] = search.weights[i];
    const auto first = search.gradients.begin() + static_cast<std::ptrdiff_t>(i * q.size());
    found.gradients[row] = {first, first + static_cast<std::ptrdiff_t>(q.size())};
  }
  return found;
}

/// Whether they are within the bound of the exact ones, sum to 1, and reproduce q.
void expect_coordinates(const test::PointSet& set, const std::vector<double>& q, double bound) {
  const auto d = static_cast<std::size_t>(set.dimension);
  const Delaunay<> t(set.points, set.dimension);
  const Found found = find(t, q);
  const std::vector<Rational> exact = coordinates(set.points, d, q.data());
  double worst = 0, sum = 0;
  std::vector<double> reproduced(d, 0.0), scale(d, 0.0);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double weight = found.weights.count(i) != 0 ? found.weights.at(i) : 0;
    worst = std::max(worst, std::fabs(static_cast<double>(exact[i] - Rational(weight))));
    sum += weight;
    for (std::size_t j = 0; j < d; ++j) {
      reproduced[j] += weight * set.points[i * d + j];
      if (weight > 0) scale[j] += std::fabs(set.points[i * d + j] - q[j]);
    }
  }
  EXPECT_LE(worst, bound) << set.name;
  EXPECT_NEAR(sum, 1, 1e-15 * static_cast<double>(found.weights.size()));
  for (std::size_t j = 0; j < d; ++j) EXPECT_NEAR(reproduced[j], q[j], bound * scale[j] + 1e-14);
}

class NaturalSearchOfDimension : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, NaturalSearchOfDimension, ::testing::Range(1, 6));

// Few points of few digits, as rationals are slow: a simplex, so that the query is inside, and others.
TEST_P(NaturalSearchOfDimension, RandomPoints) {
  const int d = GetParam();
  if (d > 3 + static_cast<int>(test::scale())) GTEST_SKIP() << "volumes in rationals take too long";
  const int more[] = {0, 3, 7, 4, 2, 1};
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    test::Random random(seed);
    test::PointSet set{"random", d, {}};
    for (int corner = 0; corner <= d; ++corner)
      for (int j = 0; j < d; ++j)
        set.points.push_back((corner == j + 1 ? 32 * d : 0) + random.integer(-2, 2));
    for (int i = 0; i < more[d] * d; ++i) set.points.push_back(random.integer(4, 27));
    std::vector<double> q;
    for (int j = 0; j < d; ++j) q.push_back(random.integer(4, 27) + 0.25);
    ASSERT_EQ(Delaunay<>(set.points, d).num_duplicates(), 0u) << "the volumes would count them twice";
    ASSERT_EQ(Delaunay<>(set.points, d).locate(q).kind, Location::Kind::in_cell);
    expect_coordinates(set, q, 1e-14);
    if (d > 3) break;
  }
}

// Cubes of a lattice: all cells of a zone share one sphere.
TEST_P(NaturalSearchOfDimension, Lattice) {
  const int d = GetParam();
  if (d > 3) GTEST_SKIP() << "16 corners take too long in rationals";
  test::PointSet set = test::lattice(d, 2);
  for (const double x : {0.5, 0.25, 0x1p-30})
    expect_coordinates(set, std::vector<double>(static_cast<std::size_t>(d), x), 1e-13);
}

// Points of one sphere and its center, so that all cells of a zone may share centers; every order of the rows
// breaks ties in the same way, and so do reflections, up to rounding.
TEST_P(NaturalSearchOfDimension, CosphericalPoints) {
  const int d = GetParam();
  if (d == 1 || d > 3) GTEST_SKIP();
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const test::PointSet set = test::sampled(test::cospherical(d, d == 2 ? 25 : 9), d == 2 ? 9 : 8, seed);
    test::Random random(seed);
    for (int run = 0; run < 2; ++run) {
      std::vector<double> q;
      for (int j = 0; j < d; ++j) q.push_back(random.integer(-4, 4) / 4.0);
      if (Delaunay<>(set.points, d).locate(q).kind != Location::Kind::in_cell) continue;
      expect_coordinates(set, q, 1e-13);
      test::PointSet reflected = set;
      for (double& x : reflected.points) x = -x;
      std::vector<double> minus_q;
      for (const double x : q) minus_q.push_back(-x);
      const Found a = find(Delaunay<>(set.points, d), q), b = find(Delaunay<>(reflected.points, d), minus_q);
      for (std::size_t i = 0; i < set.size(); ++i)
        EXPECT_NEAR(a.weights.count(i) != 0 ? a.weights.at(i) : 0,
                    b.weights.count(i) != 0 ? b.weights.at(i) : 0, 1e-13);
    }
  }
}

// One unit in the last place off a lattice: slivers whose centers are far away, or anywhere within a region.
TEST_P(NaturalSearchOfDimension, NudgedLattice) {
  const int d = GetParam();
  if (d > 2) GTEST_SKIP() << "rationals of many digits";
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    test::PointSet set = test::lattice(d, 3);
    for (double& x : set.points) x += 1;  // without zeros, next to which are the smallest denormals
    set = test::nudged(set, seed);
    for (const double x : {1.5, 1.25, 1.0625}) {
      const std::vector<double> q(static_cast<std::size_t>(d), x);
      if (Delaunay<>(set.points, d).locate(q).kind == Location::Kind::in_cell)
        expect_coordinates(set, q, largest_natural_error(static_cast<std::size_t>(d)));
    }
  }
}

// A query within 1e-14 of the hull has a region 1e14 times as long as wide: only integers settle it.
TEST(NaturalSearch, NextToTheHullIntegersDecide) {
  const test::PointSet set = {"", 2, {0, 0, 4, 3, 1, 5, 2, 6, 3, 4, 0, 2}};
  const Delaunay<> t(set.points, 2);
  EXPECT_TRUE(find(t, {2, 1.5 + 0x1p-44}).was_exact);
  EXPECT_FALSE(find(t, {2, 2}).was_exact);
  for (const double above : {0x1p-1, 0x1p-10, 0x1p-20, 0x1p-44})
    expect_coordinates(set, {2, 1.5 + above}, 0x1p-36);
}

TEST(NaturalSearch, AtTheEndsOfTheRange) {
  const std::vector<double> points = {0, 0, 4, 0, 0, 4, 4, 5, 2, -1};
  const Found unscaled = find(Delaunay<>(points, 2), {1.5, 1});
  for (const double scale : {0x1p1000, 0x1p-1060, 0x1p-500, 0x1p510}) {
    std::vector<double> scaled = points;
    for (double& x : scaled) x *= scale;
    const Found found = find(Delaunay<>(scaled, 2), {1.5 * scale, scale});
    ASSERT_EQ(found.weights.size(), unscaled.weights.size());
    for (const auto& [row, weight] : unscaled.weights) {
      EXPECT_NEAR(found.weights.at(row), weight, 1e-14);
      for (std::size_t j = 0; j < 2 && scale > 0x1p-1000; ++j)
        EXPECT_NEAR(found.gradients.at(row)[j] * scale, unscaled.gradients.at(row)[j], 1e-14);
    }
  }
}

/// The coordinates on a face of the hull are those within the face.
TEST_P(NaturalSearchOfDimension, OnTheBoundaryThoseOfTheFace) {
  const int d = GetParam();
  if (d == 1 || d > 4) GTEST_SKIP();
  test::Random random(3);
  test::PointSet face{"face", d - 1, {}};
  for (int corner = 0; corner < d; ++corner)
    for (int j = 0; j + 1 < d; ++j) face.points.push_back((corner == j + 1 ? 30 : 0) + random.integer(0, 3));
  for (int i = 0; i < 3 * (d - 1); ++i) face.points.push_back(random.integer(4, 15));
  std::vector<double> q(static_cast<std::size_t>(d - 1), 6.25);
  ASSERT_EQ(Delaunay<>(face.points, d - 1).locate(q).kind, Location::Kind::in_cell);
  const std::vector<Rational> exact = coordinates(face.points, face.points.size() / face.size(), q.data());
  test::PointSet all = test::embedded(face, d, false, 1);
  const std::size_t n = all.size();
  const double level = all.points[static_cast<std::size_t>(d) - 1];
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < d; ++j) all.points.push_back(random.integer(0, 15) + (j == d - 1 ? level + 1 : 0));
  // embedded() shifts the other axes, too.
  for (int j = 0; j + 1 < d; ++j)
    q[static_cast<std::size_t>(j)] +=
        all.points[static_cast<std::size_t>(j)] - face.points[static_cast<std::size_t>(j)];
  q.push_back(level);
  const Found found = find(Delaunay<>(all.points, d), q);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_NEAR(found.weights.count(i) != 0 ? found.weights.at(i) : 0,
                i < n ? static_cast<double>(exact[i]) : 0.0, 1e-13);
  for (const auto& [row, gradient] : found.gradients) EXPECT_EQ(gradient.back(), 0);
}

// On an edge of a cube that is divided: linear between the two next points.
TEST(NaturalSearch, OnAnEdgeOfTheHullLinear) {
  const test::PointSet cube = test::lattice(3, 3);
  const Delaunay<> t(cube.points, 3);
  const Found found = find(t, {0, 2, 1.25});
  ASSERT_EQ(found.weights.size(), 2u);
  for (const auto& [row, weight] : found.weights) {
    EXPECT_DOUBLE_EQ(weight, cube.points[3 * row + 2] == 1 ? 0.75 : 0.25);
    EXPECT_NEAR(found.gradients.at(row)[2], cube.points[3 * row + 2] == 1 ? -1 : 1, 1e-15);
  }
}

TEST_P(NaturalSearchOfDimension, FlatPoints) {
  const int d = GetParam();
  if (d > 4) GTEST_SKIP();
  test::Random random(9);
  test::PointSet set{"flat", d, {}};
  for (int i = 0; i < 10 * d; ++i) set.points.push_back(random.integer(0, 63));
  std::vector<double> q(static_cast<std::size_t>(d), 30);
  const Delaunay<> plain(set.points, d);
  if (plain.locate(q).kind != Location::Kind::in_cell) GTEST_SKIP();
  // (x, x_0 + 1): not the same distances, but those of x ↦ (√2·x_0, …); so against the vector identity only.
  test::PointSet flat{"in a flat", d + 1, {}};
  for (std::size_t i = 0; i < set.size(); ++i) {
    const double* const p = set.points.data() + i * static_cast<std::size_t>(d);
    flat.points.insert(flat.points.end(), p, p + d);
    flat.points.push_back(p[0] + 1);
  }
  q.push_back(q[0] + 1);
  const Delaunay<> t(flat.points, d + 1);
  const Found found = find(t, q);
  for (std::size_t j = 0; j < q.size(); ++j) {
    double sum = 0;
    std::vector<double> jacobian(q.size(), 0.0);
    for (const auto& [row, weight] : found.weights) {
      const double x = flat.points[row * q.size() + j];
      sum += weight * x;
      for (std::size_t m = 0; m < q.size(); ++m) jacobian[m] += found.gradients.at(row)[m] * x;
    }
    EXPECT_NEAR(sum, q[j], 1e-12);
    // The projection on the flat: identity but for the plane of the first and last axis, with halves.
    for (std::size_t m = 0; m < q.size(); ++m) {
      const bool in_plane = (j == 0 || j + 1 == q.size()) && (m == 0 || m + 1 == q.size());
      EXPECT_NEAR(jacobian[m], in_plane ? 0.5 : j == m ? 1 : 0, 1e-11);
    }
  }
}

// Σ ∇λ = 0, Σ p ∇λᵀ = 1, and difference quotients.
TEST_P(NaturalSearchOfDimension, Gradients) {
  const int d = GetParam();
  const auto size = static_cast<std::size_t>(d);
  test::Random random(11);
  std::vector<double> points;
  for (int i = 0; i < 60 * d; ++i) points.push_back(random.real());
  const Delaunay<> t(points, d);
  const std::vector<double> q(size, 0.5);
  const Found found = find(t, q), unstored = find(t, q, false);
  EXPECT_EQ(found.weights, unstored.weights);
  for (std::size_t m = 0; m < size; ++m) {
    const double step = 1e-6;
    std::vector<double> before = q, after = q;
    before[m] -= step;
    after[m] += step;
    const Found a = find(t, before), b = find(t, after);
    double sum = 0;
    std::vector<double> moved(size, 0.0);
    for (const auto& [row, gradient] : found.gradients) {
      sum += gradient[m];
      for (std::size_t j = 0; j < size; ++j) moved[j] += gradient[m] * points[row * size + j];
      if (a.weights.count(row) == 0 || b.weights.count(row) == 0) continue;
      EXPECT_NEAR(gradient[m], (b.weights.at(row) - a.weights.at(row)) / (2 * step), 1e-4);
    }
    EXPECT_NEAR(sum, 0, 1e-11);
    for (std::size_t j = 0; j < size; ++j) EXPECT_NEAR(moved[j], j == m ? 1 : 0, 1e-11);
  }
}

// A rotated grid is full of slivers; few queries may need integers, and none may lose accuracy.
TEST(NaturalSearch, RotatedGrid) {
  for (const int d : {2, 3}) {
    test::PointSet set = test::lattice(d, d == 2 ? 20 : 8);
    for (std::size_t i = 0; i < set.size(); ++i) {
      double& x = set.points[i * static_cast<std::size_t>(d)];
      double& y = set.points[i * static_cast<std::size_t>(d) + 1];
      const double old = x, c = std::cos(0.55), s = std::sin(0.55);
      x = c * old - s * y;
      y = s * old + c * y;
      if (d == 3) {
        double& z = set.points[i * 3 + 2];
        const double old_y = y;
        y = c * old_y - s * z;
        z = s * old_y + c * z;
      }
    }
    const Delaunay<> t(set.points, d);
    const NaturalCenters centers(t, true);
    NaturalSearch search(centers);
    test::Random random(1);
    int exact = 0, all = 0;
    for (int run = 0; run < 600; ++run) {
      std::vector<double> q;
      const std::size_t at = static_cast<std::size_t>(random.integer(0, static_cast<int>(set.size()) - 1));
      for (int j = 0; j < d; ++j)
        q.push_back(set.points[at * static_cast<std::size_t>(d) + static_cast<std::size_t>(j)] +
                    random.real() - 0.5);
      const Location where = t.locate(q);
      if (where.kind != Location::Kind::in_cell && where.kind != Location::Kind::on_face) continue;
      search.find(q.data(), where.cell, false);
      ++all;
      exact += search.was_exact ? 1 : 0;
      for (int j = 0; j < d; ++j) {
        double sum = -q[static_cast<std::size_t>(j)];
        for (std::size_t i = 0; i < search.vertices.size(); ++i)
          sum += search.weights[i] * t.point(search.vertices[i])[static_cast<std::size_t>(j)];
        EXPECT_NEAR(sum, 0, 1e-12);
      }
    }
    EXPECT_GT(all, 300);
    EXPECT_LT(exact, all / 50);
  }
}

TEST(NaturalSearch, OnlyForDelaunay) {
  const std::vector<double> points = {0, 0, 4, 0, 0, 4};
  EXPECT_THROW(NaturalCenters(Regular<>(points, std::vector<double>{0, 1, 0}, 2), true), Error);
}

}  // namespace
}  // namespace delone::queries
