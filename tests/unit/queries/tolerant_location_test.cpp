// SPDX-License-Identifier: BSD-3-Clause
// Location with a tolerance against the definition, in fractions: all cells and all their faces are tried.
#include "queries/tolerant_location.hpp"

#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/interpolation.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

namespace delone::queries {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Vector = std::vector<Rational>;
using Kind = Location::Kind;

Vector difference(const Vector& a, const Vector& b) {
  Vector result;
  for (std::size_t j = 0; j < a.size(); ++j) result.push_back(a[j] - b[j]);
  return result;
}
Rational dot(const Vector& a, const Vector& b) {
  Rational sum(0);
  for (std::size_t j = 0; j < a.size(); ++j) sum += a[j] * b[j];
  return sum;
}
Rational square(const Vector& a) { return dot(a, a); }
Vector exact(std::span<const double> x) { return {x.begin(), x.end()}; }

/// Solves A·y = b by elimination.
Vector solve(std::vector<Vector> a, Vector b) {
  const std::size_t n = b.size();
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t pivot = s;
    while (a[pivot][s] == 0) ++pivot;
    std::swap(a[pivot], a[s]);
    std::swap(b[pivot], b[s]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == s || a[r][s] == 0) continue;
      const Rational factor = a[r][s] / a[s][s];
      for (std::size_t c = s; c < n; ++c) a[r][c] -= factor * a[s][c];
      b[r] -= factor * b[s];
    }
  }
  for (std::size_t s = 0; s < n; ++s) b[s] /= a[s][s];
  return b;
}

/// The foot of x on the affine hull of points, as coordinates: those of all points but the first.
Vector foot(const std::vector<Vector>& points, const Vector& x) {
  std::vector<Vector> edges, gram;
  for (std::size_t i = 1; i < points.size(); ++i) edges.push_back(difference(points[i], points[0]));
  Vector right;
  for (const Vector& e : edges) {
    gram.emplace_back();
    for (const Vector& other : edges) gram.back().push_back(dot(e, other));
    right.push_back(dot(e, difference(x, points[0])));
  }
  return solve(gram, right);
}

Vector combination(const std::vector<Vector>& points, const Vector& y) {
  Vector result = points[0];
  for (std::size_t i = 1; i < points.size(); ++i)
    for (std::size_t j = 0; j < result.size(); ++j) result[j] += y[i - 1] * (points[i][j] - points[0][j]);
  return result;
}

/// The nearest point of a simplex: of the feet on all faces that contain theirs.
Vector nearest(const std::vector<Vector>& simplex, const Vector& x) {
  std::optional<Vector> best;
  for (unsigned set = 1; set < 1u << simplex.size(); ++set) {
    std::vector<Vector> face;
    for (std::size_t i = 0; i < simplex.size(); ++i)
      if ((set >> i & 1) != 0) face.push_back(simplex[i]);
    const Vector y = foot(face, x);
    Rational rest(1);
    bool is_inside = true;
    for (const Rational& w : y) {
      rest -= w;
      is_inside = is_inside && w >= 0;
    }
    if (!is_inside || rest < 0) continue;
    const Vector z = combination(face, y);
    if (!best || square(difference(z, x)) < square(difference(*best, x))) best = z;
  }
  return *best;
}

bool is_thick(const std::vector<Vector>& simplex, const Rational& tolerance) {
  for (std::size_t i = 0; i < simplex.size() && simplex.size() > 1; ++i) {
    std::vector<Vector> facet = simplex;
    facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
    const Vector z = combination(facet, foot(facet, simplex[i]));
    if (square(difference(z, simplex[i])) <= tolerance * tolerance) return false;
  }
  return true;
}

/// A lower bound on the squared distance of x from a simplex: that from its bounding box.
Rational box_distance(const std::vector<Vector>& simplex, const Vector& x) {
  Rational sum(0);
  for (std::size_t j = 0; j < x.size(); ++j) {
    Rational low = simplex[0][j], high = low;
    for (const Vector& p : simplex) {
      low = std::min(low, p[j]);
      high = std::max(high, p[j]);
    }
    const Rational off = x[j] < low    ? Rational(low - x[j])
                         : x[j] > high ? Rational(x[j] - high)
                                       : Rational(0);
    sum += off * off;
  }
  return sum;
}

