// SPDX-License-Identifier: BSD-3-Clause
// The points of a triangulation as they are stored, without the checks of its members: for loops over cells,
// and for hidden points, which no member gives.
#pragma once

#include "triangulation/triangulation_impl.hpp"

#include <cstddef>

namespace delone::internal {

class StoredPoints : private Triangulation {
  using Member = const Impl& (Triangulation::*)() const;
  static const Impl& impl_of(const Triangulation& t) {
    return (t.*static_cast<Member>(&StoredPoints::impl))();
  }

 public:
  static const VertexPoints& of(const Triangulation& t) { return impl_of(t).points; }
  /// The coordinates, and the weight if points have one, of an input row, hidden or not; null if it was not
  /// inserted.
  static const double* of_row(const Triangulation& t, std::size_t row) {
    const VertexId v = impl_of(t).vertex_of_row[row];
    return v == invalid_vertex ? nullptr : of(t).point(index(v));
  }
};

}  // namespace delone::internal
