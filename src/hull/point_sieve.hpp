// SPDX-License-Identifier: BSD-3-Clause
// Finds the points that are certainly interior to the hull of many points, before any work is spent on them.
// The extremes in some directions make a shell, a hull of few points; points strictly inside all its
// hyperplanes are interior (Akl and Toussaint 1978, doi:10.1016/0020-0190(78)90003-0). The extremes of the
// rest beyond each facet of the shell refine it, as in Quickhull (Barber, Dobkin, Huhdanpaa 1996,
// doi:10.1145/235815.235821), while that pays.
#pragma once

#include "hull/hull_planes.hpp"
#include "hull/hull_state.hpp"

#include <delone/types.hpp>

#include <memory>
#include <span>
#include <unordered_set>
#include <vector>

namespace delone::hull {

class PointSieve {
 public:
  /// Rows of `dimension` finite numbers, which outlive this object. There is no shell yet. If the numbers are
  /// rounded, each is off by at most relative_error times itself, and 2^−1072: rows are then removed only if
  /// the exact points are interior (hull_planes.hpp). `threads`, as Options::threads, share the passes.
  PointSieve(std::span<const double> coordinates, int dimension, double relative_error = 0,
             unsigned threads = 1);

  /// Removes interior rows while a pass over the rest removes enough of them. O(rows·2^d) for d ≤ 5, else
  /// O(rows·d), times the number of passes, which is logarithmic.
  void run();

  /// Whether the shell is a hull of full dimension. If not, all rows remain.
  bool has_shell() const { return shell_ != nullptr; }
  HullState& shell() { return *shell_; }
  std::unique_ptr<HullState> take_shell() { return std::move(shell_); }
  /// The row of the input that each row of the shell is.
  const std::vector<Index>& shell_rows() const { return shell_rows_; }

  /// The rows that are not certainly interior, increasing; those of the shell are among them. Equal rows
  /// remain or are removed together.
  std::vector<Index> remaining_rows() const;
  std::size_t num_remaining() const { return points_.size() / ambient(); }
  /// Their coordinates.
  std::span<const double> remaining_points() const { return points_; }
  Index remaining_row(std::size_t i) const { return rows_.empty() ? static_cast<Index>(i) : rows_[i]; }

  const CenteredBox& box() const { return box_; }
  /// Adds remaining rows, perhaps repeated, to the shell; true if it has full dimension.
  bool add_to_shell(std::span<const std::size_t> which);
  /// Removes those of the remaining rows for which is_interior is not 0.
  void remove(std::span<const char> is_interior);
  bool is_in_shell(std::size_t i) const { return chosen_.count(remaining_row(i)) > 0; }
  /// For each function, slightly tilted, a remaining row where it is greatest. Tilted functions have few
  /// ties: of rows with equal values most are no extreme points.
  std::vector<std::size_t> extremes(const LinearFunctions& functions) const {
    return extremes_among(points_, functions, true);
  }
  /// The same among some points, d numbers each; not tilted on request.
  std::vector<std::size_t> extremes_among(std::span<const double> points, LinearFunctions functions,
                                          bool tilted) const;

 private:
  std::size_t ambient() const { return static_cast<std::size_t>(dimension_); }
  bool find_box(std::vector<std::size_t>& outermost);
  HullPlanes planes_of_shell() const;
  bool remove_interior(const HullPlanes& planes);
  void put_well_spread_first(std::vector<std::size_t>& which) const;

  int dimension_;
  double relative_error_;
  unsigned threads_;
  std::span<const double> points_;  // of the remaining rows
  std::vector<double> own_points_;  // if they are not those of the input
  std::vector<Index> rows_;         // empty: all
  CenteredBox box_;
  std::unique_ptr<HullState> shell_;
  std::vector<Index> shell_rows_;
  std::unordered_set<Index> chosen_;  // these rows
};

}  // namespace delone::hull