struct Cell {
  CellId id;
  std::vector<Vector> points;
  bool thick;
};

/// What was seen, so that no test passes for want of cases.
struct Seen {
  int thick = 0, inside = 0, hull = 0, outside = 0, moved = 0, answered = 0;
};

Seen check(const Triangulation& t, const std::vector<double>& queries, double tolerance) {
  const Complex complex = t.complex();
  const auto d = static_cast<std::size_t>(t.dimension());
  const Rational radius = Rational(tolerance) * Rational(tolerance);
  std::vector<Cell> cells;
  for (const CellId c : complex.finite_cells()) {
    Cell cell{c, {}, false};
    for (const VertexId v : complex.vertices(c)) cell.points.push_back(exact(t.point(v)));
    cell.thick = is_thick(cell.points, tolerance);
    cells.push_back(std::move(cell));
  }
  const auto nearest_of = [&](const Vector& x, bool thick_only, std::optional<Rational> limit) {
    std::vector<Vector> best;  // all at the least distance
    for (const Cell& cell : cells) {
      if ((thick_only && !cell.thick) || (limit && box_distance(cell.points, x) > *limit)) continue;
      Vector z = nearest(cell.points, x);
      const Rational distance = square(difference(z, x));
      if (limit && distance > *limit) continue;
      if (!limit || distance < *limit) best.clear();
      limit = distance;
      best.push_back(std::move(z));
    }
    return best;
  };
  Seen seen;
  const PointLocator locator(t);
  std::vector<int> visits(queries.size() / d);
  locator.locate(queries, {.tolerance = tolerance}, [&](std::size_t query, const LocatedPoint& found) {
    ++visits[query];
    SCOPED_TRACE(query);
    const auto q = std::span(queries).subspan(query * d, d);
    const Vector x = exact(q);
    const Location where = t.locate(q);
    std::vector<Vector> expected{x};
    bool is_outside = false, must_be_thick = false;
    if (where.kind != Kind::on_vertex) {
      std::vector<Vector> thick = nearest_of(x, true, radius);
      if (!thick.empty()) {
        ++seen.thick;
        must_be_thick = true;
        expected = thick;
      } else if (!where.face.empty()) {
        ++seen.inside;
      } else {
        expected = nearest_of(x, false, {});
        is_outside = expected.empty() || square(difference(expected[0], x)) > radius;
        ++(is_outside ? seen.outside : seen.hull);
      }
    }
    ASSERT_EQ(found.barycentric.empty(), is_outside);
    if (is_outside) return;
    ASSERT_FALSE(complex.is_infinite(found.cell));
    ++seen.answered;
    const auto cell =
        std::find_if(cells.begin(), cells.end(), [&](const Cell& c) { return c.id == found.cell; });
    EXPECT_TRUE(!must_be_thick || cell->thick);
    Vector place(d);
    Rational sum(0);
    std::size_t positive = 0;
    for (std::size_t i = 0; i < found.barycentric.size(); ++i) {
      ASSERT_GE(found.barycentric[i], 0);
      if (found.barycentric[i] > 0) ++positive;
      sum += Rational(found.barycentric[i]);
      for (std::size_t j = 0; j < d; ++j) place[j] += Rational(found.barycentric[i]) * cell->points[i][j];
    }
    EXPECT_LT(boost::multiprecision::abs(sum - 1), Rational(1e-14));
    for (Rational& c : place) c /= sum;
    EXPECT_EQ(found.kind, positive == 1                          ? Kind::on_vertex
                          : positive == found.barycentric.size() ? Kind::in_cell
                                                                 : Kind::on_face);
    EXPECT_LE(found.distance, tolerance);
    // Where x' is not x, rounding of the weights may move it by some 1e-12 of the coordinates.
    const Rational slack(1e-11);
    Rational nearest_expected = square(difference(place, expected[0]));
    for (const Vector& z : expected)
      nearest_expected = std::min(nearest_expected, square(difference(place, z)));
    EXPECT_LT(nearest_expected, slack * slack);
    const Rational limit = Rational(found.distance) + Rational(1e-14);
    EXPECT_LE(square(difference(place, x)), found.distance == 0 ? slack * slack : Rational(limit * limit));
    if (where.kind == Kind::on_vertex) {
      EXPECT_EQ(place, x);
      EXPECT_EQ(found.distance, 0);
    }
    if (place != x) ++seen.moved;
  });
  for (const int count : visits) EXPECT_EQ(count, 1);
  return seen;
}

