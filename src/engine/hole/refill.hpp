// SPDX-License-Identifier: BSD-3-Clause
// Holes in a sphere and what fills them: a vertex is removed, or vertices have moved.
#pragma once

#include "engine/change.hpp"
#include "engine/hole/hole_filler.hpp"
#include "engine/sphere.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace delone::engine {

namespace detail {

/// Fills the hole that the workspace has as zone, on record.
template <int K, Geometry G>
std::optional<Filling> fill_hole(Sphere<K, G>& sphere, HoleFiller<K, G>& filler) {
  UndoLog<K>& log = sphere.log();
  const std::optional<Filling> made = filler.fill(sphere.workspace().zone, sphere.effort().stages,
                                                  [&](std::size_t count) { log.reserve_new(count); });
  if (made) log.note_new(filler.created());
  return made;
}

}  // namespace detail

/// Removes vertex v, one of whose cells is `cell`: done, flat or costly. `filler`: of these cells and this
/// geometry. Strong guarantee.
template <int K, Geometry G>
Outcome remove(Sphere<K, G>& sphere, Index v, Index cell, HoleFiller<K, G>& filler) {
  ConflictZone& zone = sphere.workspace().zone;
  sphere.workspace().clear();
  bool is_flat = false;
  const bool is_filled = sphere.replace_zone(
      [&] {
        filler.hole().open_star(sphere.cells(), sphere.geometry(), v, cell, zone);
        is_flat = filler.is_flat_without_leaving(zone, sphere.cells().num_cells() - sphere.num_infinite());
      },
      [&] { return is_flat ? std::nullopt : detail::fill_hole(sphere, filler); });
  return is_filled ? Outcome::done : is_flat ? Outcome::flat : Outcome::costly;
}

/// Replaces cells, which are different, by the Delaunay cells of their vertices, after these have moved.
/// Returns false, and nothing has changed, if no such cells fit their place (HoleFiller::fill()). Strong
/// guarantee.
template <int K, Geometry G>
bool refill(Sphere<K, G>& sphere, std::span<const Index> dead, HoleFiller<K, G>& filler) {
  sphere.workspace().clear();
  return sphere.replace_zone(
      [&] { filler.hole().open_cells(sphere.cells(), sphere.geometry(), dead, sphere.workspace().zone); },
      [&] { return detail::fill_hole(sphere, filler); });
}

}  // namespace delone::engine
