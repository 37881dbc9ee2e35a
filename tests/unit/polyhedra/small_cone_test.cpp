// SPDX-License-Identifier: BSD-3-Clause
// Small polyhedra by minors, against Polyhedron bit by bit: integers with ties, doubles, and doubles that
// nearly have ties. How many are decided is tested, too, because nothing else would show that it is quick.
#include "polyhedra/small_cone.hpp"

#include "base/random.hpp"
#include "polyhedra/fraction.hpp"

#include <delone/polyhedron.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

namespace delone::polyhedra {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Number = std::function<double(random::Generator&)>;

double small_integer(random::Generator& generator) { return static_cast<double>(generator.below(5)) - 2; }
double any_double(random::Generator& generator) {
  return static_cast<double>(generator.below(std::uint64_t{1} << 53)) * 0x1p-52 - 1;
}
/// Rows of few different numbers that are no small integers.
double decimal(random::Generator& generator) { return (static_cast<double>(generator.below(7)) - 3) * 0.1; }
double of_all_sizes(random::Generator& generator) {
  return std::ldexp(any_double(generator), static_cast<int>(generator.below(40)) - 20);
}
double of_all_exponents(random::Generator& generator) {
  return std::ldexp(any_double(generator), static_cast<int>(generator.below(1900)) - 950);
}

struct System {
  std::vector<double> matrix, bounds;

  RationalRows rows(std::size_t d) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      all.insert(all.end(), matrix.begin() + static_cast<std::ptrdiff_t>(i * d),
                 matrix.begin() + static_cast<std::ptrdiff_t>((i + 1) * d));
      all.push_back(bounds[i]);
    }
    return {std::span<const double>(all), d + 1};
  }
};

System random_system(random::Generator& generator, std::size_t m, std::size_t d, const Number& number) {
  System system;
  for (std::size_t i = 0; i < m * d; ++i) system.matrix.push_back(number(generator));
  for (std::size_t i = 0; i < m; ++i) system.bounds.push_back(std::abs(number(generator)));
  if (m > 0 && generator.below(4) == 0) system.bounds[0] = -system.bounds[0];
  if (m > 1 && generator.below(3) == 0) {  // a row twice, scaled
    for (std::size_t c = 0; c < d; ++c) system.matrix[c] = 4 * system.matrix[(m - 1) * d + c];
    system.bounds[0] = 4 * system.bounds[m - 1];
  }
  return system;
}

/// Whether it was for the small cone, after comparing what that has found.
bool agrees(const System& system, std::size_t d) {
  SmallCone cone;
  if (!cone.try_find(system.matrix, system.bounds, d)) return false;
  const Polyhedron expected = Polyhedron::from_inequalities(system.rows(d), {}, static_cast<int>(d));
  EXPECT_EQ(cone.vertices(), expected.vertices().to_doubles());
  for (const double x : cone.vertices()) EXPECT_FALSE(x == 0 && std::signbit(x));
  const RationalRows rays = expected.rays();
  EXPECT_EQ(cone.rays().size(), rays.size());
  for (std::size_t i = 0; i < std::min(rays.size(), cone.rays().size()); ++i)
    for (std::size_t c = 0; c < d; ++c) EXPECT_EQ(Fraction::to_rational(cone.rays()[i][c]), rays[i][c]);
  EXPECT_TRUE(expected.is_empty() || expected.affine_dimension() == static_cast<int>(d));
  EXPECT_EQ(expected.num_lines(), 0u);
  return true;
}

struct Family {
  const char* name;
  Number number;
  double decided;         ///< the least share
  std::size_t all_up_to;  ///< in so many dimensions
};

TEST(SmallCone, IsAsPolyhedron) {
  for (const auto& [name, number, decided, all_up_to] :
       {Family{"small integers", small_integer, 0.5, 6}, Family{"doubles", any_double, 0.95, 6},
        Family{"decimals", decimal, 0.5, 6}, Family{"sizes", of_all_sizes, 0.8, 4},
        Family{"exponents", of_all_exponents, 0, 6}})
    for (std::size_t d = 1; d <= SmallCone::most_dimensions; ++d) {
      SCOPED_TRACE(name + (" " + std::to_string(d)));
      random::Generator generator(d);
      const int rounds = d < 5 ? 40 : 12;
      int count = 0;
      for (int round = 0; round < rounds; ++round) {
        const std::size_t m = d + 2 + generator.below(d < 5 ? 9 : 5);
        count += agrees(random_system(generator, m, d, number), d) ? 1 : 0;
      }
      if (d <= all_up_to) {
        EXPECT_GE(count, decided * rounds);
      }
    }
}

TEST(SmallCone, FewRows) {
  random::Generator generator(1);
  for (std::size_t d = 1; d <= 3; ++d)
    for (std::size_t m = 0; m <= d + 1; ++m)
      for (int round = 0; round < 20; ++round) agrees(random_system(generator, m, d, small_integer), d);
}

/// Rows that meet in nearly one point: their determinants are far below the rounding errors of binary64.
TEST(SmallCone, NearlyDegenerate) {
  random::Generator generator(2);
  int count = 0;
  for (int round = 0; round < 200; ++round) {
    System system;
    for (int i = 0; i < 9; ++i) {
      double sum = 0;
      for (int c = 0; c < 3; ++c) {
        system.matrix.push_back(any_double(generator));
        sum += system.matrix.back() * 0.3;
      }
      system.bounds.push_back(generator.below(2) == 0 ? sum : std::nextafter(sum, 9));
    }
    count += agrees(system, 3) ? 1 : 0;
  }
  EXPECT_GE(count, 150);
}

TEST(SmallCone, OctahedronAndEmptyAndRay) {
  System octahedron;
  for (int corner = 0; corner < 8; ++corner) {
    for (int c = 0; c < 3; ++c) octahedron.matrix.push_back((corner >> c & 1) != 0 ? 1 : -1);
    octahedron.bounds.push_back(1);
  }
  EXPECT_TRUE(agrees(octahedron, 3));
  SmallCone cone;
  ASSERT_TRUE(cone.try_find(std::vector<double>{1, -1}, std::vector<double>{0, -1}, 1));
  EXPECT_THAT(cone.vertices(), IsEmpty());
  ASSERT_TRUE(cone.try_find(std::vector<double>{-3}, std::vector<double>{1}, 1));
  EXPECT_THAT(cone.vertices(), ElementsAre(-1.0 / 3));
  EXPECT_THAT(cone.rays(), ElementsAre(ElementsAre(1)));
}

TEST(SmallCone, SaysNo) {
  SmallCone cone;
  const std::vector<double> none, one{1}, two{1, 0};
  EXPECT_FALSE(cone.try_find(none, none, 2));                                             // all of space
  EXPECT_FALSE(cone.try_find(two, one, 2));                                               // has lines
  EXPECT_FALSE(cone.try_find(std::vector<double>{1, -1}, std::vector<double>{0, 0}, 1));  // one point
  EXPECT_FALSE(
      cone.try_find(std::vector<double>{1, 0x1p200, -1, -1}, std::vector<double>{1, 1}, 2));  // sizes
  EXPECT_FALSE(cone.try_find(std::vector<double>(7 * 7, 1), std::vector<double>(7, 1), 7));
  EXPECT_FALSE(cone.try_find(std::vector<double>(64, 1), std::vector<double>(64, 1), 1));
}

}  // namespace
}  // namespace delone::polyhedra
