// SPDX-License-Identifier: BSD-3-Clause
// Where queries to a periodic triangulation lie: in which cell, translated by what.
//
// A query is moved into the box and located among the points of the set and their images. A cell with a
// vertex in the box is one of the whole set, and is the answer. Others may be none. Then the query is
// translated so that a vertex of the cell comes to lie in the box, and located again. If no vertex will do,
// all translations within the reach are tried. That is enough: let p be a vertex of the cell of the whole set
// that contains the query. All vertices of a cell are within 2ρ of each other along the lattice (Period), and
// so is the query from p. With p in the box, the query is at most the reach away from its translate in the
// box.
//
// Outside. A facet of the hull with a vertex in the box is one of the whole set, and what is beyond it is
// outside. If no translate of the query is in a cell of the whole set, the query is outside, too.
#pragma once

#include "periodic/cell_classes.hpp"
#include "periodic/stored_set.hpp"
#include "queries/point_locator_impl.hpp"

#include <delone/periodic.hpp>
#include <delone/point_locator.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace delone::periodic {

/// Queries in the box, on the grid.
struct WrappedQueries {
  std::vector<double> points;       ///< q×d, numbers of the set
  std::vector<std::int32_t> wraps;  ///< q×r: the query is the point plus Σ wraps_i a_i
};

/// The parts of a periodic triangulation that queries read.
struct QueryParts {
  explicit QueryParts(const PeriodicTriangulation& t);

  const PeriodicTriangulation& triangulation;
  const PeriodicSet& set;
  const GhostTriangulation& ghosts;
  const CellClasses& classes;
  const Complex complex;
  PointLocator::Impl where;  ///< in the triangulation with ghosts
  std::size_t dimension, rank, corners;

  /// Throws Errc::not_finite, bad_dimension, invalid_argument.
  WrappedQueries wrap(std::span<const double> queries, unsigned threads) const;
  const double* point(VertexId v) const { return where.point(v); }
  std::int64_t wrap_of(std::size_t row, std::size_t i) const { return set.wraps[row * rank + i]; }
  std::uint32_t row_of(VertexId v) const { return ghosts.image_of(v).row; }
  /// The point of a vertex translated by `by`, seen from a query that was wrapped by `wraps`: how the point
  /// as it was given is translated, in terms of the caller's lattice vectors.
  void given_offset(VertexId v, std::span<const std::int64_t> by, const std::int32_t* wraps,
                    std::int32_t* given) const;
  /// Likewise of a cell of the caller.
  void given_offset_of_cell(SignedIndex cell, std::span<const std::int64_t> by, const std::int32_t* wraps,
                            std::int32_t* given) const;
  /// x − Σ k_i a_i.
  void subtract(std::span<const std::int64_t> k, std::span<double> x) const;
};

/// Where a query in the box lies. Valid during the call to which it is passed.
struct Place {
  Location::Kind kind = Location::Kind::outside_affine_hull;
  SignedIndex cell = -1;                 ///< the number of a canonical cell; −1 outside
  std::span<const std::int64_t> offset;  ///< that cell translated by Σ offset_i a_i contains the query
  std::span<const double> barycentric;   ///< by vertices of the class
};

/// Finds the place of one query after the other; each thread has its own.
class PlaceFinder {
 public:
  /// `with_coordinates`: whether barycentric coordinates are wanted, and not only whether they are 0.
  PlaceFinder(const QueryParts& parts, bool with_coordinates);

  /// `located`: where q is in the triangulation with ghosts.
  Place find(const double* q, const LocatedPoint& located);

 private:
  bool find_translate(const double* q, CellId cell);
  bool is_at(const double* q, std::span<const std::int64_t> k, CellId hint);
  void choose_first(CellId cell);
  void order_coordinates(CellId cell);

  const QueryParts& parts_;
  const bool with_coordinates_;
  // Of the cell that was found: for the query less shift_.
  Location::Kind kind_{};
  CellId cell_ = invalid_cell;
  Offset shift_, offset_, none_;
  std::vector<double> x_, weights_, ordered_;  // weights_ by vertices of cell_
  SignedIndex number_ = -1;
  std::vector<std::int32_t> given_, least_;
};

/// Calls visit(query, place) for all queries, which make_visit() makes for each thread.
using PlaceVisit = std::function<void(std::size_t query, const Place& place)>;
void find_places(const QueryParts& parts, const WrappedQueries& queries, bool with_coordinates,
                 const std::function<PlaceVisit()>& make_visit, unsigned threads);

}  // namespace delone::periodic
