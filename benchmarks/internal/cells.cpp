// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites: microseconds of processor time per site, for uniform points and clusters, beside those of
// the triangulation and of the diagram with its volumes.
//
// Counters: `triangulation`; `measures`, volumes, centroids and surfaces; `neighbors`, those with all lists;
// `proper`, with proper faces only; `diagram`, Voronoi and region_volumes(), for up to 10⁴ points.
#include "clocks.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/site_cells.hpp>
#include <delone/voronoi.hpp>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace delone;

template <class Work>
double microseconds_per_site(std::size_t n, Work work) {
  const double start = benchmarks::thread_seconds();
  benchmark::DoNotOptimize(work());
  return (benchmarks::thread_seconds() - start) / static_cast<double>(n) * 1e6;
}

void measure(benchmark::State& state, const std::string& kind, int d, std::size_t n) {
  const std::vector<double> points = make_point_set(kind, d, n, 1);
  const std::size_t sites = points.size() / static_cast<std::size_t>(d);
  for (auto _ : state) {
    static_cast<void>(_);
    const Delaunay<> t(points, d);
    const auto count = [&](const char* name, auto work) {
      double best = std::numeric_limits<double>::infinity();
      for (int round = 0; round < 3; ++round) best = std::min(best, microseconds_per_site(sites, work));
      state.counters[name] = best;
    };
    count("triangulation", [&] { return Delaunay<>(points, d); });
    count("measures", [&] { return site_cells(t); });
    count("neighbors", [&] { return site_cells(t, {.neighbors = true}); });
    count("proper", [&] { return site_cells(t, {.faces = CellFaces::proper, .neighbors = true}); });
    if (sites <= 10'000) count("diagram", [&] { return Voronoi<>(t).region_volumes(); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const int d : {2, 3, 4})
    for (const char* const kind : {"uniform", "clusters"})
      for (const std::size_t n : {10'000, 100'000}) {
        const std::string name = std::to_string(d) + "D/" + kind + "/" + std::to_string(n);
        benchmark::RegisterBenchmark(name.c_str(),
                                     [=](benchmark::State& state) { measure(state, kind, d, n); })
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
      }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
