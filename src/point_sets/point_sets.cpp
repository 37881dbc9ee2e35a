// SPDX-License-Identifier: BSD-3-Clause
// The table of named point sets.
#include <delone/arithmetic.hpp>
#include <delone/error.hpp>
#include <delone/point_sets.hpp>

#include "point_sets/generator.hpp"
#include "point_sets/kinds.hpp"

#include <array>
#include <limits>
#include <new>

namespace delone {
namespace {

struct Entry {
  std::string_view name, description;
  point_sets::Maker make;
};

constexpr std::array<Entry, 20> entries{{
    {"ball", "uniform in the unit ball", point_sets::make_ball},
    {"clusters", "about sqrt(n)/8 normal clusters of different widths in the unit cube",
     point_sets::make_clusters},
    {"collinear", "exactly on a line", point_sets::make_collinear},
    {"cospherical", "distinct integer points exactly on a sphere around the origin (d >= 2)",
     point_sets::make_cospherical},
    {"cube01", "the first n of the 2^d corners of the unit cube, counted in binary", point_sets::make_cube01},
    {"duplicates", "uniform, every point about four times", point_sets::make_duplicates},
    {"equal", "one point, n times", point_sets::make_equal},
    {"flat", "exactly in a tilted hyperplane (d >= 2)", point_sets::make_flat},
    {"gaussian", "standard normal", point_sets::make_gaussian},
    {"grid", "the integer lattice, about n^(1/d) points per axis", point_sets::make_grid},
    {"manifold", "the hypersurface x_d = sin(pi x_1), the other coordinates uniform",
     point_sets::make_manifold},
    {"mixed_scales", "magnitudes from 1e-300 to 1e150, and denormal numbers", point_sets::make_mixed_scales},
    {"moment", "the moment curve (t, t^2, ..., t^d), t uniform in [0, 1)", point_sets::make_moment},
    {"nudged_grid", "a grid, each coordinate moved by one unit in the last place or not",
     point_sets::make_nudged_grid},
    {"offset", "uniform in a kilometre, in millimetres, 4000 km from the origin", point_sets::make_offset},
    {"plummer", "the Plummer model of a star cluster; d = 6: positions and velocities",
     point_sets::make_plummer},
    {"sphere", "uniform on the unit sphere, rounded", point_sets::make_sphere},
    {"tilted_grid", "a grid mapped by an integer matrix of determinant 1", point_sets::make_tilted_grid},
    {"ulp_sphere", "correctly rounded points of the unit sphere: nearly cospherical (d >= 2)",
     point_sets::make_ulp_sphere},
    {"uniform", "uniform in the unit cube", point_sets::make_uniform},
}};

}  // namespace

const std::vector<PointSetKind>& point_set_kinds() {
  static const std::vector<PointSetKind> kinds = [] {
    std::vector<PointSetKind> result;
    for (const Entry& entry : entries) result.push_back({entry.name, entry.description});
    return result;
  }();
  return kinds;
}

std::vector<double> make_point_set(std::string_view kind, int dimension, std::size_t n, std::uint64_t seed) {
  const ArithmeticScope arithmetic;
  if (dimension < 1)
    throw Error(Errc::invalid_argument, "the dimension must be at least 1, not " + std::to_string(dimension));
  const auto d = static_cast<std::size_t>(dimension);
  if (n > std::numeric_limits<std::size_t>::max() / (2 * sizeof(double)) / d)
    throw Error(Errc::too_many, "not enough memory for " + std::to_string(n) + " points of dimension " +
                                    std::to_string(dimension));
  for (const Entry& entry : entries) {
    if (entry.name != kind) continue;
    point_sets::Generator generator(seed);
    try {
      return entry.make(d, n, generator);
    } catch (const std::bad_alloc&) {
      throw Error(Errc::out_of_memory, "not enough memory for " + std::to_string(n) +
                                           " points of dimension " + std::to_string(dimension));
    }
  }
  throw Error(Errc::invalid_argument, "unknown kind of point set '" + std::string(kind) + "'");
}

}  // namespace delone
