// SPDX-License-Identifier: BSD-3-Clause
// Operations against their definitions, point by point; volumes against known ones and sums of parts.
#include "polyhedra_support.hpp"
#include "scale.hpp"

#include <delone/convex_hull.hpp>
#include <delone/halfspaces.hpp>
#include <delone/polyhedron.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;
using Point = std::vector<Rational>;

/// Bounded or not, flat or not, sometimes empty.
Polyhedron random_polyhedron(random::Generator& generator, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  if (generator.coin())
    return Polyhedron::from_generators(random_rationals(generator, generator.below(6), d, 2),
                                       random_rationals(generator, generator.below(3), d, 2),
                                       random_rationals(generator, generator.below(5) / 4, d, 2), dimension);
  return Polyhedron::from_inequalities(random_rationals(generator, generator.below(8), d + 1, 3),
                                       random_rationals(generator, generator.below(5) / 4, d + 1, 3),
                                       dimension);
}

Point random_point(random::Generator& generator, std::size_t d) {
  const RationalRows row = random_rationals(generator, 1, d, 3);
  return {row[0].begin(), row[0].end()};
}

Point sum(const Point& a, const Point& b) {
  Point result;
  for (std::size_t i = 0; i < a.size(); ++i)
    result.push_back(as_rational(as_fraction(a[i]) + as_fraction(b[i])));
  return result;
}

Point mapped(const RationalRows& matrix, const Point& x, const Point& t) {
  Point result;
  for (std::size_t i = 0; i < matrix.size(); ++i)
    result.push_back(as_rational(value_at(matrix[i], x) + as_fraction(t[i])));
  return result;
}

/// A point of a polyhedron that is not empty: a mean of vertices plus rays and lines.
Point random_member(random::Generator& generator, const Polyhedron& p) {
  const RationalRows vertices = p.vertices(), rays = p.rays(), lines = p.lines();
  const auto d = static_cast<std::size_t>(p.dimension());
  brute_force::Vector x(d, 0);
  brute_force::Number total = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const int weight = static_cast<int>(generator.below(3)) + (i == 0 ? 1 : 0);
    total += weight;
    for (std::size_t c = 0; c < d; ++c) x[c] += weight * as_fraction(vertices[i][c]);
  }
  Point point;
  for (std::size_t c = 0; c < d; ++c) {
    x[c] /= total;
    for (std::size_t i = 0; i < rays.size(); ++i) x[c] += as_fraction(rays[i][c]) * static_cast<int>(i % 3);
    for (std::size_t i = 0; i < lines.size(); ++i) x[c] -= 2 * as_fraction(lines[i][c]);
    point.push_back(as_rational(x[c]));
  }
  return point;
}

TEST(PolyhedronOperations, IntersectionsAndInclusion) {
  random::Generator generator(21);
  const std::size_t rounds = test::scaled_count(200);
  int members = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    const int d = 1 + static_cast<int>(generator.below(3));
    const Polyhedron a = random_polyhedron(generator, d), b = random_polyhedron(generator, d),
                     both = a.intersection(b);
    EXPECT_EQ(both, b.intersection(a));
    EXPECT_TRUE(a.includes(both) && b.includes(both));
    EXPECT_EQ(a.includes(b), both == b);
    EXPECT_EQ(a.includes(b) && b.includes(a), a == b);
    for (int i = 0; i < 20; ++i) {
      const Point x = random_point(generator, static_cast<std::size_t>(d));
      EXPECT_EQ(both.contains(x), a.contains(x) && b.contains(x));
      members += both.contains(x);
    }
  }
  EXPECT_GT(members, static_cast<int>(rounds) / 10);
}

