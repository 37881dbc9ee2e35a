// SPDX-License-Identifier: BSD-3-Clause
// Periodic triangulations in space beside those of the same points alone, in microseconds of one thread per
// point: the open one, the periodic one without and with its arrays, the ratio without them; ghosts per
// point, rounds, and questions per point. And time steps, all points moved by a share of the mean distance
// of neighbors: the time of moved() over that of a new object, in turn; and of changed_neighbors().
//
//   delone_benchmark_periodic                         the standard sets
//   delone_benchmark_periodic uniform 100000 [RUNS]   one set; the best of so many runs, 3 by default
//   delone_benchmark_periodic steps uniform 100000 [RUNS]   its time steps
#include "clocks.hpp"

#include "periodic/ghost_triangulation.hpp"
#include "periodic/quotient.hpp"

#include <delone/delaunay.hpp>
#include <delone/neighbor_changes.hpp>
#include <delone/periodic.hpp>
#include <delone/point_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <optional>
#include <random>
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

double on_grid(double x) { return std::ldexp(std::floor(std::ldexp(x, 48)), -48); }

/// In the unit cube.
std::vector<double> point_set(const std::string& kind, std::size_t n) {
  std::vector<double> points = delone::make_point_set(kind, 3, n, 1);
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  const double least = *low, size = (*high - *low) * (1 + 1e-6);
  for (double& x : points) x = on_grid((x - least) / size);
  return points;
}

void measure(const std::string& kind, std::size_t n, int runs) {
  const std::vector<double> points = point_set(kind, n);
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

void measure_steps(const std::string& kind, std::size_t n, int runs) {
  const std::vector<double> points = point_set(kind, n);
  const delone::Lattice box = delone::Lattice::box(std::vector<double>(3, 1.0));
  const delone::PeriodicDelaunay<3> made(delone::PointsView(points, 3), box, {}, {.threads = 1});
  const double spacing = 0.554 / std::cbrt(static_cast<double>(n));
  std::printf("%-10s %8s %8s %10s %10s %8s %10s %8s\n", "set", "points", "step", "new", "moved", "ratio",
              "changes", "pairs");
  for (const double step : {0.0, 1e-4, 1e-3, 5e-3, 1e-2, 2e-2, 0.1, 1.0}) {
    std::mt19937_64 random(2);
    std::normal_distribution<double> component(0, step * spacing / std::sqrt(3.0));
    std::vector<double> next = points;
    for (double& x : next) x = on_grid(x + component(random));
    double fresh = std::numeric_limits<double>::infinity(), moved = fresh, compared = fresh;
    std::size_t num_pairs = 0;
    for (int run = 0; run < runs; ++run) {  // in turn
      fresh = std::min(fresh, best_of(1, [&] {
                         delone::PeriodicDelaunay<3>(delone::PointsView(next, 3), box, {}, {.threads = 1});
                       }));
      std::optional<delone::PeriodicDelaunay<3>> after;
      moved = std::min(moved, best_of(1, [&] { after = made.moved(delone::PointsView(next, 3)); }));
      compared = std::min(compared, best_of(1, [&] {
                            const delone::NeighborChanges changes = delone::changed_neighbors(made, *after);
                            num_pairs = changes.num_began() + changes.num_ended();
                          }));
    }
    const double unit = 1e6 / static_cast<double>(n);
    std::printf("%-10s %8zu %8g %10.3f %10.3f %8.2f %10.3f %8zu\n", kind.c_str(), n, step, fresh * unit,
                moved * unit, moved / fresh, compared * unit, num_pairs);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 3 && std::string(argv[1]) == "steps") {
    measure_steps(argv[2], static_cast<std::size_t>(std::atol(argv[3])), argc > 4 ? std::atoi(argv[4]) : 3);
    return 0;
  }
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
