// SPDX-License-Identifier: BSD-3-Clause
// Location with a tolerance τ, after the exact location of a query x. The rules and their guarantee are at
// LocateOptions.
#pragma once

#include "kernel/nearest_in_hull.hpp"
#include "queries/point_locator_impl.hpp"
#include "queries/thick_cells.hpp"

#include <unordered_set>
#include <vector>

namespace delone::internal {

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
  void search(const double* q, CellId start);
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
  std::unordered_set<Index> visited_;
  std::vector<double> weights_;
};

}  // namespace delone::internal
