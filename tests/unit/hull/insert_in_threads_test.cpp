// SPDX-License-Identifier: BSD-3-Clause
// Whatever the rounds and the number of threads, and wherever points are, each site is told of once, and the
// cells are those of one thread.
#include "hull/insert_in_threads.hpp"

#include "hull_support.hpp"
#include "scale.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace delone::internal {
namespace {

void expect_right(const char* generator, std::size_t n, std::vector<std::size_t> rounds) {
  SCOPED_TRACE(generator);
  const HullSites sites = sites_of(3, make_point_set(generator, 3, n, 1));
  const std::vector<Index> simplex{0, 1, 2, 3};
  std::vector<Index> others(n - 4);
  std::iota(others.begin(), others.end(), Index{4});
  ConvexHullBuilder reference(sites, simplex);
  std::vector<Insertion> outcomes(n);
  reference.insert_all(others, [](Index, Insertion) {});
  reference.prepare_for_threads(others);  // to be sorted
  for (const unsigned threads : {1u, 2u, 4u}) {
    ConvexHullBuilder made(sites, simplex);
    made.prepare_for_threads(others);
    std::vector<int> told(n, 0);
    std::size_t last = 0;
    insert_in_threads(
        made, others, rounds, threads,
        [&](std::size_t done) {
          EXPECT_GE(done, last);
          last = done;
        },
        [&](Index site, Insertion outcome) {
          ++told[site];
          outcomes[site] = outcome;
        });
    EXPECT_LE(last, others.size());
    for (const Index site : others) EXPECT_EQ(told[site], 1);
    EXPECT_EQ(made.hull().cells, reference.hull().cells);
    EXPECT_EQ(made.hull().neighbors, reference.hull().neighbors);
    for (const Index site : made.hull().cells)
      if (site >= 4) {
        EXPECT_EQ(outcomes[site], Insertion::vertex);
      }
  }
}

TEST(InsertInThreads, EverySiteHasItsOutcome) {
  const std::size_t n = test::scaled_count(3000);
  expect_right("sphere", n, {});
  expect_right("sphere", n, {n / 8, n});
  expect_right("ball", n, {});
  expect_right("ball", n, {n / 8, n / 2, n + 10});
  expect_right("uniform", n, {n / 3});
}

}  // namespace
}  // namespace delone::internal
