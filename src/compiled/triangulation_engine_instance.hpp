// SPDX-License-Identifier: BSD-3-Clause
// What is compiled of the engine of triangulations for each dimension, in files that CMake makes.
#pragma once

#include "compiled/queries.hpp"
#include "compiled/triangulation_engine_of.hpp"

namespace delone::compiled {

template <int K>
std::unique_ptr<TriangulationEngine> make_triangulation_engine_of(const std::vector<int>& axes,
                                                                  VertexPoints& points,
                                                                  const geometry::Frame& frame,
                                                                  const engine::Effort& effort) {
  return std::make_unique<TriangulationEngineOf<K>>(axes, points, frame, effort);
}

template <int K>
QueryLocation locate(const TriangulationEngineOf<K>& engine, const double* query, Index start) {
  engine.need_functionals();
  return locate_in(engine, query, start);
}

template <int K>
std::vector<CellId> conflict_zone(const TriangulationEngineOf<K>& engine, const double* query, Index start) {
  engine.need_functionals();
  return conflict_zone_in(engine, query, start);
}

template <int K>
Sign unperturbed_side(const TriangulationEngineOf<K>& engine, Index cell, const double* query) {
  return unperturbed_side_in(engine, cell, query);
}

}  // namespace delone::compiled
