// SPDX-License-Identifier: BSD-3-Clause
#include "compiled/triangulation_engine.hpp"

#include "base/compiled_dimension.hpp"
#include "compiled/queries.hpp"
#include "compiled/triangulation_engine_of.hpp"

namespace delone::compiled {
namespace {

template <class Ask>
decltype(auto) visit(const TriangulationEngine& engine, Ask&& ask) {
  return visit<TriangulationEngineOf, internal::largest_compiled_dimension>(engine, std::forward<Ask>(ask));
}

}  // namespace

std::unique_ptr<TriangulationEngine> make_triangulation_engine(const std::vector<int>& axes,
                                                               VertexPoints& points,
                                                               const geometry::Frame& frame,
                                                               const engine::Effort& effort,
                                                               bool force_runtime_dimension) {
  return internal::with_compiled_dimension(force_runtime_dimension ? 0 : axes.size(), [&](auto k) {
    return make_triangulation_engine_of<k()>(axes, points, frame, effort);
  });
}

const geometry::Frame& frame_of(const TriangulationEngine& engine) {
  return visit(engine,
               [](const auto& instance) -> const geometry::Frame& { return instance.geometry().frame(); });
}

const engine::Effort& effort_of(const TriangulationEngine& engine) {
  return visit(engine,
               [](const auto& instance) -> const engine::Effort& { return instance.sphere().effort(); });
}

std::size_t bytes_of(const TriangulationEngine& engine) {
  return visit(engine, [](const auto& instance) { return instance.bytes(); });
}

Complex complex_of(const TriangulationEngine& engine, Index num_vertices,
                   std::span<const CellId> cell_of_vertex) {
  return visit(engine,
               [&](const auto& instance) { return complex_in(instance, num_vertices, cell_of_vertex); });
}

QueryLocation locate(const TriangulationEngine& engine, const double* query, Index start) {
  return visit(engine, [&](const auto& instance) { return locate(instance, query, start); });
}

std::vector<CellId> conflict_zone(const TriangulationEngine& engine, const double* query, Index start) {
  return visit(engine, [&](const auto& instance) { return conflict_zone(instance, query, start); });
}

Sign unperturbed_side(const TriangulationEngine& engine, Index cell, const double* query) {
  return visit(engine, [&](const auto& instance) { return unperturbed_side(instance, cell, query); });
}

void find_changed_cells(const TriangulationEngine& engine, std::vector<CellId>& gone,
                        std::vector<CellId>& made) {
  visit(engine, [&](const auto& instance) { instance.sphere().changed_cells(gone, made); });
}

void find_removed_infinite_cells(const TriangulationEngine& engine, std::vector<CellId>& gone) {
  visit(engine, [&](const auto& instance) { instance.sphere().changed_infinite_cells(gone); });
}

bool shares_batches_of(const TriangulationEngine& engine, std::size_t num_vertices) {
  return visit(engine, [&](const auto& instance) {
    return instance.points().form != kernel::RowForm::furthest_point &&
           shares_batches_of(instance, num_vertices);
  });
}

bool is_worth_wrapping(const TriangulationEngine& engine, std::size_t num_points) {
  return visit(engine, [&](const auto& instance) { return instance.is_worth_wrapping(num_points); });
}

}  // namespace delone::compiled
