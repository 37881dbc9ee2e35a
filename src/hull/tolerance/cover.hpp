// SPDX-License-Identifier: BSD-3-Clause
// Points that are kept, such that all others are within a tolerance of the hull of those.
#pragma once

#include "hull/tolerance/support_tree.hpp"
#include "kernel/nearest_in_hull.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace delone::hull {

/// Points are named by their numbers. For each point that is not kept there is a *witness* once it is
/// covered: at most dimension + 1 kept points whose hull it is within the tolerance of.
class Cover {
 public:
  /// `add_neighbors(p, marks, list)` adds points that are near p and not marked to a list, and marks them;
  /// what it adds affects speed only. `alive` is called once in a while, and may throw.
  using AddNeighbors = std::function<void(std::size_t, std::vector<char>&, std::vector<Index>&)>;
  Cover(std::vector<const double*> points, int dimension, double tolerance, AddNeighbors add_neighbors,
        std::function<void()> alive);

  /// Whether the distance of q from the hull of m ≥ 1 points exceeds the tolerance, exactly.
  bool exceeds(std::span<const double* const> points, const double* q);

  /// Keeps a point for good.
  void require(Index p);
  /// Keeps a point until it is dropped.
  void keep(Index p);
  /// Looks for the point nearest to p, which is not kept, in the hull of d kept ones: a witness if near
  /// enough, and then p is not kept any more. REQUIRES a complete() that allows all points.
  void approach(Index p, std::span<const Index> kept) {
    if (!project(p, kept)) look(p, kept);
  }
  /// Keeps further points of those that are `allowed`, farthest first, until all are covered. Returns false
  /// if that is impossible.
  bool complete(const std::vector<char>& allowed);
  /// Drops points that are not required, those kept last first, whenever all stay covered.
  void reduce();

  const std::vector<Index>& kept() const { return kept_; }
  /// An upper bound on the distances of all points from the hull of those kept, at most the tolerance: the
  /// greatest of them up to rounding, unless binary64 is at its limits. REQUIRES that all are covered.
  double max_distance();

 private:
  struct State {
    bool is_kept = false, is_required = false, is_covered = false;
    double upper = 0;         // on the distance
    std::size_t seen = 0;     // how many points were kept when it was found
    std::vector<Index> face;  // the points whose hull that was the distance of; a witness if it is covered
  };

  void plant();
  bool project(Index p, std::span<const Index> corners);
  bool look(Index p, std::span<const Index> pool);
  void find_local(Index p);
  enum class Step { covered, nearer, far };
  Step step(Index p);
  bool look_at_all(Index p);
  void set_normal(Index p, std::span<const Index> pool);
  bool cover(Index p, double enough);
  bool add_witness_of(Index p, const std::vector<char>& allowed);
  double least_beyond(double length) const;
  void find_first_of_drop(std::span<const Index> covered);
  bool is_far_along_normals(Index p, std::span<const Index> points);
  bool can_drop(Index p);
  void refine(Index p);

  std::vector<const double*> points_;
  int dimension_;
  double tolerance_;
  AddNeighbors add_neighbors_;
  std::function<void()> alive_;
  std::vector<State> states_;
  std::vector<std::vector<Index>> users_;  // by kept point: those that had it in a witness, and others
  std::vector<Index> kept_;
  std::vector<Index> first_of_drop_;  // kept points near the one that is being dropped
  std::optional<SupportTree> tree_;   // of all points; those kept are in
  kernel::NearestInHull nearest_;
  std::vector<double> normals_;  // by point: from the nearest point that was found to it
  // Scratch.
  std::vector<double> mean_;
  std::vector<const double*> pool_points_;
  std::vector<char> marks_;
  std::vector<Index> near_, local_;
};

}  // namespace delone::hull
