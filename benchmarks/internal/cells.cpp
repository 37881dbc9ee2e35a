// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites: microseconds of processor time per site, for uniform points and clusters, beside those of
// the triangulation and of the diagram with its volumes.
//
// Counters: `triangulation`; `measures`, volumes, centroids and surfaces; `neighbors`, those with all lists;
// `proper`, with proper faces only; `boxed`, all lists in a box around the points; `diagram`, Voronoi and
// region_volumes(), for up to 2·10⁴ points. In space, where Voro++ is installed, `voro`: its cells in that
// box, with volumes, centroids, neighbors, areas and edges of faces. It does without a triangulation.
#include "clocks.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/site_cells.hpp>
#include <delone/voronoi.hpp>

#include <benchmark/benchmark.h>
#ifdef DELONE_HAS_VORO
#include <voro++/voro++.hh>
#endif

#include <algorithm>
#include <cmath>
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

#ifdef DELONE_HAS_VORO
double voro(const std::vector<double>& points, const Box& box) {
  const std::size_t n = points.size() / 3;
  const int blocks = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(n) / 5)));
  voro::container container(box.low[0], box.high[0], box.low[1], box.high[1], box.low[2], box.high[2], blocks,
                            blocks, blocks, false, false, false, 8);
  for (std::size_t i = 0; i < n; ++i)
    container.put(static_cast<int>(i), points[3 * i], points[3 * i + 1], points[3 * i + 2]);
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  std::vector<int> neighbors, edges;
  std::vector<double> areas;
  double volume = 0, x = 0, y = 0, z = 0;
  if (!loop.start()) return volume;
  do {
    if (!container.compute_cell(cell, loop)) continue;
    volume += cell.volume();
    cell.centroid(x, y, z);
    cell.neighbors(neighbors);
    cell.face_areas(areas);
    cell.face_orders(edges);
  } while (loop.inc());
  return volume;
}
#endif

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
    const Box box = Voronoi<>(t, {.parts = DiagramParts::regions}).bounding_box(0.001);
    if (d <= 3) count("boxed", [&] { return site_cells(t, {.neighbors = true, .box = box}); });
#ifdef DELONE_HAS_VORO
    if (d == 3) count("voro", [&] { return voro(points, box); });
#endif
    if (sites <= 20'000) count("diagram", [&] { return Voronoi<>(t).region_volumes(); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  for (const int d : {2, 3, 4})
    for (const char* const kind : {"uniform", "clusters"})
      for (const std::size_t n : {20'000, 100'000}) {
        const std::string name = std::to_string(d) + "D/" + kind + "/" + std::to_string(n);
        benchmark::RegisterBenchmark(name.c_str(),
                                     [=](benchmark::State& state) { measure(state, kind, d, n); })
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
      }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
