// SPDX-License-Identifier: BSD-3-Clause
// Where walks to points that come in no order start: a sample of the vertices, triangulated by itself, whose own walks start
// in a sample of the sample. The Delaunay hierarchy of Devillers (2002, doi:10.1142/S0129054102001035).
#pragma once

#include "front_ends/triangulation_impl.hpp"

#include <vector>

namespace delone {

/// Expected cost of an insertion and of a query: a walk past a constant number of cells on each of log(n) levels, for points
/// with evenly spread walks.
class Triangulation::Impl::Landmarks {
 public:
  explicit Landmarks(int dimension);

  /// Whether a vertex belongs to the sample.
  static bool include(Index vertex) { return vertex % one_in == 0; }
  /// Adds vertices of the sample, and their points. Throws std::bad_alloc; what is known then is less than what was given.
  void add(Index vertex, std::span<const double> point);
  void add(const std::vector<Index>& vertices, std::span<const double> points);

  /// A vertex close to a point, as a rule; invalid_index if there is none.
  Index near(const double* point) const;

 private:
  static constexpr Index one_in = 32;

  Impl sample_;
  std::vector<Index> vertex_of_row_;  // of the sample
};

}  // namespace delone
