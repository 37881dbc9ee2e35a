// SPDX-License-Identifier: BSD-3-Clause
// Piecewise linear interpolation of values at scattered points.
#pragma once

#include <delone/point_locator.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace delone {

/// What an interpolation gives to queries outside the convex hull of the points (within their flat).
enum class Outside : std::uint8_t {
  fill,     ///< constants, NaN unless told otherwise; gradients are NaN
  nearest,  ///< the value at the nearest vertex; gradients are 0
  error,    ///< Errc::invalid_argument, rows() naming one such query
};

/// The function that is linear in every cell of a triangulation and has given values at its vertices.
/// Continuous; which cell a query is in, and whether it is in any, is decided exactly. At a vertex it has the
/// given value exactly.
///
/// Refers to the triangulation: valid until the next insertion. `const` members may be called from several
/// threads at once.
class LinearInterpolator {
 public:
  /// `values`: n×columns numbers, one row for each input row; NaN and infinities spread to the cells they are
  /// at. Of duplicates the value of the first row counts, those of hidden points are not used. Throws
  /// bad_dimension unless the numbers fit.
  LinearInterpolator(const Triangulation& triangulation, std::span<const double> values,
                     std::size_t columns = 1);

  std::size_t columns() const { return columns_; }

  /// Called now and then with the number of queries done; returning false cancels (Errc::cancelled).
  using Progress = std::function<bool(std::size_t)>;

  /// The values at q queries (q×d coordinates) as q×columns numbers, none off by more than (k+1)·2⁻³⁵ times
  /// the largest magnitude of a value at the cell, whatever its shape; mostly by a few units of 2⁻⁵³. Throws
  /// as PointLocator::locate(), bad_dimension if `result` is not of that size, and see Outside. `fill`: one
  /// number for each column, for Outside::fill; NaN if it is empty.
  void evaluate(std::span<const double> queries, std::span<double> result, Outside outside = Outside::fill,
                std::span<const double> fill = {}, const Progress& progress = {}) const;
  /// The gradients at q queries, q×columns×d numbers: where cells meet, of one of them. Flat input: tangent
  /// to the flat.
  void gradients(std::span<const double> queries, std::span<double> result, Outside outside = Outside::fill,
                 const Progress& progress = {}) const;

 private:
  const Triangulation& triangulation_;
  PointLocator locator_;
  std::size_t columns_;
  std::vector<double> values_;  // by vertex id
};

}  // namespace delone
