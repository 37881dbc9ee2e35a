// SPDX-License-Identifier: BSD-3-Clause
// The methods of a conversion, each alone, and what chooses between them (polyhedra/double_description.hpp):
//
//   delone_benchmark_conversion METHOD FILE      METHOD: steps, insertion or chosen
//
// It prints the number of rays, and the seconds of processor time of the conversion of the cone alone:
// reading, redundancy and order of the result are the same for all. Short ones are repeated, and the mean is
// printed. If insertion does not suit the file, it prints "none". benchmarks/methods.py compares them.
#include "polyhedra/cone.hpp"
#include "polyhedra/double_description.hpp"
#include "polyhedra/fraction.hpp"
#include "polyhedra/insertion.hpp"

#include <delone/error.hpp>
#include <delone/polyhedron_io.hpp>

#include <cstdio>
#include <ctime>
#include <limits>
#include <string>

namespace {

using namespace delone;
using namespace delone::polyhedra;

Rows functions_of(const RationalRows& inequalities) {
  Rows rows;
  for (std::size_t i = 0; i < inequalities.size(); ++i) {
    Row row = common_integers(inequalities[i]);
    row.pop_back();
    for (std::size_t c = 0; c + 1 < row.size(); ++c) row[c] = -row[c];
    rows.push_back(std::move(row));
  }
  return rows;
}

void append(const RationalRows& generators, bool are_points, Rows& rows) {
  for (std::size_t i = 0; i < generators.size(); ++i) {
    rows.push_back(common_integers(generators[i]));
    if (!are_points) rows.back().back() = 0;
  }
}

struct NotApplicable {};

PointedRays by_insertion(const PointedCone& cone, unsigned) {
  if (auto found = find_rays_by_insertion(cone, std::numeric_limits<double>::infinity()); found.rays)
    return std::move(*found.rays);
  throw NotApplicable();
}
PointedRays by_steps(const PointedCone& cone, unsigned threads) { return find_rays_by_steps(cone, threads); }

/// Some systems count processor time in steps of milliseconds, so short conversions are repeated.
constexpr double enough_seconds = 0.2;
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

int measure(const std::string& method, const std::string& path) {
  const PolyhedronRows given = read_polyhedron(path);
  const auto dimension = static_cast<std::size_t>(given.dimension) + 1;
  Rows rows, equations;
  if (given.has_generators) {
    append(given.vertices, true, rows);
    append(given.rays, false, rows);
    append(given.lines, false, equations);
  } else {
    rows = functions_of(given.inequalities);
    rows.emplace_back(dimension, Integer(0));
    rows.back().back() = 1;
    equations = functions_of(given.equations);
  }
  const PointedMethod how = method == "steps"       ? by_steps
                            : method == "insertion" ? by_insertion
                                                    : find_rays_of_pointed;
  try {
    const double begin = processor_seconds();
    double seconds = 0;
    std::size_t times = 0, rays = 0;
    do {
      rays = find_rays(rows, equations, dimension, 1, how).rays.size();
      seconds = processor_seconds() - begin;
      ++times;
    } while (seconds < enough_seconds);
    std::printf("%zu %.6f\n", rays, seconds / static_cast<double>(times));
  } catch (const NotApplicable&) {
    std::printf("none\n");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string method = argc == 3 ? argv[1] : "";
  if (method != "steps" && method != "insertion" && method != "chosen") {
    std::fprintf(stderr, "usage: %s steps|insertion|chosen FILE\n", argv[0]);
    return 64;
  }
  try {
    return measure(method, argv[2]);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
