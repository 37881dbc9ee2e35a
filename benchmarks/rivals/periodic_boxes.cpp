// SPDX-License-Identifier: BSD-3-Clause
// Periodic boxes in space: the triangulation and the complete pass over all cells (neighbors with offsets,
// areas, volumes, centroids) of delone, the cells of Voro++ with the same numbers, and the triangulation of
// CGAL, in microseconds of one thread per point; the ratios to delone's sum; and the largest relative errors
// of the volumes of delone and Voro++. References of 113 bits follow from the cells of the triangulation by
// another formula; of many points some are compared.
//
//   periodic_boxes                          the standard sets
//   periodic_boxes uniform 100000 [RUNS]    one set; the best of so many runs, 2 by default
//
// Sets are those of make_point_set(), and "lattice+1e-9": a cubic lattice, each coordinate moved by up to
// 1e-9.
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
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <random>
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

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Wide;
#else
using Wide = long double;
#endif
using Vector = std::array<Wide, 3>;

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Wide dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Wide determinant(const Vector& a, const Vector& b, const Vector& c) { return dot(a, cross(b, c)); }

/// From the first corner to the point that is as near to it as to the others.
Vector to_center(const Vector& a, const Vector& b) {
  const Vector n = cross(a, b), of_a = cross(b, n), of_b = cross(n, a);
  Vector center;
  for (std::size_t j = 0; j < 3; ++j)
    center[j] = (dot(a, a) * of_a[j] + dot(b, b) * of_b[j]) / (2 * dot(n, n));
  return center;
}
Vector to_center(const Vector& a, const Vector& b, const Vector& c) {
  const Vector of_a = cross(b, c), of_b = cross(c, a), of_c = cross(a, b);
  Vector center;
  for (std::size_t j = 0; j < 3; ++j)
    center[j] =
        (dot(a, a) * of_a[j] + dot(b, b) * of_b[j] + dot(c, c) * of_c[j]) / (2 * determinant(a, b, c));
  return center;
}

/// The volumes of the cells of every `step`-th point: the sums, over the tetrahedra at the point, of signed
/// tetrahedra of the point, the middle of an edge, and the centers of a triangle and of the tetrahedron.
std::vector<Wide> reference_volumes(const delone::PeriodicTriangulation& t, std::size_t step) {
  std::vector<Wide> volumes((t.num_points() + step - 1) / step, 0);
  for (std::size_t cell = 0; cell < t.num_cells(); ++cell) {
    std::array<Vector, 4> corners;
    std::array<std::size_t, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) {
      rows[i] = static_cast<std::size_t>(t.cells()[4 * cell + i]);
      for (std::size_t j = 0; j < 3; ++j)
        corners[i][j] =
            static_cast<Wide>(t.points()[3 * rows[i] + j]) + t.cell_offsets()[3 * (4 * cell + i) + j];
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if (rows[i] % step != 0) continue;
      std::array<Vector, 3> edges;
      for (std::size_t e = 0; e < 3; ++e) edges[e] = corners[(i + e + 1) % 4] - corners[i];
      const Vector center = to_center(edges[0], edges[1], edges[2]);
      const bool is_positive = determinant(edges[0], edges[1], edges[2]) > 0;
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) {
          if (j == k) continue;
          const Wide six_fold = determinant(edges[j], to_center(edges[j], edges[k]), center) / 2;
          volumes[rows[i] / step] += (((k == (j + 1) % 3) == is_positive) ? six_fold : -six_fold) / 6;
        }
    }
  }
  return volumes;
}

double largest_error(const std::vector<double>& volumes, const std::vector<Wide>& references,
                     std::size_t step) {
  double largest = 0;
  for (std::size_t i = 0; i < references.size(); ++i)
    largest =
        std::max(largest, std::abs(static_cast<double>((volumes[i * step] - references[i]) / references[i])));
  return largest;
}

std::vector<double> points_of(const std::string& kind, std::size_t n) {
  if (kind != "lattice+1e-9") return delone::make_point_set(kind, 3, n, 1);
  const auto side = static_cast<std::size_t>(std::lround(std::cbrt(static_cast<double>(n))));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> noise(-1e-9, 1e-9);
  std::vector<double> points;
  for (std::size_t i = 0; i < side * side * side; ++i)
    for (const std::size_t at : {i % side, i / side % side, i / side / side})
      points.push_back((static_cast<double>(at) + 0.5) / static_cast<double>(side) + noise(random));
  return points;
}

void measure(const std::string& kind, std::size_t wanted, int runs) {
  std::vector<double> points = points_of(kind, wanted);
  const std::size_t n = points.size() / 3;
  const bool is_lattice = kind == "lattice+1e-9";  // is in the box as it is
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  const double least = is_lattice ? 0 : *low, size = is_lattice ? 1 : (*high - *low) * (1 + 1e-6);
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
  double voro = none, cgal = none, voro_error = none;
  constexpr std::size_t most_compared = 2000;
  const std::size_t step = (n + most_compared - 1) / most_compared;
  const std::vector<Wide> references = reference_volumes(made, step);
#ifdef DELONE_HAS_VORO
  std::vector<double> volumes;
  voro = unit * best_of(runs, [&] { volumes = voro_cells(points); });
  voro_error = largest_error(volumes, references, step);
#endif
#ifdef DELONE_HAS_CGAL
  cgal = unit * best_of(runs, [&] { cgal_triangulation(points); });
#endif
  const double sum = triangulation + pass;
  std::printf("%-12s %8zu %9.2f %7.2f %7.2f %8.2f %8.2f %8.2f %8.2f %8.1e %8.1e\n", kind.c_str(), n,
              triangulation, pass, sum, voro, cgal, voro / sum, cgal / triangulation,
              largest_error(cells.volumes, references, step), voro_error);
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%-12s %8s %9s %7s %7s %8s %8s %8s %8s %8s %8s\n", "set", "points", "triangul.", "pass", "sum",
              "Voro++", "CGAL", "Voro++/", "CGAL/", "error", "Voro++");
  if (argc > 2) {
    measure(argv[1], static_cast<std::size_t>(std::atof(argv[2])), argc > 3 ? std::atoi(argv[3]) : 2);
    return 0;
  }
  for (const std::size_t n : {std::size_t{1000}, std::size_t{10000}, std::size_t{100000}})
    for (const char* kind : {"uniform", "plummer", "clusters", "lattice+1e-9"}) measure(kind, n, 2);
  return 0;
}
