// SPDX-License-Identifier: BSD-3-Clause
// The other way to all cells: each is created once, beside one that is there already (wrapping.hpp), and the
// whole is proved in the end (proof.hpp). In many dimensions it costs less than insertions, most of whose
// cells do not last (docs/decisions/0007-small-sets-in-high-dimensions-are-wrapped.md).
#pragma once

#include "engine/sphere.hpp"
#include "engine/wrap/proof.hpp"
#include "engine/wrap/wrapping.hpp"

#include <deque>
#include <functional>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace delone::engine {

/// Fills an empty store with all cells of the vertices 1 … points.last_vertex(); functionals are not
/// computed. Returns how many are infinite, or nothing, and then there are no cells: where rounded numbers do
/// not say how to go on, with ties, and without memory, of which insertion needs less. `tick` is called
/// often, with the fraction done; what it throws is passed on.
///
/// Points knows coordinates: search() says what is beyond facets, in one thread; geometry_of(memory) is a
/// geometry for cells in another memory; query_in_one_cell(geometry) is at a point inside exactly one finite
/// cell, exactly proved, or nothing. The cells and their order are the same for every number of threads.
template <int K, class Points>
std::optional<Index> wrap_all(CellStore<K>& cells, Points& points, unsigned threads, StageCounts& counts,
                              const std::function<void(double)>& tick) {
  const auto first_half = [&](double done) { tick(done / 2); };
  const auto second_half = [&](double done) { tick(0.5 + done / 2); };
  const auto try_to = [&]() -> std::optional<Index> {
    cells.widen_vertices();
    {
      std::vector<ForThread<decltype(points.search())>> searches;
      for (unsigned thread = 0; thread < threads; ++thread) searches.push_back({points.search()});
      if (!Wrapping<K, decltype(points.search())>(cells, searches, points.last_vertex()).run(first_half))
        return std::nullopt;
    }
    using Geometry = decltype(points.geometry_of(std::declval<CellMemory<K>&>()));
    using Proof = engine::Proof<K, Geometry>;
    struct SomeCells {
      explicit SomeCells(Points& points) : geometry(points.geometry_of(memory)) {
        memory.reserve(Proof::batch_size);
      }
      CellMemory<K> memory{K};
      Geometry geometry;
    };
    std::deque<SomeCells> some_cells;  // a thread's each
    std::vector<Geometry*> geometries;
    for (unsigned thread = 0; thread < threads; ++thread)
      geometries.push_back(&some_cells.emplace_back(points).geometry);
    const Geometry& geometry = *geometries.front();
    const auto inner = points.query_in_one_cell(geometry);
    if (!inner) return std::nullopt;
    std::vector<typename Geometry::Query> queries;
    queries.reserve(points.last_vertex() + 1);
    for (Index v = 0; v <= points.last_vertex(); ++v) queries.push_back(geometry.query_at(v));
    Proof proof(cells, geometries, queries, counts);
    if (!proof.run(*inner, second_half)) return std::nullopt;
    return proof.num_infinite();
  };
  std::optional<Index> num_infinite;
  try {
    num_infinite = try_to();
  } catch (const std::bad_alloc&) {  // insertion will say so, or do with less
  } catch (...) {
    cells.clear();
    throw;
  }
  if (!num_infinite) cells.clear();
  return num_infinite;
}

/// The first cells of a sphere, all at once. Returns false, and there are no cells, if that cannot be proved
/// to be right.
template <int K, Geometry G, class Points>
bool wrap(Sphere<K, G>& sphere, Points&& points, unsigned threads, const std::function<void(double)>& tick) {
  const std::optional<Index> num_infinite =
      wrap_all(sphere.cells(), points, threads, sphere.effort().stages, tick);
  if (num_infinite) sphere.starts_with(*num_infinite, sphere.cells().num_cells());
  return num_infinite.has_value();
}

}  // namespace delone::engine
