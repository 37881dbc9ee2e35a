// SPDX-License-Identifier: BSD-3-Clause
// A periodic set: points and lattice on a grid, so that images of points are doubles without rounding, and
// each point in the box of its lattice.
//
// Let all coordinates of images that are ever looked at (Period: the reach) be below 2^e. Coordinates and
// lattice vectors become multiples of u = 2^(e−53): then a sum p + Σ k_i a_i is exact, whatever the order of
// its terms. What lies on that grid is not changed.
//
// Numbers within a set are those of the caller, unless squares of coordinates could overflow or underflow, or
// a unit is given: then they are multiples of 2^scale, or of the unit.
#pragma once

#include "periodic/period.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace delone::periodic {

/// Multiplies by 2^exponent, rounded as by std::ldexp: where that is a normal number, the product is.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int exponent)
      : exponent_(exponent), factor_(std::abs(exponent) < 1000 ? std::ldexp(1.0, exponent) : 0) {}
  double operator()(double x) const { return factor_ > 0 ? x * factor_ : std::ldexp(x, exponent_); }

 private:
  int exponent_;
  double factor_;
};

/// What a set is made of.
struct SetInput {
  std::span<const double> points;   ///< n×d
  std::span<const double> weights;  ///< n, if points have weights
  std::span<const double> lattice;  ///< r×d
  std::size_t dimension = 0;
  bool is_weighted = false;
  bool is_exact = false;  ///< refuse what is not on the grid
  bool wraps = true;      ///< move points into the box; otherwise refuse those outside
  double unit = 0;        ///< 0: none
  unsigned threads = 1;   ///< as Options::threads
};

struct PeriodicSet {
  std::size_t dimension = 0, rank = 0;
  bool weighted = false;
  Period period;                    ///< the reduced lattice
  std::vector<double> lattice;      ///< r×d, the vectors of the caller on the grid
  std::vector<std::int64_t> sums;   ///< r×r: how reduced vectors are sums of those
  std::vector<double> rows;         ///< n times d coordinates and, if there are weights, one
  std::vector<std::int32_t> wraps;  ///< n×r: the caller's point is the row plus Σ wraps_i a_i
  std::vector<double> largest;      ///< d, bounds of |coordinates| of all images that are looked at
  double displacement = 0;          ///< the most that a coordinate has moved, in numbers of the caller
  int scale = 0;
  int grid = 0;        ///< given numbers, or numbers of units, are rounded to multiples of 2^grid
  int query_grid = 0;  ///< queries, in numbers of the set, are rounded to multiples of 2^query_grid
  double unit = 0;

  std::size_t row_size() const { return dimension + (weighted ? 1 : 0); }
  std::size_t num_points() const { return rows.size() / row_size(); }
  const double* row(std::size_t i) const { return rows.data() + i * row_size(); }
  /// A coordinate or length as a number of the caller, and back.
  double outer(double x) const { return unit > 0 ? x * unit : std::ldexp(x, scale); }
  double inner(double x) const { return unit > 0 ? x / unit : std::ldexp(x, -scale); }
  /// A weight as a number of the set, and back: to one that becomes this number of the set.
  double inner_weight(double w) const {
    return (unit > 0 ? w / unit / unit : std::ldexp(w, -2 * scale)) + 0.0;
  }
  double outer_weight(double w) const;
  /// A coordinate of a query, as a number of the set on a grid on which its translates in the box are exact.
  /// Of a set with a unit that is finer than the unit. Beyond 2^53 of its steps: as it is.
  double snapped_query(double x) const;
  /// The points, n×d, where they were given, on the grid, in numbers of the caller.
  std::vector<double> given_points(std::span<const double> given, unsigned threads) const;
  /// Moves a point of the caller onto the grid and into the box: d coordinates, and the weight if there are
  /// weights. REQUIRES finite numbers. Throws invalid_argument with the row.
  void place(std::size_t row, double* point) const;
  /// Σ k_i a_i in terms of the caller's vectors, |k_i| < 2^32. Throws Errc::unsupported beyond 32 bits.
  void to_given_basis(std::span<const std::int64_t> k, std::int32_t* given) const;
};

/// Throws Errc::not_finite; bad_dimension for lattice vectors without d numbers and a wrong number of
/// weights; invalid_argument for dependent, too flat or too skewed lattice vectors, and for what the options
/// refuse.
PeriodicSet make_periodic_set(const SetInput& input);

/// Calls visit(x) with the d coordinates of each point.
using EachPoint = std::function<void(const std::function<void(const double*)>& visit)>;

/// How far points reach beside the lattice: d bounds of the coordinates of their parts that are orthogonal to
/// it, in a unit that depends on the lattice alone. Of points in several parts the bounds are the largest of
/// the parts. each_point() is not called if the lattice has d vectors. Throws as make_periodic_set().
std::vector<double> free_extent(const SetInput& input, const EachPoint& each_point);

/// A set whose points are placed one after the other, so that it has no rows: `input` has none either.
/// `free`: the free_extent() of all points. Throws as make_periodic_set().
PeriodicSet make_set_without_rows(const SetInput& input, std::span<const double> free);

}  // namespace delone::periodic
