// SPDX-License-Identifier: BSD-3-Clause
// Location with a tolerance τ, after the exact location of a query x. The rules and their guarantee are at
// LocateOptions.
#pragma once

#include "base/stamped_table.hpp"
#include "kernel/nearest_in_hull.hpp"
#include "queries/point_locator_impl.hpp"
#include "queries/thick_cells.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace delone::queries {

class TolerantLocation {
 public:
  /// `thick`: for options.tolerance; null if that is 0.
  TolerantLocation(const PointLocator::Impl& where, const LocateOptions& options, const ThickCells* thick)
      : where_(where), options_(options), thick_(thick) {}

  /// Whether the exact location is the answer without another look.
  bool is_final(const LocatedPoint& found) const {
    if (found.barycentric.empty()) return thick_ == nullptr && !options_.project;
    return thick_ == nullptr || thick_->is_known_thick(found.cell);
  }
  /// Replaces the exact location of q by that of x'. found.barycentric is then memory of this object.
  void refine(const double* q, LocatedPoint& found);
  /// Calls visit(cell) for all finite cells within the tolerance of q, until it returns false; `found` is its
  /// exact location.
  template <class Visit>
  void visit_near(const double* q, const LocatedPoint& found, Visit visit);

 private:
  /// A cell and its point nearest to the query.
  struct Candidate {
    CellId cell = invalid_cell;
    double lower = 0, upper = 0;  // of the distance
    bool is_accurate = false;     // no weight is off by more than largest_weight_error
    std::vector<double> weights;
    std::vector<VertexId> face;  // those with positive weights, in the order of the cell
    kernel::ExactNearest exact;  // if that was computed
  };

  void load(CellId cell);
  bool is_thick(CellId cell);
  bool is_accurate(const Candidate& candidate);
  bool is_within(const Candidate& candidate, const double* q);
  void find(CellId cell, const double* q, Candidate& result);
  void find_exactly(CellId cell, const double* q, Candidate& result);
  template <class Visit>
  void visit_ball(const double* q, CellId start, double& radius, Visit visit);
  bool has_far_box(const std::vector<const double*>& points, const double* q, double radius) const;
  CellId finite_cell(const LocatedPoint& found) const;
  void search(const double* q, CellId start);
  void list_thick_cells();
  bool find_thick(const double* q, CellId start, Candidate& result);
  void find_in_hull(const double* q, CellId start, Candidate& result);
  bool precedes(const Candidate& a, const Candidate& b) const;
  std::vector<std::size_t> rows(std::span<const VertexId> vertices) const;
  std::vector<std::size_t> rows_of_cell(CellId cell) const;
  template <class Visit>
  void visit_star(CellId cell, std::span<const VertexId> face, Visit visit);
  void prefer_thick(LocatedPoint& found);
  void answer(const Candidate& candidate, LocatedPoint& found);

  const PointLocator::Impl& where_;
  LocateOptions options_;
  const ThickCells* thick_;
  CellId last_ = invalid_cell;
  kernel::NearestInHull nearest_, heights_;
  std::vector<const double*> points_, facet_;
  std::vector<Candidate> candidates_;
  internal::StampedTable visited_;
  std::vector<std::pair<double, Index>> queue_;  // a heap
  std::vector<double> weights_;
};

/// Calls visit(cell) for the cells that meet the ball of this radius, which may shrink meanwhile, the nearest
/// first, until it returns false.
template <class Visit>
void TolerantLocation::visit_ball(const double* q, CellId start, double& radius, Visit visit) {
  queue_.assign(1, {0.0, index(start)});
  visited_.clear();
  while (!queue_.empty() && queue_.front().first <= radius) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const CellId cell{queue_.back().second};
    queue_.pop_back();
    if (!visited_.insert(index(cell), 0).second) continue;
    if (!visit(cell)) return;
    load(cell);
    for (int i = 0; i <= where_.affine_dimension; ++i) {
      const CellId other = where_.complex.neighbor(cell, i);
      if (where_.complex.is_infinite(other) || visited_.contains(index(other))) continue;
      facet_ = points_;
      facet_.erase(facet_.begin() + i);
      if (has_far_box(facet_, q, radius)) continue;
      nearest_.find(facet_, q, where_.dimension);
      if (nearest_.lower() > radius) continue;
      queue_.emplace_back(nearest_.lower(), index(other));
      std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
    }
  }
}

template <class Visit>
void TolerantLocation::visit_near(const double* q, const LocatedPoint& found, Visit visit) {
  CellId start = finite_cell(found);
  if (start == invalid_cell) return;
  if (found.barycentric.empty()) {
    Candidate candidate;
    find(start, q, candidate);
    if (candidate.upper > options_.tolerance) {
      find_in_hull(q, start, candidate);
      start = last_ = candidate.cell;
      if (candidate.lower > options_.tolerance) return;
    }
  }
  double radius = options_.tolerance;
  visit_ball(q, start, radius, visit);
}

}  // namespace delone::queries
