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

VertexOrder PeriodicSites::order() const {
  const Complex complex = triangulation().complex();
  VertexOrder order;
  order.ids.push_back(index(infinite_vertex));
  std::vector<Index> ghosts;
  for (Index v = 1; v < complex.num_vertex_slots(); ++v)
    if (complex.is_vertex(VertexId{v})) (has_cell(v) ? order.ids : ghosts).push_back(v);
  order.last_site = static_cast<Index>(order.ids.size() - 1);
  internal::QuickRounds round;
  std::sort(ghosts.begin(), ghosts.end(), [&](Index v, Index w) {
    round();
    if (row_of(v) != row_of(w)) return row_of(v) < row_of(w);
    return std::ranges::lexicographical_compare(ghosts_.offset_of(VertexId{v}),
                                                ghosts_.offset_of(VertexId{w}));
  });
  order.ids.insert(order.ids.end(), ghosts.begin(), ghosts.end());
  order.ranks.assign(complex.num_vertex_slots(), 0);
  for (std::size_t rank = 0; rank < order.ids.size(); ++rank)
    order.ranks[order.ids[rank]] = static_cast<Index>(rank);
  return order;
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