TEST(PolyhedronOperations, UnionsAndSums) {
  random::Generator generator(22);
  const std::size_t rounds = test::scaled_count(200);
  for (std::size_t round = 0; round < rounds; ++round) {
    const int d = 1 + static_cast<int>(generator.below(3));
    const Polyhedron a = random_polyhedron(generator, d), b = random_polyhedron(generator, d);
    const Polyhedron hull = a.convex_union(b), total = a.minkowski_sum(b);
    EXPECT_EQ(hull, b.convex_union(a));
    EXPECT_EQ(total, b.minkowski_sum(a));
    EXPECT_TRUE(hull.includes(a) && hull.includes(b));
    if (a.is_empty() || b.is_empty()) {
      EXPECT_TRUE(total.is_empty());
      continue;
    }
    EXPECT_TRUE(total.contains(sum(random_member(generator, a), random_member(generator, b))));
    // The support function of a sum is the sum of support functions, that of a union the larger of the two.
    const Point c = random_point(generator, static_cast<std::size_t>(d));
    const Optimum of_a = a.maximize(c), of_b = b.maximize(c), of_total = total.maximize(c),
                  of_hull = hull.maximize(c);
    if (of_a.state == Optimum::State::unbounded || of_b.state == Optimum::State::unbounded) {
      EXPECT_EQ(of_total.state, Optimum::State::unbounded);
      EXPECT_EQ(of_hull.state, Optimum::State::unbounded);
    } else {
      EXPECT_EQ(of_total.value, sum({of_a.value}, {of_b.value})[0]);
      EXPECT_EQ(of_hull.value, std::max(of_a.value, of_b.value));
    }
  }
}

TEST(PolyhedronOperations, Products) {
  random::Generator generator(23);
  const std::size_t rounds = test::scaled_count(100);
  for (std::size_t round = 0; round < rounds; ++round) {
    const int d = static_cast<int>(generator.below(3)), e = static_cast<int>(generator.below(3));
    const Polyhedron a = random_polyhedron(generator, d), b = random_polyhedron(generator, e),
                     both = a.product(b);
    // The same, by the way over all inequalities.
    EXPECT_EQ(both, Polyhedron::from_inequalities(both.inequalities(), both.equations(), d + e));
    EXPECT_EQ(both.inequalities(),
              Polyhedron::from_generators(both.vertices(), both.rays(), both.lines(), d + e).inequalities());
    std::vector<int> first, second;
    for (int i = 0; i < d; ++i) first.push_back(i);
    for (int i = d; i < d + e; ++i) second.push_back(i);
    if (a.is_empty() || b.is_empty()) {
      EXPECT_TRUE(both.is_empty());
      continue;
    }
    EXPECT_EQ(both.num_vertices(), a.num_vertices() * b.num_vertices());
    EXPECT_EQ(both.projection(first), a);
    EXPECT_EQ(both.projection(second), b);
  }
}

TEST(PolyhedronOperations, Polars) {
  random::Generator generator(24);
  const std::size_t rounds = test::scaled_count(150);
  for (std::size_t round = 0; round < rounds; ++round) {
    const int d = 1 + static_cast<int>(generator.below(3));
    const Polyhedron a = random_polyhedron(generator, d), polar = a.polar();
    // Twice is the closed hull with the origin, and three times the same as once.
    const Polyhedron origin =
        Polyhedron::from_generators({std::initializer_list<Rational>{}}, {}, {}, 0).image(RationalRows(), {});
    EXPECT_EQ(origin, Polyhedron::space(0));
    RationalRows zero;
    zero.push_back(Point(static_cast<std::size_t>(d)));
    EXPECT_EQ(polar.polar(), a.convex_union(Polyhedron::from_generators(zero, {}, {}, d)));
    EXPECT_EQ(polar.polar().polar(), polar);
    for (int i = 0; i < 10; ++i) {
      const Point y = random_point(generator, static_cast<std::size_t>(d));
      const Optimum most = a.maximize(y);
      EXPECT_EQ(polar.contains(y), most.state == Optimum::State::empty ||
                                       (most.state == Optimum::State::attained && most.value <= Rational(1)));
    }
  }
}

TEST(PolyhedronOperations, ImagesAndPreimages) {
  random::Generator generator(25);
  const std::size_t rounds = test::scaled_count(200);
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::size_t d = 1 + generator.below(3), e = 1 + generator.below(3);
    const Polyhedron a = random_polyhedron(generator, static_cast<int>(d));
    const RationalRows matrix = random_rationals(generator, e, d, 2),
                       other = random_rationals(generator, d, e, 2);
    const Point t = random_point(generator, e), s = random_point(generator, d);
    const Polyhedron image = a.image(matrix, t), preimage = a.preimage(other, static_cast<int>(e), s);
    EXPECT_EQ(image.is_empty(), a.is_empty());
    if (!a.is_empty()) {
      EXPECT_TRUE(image.contains(mapped(matrix, random_member(generator, a), t)));
    }
    for (int i = 0; i < 10; ++i) {
      const Point y = random_point(generator, e);
      EXPECT_EQ(preimage.contains(y), a.contains(mapped(other, y, s)));
      // y is an image iff the points that map to it meet the polyhedron.
      RationalRows fiber;
      for (std::size_t r = 0; r < e; ++r) {
        Point row(matrix[r].begin(), matrix[r].end());
        row.push_back(as_rational(as_fraction(y[r]) - as_fraction(t[r])));
        fiber.push_back(row);
      }
      const Polyhedron points = Polyhedron::from_inequalities({}, fiber, static_cast<int>(d));
      EXPECT_EQ(image.contains(y), !a.intersection(points).is_empty());
    }
  }
}

