// SPDX-License-Identifier: BSD-3-Clause
// The rays of a cone that grows smaller row by row, as the double description method sees them without their
// coordinates: on which rows each ray lies, which later row removes it first, and the edges that later rows
// cut (Fukuda and Prodon, doi:10.1007/3-540-61576-8_77: an edge is kept only for the row that cuts it first).
#pragma once

#include "polyhedra/adjacency.hpp"
#include "polyhedra/bit_rows.hpp"
#include "polyhedra/integer_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace delone::polyhedra {

/// A ray, by a number that is used again after its end.
using RayId = std::uint32_t;

/// An edge of the cone with its ends on both sides of a row.
struct CutEdge {
  RayId positive, negative;
  friend auto operator<=>(const CutEdge&, const CutEdge&) = default;
};

/// Rays that a step makes, before they get their numbers. Each is where a row meets an edge.
struct NewRays {
  std::vector<CutEdge> edges;
  BitRows zeros;
  std::vector<std::uint32_t> first_negative;
};

class RayGraph {
 public:
  static constexpr std::uint32_t none = Adjacency::no_key;

  RayGraph() = default;
  /// Of the cone that the first `dimension` rows define, which are independent. `rows` must outlive the
  /// graph.
  explicit RayGraph(const Rows& rows);

  std::size_t num_rows() const { return rows_->size(); }
  std::size_t dimension() const { return dimension_; }
  /// The rays at present, in no particular order.
  const std::vector<RayId>& rays() const { return rays_; }
  /// One more than the largest number of a ray so far.
  std::size_t capacity() const { return first_negative_.size(); }
  /// The rows that a ray lies on: all of them if no later row removes it, otherwise those before that row.
  ConstBits zeros(RayId ray) const { return zeros_[ray]; }

  /// How many rays lie on one row less than there are dimensions, of those that have cut something.
  std::size_t num_simple_rays() const;

  /// Adds a ray of the simplicial cone. When all are there, connect_all() makes their edges.
  void add(ConstBits zeros, std::uint32_t first_negative);
  void connect_all();

  /// Whether the row cuts anything.
  bool cuts(std::size_t row) const { return !removed_by_[row].empty(); }
  /// The edges that the row cuts.
  const std::vector<CutEdge>& edges_cut_by(std::size_t row);
  /// Removes the rays beyond the row, and adds those that were made; their numbers are appended to `ids`.
  void commit(std::size_t row, const NewRays& made, std::vector<RayId>& ids);
  /// Finds the edges between the rays that lie on the row that was committed last, in up to `threads` threads
  /// (Options::threads).
  void connect(std::size_t row, unsigned threads);

 private:
  bool is_zero(RayId ray, std::size_t row) const { return test(zeros_[ray], row); }
  RayId new_id();
  void insert(RayId ray, ConstBits zeros, std::uint32_t first_negative);
  void add_edge(RayId a, RayId b);
  std::size_t rank_of(const std::vector<std::size_t>& rows) const;
  void collect_section(std::size_t row);

  const Rows* rows_ = nullptr;
  std::size_t dimension_ = 0;
  BitRows zeros_;
  std::vector<std::uint32_t> first_negative_;
  std::vector<RayId> rays_, free_ids_;
  std::vector<std::uint32_t> place_;            // in rays_
  std::vector<std::uint64_t> used_;             // rows that have cut something, and the first ones
  std::vector<std::vector<CutEdge>> edges_;     // by the row that cuts them
  std::vector<std::vector<RayId>> removed_by_;  // by row
  std::vector<RayId> section_;
  Adjacency adjacency_;
};

}  // namespace delone::polyhedra