/// n points per axis, distance 1, turned.
std::vector<double> turned_grid(int d, int n, double angle) {
  std::vector<double> result;
  int total = 1;
  for (int j = 0; j < d; ++j) total *= n;
  for (int i = 0; i < total; ++i) {
    std::vector<double> x;
    for (int j = 0, rest = i; j < d; ++j, rest /= n) x.push_back(rest % n);
    for (int j = 0; j + 1 < d; ++j) {
      const double a = x[static_cast<std::size_t>(j)], b = x[static_cast<std::size_t>(j) + 1];
      x[static_cast<std::size_t>(j)] = std::cos(angle) * a - std::sin(angle) * b;
      x[static_cast<std::size_t>(j) + 1] = std::sin(angle) * a + std::cos(angle) * b;
    }
    result.insert(result.end(), x.begin(), x.end());
  }
  return result;
}

/// Midpoints and thirds of pairs of points, those points, and copies of all that are off by about `off`.
std::vector<double> queries_near(const std::vector<double>& points, int d, std::size_t count, double off,
                                 unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto width = static_cast<std::size_t>(d), n = points.size() / width;
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t a = random() % n, b = random() % n;
    const double share = static_cast<double>(random() % 4) / 3, size = i % 3 == 0   ? 0
                                                                       : i % 3 == 1 ? off
                                                                                    : 4 * off;
    for (std::size_t j = 0; j < width; ++j)
      result.push_back(points[a * width + j] + share * (points[b * width + j] - points[a * width + j]) +
                       size * normal(random));
  }
  return result;
}

/// Beyond, checking all cells with fractions takes too long.
int most_dimensions() { return static_cast<int>(test::scaled_size(4, 2)); }

TEST(TolerantLocation, TurnedGrids) {
  Seen all;
  for (const auto& [d, n] : {std::pair{2, 5}, {3, 3}, {4, 2}})
    for (const double angle : {0.0, 0.55})
      for (const double tolerance : {1e-12, 1e-3}) {
        if (d > most_dimensions()) continue;
        SCOPED_TRACE(testing::Message() << d << "D " << angle << " " << tolerance);
        const std::vector<double> points = turned_grid(d, n, angle);
        const Delaunay<> t(points, d);
        const Seen seen = check(t, queries_near(points, d, d == 4 ? 4 : 12, tolerance / 2, 3), tolerance);
        all.thick += seen.thick;
        all.outside += seen.outside;
        all.moved += seen.moved;
      }
  if (test::scale() == test::Scale::small)
    return;  // too few for all kinds, with every library's distributions
  EXPECT_GT(all.thick, 20);
  EXPECT_GT(all.outside, 0);
  EXPECT_GT(all.moved, 4);
}

TEST(TolerantLocation, ToleranceOfTheSizeOfCells) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  Seen all;
  for (int d = 1; d <= most_dimensions(); ++d)
    for (const double tolerance : {0.01, 0.05, 0.2, 0.7})
      for (const bool is_rounded : {false, true}) {
        SCOPED_TRACE(testing::Message() << d << "D " << tolerance);
        std::vector<double> points;
        for (int i = 0; i < (d == 4 ? 8 : 14) * d; ++i)
          points.push_back(is_rounded ? std::round(uniform(random) * 8) / 8 : uniform(random));
        const Delaunay<> t(points, d);
        const Seen seen = check(t, queries_near(points, d, d == 4 ? 2 : 10, tolerance / 2, 5), tolerance);
        all.thick += seen.thick;
        all.inside += seen.inside;
        all.hull += seen.hull;
        all.outside += seen.outside;
      }
  if (test::scale() == test::Scale::small) return;
  EXPECT_GT(all.thick, 20);
  EXPECT_GT(all.inside, 20);
  EXPECT_GT(all.hull, 5);
  EXPECT_GT(all.outside, 5);
}

