// SPDX-License-Identifier: BSD-3-Clause
// Rays and lines of cones against all sets of rows, in fractions, with all kinds of integers.
#include "polyhedra/cone.hpp"

#include "cone_support.hpp"
#include "polyhedra/double_description.hpp"
#include "polyhedra/ray_numbers.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace delone::polyhedra {
namespace {

void expect_cone(const Rows& rows, const Rows& equations, std::size_t n) {
  const ConeRays found = find_rays(rows, equations, n);
  const brute_force::Cone expected = brute_force::find_cone(as_fractions(rows), as_fractions(equations), n);
  ASSERT_EQ(found.lines.size(), expected.lines.size());
  for (const Row& line : found.lines)
    for (const Rows* some : {&rows, &equations})
      for (const Row& row : *some) EXPECT_EQ(scalar_product(row, line), 0);
  EXPECT_EQ(Echelon(n, found.lines).rank(), found.lines.size());
  std::set<brute_force::Vector> rays;
  for (const brute_force::Vector& ray : as_fractions(found.rays))
    EXPECT_TRUE(rays.insert(brute_force::normal_form(ray, expected.lines)).second);
  EXPECT_EQ(rays, expected.rays);
  ASSERT_EQ(found.zeros.size(), found.rays.size());
  for (std::size_t ray = 0; ray < found.rays.size(); ++ray)
    for (std::size_t row = 0; row < rows.size(); ++row)
      EXPECT_EQ(test(found.zeros[ray], row), scalar_product(rows[row], found.rays[ray]) == 0);
}

TEST(Cone, AgreesWithAllSetsOfRows) {
  random::Generator generator(7);
  const int rounds = static_cast<int>(test::scaled_count(400));
  for (int round = 0; round < rounds; ++round) {
    const std::size_t n = 1 + generator.below(5);
    const Integer largest = Integer(1) << std::vector<int>{1, 2, 3, 16, 40, 90, 250}[generator.below(7)];
    const Rows rows = random_rows(generator, generator.below(9), n, largest);
    const Rows equations = random_rows(generator, generator.below(4) / 2, n, largest);
    expect_cone(rows, equations, n);
  }
}

TEST(Cone, ConesWithAndWithoutRays) {
  expect_cone({}, {}, 0);
  expect_cone({}, {}, 3);                                   // all of space
  expect_cone({{0, 0}}, {{0, 0}}, 2);                       // conditions that are none
  expect_cone({{1, 0}, {-1, 0}}, {}, 2);                    // a line
  expect_cone({{1, 0}, {-1, 0}, {0, 1}, {0, -1}}, {}, 2);   // the origin
  expect_cone({{1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {}, 3);  // a line, implied
  expect_cone({{1, 0, 0}, {2, 0, 0}, {1, 0, 0}}, {}, 3);    // copies
  expect_cone({{1, 0, 1}, {-1, 0, 1}, {0, 1, 1}, {0, -1, 1}}, {{0, 0, 1}}, 3);
}

/// The moment curve: numbers that grow beyond 64 and 128 bits while rays are made.
Rows moment_rows(std::size_t n, std::size_t d, std::int64_t step) {
  Rows rows;
  for (std::size_t i = 0; i < n; ++i) {
    Row row{1};
    for (std::size_t c = 1; c < d; ++c)
      row.push_back(row.back() * step * (static_cast<std::int64_t>(i) + 1) - 7);
    rows.push_back(row);
  }
  return rows;
}

TEST(Cone, StepsAreRepeatedWithLargerNumbers) {
  for (const std::int64_t step : {std::int64_t{1}, std::int64_t{1000}, std::int64_t{10'000'000}})
    for (const std::size_t d : {std::size_t{4}, std::size_t{5}}) {
      const Rows rows = moment_rows(11, d, step);
      expect_cone(rows, {}, d);
    }
}

TEST(Cone, AllKindsOfIntegersFindTheSame) {
  for (const std::int64_t step : {1, 300}) {
    PointedCone cone;
    cone.rows = moment_rows(20, 6, step);
    for (std::size_t i = 0; i < 6; ++i) {
      Rows others;
      for (std::size_t j = 0; j < 6; ++j)
        if (j != i) others.push_back(cone.rows[j]);
      Row ray = Echelon(6, others).kernel().front();
      if (scalar_product(ray, cone.rows[i]) < 0)
        for (Integer& x : ray) x = -x;
      cone.first_rays.push_back(ray);
    }
    std::set<Row> rays[3];
    for (const Tier tier : {Tier::small, Tier::medium, Tier::large}) {
      const PointedRays found = find_rays_by_steps(cone, 1, tier);
      rays[static_cast<int>(tier)] = {found.rays.begin(), found.rays.end()};
      EXPECT_EQ(rays[static_cast<int>(tier)].size(), 272u)
          << step;  // facets of a cyclic polytope, 2·(17 choose 2)
    }
    EXPECT_EQ(rays[0], rays[1]);
    EXPECT_EQ(rays[0], rays[2]);
  }
}

TEST(Cone, TheSameForEveryNumberOfThreads) {
  random::Generator generator(9);
  for (const int largest : {1, 1000, 1000000000}) {
    Rows rows;
    const std::size_t d = largest == 1 ? 10 : 7;
    while (rows.size() < 60) {
      Row row{1};
      while (row.size() < d) row.push_back(random_integer(generator, largest));
      rows.push_back(row);
    }
    const ConeRays one = find_rays(rows, {}, d, 1), three = find_rays(rows, {}, d, 3);
    EXPECT_GT(one.rays.size(), 1000u);
    EXPECT_EQ(one.rays, three.rays);
    ASSERT_EQ(one.zeros.size(), three.zeros.size());
    for (std::size_t ray = 0; ray < one.zeros.size(); ++ray)
      for (std::size_t row = 0; row < rows.size(); ++row)
        ASSERT_EQ(test(one.zeros[ray], row), test(three.zeros[ray], row));
  }
}

}  // namespace
}  // namespace delone::polyhedra
