// SPDX-License-Identifier: BSD-3-Clause
// Options of constructions, and the cost of a construction.
#pragma once

#include <delone/config.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace delone {

/// How a batch of points is ordered before insertion. The result never depends on it.
enum class InsertionOrder {
  automatic,  ///< rounds along a Hilbert curve; each takes points far apart, in the plane random ones
  as_given,   ///< the order of the input
  shuffled,   ///< a random permutation
};

/// Options of a construction. The result depends on the set of points alone and, for hulls, on the tolerance;
/// the other options change only the cost.
struct Options {
  std::uint64_t seed = 0;  ///< seed of the random choices in the insertion order
  InsertionOrder order = InsertionOrder::automatic;
  /// The most threads that build, as Execution::threads. Points, sets of cells and exported files and arrays
  /// do not depend on it; ids of cells do.
  unsigned threads = 1;
  bool force_runtime_dimension = false;  ///< use the run-time-dimension engine even for k ≤ 8
  /// As Execution::progress. The function must not use the object that is being built or changed.
  std::function<bool(double)> progress = {};
  /// The most memory that the process may use, in bytes; 0: no limit. A construction that comes within 64 MB
  /// or an eighth of it throws Errc::out_of_memory and leaves everything unchanged; the message says how far
  /// it got and about how much the whole would need. There is no limit on systems that do not report the
  /// memory in use. forecast() and estimate() predict the need.
  std::size_t memory_limit = 0;
  /// The most seconds that one call may build; 0: no limit. After that the call throws Errc::time_limit and
  /// leaves everything unchanged. Must be finite and ≥ 0; otherwise Errc::invalid_argument.
  double time_limit = 0;
  /// For hulls only (ConvexHull, LowerHull; see there): a distance in the unit of the coordinates. 0 is
  /// exact. Must be finite and ≥ 0, and 0 for triangulations and halfspaces; otherwise
  /// Errc::invalid_argument.
  double tolerance = 0;
  /// For ConvexHull only, see there: a tolerance for each axis, in place of `tolerance`. As many as there are
  /// axes, all 0 or none; otherwise Errc::invalid_argument.
  std::vector<double> axis_tolerances = {};
};

/// What a construction has cost so far, all insertions together.
struct Statistics {
  std::uint64_t created_cells = 0;  ///< by all insertions, including cells destroyed later
  std::uint64_t visited_cells = 0;  ///< by the walks of all insertions
  std::uint64_t insertions = 0;     ///< vertices inserted
  /// Conflict tests decided by the cached functional of the cell, repeated ones included.
  std::uint64_t filter = 0;
  std::uint64_t direct = 0;  ///< … by a determinant in binary64 with a certified bound
  std::uint64_t exact = 0;   ///< … by exact integer arithmetic
  /// Ties, decided by the symbolic perturbation after one of the stages proved a zero.
  std::uint64_t perturbed = 0;
  double order_seconds = 0;    ///< ordering and merging duplicates
  double build_seconds = 0;    ///< insertions
  std::size_t cell_bytes = 0;  ///< memory now reserved for cells
  unsigned threads = 1;        ///< the most threads that inserted one batch
};

}  // namespace delone
