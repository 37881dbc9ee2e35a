// SPDX-License-Identifier: BSD-3-Clause
// Options of constructions, and what a construction has cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace delone {

/// How a batch of points is ordered before insertion. The result never depends on it.
enum class InsertionOrder {
  automatic,  ///< rounds along a Hilbert curve: of points chosen farthest first, in the plane of random ones
  as_given,   ///< the order of the input
  shuffled,   ///< a random permutation
};

/// Options of a construction. The result depends on the set of points alone and, for hulls, on the tolerance;
/// the other options change the path, not the end.
struct Options {
  std::uint64_t seed = 0;  ///< of the random choices of the insertion order
  InsertionOrder order = InsertionOrder::automatic;
  /// At most so many threads build; 0: as many as there are cores for this process (affinity mask, quota of
  /// the container), where a batch is large enough to gain by them. Points, sets of cells and exported files
  /// and arrays do not depend on it; ids of cells do.
  unsigned threads = 1;
  bool force_runtime_dimension = false;  ///< use the run-time-dimension engine even for k ≤ 8
  /// Called from the thread that builds, and from no other, about every 20 ms with the fraction done, 0…1,
  /// which does not decrease; return false to cancel (Errc::cancelled). ProgressScope does the same for calls
  /// without options.
  std::function<bool(double)> progress = {};
  /// The most memory that the process may have in use, in bytes; 0: no limit. A construction that comes near,
  /// within 64 MB or an eighth, throws Errc::out_of_memory, says how far it came and about what the whole
  /// would have taken, and leaves everything as it was. Where the system does not tell the memory in use
  /// there is no limit. forecast() and estimate() tell beforehand.
  std::size_t memory_limit = 0;
  /// The most seconds for one call that builds; 0: no limit. Beyond it the call throws Errc::time_limit, as
  /// above. Must be finite and ≥ 0; otherwise Errc::invalid_argument.
  double time_limit = 0;
  /// Of hulls (ConvexHull, LowerHull), with the unit of the coordinates; see there. 0, the default, is exact.
  /// Must be finite and ≥ 0, and 0 for triangulations and halfspaces; otherwise Errc::invalid_argument.
  double tolerance = 0;
};

/// What a triangulation has cost so far.
struct Statistics {
  std::uint64_t created_cells = 0;  ///< by all insertions, including cells destroyed later
  std::uint64_t visited_cells = 0;  ///< by the walks of all insertions
  std::uint64_t insertions = 0;     ///< vertices inserted
  std::uint64_t filter =
      0;  ///< conflict tests decided by the cached functional of the cell, repeated ones included
  std::uint64_t direct = 0;  ///< … by a determinant in binary64 with a certified bound
  std::uint64_t exact = 0;   ///< … by exact integer arithmetic
  std::uint64_t perturbed =
      0;  ///< ties, decided by the symbolic perturbation (after one of the stages proved a zero)
  double order_seconds = 0;    ///< ordering and merging duplicates
  double build_seconds = 0;    ///< insertions
  std::size_t cell_bytes = 0;  ///< memory reserved for cells, at present
  unsigned threads = 1;        ///< most threads that have inserted a batch
};

}  // namespace delone
