// SPDX-License-Identifier: BSD-3-Clause
// What the parts of PointLocator share: the triangulation, with direct access to its coordinates.
#pragma once

#include "order/insertion_order.hpp"
#include "queries/thick_cells.hpp"
#include "triangulation/stored_points.hpp"

#include <delone/point_locator.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace delone {

struct PointLocator::Impl {
  explicit Impl(const Triangulation& t)
      : triangulation(t),
        complex(t.complex()),
        points(internal::StoredPoints::of(t)),
        dimension(t.dimension()),
        affine_dimension(t.affine_dimension()),
        axes(t.axes()) {}

  const Triangulation& triangulation;
  Complex complex;
  const VertexPoints& points;
  int dimension, affine_dimension;
  std::vector<int> axes;

  mutable std::once_flag edges_once;
  mutable Edges edges;
  mutable std::once_flag side_once;
  mutable double side = 0;
  mutable std::mutex thick_mutex;
  mutable std::shared_ptr<const internal::ThickCells> thick;  // for the tolerance used last

  const double* point(VertexId v) const { return points.point(index(v)); }
  /// Calls each(rows) for all queries, in pieces, each in the order of a Hilbert curve. Pieces bound the time
  /// until the first call, so that a callback can stop a large batch early. Throws as locate().
  template <class Each>
  void in_pieces(std::span<const double> queries, Each each) const {
    std::vector<Index> rows = rows_of(queries);
    for (std::size_t first = 0; first < rows.size(); first += piece) {
      const auto part = std::span(rows).subspan(first, std::min(piece, rows.size() - first));
      if (part.size() > 8) order::hilbert_sort(PointsView(queries, dimension), part);
      each(std::span<const Index>(part));
    }
  }
  /// Calls each(query) for all queries in this order.
  template <class Each>
  void in_order(std::span<const double> queries, Each each) const {
    in_pieces(queries, [&](std::span<const Index> rows) {
      for (const Index query : rows) each(query);
    });
  }
  /// The longest side of the bounding box of the vertices; 0 if there are none. Kept.
  double longest_side() const;
  /// The kinds of cells for this tolerance; null for 0.
  std::shared_ptr<const internal::ThickCells> thick_cells(double tolerance) const;
  static constexpr std::size_t piece = std::size_t{1} << 18;

 private:
  /// Checks the queries and returns their numbers. Throws as locate().
  std::vector<Index> rows_of(std::span<const double> queries) const;
};

}  // namespace delone
