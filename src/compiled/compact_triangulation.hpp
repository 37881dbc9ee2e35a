// SPDX-License-Identifier: BSD-3-Clause
// A triangulation without what only insertions need: 8(k + 1) bytes per cell. Queries are exact and slower,
// as nothing is cached: every test is a determinant.
#pragma once

#include "compiled/triangulation_engine.hpp"

#include <memory>

namespace delone::compiled {

class CompactTriangulation : public TriangulationQueries {
 public:
  /// A copy that reads the points, which are the same, from another place.
  virtual std::unique_ptr<CompactTriangulation> copy(const VertexPoints& points) const = 0;
};

/// The cells of `complex`, renumbered without gaps; the rest is copied from `engine`.
std::unique_ptr<CompactTriangulation> make_compact_triangulation(const std::vector<int>& axes,
                                                                 const VertexPoints& points,
                                                                 const TriangulationEngine& engine,
                                                                 const Complex& complex);

}  // namespace delone::compiled
