// SPDX-License-Identifier: BSD-3-Clause
// Piecewise linear interpolation of values at scattered points.
#pragma once

#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/point_locator.hpp>
#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone {

/// How an interpolation answers queries outside: those that are neither in the convex hull of the points nor
/// within the tolerance of it. For flat input these include all queries that are not within the tolerance of
/// the flat of the points.
enum class Outside : std::uint8_t {
  fill,     ///< constants, NaN by default; gradients are NaN
  nearest,  ///< the value of the vertex nearest to the query, as by PointLocator::nearest(); gradients
            ///< are 0
  error,    ///< Errc::invalid_argument, rows() naming one such query
  project,  ///< the value at the point of the convex hull nearest to the query, whatever its distance: the
            ///< function continues constantly at right angles to the hull, and continuously. Gradients are
            ///< those of the function in the cell of that point. As `fill` if there is no point at all.
};

/// How interpolators treat queries.
struct EvaluateOptions {
  Outside outside = Outside::fill;
  /// For Outside::fill: one number for each column; empty: NaN. Not used for gradients.
  std::span<const double> fill = {};
  /// τ of LocateOptions: the value at x is that of the function at the point x' described there, with |x −
  /// x'| ≤ τ; at a vertex it is the given one.
  double tolerance = 0;
};

/// The function that is linear in every cell of a triangulation and has given values at its vertices.
/// Continuous; which cell a query is in, and whether it is in any, is decided exactly. At a vertex it has the
/// given value exactly.
///
/// Refers to the triangulation: valid until the next insertion or edit. `const` members may be called from
/// several threads at once.
class DELONE_EXPORT LinearInterpolator {
 public:
  /// `values`: n×columns numbers, one row for each input row; NaN and infinities affect the cells of their
  /// vertices. Of duplicates the value of the first row counts; those of hidden points are not used. Throws
  /// Errc::bad_dimension unless there are that many numbers, out_of_memory.
  LinearInterpolator(const Triangulation& triangulation, std::span<const double> values,
                     std::size_t columns = 1);

  std::size_t columns() const { return columns_; }

  /// The values at q queries (q×d coordinates) as q×columns numbers, none off by more than (k+1)·2⁻³⁵ times
  /// the largest magnitude of a value at the cell, whatever its shape; mostly by a few units of 2⁻⁵³. Throws
  /// as PointLocator::locate(), Errc::bad_dimension unless `result` has that size, cancelled, and
  /// invalid_argument for Outside::error. The result does not depend on the number of threads, to the last
  /// bit.
  void evaluate(std::span<const double> queries, std::span<double> result,
                const EvaluateOptions& options = {}, const Execution& how = {}) const;
  /// The gradients at q queries, q×columns×d numbers. Where cells meet it is the gradient of one of them;
  /// with a tolerance, of a thick one that contains x' if there is any. Flat input: tangent to the flat.
  /// Throws as evaluate().
  void gradients(std::span<const double> queries, std::span<double> result,
                 const EvaluateOptions& options = {}, const Execution& how = {}) const;

 private:
  const Triangulation& triangulation_;
  PointLocator locator_;
  std::size_t columns_;
  std::vector<double> values_;  // by vertex id
};

}  // namespace delone