// A locator that has seen a large ball keeps a list of the thick cells; a new one has none.
TEST(TolerantLocation, IsTheSameWithAListOfThickCells) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> points;
  for (int i = 0; i < 4000; ++i) points.push_back(uniform(random));
  points.insert(points.end(), {3.0, 0.5, 3.0, 1.5, 4.0, 0.5});  // some large cells
  const Delaunay<> t(points, 2);
  const PointLocator kept(t);
  int moved = 0;
  for (const double tolerance : {0.3, 0.9})
    for (int i = 0; i < 60; ++i) {
      const std::vector<double> query{uniform(random) * 5 - 0.5, uniform(random) * 2 - 0.5};
      const auto locate = [&](const PointLocator& locator) {
        std::tuple<CellId, Kind, double> answer;
        locator.locate(query, {.tolerance = tolerance}, [&](std::size_t, const LocatedPoint& found) {
          answer = {found.cell, found.kind, found.distance};
        });
        return answer;
      };
      const auto answer = locate(kept);
      EXPECT_EQ(answer, locate(PointLocator(t)));
      moved += std::get<double>(answer) > 0 ? 1 : 0;
    }
  EXPECT_GT(moved, 10);
}

TEST(TolerantLocation, FlatInput) {
  std::mt19937_64 random(9);
  Seen all;
  for (const double tolerance : {0.001, 0.3}) {
    std::vector<double> points;  // in the plane x + y + z = 0
    for (int i = 0; i < 25; ++i) {
      const auto a = static_cast<double>(random() % 9), b = static_cast<double>(random() % 9);
      points.insert(points.end(), {a, b, -a - b});
    }
    const Delaunay<> t(points, 3);
    ASSERT_EQ(t.affine_dimension(), 2);
    const Seen seen = check(t, queries_near(points, 3, 60, tolerance / 2, 6), tolerance);
    all.thick += seen.thick;
    all.outside += seen.outside;
  }
  EXPECT_GT(all.thick, 20);
  EXPECT_GT(all.outside, 10);
}

TEST(TolerantLocation, FiveAndSixDimensions) {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> uniform(0, 1);
  if (test::scale() == test::Scale::small) GTEST_SKIP() << "fractions take too long";
  for (int d = 5; d <= 6; ++d) {
    std::vector<double> points;
    for (int i = 0; i < (d + 2) * d; ++i) points.push_back(uniform(random));
    const Delaunay<> t(points, d);
    check(t, queries_near(points, d, 2, 0.05, 7), 0.1);
    const std::vector<double> cube = turned_grid(d, 2, 0.55);
    const auto part = static_cast<std::ptrdiff_t>(d * (d + 2));
    const Delaunay<> u(std::vector<double>(cube.begin(), cube.begin() + part), d);
    check(u, queries_near(cube, d, 1, 1e-10, 7), 1e-9);
  }
}

TEST(TolerantLocation, FewPoints) {
  const Delaunay<> none(2);
  EXPECT_EQ(check(none, {0, 0}, 1).outside, 1);
  const Delaunay<> one(std::vector<double>{1, 1}, 2);
  EXPECT_EQ(check(one, {1, 1, 1.5, 1, 3, 3, 1, 2}, 1).thick, 2);  // the first is the vertex
  const Delaunay<> two(std::vector<double>{0, 0, 4, 2}, 2);
  check(two, {1, 1, 2, 1, 0, 0, -0.5, 0, 5, 3, 4, 2.5}, 1);
}

TEST(TolerantLocation, AnyScale) {
  for (const double scale : {0x1p-990, 0x1p980}) {
    std::vector<double> points = turned_grid(2, 4, 0.5);
    for (double& x : points) x *= scale;
    const Delaunay<> t(points, 2);
    std::size_t answered = 0;
    PointLocator(t).locate(points, {.tolerance = 1e-9 * scale}, [&](std::size_t, const LocatedPoint& found) {
      if (found.kind == Kind::on_vertex && found.distance == 0) ++answered;
    });
    EXPECT_EQ(answered, points.size() / 2);
    std::vector<double> beside = points;
    for (double& x : beside) x += 3e-10 * scale;
    answered = 0;
    PointLocator(t).locate(beside, {.tolerance = 1e-9 * scale}, [&](std::size_t, const LocatedPoint& found) {
      if (!found.barycentric.empty() && found.distance <= 1e-9 * scale) ++answered;
    });
    EXPECT_EQ(answered, points.size() / 2);
  }
}

