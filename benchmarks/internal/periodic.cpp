// SPDX-License-Identifier: BSD-3-Clause
// Periodic triangulations in space beside those of the same points alone, in microseconds of one thread per
// point: the open one, the periodic one without and with its arrays, the ratio without them; ghosts per
// point, rounds, and questions per point.
//
//   delone_benchmark_periodic                         the standard sets
//   delone_benchmark_periodic uniform 100000 [RUNS]   one set; the best of so many runs, 3 by default
#include "clocks.hpp"

#include "periodic/ghost_triangulation.hpp"
#include "periodic/quotient.hpp"

#include <delone/delaunay.hpp>
#include <delone/periodic.hpp>
#include <delone/point_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace {

/// The best of some runs, in seconds.
double best_of(int runs, const std::function<void()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const double start = benchmarks::thread_seconds();
    work();
    best = std::min(best, benchmarks::thread_seconds() - start);
  }
  return best;
}

void measure(const std::string& kind, std::size_t n, int runs) {
  std::vector<double> points = delone::make_point_set(kind, 3, n, 1);
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  const double least = *low, size = (*high - *low) * (1 + 1e-6);
  for (double& x : points) x = std::ldexp(std::floor(std::ldexp((x - least) / size, 48)), -48);
  const std::vector<double> lengths(3, 1.0);
  const delone::Lattice box = delone::Lattice::box(lengths);
  const double open = best_of(runs, [&] { delone::Delaunay<3>{points}; });
  delone::periodic::SetInput input;
  input.points = points;
  input.lattice = box.vectors;
  input.dimension = 3;
  const delone::periodic::PeriodicSet set = delone::periodic::make_periodic_set(input);
  delone::periodic::GhostEffort effort;
  const double periodic =
      best_of(runs, [&] { effort = delone::periodic::GhostTriangulation(set, {}).effort(); });
  const double making = best_of(runs, [&] { delone::periodic::make_periodic_set(input); });
  const delone::periodic::GhostTriangulation ghosts(set, {});
  const double arrays = best_of(runs, [&] {
    delone::periodic::make_quotient(ghosts, set, delone::periodic::CellClasses(ghosts, set));
  });
  const auto count = static_cast<double>(n);
  const double unit = 1e6 / count;
  std::printf("%-10s %8zu %8.2f %9.2f %12.2f %7.2f %8.3f %7zu %10.3f\n", kind.c_str(), n, open * unit,
              (making + periodic) * unit, (making + periodic + arrays) * unit, (making + periodic) / open,
              static_cast<double>(effort.num_ghosts) / count, effort.num_rounds,
              static_cast<double>(effort.questions) / count);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-10s %8s %8s %9s %12s %7s %8s %7s %10s\n", "set", "points", "open", "periodic", "with arrays",
              "ratio", "ghosts", "rounds", "questions");
  if (argc > 2) {
    measure(argv[1], static_cast<std::size_t>(std::atol(argv[2])), argc > 3 ? std::atoi(argv[3]) : 3);
    return 0;
  }
  for (const char* kind : {"uniform", "plummer"})
    for (const std::size_t n : {std::size_t{30}, std::size_t{100}, std::size_t{1000}, std::size_t{10000},
                                std::size_t{100000}, std::size_t{1000000}})
      measure(kind, n, n < 100000 ? 5 : 3);
}
