// SPDX-License-Identifier: BSD-3-Clause
// Which copies a ball may reach, against all that have an image in it.
#include "periodic/shifts_in_ball.hpp"

#include "made_set.hpp"
#include "periodic/images.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <set>
#include <span>
#include <vector>

namespace delone::periodic {
namespace {

using Shifts = std::set<std::vector<std::int32_t>>;

Shifts shifts_in(ShiftsInBall& in_ball, double part) {
  Shifts found;
  in_ball.each(part, [&](std::span<const std::int32_t> k) {
    EXPECT_TRUE(found.emplace(k.begin(), k.end()).second) << "each is visited once";
  });
  return found;
}

/// Whether a point of the set, translated by k, is nearer to the center than `squared`, the square of a
/// distance.
bool has_image_in_ball(const PeriodicSet& set, const std::vector<std::int32_t>& k,
                       const std::vector<double>& center, double squared) {
  for (std::size_t row = 0; row < set.num_points(); ++row) {
    std::vector<double> image(set.row(row), set.row(row) + set.dimension);
    set.period.translate(k, image.data());
    double distance = 0;
    for (std::size_t j = 0; j < set.dimension; ++j)
      distance += (image[j] - center[j]) * (image[j] - center[j]);
    if (distance < squared * (1 - 1e-9)) return true;
  }
  return false;
}

TEST(ShiftsInBall, AreAllThatHaveAnImageInIt) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::size_t num_visited = 0, num_needed = 0;
  for (int run = 0; run < 300; ++run) {
    const std::size_t d = 1 + run % 3, rank = 1 + run / 3 % d, n = 1 + run % 7;
    std::vector<double> points(n * d), lattice(rank * d);
    for (double& x : points) x = uniform(random);
    for (std::size_t i = 0; i < rank * d; ++i) lattice[i] = (i / d == i % d ? 1.5 : 0) + uniform(random) / 2;
    const PeriodicSet set = set_of(points, lattice, d);
    Images images(set);
    ShiftsInBall in_ball(set, images.extent());
    const double* const p = set.row(0);
    std::vector<double> center(p, p + d);
    for (double& x : center) x += uniform(random) * (run % 2 == 0 ? 0.3 : 1.5);
    in_ball.set_ball(p, center.data());
    for (const double part : {0.25, 1.0}) {
      std::vector<double> nearer(center);
      double squared = 0;
      for (std::size_t j = 0; j < d; ++j) {
        nearer[j] = p[j] + part * (center[j] - p[j]);
        squared += (nearer[j] - p[j]) * (nearer[j] - p[j]);
      }
      const Shifts visited = shifts_in(in_ball, part);
      num_visited += visited.size();
      std::vector<std::int32_t> low(rank), high(rank);
      for (std::size_t i = 0; i < rank; ++i) low[i] = -set.period.reach(i), high[i] = -low[i];
      std::vector<std::int32_t> k = low;
      do
        if (has_image_in_ball(set, k, nearer, squared)) {
          ++num_needed;
          EXPECT_TRUE(visited.count(k)) << "run " << run << ", part " << part;
        }
      while (next_in_range(k, low, high));
    }
  }
  EXPECT_GT(num_needed, 300u);
  EXPECT_LT(num_visited, 3 * num_needed) << "few are visited in vain";
}

TEST(ShiftsInBall, OfAHugeBallAreWithinTheReach) {
  const PeriodicSet set = set_of({0.25, 0.5, 0.75, 0.125}, {1, 0, 0.5, 1}, 2);
  Images images(set);
  ShiftsInBall in_ball(set, images.extent());
  const std::vector<double> center{1e9, 3e8};
  in_ball.set_ball(set.row(0), center.data());
  for (const double part : {1e-3, 1.0}) {
    const Shifts visited = shifts_in(in_ball, part);
    EXPECT_FALSE(visited.empty());
    for (const std::vector<std::int32_t>& k : visited)
      for (std::size_t i = 0; i < 2; ++i) EXPECT_LE(std::abs(k[i]), set.period.reach(i));
  }
}

}  // namespace
}  // namespace delone::periodic