/// Rows decide between two points at the same distance.
TEST(TolerantLocation, TiesGoByRows) {
  // Two thick squares left and right, and a thin band between them with the query in its middle.
  const std::vector<double> left{0, 0, 0, 1, 1, 0, 1, 1}, right{1.5, 0, 1.5, 1, 2.5, 0, 2.5, 1};
  for (const bool is_left_first : {true, false}) {
    std::vector<double> points = is_left_first ? left : right;
    points.insert(points.end(), is_left_first ? right.begin() : left.begin(),
                  is_left_first ? right.end() : left.end());
    const Delaunay<> t(points, 2);
    PointLocator(t).locate(std::vector<double>{1.25, 0.5}, {.tolerance = 0.6},
                           [&](std::size_t, const LocatedPoint& found) {
                             double x = 0;
                             for (int i = 0; i < 3; ++i)
                               x += found.barycentric[static_cast<std::size_t>(i)] *
                                    t.point(t.complex().vertex(found.cell, i))[0];
                             EXPECT_EQ(x, is_left_first ? 1 : 1.5);
                             EXPECT_NEAR(found.distance, 0.25, 1e-12);
                           });
  }
}

/// The nearest point of the hull is the nearest of all cells.
TEST(TolerantLocation, Projection) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (int d = 1; d <= most_dimensions(); ++d)
    for (const int kind : {0, 1, 2}) {
      std::vector<double> points;
      for (int i = 0; i < (d == 4 ? 8 : 14) * d; ++i)
        points.push_back(kind == 1 ? static_cast<double>(random() % 3) : normal(random));
      if (kind == 2 && d == 2) points = turned_grid(2, 5, 0.55);
      if (kind == 2 && d == 3) points = turned_grid(3, 3, 0.55);
      const Delaunay<> t(points, d);
      std::vector<double> queries;
      for (int i = 0; i < (d == 4 ? 4 : 8) * d; ++i)
        queries.push_back(kind == 1 ? static_cast<double>(random() % 7) - 2 : 3 * normal(random));
      PointLocator(t).locate(queries, {.project = true}, [&](std::size_t query, const LocatedPoint& found) {
        SCOPED_TRACE(testing::Message() << d << "D " << kind << " query " << query);
        const auto width = static_cast<std::size_t>(d);
        const Vector x = exact(std::span(queries).subspan(query * width, width));
        ASSERT_EQ(found.barycentric.size(), width + 1);
        if (found.distance == 0) return;
        std::optional<Vector> best;
        for (const CellId c : t.complex().finite_cells()) {
          std::vector<Vector> cell;
          for (const VertexId v : t.complex().vertices(c)) cell.push_back(exact(t.point(v)));
          if (best && box_distance(cell, x) >= square(difference(*best, x))) continue;
          const Vector z = nearest(cell, x);
          if (!best || square(difference(z, x)) < square(difference(*best, x))) best = z;
        }
        Vector place(width);
        for (std::size_t i = 0; i <= width; ++i)
          for (std::size_t j = 0; j < width; ++j)
            place[j] += Rational(found.barycentric[i]) *
                        Rational(t.point(t.complex().vertex(found.cell, static_cast<int>(i)))[j]);
        EXPECT_LT(square(difference(place, *best)), Rational(1e-20));
      });
    }
}

/// All cells within a distance, and hardly any other.
TEST(TolerantLocation, CellsWithin) {
  std::mt19937_64 random(12);
  for (int d = 1; d <= 3; ++d) {
    std::vector<double> points;
    for (int i = 0; i < 16 * d; ++i) points.push_back(static_cast<double>(random() % 8));
    const Delaunay<> t(points, d);
    const std::vector<double> queries = queries_near(points, d, 5, 1, 8);
    for (const double radius : {0.0, 0.7, 2.0}) {
      std::vector<std::vector<CellId>> visited(5);
      PointLocator(t).cells_within(queries, radius, [&](std::size_t query, CellId c) {
        visited[query].push_back(c);
        return true;
      });
      for (std::size_t query = 0; query < visited.size(); ++query) {
        const auto width = static_cast<std::size_t>(d);
        const Vector x = exact(std::span(queries).subspan(query * width, width));
        for (const CellId c : t.complex().finite_cells()) {
          std::vector<Vector> cell;
          for (const VertexId v : t.complex().vertices(c)) cell.push_back(exact(t.point(v)));
          const Rational distance = square(difference(nearest(cell, x), x));
          const auto count = std::count(visited[query].begin(), visited[query].end(), c);
          EXPECT_LE(count, 1);
          EXPECT_TRUE(count == 1 || distance > Rational(radius) * Rational(radius));
          EXPECT_TRUE(count == 0 || distance < Rational(radius * radius + 1e-9));
        }
      }
      std::size_t first = 0;
      PointLocator(t).cells_within(queries, radius, [&](std::size_t, CellId) { return ++first == 0; });
      EXPECT_EQ(first, static_cast<std::size_t>(std::count_if(visited.begin(), visited.end(),
                                                              [](const auto& v) { return !v.empty(); })));
    }
  }
}

