// SPDX-License-Identifier: BSD-3-Clause
#include "particles/periodic_sites.hpp"

#include "base/quick_rounds.hpp"
#include "periodic/stored_set.hpp"

#include <algorithm>

namespace delone::particles {

PeriodicSites::PeriodicSites(const PeriodicTriangulation& triangulation)
    : set_(periodic::StoredSet::set(triangulation)),
      ghosts_(periodic::StoredSet::ghosts(triangulation)),
      given_(triangulation.points()),
      has_wraps_(std::ranges::any_of(set_.wraps, [](std::int32_t k) { return k != 0; })) {}

std::vector<unsigned char> PeriodicSites::have_cells() const {
  const Complex complex = triangulation().complex();
  std::vector<unsigned char> have(complex.num_vertex_slots(), 0);
  for (Index v = 1; v < complex.num_vertex_slots(); ++v)
    have[v] = complex.is_vertex(VertexId{v}) && has_cell(v) ? 1 : 0;
  return have;
}

void PeriodicSites::find_offsets(Index site, std::span<const Index> vertices,
                                 std::vector<std::int32_t>& offsets) const {
  const std::size_t r = set_.rank;
  offsets.assign(vertices.size() * r, 0);
  const std::int32_t* const of_site = set_.wraps.data() + row_of(site) * r;
  std::vector<std::int64_t> sum(r);
  for (std::size_t slot = 0; slot < vertices.size(); ++slot) {
    const Index v = vertices[slot];
    if (!has_wraps_ && has_cell(v)) continue;
    const auto shift = ghosts_.offset_of(VertexId{v});
    const std::int32_t* const of_vertex = set_.wraps.data() + row_of(v) * r;
    for (std::size_t i = 0; i < r; ++i) sum[i] = std::int64_t{shift[i]} + of_site[i] - of_vertex[i];
    set_.to_given_basis(sum, offsets.data() + slot * r);
  }
}

}  // namespace delone::particles
