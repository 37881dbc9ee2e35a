// SPDX-License-Identifier: BSD-3-Clause
// The other way to all cells: each is created once, beside one that is there already (wrapping.hpp), and the
// whole is proved in the end (proof.hpp). In many dimensions it costs less than insertions, most of whose
// cells do not last (docs/decisions/0007-small-sets-in-high-dimensions-are-wrapped.md).
#pragma once

#include "engine/wrap/proof.hpp"
#include "engine/wrap/wrapping.hpp"

#include <functional>
#include <new>
#include <optional>
#include <vector>

namespace delone::engine {

/// Whether wrapping n points that span k dimensions costs less than inserting them.
constexpr bool is_worth_wrapping(int k, std::size_t n) {
  return (k == 7 && 200 <= n && n <= 4000) || (k == 8 && 100 <= n && n <= 4000);
}

/// Fills an empty store with all cells of the vertices 1 … points.last_vertex(); functionals are not
/// computed. Returns how many are infinite, or nothing, and then there are no cells: where rounded numbers do
/// not say how to go on, with ties, and without memory, of which insertion needs less. `tick` is called
/// often, with the fraction done; what it throws is passed on.
///
/// Points knows coordinates: search() says what is beyond facets; geometry_of(memory) is a geometry for cells
/// in another memory; query_in_one_cell(geometry) is at a point inside exactly one finite cell, exactly
/// proved, or nothing.
template <int K, class Points>
std::optional<Index> wrap_all(CellStore<K>& cells, Points& points, StageCounts& counts,
                              const std::function<void(double)>& tick) {
  const auto first_half = [&](double done) { tick(done / 2); };
  const auto second_half = [&](double done) { tick(0.5 + done / 2); };
  const auto try_to = [&]() -> std::optional<Index> {
    cells.widen_vertices();
    {
      auto search = points.search();
      if (!Wrapping<K, decltype(search)>(cells, search, points.last_vertex()).run(first_half))
        return std::nullopt;
    }
    CellMemory<K> some_cells(K);
    auto geometry = points.geometry_of(some_cells);
    using Proof = engine::Proof<K, decltype(geometry)>;
    some_cells.reserve(Proof::batch_size);
    const auto inner = points.query_in_one_cell(geometry);
    if (!inner) return std::nullopt;
    std::vector<typename decltype(geometry)::Query> queries;
    queries.reserve(points.last_vertex() + 1);
    for (Index v = 0; v <= points.last_vertex(); ++v) queries.push_back(geometry.query_at(v));
    Proof proof(cells, geometry, queries, counts);
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

}  // namespace delone::engine
