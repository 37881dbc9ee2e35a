// SPDX-License-Identifier: BSD-3-Clause
// From the arrays of an exact diagram to those of the diagram with a tolerance, in the order of the calls in
// run(). What is kept and what goes is stated in <delone/voronoi.hpp>; all distances that decide are upper
// bounds (kernel/distance_bound.hpp), computed in an order that does not depend on numbers of vertices.
#pragma once

#include "base/axis_scale.hpp"
#include "kernel/distance_bound.hpp"
#include "voronoi/ridge_width.hpp"

#include <delone/voronoi.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace delone::voronoi {

class DiagramSimplifier {
 public:
  /// `scale`: with the tolerance; distances are those where axes are scaled. REQUIRES an exact diagram with
  /// ridges, which stays valid, and a tolerance > 0.
  DiagramSimplifier(const Diagram& exact, const internal::AxisScale& scale);

  /// Whether the tolerance changes anything. If so, `out`, which has the sites and the dimensions already,
  /// gets vertices, ridges, regions and rays.
  bool run(Diagram& out) {
    cluster_vertices();
    merge_rays();
    if (k_ == 2) cut_cycles_of_regions();
    choose_ridges();
    if (!is_changed_) return false;
    if (k_ == 3) drop_straight_vertices();
    number_vertices(out);
    write_ridges(out);
    write_regions(out);
    write_rays(out);
    out.max_displacement_ = max_displacement_;
    return true;
  }

 private:
  /// Pairs of vertices that an edge connects, for k > 3 a ridge, and that may be in one ball of radius ε;
  /// some several times.
  std::vector<std::pair<Index, Index>> short_edges() const;
  /// Finds the representative of each vertex, greedily: the first vertex that has none, of most ridges, takes
  /// all without one that are within ε of it and that edges among these connect with it.
  void cluster_vertices();
  /// Makes one of the rays from one vertex whose hull facets are in one hyperplane.
  void merge_rays();
  bool in_one_facet(std::span<const SignedIndex> ray, std::span<const SignedIndex> rows) const;
  /// k = 2: the cycles of regions, each vertex once, and the sides that they lose by that.
  void cut_cycles_of_regions();
  /// The vertices of each ridge, representatives; none for those that go.
  void choose_ridges();
  bool is_thin(std::size_t ridge, std::span<const SignedIndex> vertices, bool is_exact);
  bool is_single_ray(std::size_t ridge) const;
  std::span<const Index> regions_of(SignedIndex vertex);
  /// k = 3: see Diagram. Candidates are in the order of their coordinates.
  void drop_straight_vertices();
  std::vector<SignedIndex> vertices_that_lost_ridges() const;
  /// Whether a vertex of a ridge is within ε of the edge that it would leave behind, and all that were
  /// dropped from this edge before; `farthest`: how far they are.
  bool is_straight(std::span<const SignedIndex> ridge, SignedIndex vertex, double& farthest);
  void number_vertices(Diagram& out);
  void write_ridges(Diagram& out) const;
  void write_regions(Diagram& out);
  void write_rays(Diagram& out) const;

  /// Maps a list to representatives. Cycles lose neighbors that are equal; where a vertex is left twice, the
  /// part between is cut off, or all but the part: what keeps −1, or has the larger circumference.
  void represent(std::span<const SignedIndex> list, bool is_cycle, std::vector<SignedIndex>& result) const;
  double circumference(std::span<const SignedIndex> part) const;
  bool is_moved(std::span<const SignedIndex> list) const;
  SignedIndex representative(SignedIndex v) const {
    return v < 0 ? v : static_cast<SignedIndex>(representative_[static_cast<std::size_t>(v)]);
  }
  std::span<const SignedIndex> ridge(std::size_t i) const { return Diagram::list(items_, offsets_, i); }
  template <class Number>
  const double* at(Number v) const {
    return (scaled_.empty() ? in_.vertices_ : scaled_).data() + static_cast<std::size_t>(v) * d_;
  }
  std::size_t region_of_row(SignedIndex row) const {
    return static_cast<std::size_t>(in_.point_region_[static_cast<std::size_t>(row)]);
  }
  bool comes_before(Index v, Index w) const;

  const Diagram& in_;
  const double tolerance_;
  const std::size_t k_, d_, num_vertices_;
  const std::vector<double> scaled_;  // the vertices, unless axes are as they are
  bool is_changed_ = false;
  double max_displacement_ = 0;
  std::vector<Index> representative_;                          // of each vertex
  std::vector<Index> first_ray_;                               // of each ray, the one it becomes
  std::vector<std::pair<SignedIndex, Index>> rays_by_vertex_;  // exact ones, sorted
  std::vector<SignedIndex> items_;      // of ridges, in the numbers of the exact diagram
  std::vector<std::int64_t> offsets_;   // of exact ridges in items_; empty lists for those that go
  std::vector<unsigned char> is_gone_;  // by exact ridge
  std::vector<SignedIndex> cycles_;     // k = 2: of regions, likewise
  std::vector<std::int64_t> cycle_offsets_{0};
  std::vector<std::array<SignedIndex, 3>> lost_;  // k = 2: region and the two ends, smaller one first; sorted
  std::vector<unsigned char> is_dropped_;         // k = 3, by vertex
  std::vector<SignedIndex> number_;               // by vertex; −1: not in the result
  std::vector<Index> regions_at_, region_starts_;  // k > 3, made on first use
  RidgeWidth width_;
  kernel::FlatDistance line_;
  std::vector<const double*> corners_, facet_;
};

}  // namespace delone::voronoi
