// SPDX-License-Identifier: BSD-3-Clause
// A shell that grows until it covers a set up to a small distance, with few vertices that are not extreme.
#pragma once

#include "hull/cell_cones.hpp"
#include "hull/point_sieve.hpp"
#include "kernel/nearest_in_hull.hpp"

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace delone::hull {

/// More than underflow takes from a distance.
inline constexpr double underflow_slack = 0x1p-500;

/// Adds the farthest points beyond cells of the shell of a sieve, as in Quickhull (Barber, Dobkin, Huhdanpaa
/// 1996, doi:10.1145/235815.235821), until every point is within the tolerance of the shell; that is proved
/// in binary64, and no exact predicate is asked but by insertions. Points are remaining rows of the sieve.
class GrowingShell {
 public:
  struct Limits {
    std::size_t vertices = std::numeric_limits<std::size_t>::max();  ///< of the shell
    std::size_t products =
        std::numeric_limits<std::size_t>::max();  ///< of points beyond and functions of cells
  };

  /// The sieve has a shell, and outlives this object. `alive` is called once in a while, and may throw.
  GrowingShell(PointSieve& sieve, double tolerance, std::function<void()> alive);
  ~GrowingShell();

  /// Whether squares of coordinates neither overflow nor underflow where that matters, and there is a point
  /// inside.
  bool is_possible();
  /// Grows until all points are covered. Returns false if they could not be, or a limit is reached.
  /// REQUIRES is_possible().
  bool run(const Limits& limits);

  /// After run(): the points that are not vertices and not certainly in the interior, increasing.
  const std::vector<std::size_t>& covered() const { return covered_; }
  /// If run() returned false: those that are not covered.
  const std::vector<std::size_t>& open() const { return open_; }
  /// A cell of the shell with a point in its cone, up to rounding; any cell if the walk fails.
  std::size_t cell_of(std::size_t point);

 private:
  const double* point(std::size_t i) const { return sieve_.remaining_points().data() + i * d_; }
  HullState& shell() { return sieve_.shell(); }
  const Boundary& boundary() { return *shell().boundary(); }
  double distance_up(const CellCones& cones, std::size_t cell);
  void set_out_for(const double* p);
  std::size_t weigh(CellCones& cones);
  std::size_t across(const CellCones& cones, std::size_t least, int step) const;
  double walk(CellCones& cones, const double* p);
  void cover();
  bool extend();
  bool cover_by_all();

  PointSieve& sieve_;
  std::size_t d_;
  double tolerance_;
  std::function<void()> alive_;
  kernel::NearestInHull nearest_;
  std::vector<std::size_t> open_, covered_;
  std::vector<Index> cells_;          // where the open ones are
  std::unique_ptr<CellCones> cones_;  // of the shell as it is now
  std::size_t cell_ = 0;              // where the walk is
  double sum_ = 0;                    // of the weights found
  std::size_t products_ = 0;          // so far
  std::vector<double> difference_, weights_;
};

}  // namespace delone::hull
