// SPDX-License-Identifier: BSD-3-Clause
// Replaces a conflict zone by the star of the new vertex (§2.6 of the report): one new cell per horizon
// facet, linked along the ridges of the horizon by hashing. (The report rotates about each ridge through the
// dead cells, which is a walk in memory of its own; hashing streams.)
#pragma once

#include "engine/conflict_zone.hpp"
#include "engine/ridge_table.hpp"
#include "engine/workspace.hpp"

#include <algorithm>
#include <iterator>
#include <new>

namespace delone::engine {

/// What has taken the place of a zone.
struct Filling {
  std::size_t num_cells;
  Index num_infinite;  ///< of them; 0 if the zone has no infinite cell either
  Index cell;          ///< one of them
};

/// How many cells of a star are created at a time, so that their records, and those of the cells they are
/// made from, stay in the cache through all steps.
constexpr std::size_t star_block = 128;

/// Gives the cells of the star their slots. The cell that is made from the last facet of a dead cell takes
/// its place; what is made before from other facets of it gets the slot of a dead cell that has none, or a
/// vacant one. So a cell is close to where those were that it is made of, and what is met together stays
/// together on a few pages. Throws what a reserve() throws, and then changes nothing.
///
/// If cells are made in the order of the facets, each of which is read before its cell is written, no dead
/// cell is written over that is still to be read. Nor is a survivor ever next to two cells of one id: when a
/// new cell gets the id of a dead one, all survivors next to that have been linked with what is made from its
/// facets, or there are none.
template <int K, Geometry G>
void replace_slots(CellStore<K>& cells, const G& geometry, ConflictZone& zone) {
  const std::span<HorizonFacet> facets{zone.horizon.data(), zone.num_facets};
  const std::span<const Index> dead{zone.cells.data(), zone.num_cells};
  std::uint8_t* const has_facets = zone.has_facets.data();
  std::uint32_t* const others = zone.others.data();
  Index* const without_facets = zone.without_facets.data();
  std::fill_n(has_facets, dead.size(), std::uint8_t{0});
  std::size_t num_others = 0, num_without = 0, num_infinite = 0;
  // No branch depends on the data.
  for (std::size_t f = facets.size(); f-- > 0;) {
    const std::size_t from = facets[f].dead;
    facets[f].created = dead[from];
    others[num_others] = static_cast<std::uint32_t>(f);
    num_others += has_facets[from];  // later ones
    has_facets[from] = 1;
  }
  for (std::size_t i = dead.size(); i-- > 0;) {
    without_facets[num_without] = dead[i];
    num_without += has_facets[i] == 0;
    num_infinite += geometry.is_infinite(dead[i]) ? 1 : 0;
  }
  const std::size_t reused = std::min(num_others, num_without);
  cells.reserve_vacancies(num_without - reused);
  cells.reserve(num_others - reused);
  for (std::size_t i = 0; i < reused; ++i) facets[others[i]].created = without_facets[i];
  for (std::size_t i = reused; i < num_others; ++i) facets[others[i]].created = cells.allocate();
  for (std::size_t i = reused; i < num_without; ++i) cells.release(without_facets[i]);
  zone.num_infinite = num_infinite;
}

/// The vertices of the zone that are on no horizon facet. Throws std::bad_alloc, and then changes nothing.
template <int K>
void find_swallowed(const CellStore<K>& cells, const ConflictZone& zone, std::vector<Index>& swallowed) {
  std::vector<Index> all, kept;
  for (std::size_t i = 0; i < zone.num_cells; ++i)
    for (int slot = 0; slot <= cells.dimension(); ++slot) all.push_back(cells.vertex(zone.cells[i], slot));
  for (std::size_t f = 0; f < zone.num_facets; ++f) {
    const Index dead = zone.cells[zone.horizon[f].dead];
    for (int i = 0; i <= cells.dimension(); ++i)
      if (i != zone.horizon[f].slot) kept.push_back(cells.vertex(dead, i));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::sort(kept.begin(), kept.end());
  swallowed.clear();
  std::set_difference(all.begin(), all.end(), kept.begin(), kept.end(), std::back_inserter(swallowed));
}

/// Creates triangles first … last − 1 of a star. They have too few ids for vectors of them, as create_cells()
/// uses. `dead`: the cells in conflict, and what their functionals are at the new vertex.
inline void create_triangles(CellStore<2>& cells, Index v, const DeadCells& dead,
                             std::span<HorizonFacet> facets, RidgeTable& ridges, std::size_t first,
                             std::size_t last) {
  for (std::size_t f = first; f < last; ++f) {
    if (f + 8 < facets.size()) cells.prefetch(facets[f + 8].survivor);
    HorizonFacet& facet = facets[f];
    const Index from = dead.cells[facet.dead], survivor = facet.survivor, created = facet.created;
    const int slot = facet.slot;
    const Index* const dead_vertices = cells.wide_vertices(from);
    facet.dead_opposite = dead_vertices[slot];  // the new cell may be where the dead one is
    ridges.note(static_cast<std::uint32_t>(f), dead_vertices, slot);
    Index* const vertices = cells.wide_vertices(created);
    for (int i = 0; i <= 2; ++i) vertices[i] = dead_vertices[i];
    vertices[slot] = v;
    cells.neighbors(created)[slot] = survivor;
    const int mirror = cells.slot_of_neighbor(survivor, from);
    cells.neighbors(survivor)[mirror] = created;
    facet.dead_value = dead.values[facet.dead];
    facet.dead = from;
    facet.survivor_opposite = cells.vertex(survivor, mirror);
  }
}

/// Kills the zone and creates the star of vertex v at q; takes the marks back. If memory or ids run out it
/// throws before anything has changed, the marks included. If that is tracked, finds the vertices that lose
/// all their cells.
template <int K, Geometry G>
Filling retriangulate(CellStore<K>& cells, G& geometry, Index v, const typename G::Query& q,
                      Workspace& work) {
  const int k = cells.dimension();
  ConflictZone& zone = work.zone;
  RidgeTable& ridges = work.ridges;
  cells.admit_vertices(v);
  if (work.tracks_swallowed) find_swallowed(cells, zone, work.swallowed);
  ridges.reserve(zone.num_facets, k);
  geometry.reserve_star(v, std::min(zone.num_facets, star_block));
  const std::span<HorizonFacet> facets{zone.horizon.data(), zone.num_facets};
  replace_slots(cells, geometry, zone);

  for (std::size_t first = 0; first < facets.size(); first += star_block) {
    const std::size_t last = std::min(first + star_block, facets.size());
    const DeadCells dead{zone.cells.data(), zone.values.data()};
    if constexpr (K == 2)
      create_triangles(cells, v, dead, facets, ridges, first, last);
    else
      create_cells(cells.links(), v, dead, facets.subspan(first, last - first), work.shares_survivors);
    ridges.hash(cells, facets, first, last);
    try {
      for (const std::uint32_t f : geometry.create_star(v, q, facets.subspan(first, last - first))) {
        const Index cell = facets[first + f].created;
        const auto vertices = cells.vertices(cell);
        geometry.create(cell, vertices, cells.infinite_slot(cell), facets[first + f].slot);
      }
    } catch (const std::bad_alloc&) {
      // Where the dimension is chosen at run time, what is cached takes memory to compute. It is too late to
      // change nothing: without it, exact stages decide.
      for (std::size_t f = first; f < last; ++f)
        geometry.give_up(facets[f].created, cells.infinite_slot(facets[f].created) >= 0);
    }
  }
  ridges.link(cells, facets);
  // Created cells have no marks.
  if (work.cells_have_marks)
    for (std::size_t i = 0; i < zone.num_marked; ++i) cells.marks().set(zone.marked[i], Mark::unseen);
  Index num_infinite = 0;
  if (zone.num_infinite > 0)  // else the infinite vertex is on no facet of the zone
    for (const HorizonFacet& facet : facets) num_infinite += geometry.is_infinite(facet.created) ? 1 : 0;
  return {facets.size(), num_infinite, facets.back().created};
}

}  // namespace delone::engine
