// SPDX-License-Identifier: BSD-3-Clause
// Periodic boxes in space: the triangulation and the complete pass over all cells (neighbors with offsets,
// areas, volumes, centroids) of delone, the cells of Voro++ with the same numbers, and the triangulation of
// CGAL, in microseconds of one thread per point; the ratios to delone's sum; and how far the volumes of
// delone and Voro++ are apart.
//
//   periodic_boxes                          the standard sets
//   periodic_boxes uniform 100000 [RUNS]    one set; the best of so many runs, 2 by default
#include <delone/periodic.hpp>
#include <delone/point_sets.hpp>
#include <delone/site_cells.hpp>

#ifdef DELONE_HAS_VORO
#include <voro++/voro++.hh>
#endif
#ifdef DELONE_HAS_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Periodic_3_Delaunay_triangulation_3.h>
#include <CGAL/Periodic_3_Delaunay_triangulation_traits_3.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double best_of(int runs, const std::function<void()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    const double start = thread_seconds();
    work();
    best = std::min(best, thread_seconds() - start);
  }
  return best;
}

/// The cells of Voro++, with what the pass has. Returns their volumes.
std::vector<double> voro_cells([[maybe_unused]] const std::vector<double>& points) {
  std::vector<double> volumes;
#ifdef DELONE_HAS_VORO
  const std::size_t n = points.size() / 3;
  volumes.resize(n);
  const int blocks = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(n) / 5)));
  voro::container container(0, 1, 0, 1, 0, 1, blocks, blocks, blocks, true, true, true, 8);
  for (std::size_t i = 0; i < n; ++i)
    container.put(static_cast<int>(i), points[3 * i], points[3 * i + 1], points[3 * i + 2]);
  voro::c_loop_all loop(container);
  voro::voronoicell_neighbor cell;
  std::vector<int> neighbors, edges;
  std::vector<double> areas;
  if (loop.start()) do
      if (container.compute_cell(cell, loop)) {
        double x, y, z;
        volumes[static_cast<std::size_t>(loop.pid())] = cell.volume();
        cell.centroid(x, y, z);
        cell.neighbors(neighbors);
        cell.face_areas(areas);
        cell.face_orders(edges);
      }
    while (loop.inc());
#endif
  return volumes;
}

void cgal_triangulation([[maybe_unused]] const std::vector<double>& points) {
#ifdef DELONE_HAS_CGAL
  using Traits =
      CGAL::Periodic_3_Delaunay_triangulation_traits_3<CGAL::Exact_predicates_inexact_constructions_kernel>;
  using Triangulation = CGAL::Periodic_3_Delaunay_triangulation_3<Traits>;
  std::vector<Triangulation::Point> of_cgal;
  for (std::size_t at = 0; at < points.size(); at += 3)
    of_cgal.emplace_back(points[at], points[at + 1], points[at + 2]);
  Triangulation triangulation(Triangulation::Iso_cuboid(0, 0, 0, 1, 1, 1));
  triangulation.insert(of_cgal.begin(), of_cgal.end(), of_cgal.size() > 1000);
#endif
}

void measure(const std::string& kind, std::size_t n, int runs) {
  std::vector<double> points = delone::make_point_set(kind, 3, n, 1);
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  const double least = *low, size = (*high - *low) * (1 + 1e-6);
  for (double& x : points) x = std::ldexp(std::floor(std::ldexp((x - least) / size, 48)), -48);
  const std::vector<double> lengths(3, 1.0);
  const delone::Lattice box = delone::Lattice::box(lengths);
  const delone::PointsView view(points, 3);
  const double unit = 1e6 / static_cast<double>(n);
  const double triangulation = unit * best_of(runs, [&] { delone::PeriodicDelaunay<3>(view, box); });
  const delone::PeriodicDelaunay<3> made(view, box);
  delone::SiteCells cells;
  const double pass =
      unit * best_of(runs, [&] { cells = delone::site_cells(made, {.neighbors = true}, {.threads = 1}); });
  double voro = none, cgal = none, apart = none;
#ifdef DELONE_HAS_VORO
  std::vector<double> volumes;
  voro = unit * best_of(runs, [&] { volumes = voro_cells(points); });
  apart = 0;
  for (std::size_t i = 0; i < n; ++i)
    apart = std::max(apart, std::abs(volumes[i] - cells.volumes[i]) * static_cast<double>(n));
#endif
#ifdef DELONE_HAS_CGAL
  cgal = unit * best_of(runs, [&] { cgal_triangulation(points); });
#endif
  const double sum = triangulation + pass;
  std::printf("%-10s %8zu %9.2f %7.2f %7.2f %8.2f %8.2f %8.2f %8.2f %10.1e\n", kind.c_str(), n, triangulation,
              pass, sum, voro, cgal, voro / sum, cgal / triangulation, apart);
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-10s %8s %9s %7s %7s %8s %8s %8s %8s %10s\n", "set", "points", "triangul.", "pass", "sum",
              "Voro++", "CGAL", "Voro++/", "CGAL/", "volumes");
  if (argc > 2) {
    measure(argv[1], static_cast<std::size_t>(std::atof(argv[2])), argc > 3 ? std::atoi(argv[3]) : 2);
    return 0;
  }
  for (const std::size_t n : {std::size_t{1000}, std::size_t{10000}, std::size_t{100000}})
    for (const char* kind : {"uniform", "plummer"}) measure(kind, n, 2);
  return 0;
}
