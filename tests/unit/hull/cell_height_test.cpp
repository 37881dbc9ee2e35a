// SPDX-License-Identifier: BSD-3-Clause
// Heights over and above cells against rationals: thin cells, numbers of any size, tolerances at the last
// bit.
#include "hull/cell_height.hpp"

#include "base/random.hpp"

#include <delone/lower_hull.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace delone::hull {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Rows = std::vector<std::vector<double>>;
using Limits = std::numeric_limits<double>;
using ::testing::ElementsAre;

/// The height of the plane through the points over q, by Gaussian elimination of [1 x | h]·w = [1 q | ?].
Rational exact_height(const Rows& points, const double* q) {
  const std::size_t n = points.size();
  std::vector<std::vector<Rational>> a;  // the rows of a composition axis, then the right side
  for (std::size_t r = 0; r < n; ++r) {
    a.emplace_back();
    for (const auto& p : points) a[r].push_back(r == 0 ? Rational(1) : Rational(p[r - 1]));
    a[r].push_back(r == 0 ? Rational(1) : Rational(q[r - 1]));
  }
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    while (a[pivot][s] == 0) ++pivot;
    std::swap(a[s], a[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == s) continue;
      const Rational factor = a[r][s] / a[s][s];
      for (std::size_t c = s; c <= n; ++c) a[r][c] -= factor * a[s][c];
    }
  }
  Rational height = 0;
  for (std::size_t i = 0; i < n; ++i) height += a[i][n] / a[i][i] * Rational(points[i][n - 1]);
  return height;
}

