// SPDX-License-Identifier: BSD-3-Clause
// The points of a triangulation as they are stored, including hidden points, which its members do not give.
// Skips the checks of the members, for loops over cells.
#pragma once

#include "triangulation/triangulation_impl.hpp"

#include <cstddef>

namespace delone::triangulation {

class StoredPoints : private Triangulation {
  using Member = const Impl& (Triangulation::*)() const;
  static const Impl& impl_of(const Triangulation& t) {
    return (t.*static_cast<Member>(&StoredPoints::impl))();
  }

 public:
  /// Moves and reweights rows unless a new triangulation costs less: then returns false, and has changed
  /// nothing. REQUIRES that each row exists and is in a list once, and finite numbers.
  static bool edit_in_place(Triangulation& t, const construction::RowEdits& edits) {
    return const_cast<Impl&>(impl_of(t)).edit_in_place(edits);
  }
  /// The side of the sphere of a finite cell that q lies on, which only the products tell.
  static Side in_sphere(const Triangulation& t, CellId cell, std::span<const double> query) {
    using Predicate = Side (Triangulation::*)(CellId, std::span<const double>, double) const;
    return (t.*static_cast<Predicate>(&StoredPoints::side_of_sphere))(cell, query, 0.0);
  }
  /// The cells in conflict with a query.
  static std::vector<CellId> conflict_zone(const Triangulation& t, std::span<const double> query, CellId hint,
                                           double weight = 0) {
    using Find =
        std::vector<CellId> (Triangulation::*)(std::span<const double>, double, std::optional<CellId>) const;
    return (t.*static_cast<Find>(&StoredPoints::conflict_zone_of))(query, weight, hint);
  }
  /// The vertex of each row, hidden or not; invalid_vertex for rows that were not inserted.
  static const std::vector<VertexId>& vertices_of_rows(const Triangulation& t) {
    return impl_of(t).sites().vertices_of_rows();
  }
  static const sites::VertexPoints& of(const Triangulation& t) { return impl_of(t).points(); }
  /// The coordinates of an input row, followed by its weight if points have one; hidden or not. Null if the
  /// row was not inserted.
  static const double* of_row(const Triangulation& t, std::size_t row) {
    const VertexId v = impl_of(t).sites().vertex_of(row);
    return v == invalid_vertex ? nullptr : of(t).point(index(v));
  }
};

}  // namespace delone::triangulation
