// SPDX-License-Identifier: BSD-3-Clause
// Piecewise linear interpolation of values at scattered points.
#pragma once

#include <delone/export.hpp>
#include <delone/point_locator.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace delone {

/// What an interpolation gives to queries outside: those that are not in the convex hull of the points, nor
/// within the tolerance of it. For flat input these are also all queries that are not in the flat of the
/// points, but for the tolerance.
enum class Outside : std::uint8_t {
  fill,     ///< constants, NaN unless told otherwise; gradients are NaN
  nearest,  ///< the value given at the vertex nearest to the query, as by PointLocator::nearest(); gradients
            ///< are 0
  error,    ///< Errc::invalid_argument, rows() naming one such query
  project,  ///< the value at the point of the convex hull nearest to the query, whatever its distance: the
            ///< function goes on constant at right angles to the hull, continuously. Gradients are those of
            ///< the function in the cell of that point. As `fill` if there is no point at all.
};

/// How interpolators treat queries.
struct EvaluateOptions {
  Outside outside = Outside::fill;
  /// For Outside::fill: one number for each column; NaN if it is empty. Not used for gradients.
  std::span<const double> fill = {};
  /// τ of LocateOptions: the value at x is that of the function at the point x' there, so at one with |x −
  /// x'| ≤ τ; at a vertex it is the given one.
  double tolerance = 0;
  /// Called now and then, by the calling thread, with the number of queries done; returning false cancels
  /// (Errc::cancelled).
  std::function<bool(std::size_t)> progress = {};
  /// At most so many threads; 0: as many as there are cores for this process, where the batch is large enough
  /// to gain by them. The result does not depend on it, to the last bit.
  unsigned threads = 1;
};

/// The function that is linear in every cell of a triangulation and has given values at its vertices.
/// Continuous; which cell a query is in, and whether it is in any, is decided exactly. At a vertex it has the
/// given value exactly.
///
/// Refers to the triangulation: valid until the next insertion or edit. `const` members may be called from
/// several threads at once.
class DELONE_EXPORT LinearInterpolator {
 public:
  /// `values`: n×columns numbers, one row for each input row; NaN and infinities spread to the cells they are
  /// at. Of duplicates the value of the first row counts, those of hidden points are not used. Throws
  /// bad_dimension unless the numbers fit.
  LinearInterpolator(const Triangulation& triangulation, std::span<const double> values,
                     std::size_t columns = 1);

  std::size_t columns() const { return columns_; }

  using Progress = std::function<bool(std::size_t)>;

  /// The values at q queries (q×d coordinates) as q×columns numbers, none off by more than (k+1)·2⁻³⁵ times
  /// the largest magnitude of a value at the cell, whatever its shape; mostly by a few units of 2⁻⁵³. Throws
  /// as PointLocator::locate(), bad_dimension if `result` is not of that size, and see Outside.
  void evaluate(std::span<const double> queries, std::span<double> result,
                const EvaluateOptions& options = {}) const;
  /// The gradients at q queries, q×columns×d numbers: where cells meet, of one of them; with a tolerance, of
  /// a thick one that contains x', if there is one. Flat input: tangent to the flat.
  void gradients(std::span<const double> queries, std::span<double> result,
                 const EvaluateOptions& options = {}) const;

 private:
  const Triangulation& triangulation_;
  PointLocator locator_;
  std::size_t columns_;
  std::vector<double> values_;  // by vertex id
};

}  // namespace delone