std::vector<double> flat(const Rows& rows) {
  std::vector<double> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

Rows points_of(const LowerHull<>& hull, const Rows& rows, std::size_t cell) {
  Rows result;
  const std::size_t corners = rows[0].size();
  for (const SignedIndex row : hull.cells().subspan(cell * corners, corners))
    result.push_back(rows[static_cast<std::size_t>(row)]);
  return result;
}

/// Compares the answers for a query with rationals. Returns whether it was in the domain.
bool expect_right(const LowerHull<>& hull, const Rows& rows, std::vector<double> q) {
  const double height = q.back(), over = hull.heights(std::span(q).first(q.size() - 1))[0];
  const std::optional<std::size_t> cell = hull.find_cell(std::span(q).first(q.size() - 1));
  if (!cell) return false;
  const Rows points = points_of(hull, rows, *cell);
  double low = points[0].back(), high = low;
  for (const auto& p : points) low = std::min(low, p.back()), high = std::max(high, p.back());
  const Rational plane = exact_height(points, q.data()), allowed(largest_height_error);
  EXPECT_LE(abs(Rational(over) - plane),
            allowed * (Rational(high) - Rational(low)) + Rational(std::fabs(over)) * Rational(0x1p-52));
  const Rational difference = Rational(height) - plane, size = abs(difference);
  const double above = hull.height_above(q)[0];
  EXPECT_LE(abs(Rational(above) - difference), allowed * size + Rational(Limits::denorm_min()));
  EXPECT_EQ(above > 0, difference > 0);
  EXPECT_EQ(above < 0, difference < 0);
  const double middle = std::fabs(above);
  for (const double t : {std::nextafter(middle, 0.0), middle, std::nextafter(middle, Limits::infinity())})
    EXPECT_EQ(hull.height_above(q, t)[0] == 0, size <= Rational(t)) << t;
  return true;
}

TEST(CellHeight, OfRoundedCollinearCompositions) {
  const Rows rows{{.6000000000000001, 1.7999999999999998, 0}, {.1, .3, 1}, {.4, 1.2, 8}};
  const LowerHull<> hull(flat(rows), 3);
  EXPECT_TRUE(expect_right(hull, rows, {.2720157217882437, .8160471653647309, 3}));
  EXPECT_NEAR(hull.heights(std::vector<double>{.2720157217882437, .8160471653647309})[0], 0.859, 0.001);
}

TEST(CellHeight, OfThinCells) {
  random::Generator random(3);
  int inside = 0;
  for (const std::size_t c : {1u, 2u, 3u, 4u})
    for (int round = 0; round < 12; ++round) {
      Rows rows(c + 4, std::vector<double>(c + 1));
      const double scale = std::ldexp(1.0, static_cast<int>(random.below(3)) * 500 - 500);
      for (auto& row : rows) {
        const double t = random.uniform(), s = random.uniform();
        for (std::size_t j = 0; j < c; ++j)
          row[j] =
              round % 3 == 0 ? random.uniform() : (0.1 + t * (1 + 0.3 * static_cast<double>(j)) + s) * scale;
        row[c] = (random.uniform() - 0.5) * (round % 2 == 0 ? 1 : scale);
      }
      const LowerHull<> hull(flat(rows), static_cast<int>(c) + 1);
      if (hull.composition_dimension() < static_cast<int>(c)) continue;
      for (int query = 0; query < 4; ++query) {
        std::vector<double> q(c + 1);
        const auto a = random.below(rows.size()), b = random.below(rows.size());
        for (std::size_t j = 0; j <= c; ++j) q[j] = (rows[a][j] + rows[b][j]) / 2;
        inside += expect_right(hull, rows, q);
      }
    }
  EXPECT_GT(inside, 60);
}

TEST(CellHeight, OfNumbersOfAnySize) {
  const double little = Limits::denorm_min(), most = Limits::max();
  const LowerHull<> narrow(std::vector<double>{little, -2, -little, 0}, 2);
  EXPECT_THAT(narrow.heights(std::vector<double>{little}), ElementsAre(-2));
  EXPECT_THAT(narrow.heights(std::vector<double>{0}), ElementsAre(-1));
  EXPECT_THAT(narrow.height_above(std::vector<double>{0, -1, 0, 1, little, -2}), ElementsAre(0, 2, 0));
  const LowerHull<> high(std::vector<double>{0, -most, 1, most}, 2);
  EXPECT_THAT(high.heights(std::vector<double>{0, 0.25, 0.5, 1}), ElementsAre(-most, -most / 2, 0, most));
  EXPECT_THAT(high.height_above(std::vector<double>{0, most, 0.5, 1}), ElementsAre(Limits::infinity(), 1));
  const LowerHull<> low(std::vector<double>{0, 0, 3, little}, 2);
  EXPECT_THAT(low.heights(std::vector<double>{1, 2}), ElementsAre(0, little));
  EXPECT_THAT(low.height_above(std::vector<double>{1, 0, 2, 0, 1, 1}), ElementsAre(-little, -little, 1));
  EXPECT_THAT(low.height_above(std::vector<double>{1, 0, 2, 0, 2, little, 2, 1}, little),
              ElementsAre(0, 0, 0, 1));
}

// On an edge, heights off it do not count.
TEST(CellHeight, OnFacesIsThatOfTheirVertices) {
  const Rows rows{{0, 0, -2}, {1, 0, -2}, {0.3, 0.9, 1e30}};
  const LowerHull<> hull(flat(rows), 3);
  EXPECT_THAT(hull.heights(std::vector<double>{0.7, 0, 0.3, 0.9}), ElementsAre(-2, 1e30));
}

TEST(CellHeight, TolerancesAreForTheExactHeight) {
  const double u = 0x1p-52;
  const Rows rows{{3 - 2 * u, 3 - 2 * u}, {1 - u / 2, 3 + 2 * u}, {1 + u, 3 + 2 * u}, {3 + 2 * u, 3 + 2 * u}};
  const LowerHull<> hull(flat(rows), 2);
  EXPECT_EQ(hull.height_above(rows[2], 1e-20)[0], 0);
  EXPECT_NEAR(hull.height_above(rows[2])[0], 1.48e-31, 0.01e-31);
  for (const auto& row : rows) expect_right(hull, rows, row);
}

TEST(HeightOfPlane, IsDecidedAtTheLastBit) {
  const std::vector<double> a{0, 0}, b{3, 3}, q{1, 0.75}, above{1, 1.25};
  const std::vector<const double*> line{a.data(), b.data()}, other{b.data(), a.data()};
  for (const auto& points : {line, other}) {
    const HeightOfPlane height(points, q.data(), 2), negative(points, above.data(), 2);
    EXPECT_FALSE(height.exceeds(0.25));
    EXPECT_TRUE(height.exceeds(std::nextafter(0.25, 0)));
    EXPECT_TRUE(height.exceeds(0));
    EXPECT_FALSE(negative.exceeds(0));
    EXPECT_FALSE(negative.magnitude_exceeds(0.25));
    EXPECT_TRUE(negative.magnitude_exceeds(std::nextafter(0.25, 0)));
    EXPECT_EQ(height.above(), 0.25);
    EXPECT_EQ(height.nearest(), 0.25);
    EXPECT_EQ(negative.nearest(), -0.25);
    EXPECT_EQ(negative.above(), 0);
  }
}

}  // namespace
}  // namespace delone::hull
