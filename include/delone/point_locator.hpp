// SPDX-License-Identifier: BSD-3-Clause
// Many questions to one triangulation: in which cell, with which barycentric coordinates, next to which
// vertex.
#pragma once

#include <delone/triangulation.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace delone {

/// Where a query lies (exactly), and its barycentric coordinates (rounded).
struct LocatedPoint {
  Location::Kind kind = Location::Kind::outside_affine_hull;
  /// A finite cell that contains the query; outside the hull the infinite cell of a hull facet that has the
  /// query strictly beyond it; invalid_cell outside the affine hull.
  CellId cell = invalid_cell;
  /// k+1 numbers ≥ 0 with sum 1, up to rounding: the query is the sum of the vertices of the cell times
  /// these. None is off by more than 2⁻³⁶, whatever the shape of the cell; mostly it is a few units of 2⁻⁵³.
  /// A number is 0 exactly if the facet opposite that vertex contains the query: the vertices with positive
  /// numbers span the smallest face that contains it. Empty outside. Valid during the call that it is passed
  /// to.
  std::span<const double> barycentric;
};

/// Answers queries about a triangulation, which it refers to: valid until the next insertion. `const` members
/// may be called from several threads at once. A batch is visited along a Hilbert curve, each walk starting
/// where the one before ended; answers are given with the number of their query.
///
/// Method: the visibility walk with signs of orientations. For k = d ≤ 6 all of a cell come from one table of
/// minors with a certified bound, those that it cannot tell from exact arithmetic. Cost: for a batch as dense
/// as the vertices O(1) cells per query, and O(q log q) comparisons.
class PointLocator {
 public:
  using Visit = std::function<void(std::size_t query, const LocatedPoint& where)>;

  explicit PointLocator(const Triangulation& triangulation);
  PointLocator(PointLocator&&) noexcept;
  PointLocator& operator=(PointLocator&&) noexcept;
  ~PointLocator();

  /// Locates q queries (q×d coordinates) and calls `visit` once for each, in no particular order. What
  /// `visit` throws ends the batch and is passed on. Throws bad_dimension, not_finite (rows() names the
  /// queries), out_of_memory.
  void locate(std::span<const double> queries, const Visit& visit) const;

  /// For each of q queries the vertex of least distance; of a regular triangulation, of least power |x − p|²
  /// − weight: the site whose region of the diagram contains the query. Exact; of several the one with the
  /// first input row. invalid_vertex if there is no vertex. `visit` as for locate(). The first call makes a
  /// table of all edges, O(cells·k). Throws as locate(), and unsupported for a furthest-site triangulation.
  void nearest(std::span<const double> queries,
               const std::function<void(std::size_t query, VertexId nearest)>& visit) const;

  /// The k nearest vertices of each query, or all if there are fewer, nearest first; of equally near ones
  /// those with smaller first rows first. Exact. By power for a regular triangulation, and else as above.
  /// Valid during the call that they are passed to. Method: best-first search over edges, O(k·e·log(k·e))
  /// per query for e edges at a vertex. Throws as above, and invalid_argument for k = 0.
  void nearest(std::span<const double> queries, std::size_t k,
               const std::function<void(std::size_t query, std::span<const VertexId> nearest)>& visit) const;

  /// The vertices joined to each vertex by an edge, the infinite vertex excluded, increasing: those of v are
  /// entries offsets[v] … offsets[v+1]−1 of `vertices`; for v up to num_vertex_slots(). Made on first use,
  /// O(cells·k).
  struct Edges {
    std::vector<std::size_t> offsets;
    std::vector<VertexId> vertices;
  };
  const Edges& edges() const;

  struct Impl;

 private:
  template <class Each>
  void each_nearest(std::span<const double> queries, Each each) const;

  std::unique_ptr<Impl> impl_;
};

/// The sign of |q − a|² − weight_a − (|q − b|² − weight_b), exactly: negative if q is nearer to a. All
/// finite, as many coordinates of each. Stages: binary64 with a certified bound, then integers. O(d).
Sign compare_distances(std::span<const double> q, std::span<const double> a, std::span<const double> b,
                       double weight_a = 0, double weight_b = 0);

}  // namespace delone
