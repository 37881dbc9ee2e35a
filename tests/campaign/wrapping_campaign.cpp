// SPDX-License-Identifier: BSD-3-Clause
// Wrapping against insertion in 7 and 8 dimensions: the same points, all at once and after the first few one
// by one, must have the same triangulation. Prints a line for each set.
//
// Usage: delone_wrapping_campaign [--dimension D] [--points N] [--kind NAME]    without: all of the campaign
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace delone;

struct Set {
  std::string kind;
  int dimension;
  std::size_t num_points;
};

/// Points of [0, 1]^d of which the last coordinate is less than 2^-20.
std::vector<double> near_flat(int d, std::size_t n) {
  std::vector<double> points = make_point_set("uniform", d, n, 4);
  for (std::size_t i = static_cast<std::size_t>(d) - 1; i < points.size(); i += static_cast<std::size_t>(d))
    points[i] *= 0x1p-20;
  return points;
}
/// (t, t², …, t^d): every cell that there can be.
std::vector<double> moment_curve(int d, std::size_t n) {
  std::vector<double> points;
  std::mt19937_64 random(5);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2 * static_cast<double>(random() >> 11) * 0x1p-53 - 1;
    double power = 1;
    for (int j = 0; j < d; ++j) points.push_back(power *= t);
  }
  return points;
}

/// Batches are wrapped only where nothing was before them.
bool run(const Set& set) {
  const auto d = static_cast<std::size_t>(set.dimension);
  const std::vector<double> points = set.kind == "near_flat" ? near_flat(set.dimension, set.num_points)
                                     : set.kind == "moment_curve"
                                         ? moment_curve(set.dimension, set.num_points)
                                         : make_point_set(set.kind, set.dimension, set.num_points, 3);
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto seconds = [](auto from, auto to) { return std::chrono::duration<double>(to - from).count(); };
  const auto start = now();
  CanonicalHash of_wrapped;
  std::size_t num_cells;
  bool is_wrapped;
  {
    const Delaunay<> wrapped(points, set.dimension);
    of_wrapped = wrapped.hash();
    num_cells = wrapped.num_finite_cells();
    is_wrapped = wrapped.statistics().created_cells == wrapped.num_all_cells();
  }
  const auto middle = now();
  Delaunay<> inserted(set.dimension);
  const std::size_t first = d + 2;
  for (std::size_t row = 0; row < first; ++row) inserted.insert(std::span(points).subspan(row * d, d));
  inserted.insert_range(
      std::vector<double>(points.begin() + static_cast<std::ptrdiff_t>(first * d), points.end()));
  const bool same = inserted.hash() == of_wrapped;
  std::printf("%-13s %dD %5zu points %9zu cells  %-8s %7.1f s  inserted %7.1f s  %s\n", set.kind.c_str(),
              set.dimension, set.num_points, num_cells, is_wrapped ? "wrapped" : "inserted",
              seconds(start, middle), seconds(middle, now()), same ? "same" : "DIFFERENT");
  std::fflush(stdout);
  return same;
}

}  // namespace

int main(int argc, char** argv) {
  std::string kind;
  int dimension = 0;
  std::size_t points = 0;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--kind") == 0) kind = argv[i + 1];
    if (std::strcmp(argv[i], "--dimension") == 0) dimension = std::stoi(argv[i + 1]);
    if (std::strcmp(argv[i], "--points") == 0) points = std::stoul(argv[i + 1]);
  }
  std::vector<Set> sets;
  if (!kind.empty() && dimension > 0 && points > 0) {
    sets.push_back({kind, dimension, points});
  } else {
    for (const char* of_points : {"uniform", "clusters", "near_flat", "plummer"}) {
      for (const std::size_t n : {1000u, 2000u, 4000u}) sets.push_back({of_points, 7, n});
      sets.push_back({of_points, 8, 1000});
    }
    for (const std::size_t n : {60u, 100u})
      for (const int d : {7, 8}) sets.push_back({"moment_curve", d, n});
  }
  bool all_same = true;
  for (const Set& set : sets) all_same = run(set) && all_same;
  return all_same ? 0 : 1;
}
