// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/speed.hpp"

#include "base/platform.hpp"
#include "base/random.hpp"

#include <delone/delaunay.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace delone::cost_model {
namespace {

double measure_nanoseconds() {
  constexpr std::size_t num_points = 5000;
  constexpr int dimension = 3, runs = 3;
  random::Generator generator(1);
  std::vector<double> points(num_points * dimension);
  for (double& x : points) x = generator.uniform();
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const double start = platform::thread_seconds();
    const Delaunay<> triangulation(points, dimension);
    const double seconds = platform::thread_seconds() - start;
    least = std::min(least, 1e9 * seconds / static_cast<double>(triangulation.statistics().created_cells));
  }
  return least;
}

}  // namespace

double machine_nanoseconds() {
  static const double measured = measure_nanoseconds();
  return measured;
}

}  // namespace delone::cost_model
