// SPDX-License-Identifier: BSD-3-Clause
// Whatever the rounds and the number of threads, and wherever points are, the cells are those of one
// thread, and none of their vertices is said to be inside.
#include "hull/boundary.hpp"

#include "hull/hull_fan.hpp"
#include "hull_support.hpp"
#include "scale.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <numeric>
#include <string_view>
#include <vector>

namespace delone::hull {
namespace {

void expect_right(const char* generator, std::size_t n, std::vector<std::size_t> rounds) {
  SCOPED_TRACE(generator);
  const BoundarySites sites = sites_of(3, make_point_set(generator, 3, n, 1));
  const std::vector<Index> simplex{0, 1, 2, 3};
  std::vector<Index> others(n - 4);
  std::iota(others.begin(), others.end(), Index{4});
  const CentralView view = view_from_inside(sites, simplex);
  Boundary reference(sites, simplex, view);
  reference.insert_all(others, [](std::size_t) {});
  reference.prepare_for_threads(others);  // to be sorted
  for (const unsigned threads : {1u, 2u, 4u}) {
    Boundary made(sites, simplex, view);
    made.prepare_for_threads(others);
    std::size_t last = 0;
    made.insert_all(others, rounds, threads, [&](std::size_t done) {
      EXPECT_GE(done, last);
      last = done;
    });
    EXPECT_LE(last, others.size());
    EXPECT_EQ(made.hull().cells, reference.hull().cells);
    EXPECT_EQ(made.hull().neighbors, reference.hull().neighbors);
    for (const Index site : made.hull().cells) EXPECT_FALSE(made.is_surely_interior(site));
    std::size_t num_interior = 0;
    for (const Index site : others) num_interior += made.is_surely_interior(site);
    EXPECT_EQ(num_interior > 0, std::string_view(generator) != "sphere");
  }
}

TEST(Boundary, IsThatOfOneThread) {
  const std::size_t n = test::scaled_count(3000);
  expect_right("sphere", n, {});
  expect_right("sphere", n, {n / 8, n});
  expect_right("ball", n, {});
  expect_right("ball", n, {n / 8, n / 2, n + 10});
  expect_right("uniform", n, {n / 3});
}

}  // namespace
}  // namespace delone::hull
