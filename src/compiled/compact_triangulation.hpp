// SPDX-License-Identifier: BSD-3-Clause
// A triangulation without what only insertions need: 8(k + 1) bytes per cell. Queries are exact and slower,
// as nothing is cached: every test is a determinant.
#pragma once

#include "compiled/triangulation_engine.hpp"

#include <memory>
#include <span>
#include <vector>

namespace delone::compiled {

class CompactTriangulation {
 public:
  /// The cells of `complex`, renumbered without gaps; the rest is copied from `engine`.
  CompactTriangulation(const std::vector<int>& axes, const VertexPoints& points,
                       const TriangulationEngine& engine, const Complex& complex);
  /// A copy that reads the points, which are the same, from another place.
  CompactTriangulation(const VertexPoints& points, const CompactTriangulation& other);
  ~CompactTriangulation();

  struct Held;
  const Held& held() const { return *held_; }

 private:
  std::unique_ptr<Held> held_;
};

// As of an engine; walks that are not given a cell to start from start anywhere.
const geometry::Frame& frame_of(const CompactTriangulation& compact);
const engine::Effort& effort_of(const CompactTriangulation& compact);
std::size_t bytes_of(const CompactTriangulation& compact);
Complex complex_of(const CompactTriangulation& compact, Index num_vertices,
                   std::span<const CellId> cell_of_vertex);
QueryLocation locate(const CompactTriangulation& compact, const double* query, Index start);
std::vector<CellId> conflict_zone(const CompactTriangulation& compact, const double* query, Index start);
Sign unperturbed_side(const CompactTriangulation& compact, Index cell, const double* query);

}  // namespace delone::compiled