/// A linear function has its value at x', and its gradient.
TEST(TolerantLocation, InterpolationNearTheBoundary) {
  const std::vector<double> points = turned_grid(2, 12, 0.55);
  std::vector<double> values, border;
  for (std::size_t i = 0; i < points.size(); i += 2) values.push_back(3 * points[i] - points[i + 1]);
  for (int i = 0; i < 200; ++i) {
    const double a = 11 * i / 199.0;
    border.insert(border.end(), {std::cos(0.55) * a, std::sin(0.55) * a});
  }
  const Delaunay<> t(points, 2);
  const LinearInterpolator f(t, values);
  std::vector<double> result(200), slopes(400);
  f.evaluate(border, result, {.outside = Outside::error, .tolerance = 1e-9});
  f.gradients(border, slopes, {.tolerance = 1e-9});
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_NEAR(result[i], 3 * border[2 * i] - border[2 * i + 1], 1e-8);
    EXPECT_NEAR(slopes[2 * i], 3, 1e-11);
    EXPECT_NEAR(slopes[2 * i + 1], -1, 1e-11);
  }
  f.evaluate(points, std::span(result).first(144), {.tolerance = 1e-9});
  for (std::size_t i = 0; i < 144; ++i) EXPECT_EQ(result[i], values[i]);
  // Far outside a corner its value, beside an edge that of the foot.
  const Delaunay<> square(std::vector<double>{0, 0, 4, 0, 0, 4, 4, 4}, 2);
  const LinearInterpolator g(square, std::vector<double>{0, 4, 8, 12});
  const std::vector<double> outside{-3, -1, 1, -50, 7, 9, 5, 1.5};
  std::vector<double> four(4), eight(8);
  g.evaluate(outside, four, {.outside = Outside::project});
  EXPECT_EQ(four, (std::vector<double>{0, 1, 12, 7}));
  g.gradients(outside, eight, {.outside = Outside::project});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(eight[2 * i] + 10 * eight[2 * i + 1], 21, 1e-12);
  EXPECT_THROW(g.evaluate(outside, four, {.outside = Outside::error, .tolerance = 0.5}), Error);
  EXPECT_THROW(g.evaluate(outside, four, {.tolerance = -1}), Error);
}

TEST(TolerantLocation, BadTolerances) {
  const Delaunay<> t(std::vector<double>{0, 0, 1, 0, 0, 1}, 2);
  for (const double bad :
       {-1.0, std::nan(""), std::numeric_limits<double>::infinity(), std::nextafter(1.0, 2.0)}) {
    try {
      PointLocator(t).locate(std::vector<double>{0, 0}, {.tolerance = bad},
                             [](std::size_t, const LocatedPoint&) {});
      ADD_FAILURE() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::invalid_argument);
    }
  }
  const auto find = [](const Delaunay<>& points, double tolerance) {
    Location::Kind kind = Location::Kind::outside_hull;
    PointLocator(points).locate(std::vector<double>{0, 0}, {.tolerance = tolerance},
                                [&](std::size_t, const LocatedPoint& found) { kind = found.kind; });
    return kind;
  };
  EXPECT_EQ(find(t, 1), Location::Kind::on_vertex);
  std::vector<double> result(1);
  // Points without an extent have no bound.
  EXPECT_EQ(find(Delaunay<>(std::vector<double>{1, 1, 1, 1}, 2), 5), Location::Kind::on_vertex);
  EXPECT_THROW(LinearInterpolator(t, std::vector<double>{1, 2, 3})
                   .evaluate(std::vector<double>{0, 0}, result, {.tolerance = 2}),
               Error);
}

}  // namespace
}  // namespace delone::queries
