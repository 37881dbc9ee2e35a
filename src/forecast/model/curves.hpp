// SPDX-License-Identifier: BSD-3-Clause
// What has been measured of the named point sets, as curves with few constants.
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace delone::cost_model {

/// How the number of cells grows with the number v of vertices. With s = v^(−1/k):
enum class Growth {
  spread,  ///< log(cells/v) is that of a Poisson process and a polynomial in s without constant term
  free,    ///< log(cells/v) is a cubic polynomial in log(v); beyond the last measurement its slope, the fifth
           ///< constant, falls like s
  lattice,  ///< log(cells) is log(k!·volume of the hull in boxes) and a line in s
  moment,   ///< that of points on the moment curve, exactly
  line,     ///< k = 1: v − 1
};

/// The curves of a kind of point sets (point_sets.hpp) in one dimension.
struct Curve {
  std::string_view kind;
  int dimension, affine_dimension;
  Growth growth;
  double first, last;             ///< the numbers of vertices that were measured
  std::array<double, 5> cells;    ///< see Growth
  std::array<double, 3> created;  ///< log(created/finite cells), a polynomial in s, where points are inserted
  std::array<double, 2> infinite;  ///< log(infinite/finite cells), a line in log(v)
  /// Where points are inserted: nanoseconds per created cell, at `last` vertices, which grow as a power of v,
  /// and bytes per cell, infinite ones included.
  double nanoseconds, slowdown, bytes;
  /// Where they are wrapped: both per cell, infinite ones included; 0 where they never are.
  double wrapping_nanoseconds, wrapping_bytes;
};

/// All of them, by dimension; for each dimension in the order of their names.
std::span<const Curve> curves();
/// Nanoseconds per created cell of the set that the speed of a machine is told by, when the curves were
/// measured (speed.hpp).
double reference_nanoseconds();

}  // namespace delone::cost_model