TEST(PolyhedronOperations, ProjectionsKeepAxesInOrder) {
  const Polyhedron box = Polyhedron::from_inequalities(
      {{-1, 0, 0, 0}, {1, 0, 0, 1}, {0, -1, 0, 0}, {0, 1, 0, 2}, {0, 0, -1, 0}, {0, 0, 1, 3}}, {}, 3);
  EXPECT_EQ(box.projection(std::vector<int>{2, 0}).vertices(),
            (RationalRows{{0, 0}, {0, 1}, {3, 0}, {3, 1}}));
  EXPECT_EQ(box.projection({}), Polyhedron::space(0));
  EXPECT_THROW(box.projection(std::vector<int>{3}), Error);
  EXPECT_THROW(box.projection(std::vector<int>{1, 1}), Error);
}

TEST(PolyhedronOperations, OptimaAreFaces) {
  random::Generator generator(26);
  const std::size_t rounds = test::scaled_count(200);
  int attained = 0, unbounded = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::size_t d = 1 + generator.below(3);
    const Polyhedron a = random_polyhedron(generator, static_cast<int>(d));
    const Point c = random_point(generator, d);
    const Optimum most = a.maximize(c);
    RationalRows row;
    row.push_back(sum(c, Point(d)));
    Point equation = c;
    equation.push_back(most.value);
    RationalRows equations;
    equations.push_back(equation);
    if (most.state == Optimum::State::attained) {
      ++attained;
      const Polyhedron face =
          a.intersection(Polyhedron::from_inequalities({}, equations, static_cast<int>(d)));
      RationalRows vertices, rays;
      for (const std::size_t v : most.vertices) vertices.push_back(a.vertices()[v]);
      for (const std::size_t r : most.rays) rays.push_back(a.rays()[r]);
      EXPECT_EQ(face, Polyhedron::from_generators(vertices, rays, a.lines(), static_cast<int>(d)));
      EXPECT_LE(Rational(as_rational(value_at(c, random_member(generator, a)))), most.value);
      EXPECT_GE(most.value,
                a.minimize(c).state == Optimum::State::attained ? a.minimize(c).value : most.value);
    } else if (most.state == Optimum::State::unbounded) {
      ++unbounded;
      equation.back() = 1000000;
      for (Rational& x : equation) x = as_rational(-as_fraction(x));
      RationalRows far;
      far.push_back(equation);
      EXPECT_FALSE(a.intersection(Polyhedron::from_inequalities(far, {}, static_cast<int>(d))).is_empty());
    } else {
      EXPECT_TRUE(a.is_empty());
    }
  }
  EXPECT_GT(attained, static_cast<int>(rounds) / 10);
  EXPECT_GT(unbounded, static_cast<int>(rounds) / 10);
}

TEST(PolyhedronOperations, Boxes) {
  const Polyhedron triangle =
      Polyhedron::from_generators({{Rational("-7/2"), 1}, {2, Rational("1/3")}, {0, 5}}, {}, {}, 2);
  const RationalBox exact = *triangle.bounding_box(), integer = *triangle.integer_bounding_box();
  EXPECT_THAT(exact.lower, ElementsAre(Rational("-7/2"), Rational("1/3")));
  EXPECT_THAT(exact.upper, ElementsAre(Rational(2), Rational(5)));
  EXPECT_THAT(integer.lower, ElementsAre(Rational(-4), Rational(0)));
  EXPECT_THAT(integer.upper, ElementsAre(Rational(2), Rational(5)));
  const RationalBox half = *Polyhedron::from_inequalities({{-2, 0, 1}}, {}, 2).integer_bounding_box();
  EXPECT_THAT(half.lower, ElementsAre(Rational(-1), std::nullopt));
  EXPECT_THAT(half.upper, ElementsAre(std::nullopt, std::nullopt));
  EXPECT_EQ(Polyhedron::empty(2).bounding_box(), std::nullopt);
}

TEST(PolyhedronOperations, KnownVolumes) {
  for (int d = 1; d <= 6; ++d) {
    EXPECT_EQ(unit_cube(d).volume(), Rational(1));
    std::int64_t factorial = 1;
    for (int i = 2; i <= d; ++i) factorial *= i;
    EXPECT_EQ(cube_around_origin(d).polar().volume(),
              Rational(Rational(std::int64_t{1} << d), Rational(factorial)));
  }
  EXPECT_EQ(Polyhedron::space(0).volume(), Rational(1));
  EXPECT_EQ(Polyhedron::empty(0).volume(), Rational(0));
  EXPECT_EQ(Polyhedron::space(2).volume(), std::nullopt);
  EXPECT_EQ(Polyhedron::from_generators({{0, 0}}, {{1, 1}}, {}, 2).volume(), Rational(0));
  // The permutahedron without its last coordinate: n^(n−2) parallelepipeds of the volume 1 (Stanley).
  const Polyhedron permutahedron = Polyhedron::from_generators(permutations(5), {}, {}, 5);
  EXPECT_EQ(permutahedron.volume(), Rational(0));
  EXPECT_EQ(permutahedron.projection(std::vector<int>{0, 1, 2, 3}).volume(), Rational(125));
}

TEST(PolyhedronOperations, VolumesAddUp) {
  random::Generator generator(27);
  const std::size_t rounds = test::scaled_count(100);
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::size_t d = 1 + generator.below(4);
    const int dimension = static_cast<int>(d);
    const Polyhedron whole =
        Polyhedron::from_generators(random_rationals(generator, 2 * d + 3, d, 2), {}, {}, dimension);
    Point row = random_point(generator, d + 1), opposite;
    for (const Rational& x : row) opposite.push_back(as_rational(-as_fraction(x)));
    RationalRows one, other;
    one.push_back(row);
    other.push_back(opposite);
    const Polyhedron left = whole.intersection(Polyhedron::from_inequalities(one, {}, dimension)),
                     right = whole.intersection(Polyhedron::from_inequalities(other, {}, dimension));
    if (std::all_of(row.begin(), row.end() - 1, [](const Rational& x) { return x == Rational(); })) continue;
    EXPECT_EQ(as_fraction(*left.volume()) + as_fraction(*right.volume()), as_fraction(*whole.volume()));
    // A matrix multiplies it by its determinant: here that of a shear with a stretch.
    RationalRows matrix;
    for (std::size_t i = 0; i < d; ++i) {
      Point entries(d);
      for (std::size_t c = 0; c < i; ++c) entries[c] = static_cast<int>(c) - 3;
      entries[i] = i == 0 ? Rational("-2/3") : Rational(1);
      matrix.push_back(entries);
    }
    EXPECT_EQ(as_fraction(*whole.image(matrix).volume()) * 3, as_fraction(*whole.volume()) * 2);
  }
}

/// Full, flat, unbounded and empty intersections, and hulls that are flat or have more than extreme points.
TEST(Polyhedron, OfIntersectionsAndHulls) {
  const std::vector<double> flat{1, 0,  0, -1, -1, 0, 0, -1, 0, 1, 0,  -1,
                                 0, -1, 0, -1, 0,  0, 1, 0,  0, 0, -1, 0};
  const HalfspaceIntersection<> square(flat, 3);
  EXPECT_EQ(square.state(), IntersectionState::flat);
  const Polyhedron found = to_polyhedron(square.to_data());
  EXPECT_EQ(found, cube_around_origin(2).product(Polyhedron::from_generators({{0}}, {}, {}, 1)));
  EXPECT_EQ(found.row_kinds().back(), RowKind::implicit);

  const HalfspaceIntersection<> slab(std::vector<double>{0.5, 0, -1, -1, 0, 0}, 2);  // 0 ≤ x ≤ 2
  EXPECT_EQ(to_polyhedron(slab.to_data()), Polyhedron::from_inequalities({{1, 0, 2}, {-1, 0, 0}}, {}, 2));
  const HalfspaceIntersection<> none(std::vector<double>{1, 1, -1, 1}, 1);
  EXPECT_TRUE(to_polyhedron(none.to_data()).is_empty());
  EXPECT_EQ(test::code_of([&] { to_polyhedron(square.data()); }), Errc::invalid_argument);

  const std::vector<double> points{0, 0, 1, 0, 0.5, 0, 0, 1, 1, 1, 0, 1};
  const ConvexHull<> hull(points, 2), segment(std::vector<double>{0, 0, 2, 2, 1, 1}, 2);
  EXPECT_EQ(to_polyhedron(hull.to_data()), unit_cube(2));
  EXPECT_EQ(to_polyhedron(segment.to_data()), Polyhedron::from_generators({{0, 0}, {2, 2}}, {}, {}, 2));
  EXPECT_EQ(test::code_of([&] { to_polyhedron(hull.data()); }), Errc::invalid_argument);
}

/// Boxes of integers, flat ones and equal ones among them, against the unit cubes that they consist of.
TEST(Polyhedron, UnionsOfBoxes) {
  random::Generator generator(17);
  constexpr std::size_t size = 4;
  const std::size_t rounds = test::scaled_count(40);
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::size_t d = 1 + generator.below(3), count = generator.below(7);
    std::size_t num_cubes = 1;
    for (std::size_t c = 0; c < d; ++c) num_cubes *= size;
    std::vector<Polyhedron> boxes;
    std::vector<std::size_t> members_of(num_cubes, 0);  // a bit for each box
    for (std::size_t i = 0; i < count; ++i) {
      Polyhedron box = Polyhedron::space(0);
      std::vector<std::size_t> low(d), high(d);
      for (std::size_t c = 0; c < d; ++c) {
        low[c] = generator.below(size + 1);
        high[c] = low[c] + generator.below(size + 1 - low[c]);
        box = box.product(Polyhedron::from_generators(
            {{static_cast<std::int64_t>(low[c])}, {static_cast<std::int64_t>(high[c])}}, {}, {}, 1));
      }
      boxes.push_back(box);
      for (std::size_t cube = 0; cube < num_cubes; ++cube) {
        bool is_in = true;
        for (std::size_t c = 0, rest = cube; c < d; ++c, rest /= size)
          is_in = is_in && low[c] <= rest % size && rest % size < high[c];
        if (is_in) members_of[cube] |= std::size_t{1} << i;
      }
    }
    const auto with_all_of = [&](std::size_t set) {
      return std::count_if(members_of.begin(), members_of.end(),
                           [&](std::size_t members) { return (members & set) == set; });
    };
    const std::size_t in_any =
        num_cubes - static_cast<std::size_t>(std::count(members_of.begin(), members_of.end(), 0u));
    EXPECT_EQ(union_volume(boxes), Rational(static_cast<std::int64_t>(in_any)));
    std::size_t found = 0;
    for (const auto& [members, polyhedron] : intersections(boxes)) {
      std::size_t set = 0;
      for (const std::size_t member : members) set |= std::size_t{1} << member;
      EXPECT_EQ(polyhedron.volume(), Rational(static_cast<std::int64_t>(with_all_of(set))));
      ++found;
    }
    std::size_t expected = 0;
    for (std::size_t set = 0; set < std::size_t{1} << count; ++set)
      if (std::popcount(set) > 1 && with_all_of(set) > 0) ++expected;
    EXPECT_EQ(found, expected);
    for (const auto& part : intersections(boxes, 2)) EXPECT_EQ(part.members.size(), 2u);
  }
}

TEST(Polyhedron, UnionsOfFewAndOfUnboundedSets) {
  const Polyhedron quadrant = Polyhedron::from_generators({}, {{1, 0}, {0, 1}}, {}, 2);
  const Polyhedron ray = Polyhedron::from_generators({}, {{1, 0}}, {}, 2);
  EXPECT_EQ(union_volume({}), Rational(0));
  EXPECT_EQ(union_volume(std::vector{unit_cube(2), ray}), Rational(1));
  EXPECT_EQ(union_volume(std::vector{unit_cube(2), quadrant}), std::nullopt);
  const auto parts = intersections(std::vector{quadrant, ray, unit_cube(2)});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_THAT(parts[0].members, ElementsAre(0, 2));
  EXPECT_EQ(parts[0].polyhedron, unit_cube(2));
  const std::vector different{unit_cube(2), unit_cube(3)};
  EXPECT_EQ(test::code_of([&] { union_volume(different); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { intersections(different); }), Errc::bad_dimension);
  // A hundred nested ones: each is left out at once.
  std::vector<Polyhedron> nested;
  for (int i = 1; i <= 100; ++i) nested.push_back(Polyhedron::from_generators({{0}, {i}}, {}, {}, 1));
  EXPECT_EQ(union_volume(nested), Rational(100));
  EXPECT_EQ(test::code_of([&] { union_volume(nested, {.progress = [](double) { return false; }}); }),
            Errc::cancelled);
}

}  // namespace
}  // namespace delone::polyhedra
