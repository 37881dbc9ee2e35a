// SPDX-License-Identifier: BSD-3-Clause
// Up to 7 dimensions the vertices of a cell, and likewise its neighbors, fit a vector of eight ids. Beyond,
// and where vectors are shorter, they take several vectors, and the last one may reach past their end. Ids
// that it reads there are not used; what it writes there is either unchanged or overwritten next. Vectors of
// neighbors are cut off at the last neighbor: the next cell may be on a cache line that nothing else needs.
#include "engine/link_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "base/compiler.hpp"

#include <algorithm>
#include <bit>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "engine/link_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace delone::engine {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// In the following K is k if that is from 2 to 8, 1 if it is at most 1, and 0 if it is more than 8. Ids says
// how vertices are stored; in vectors they are wide.

/// The vectors for the ids of a cell.
template <int K>
using IdTag =
    hn::FixedTag<std::uint32_t,
                 std::min<std::size_t>({HWY_LANES(std::uint32_t), 8, K > 0 ? std::bit_ceil(K + 1u) : 8})>;

/// The pieces of a cell's ids.
template <int K>
struct Pieces {
  using Ids = hn::Vec<IdTag<K>>;
  static constexpr std::size_t lanes = hn::MaxLanes(IdTag<K>());

  explicit Pieces(int k) : num_ids(static_cast<std::size_t>(K > 1 ? K : k) + 1) {}
  std::size_t num() const { return (num_ids + lanes - 1) / lanes; }
  /// The numbers from `first` on.
  HWY_INLINE Ids numbers(std::size_t first) const {
    return hn::Add(lane, hn::Set(d, static_cast<std::uint32_t>(first)));
  }
  /// The lane of `slot`, among lanes that start at slot `begin`.
  HWY_INLINE hn::Mask<IdTag<K>> is(int slot, std::size_t begin) const {
    return hn::Eq(lane, hn::Set(d, static_cast<std::uint32_t>(slot) - static_cast<std::uint32_t>(begin)));
  }
  /// The lanes with ids of the cell other than that of `slot`, among lanes that start at slot `begin`.
  HWY_INLINE hn::Mask<IdTag<K>> others(int slot, std::size_t begin) const {
    return hn::AndNot(is(slot, begin), hn::FirstN(d, num_ids - begin));
  }

  const IdTag<K> d;
  const Ids lane = hn::Iota(d, 0);
  const std::size_t num_ids;
};

/// The layout of cells, known at compile time from 2D to 8D.
template <int K, cells::VertexIds Ids>
cells::CellLayout<(K > 1 ? K : 0)> layout_of(const CellLinks& links) {
  return cells::CellLayout<(K > 1 ? K : 0)>(links.k, Ids);
}

/// Vertices of a cell from number `begin` on, given its links.
template <cells::VertexIds Ids, class D>
HWY_INLINE hn::Vec<D> load_vertices(D d, const Index* links, std::size_t begin) {
  if constexpr (Ids == cells::VertexIds::narrow) {
    const hn::Rebind<std::uint16_t, D> narrow;
    return hn::PromoteTo(d, hn::LoadU(narrow, reinterpret_cast<const std::uint16_t*>(links) + begin));
  } else {
    return hn::LoadU(d, links + begin);
  }
}
template <cells::VertexIds Ids, class D>
HWY_INLINE void store_vertices(hn::Vec<D> vertices, D d, Index* links, std::size_t begin) {
  if constexpr (Ids == cells::VertexIds::narrow) {
    const hn::Rebind<std::uint16_t, D> narrow;
    const hn::RebindToSigned<D> positive;
    hn::StoreU(hn::DemoteTo(narrow, hn::BitCast(positive, vertices)), narrow,
               reinterpret_cast<std::uint16_t*>(links) + begin);
  } else {
    hn::StoreU(vertices, d, links + begin);
  }
}

/// Survivors are prefetched this many facets ahead.
constexpr std::size_t ahead = 8;

/// Different sets of vertices should have different sums of tags, in all but a few cases.
template <class D>
HWY_INLINE hn::Vec<D> tags(D d, hn::Vec<D> vertices) {
  auto x = hn::Mul(vertices, hn::Set(d, 0x9e3779b1u));
  x = hn::Xor(x, hn::ShiftRight<16>(x));
  return hn::Mul(x, hn::Set(d, 0x85ebca6bu));
}

/// The entries at the indices of the first `count` lanes, loaded one by one: a gather is no faster.
template <class D>
HWY_INLINE hn::Vec<D> look_up(D d, const std::uint32_t* entries, hn::Vec<D> indices, std::size_t count) {
  HWY_ALIGN std::uint32_t index[hn::MaxLanes(d)];
  hn::Store(indices, d, index);
  const hn::FixedTag<std::uint32_t, std::min<std::size_t>(hn::MaxLanes(d), 4)> of_four;
  const auto four_from = [&](std::size_t first) {
    auto found = hn::Zero(of_four);
    for (std::size_t i = 0; i < hn::MaxLanes(of_four); ++i)
      if (first + i < count) found = hn::InsertLane(found, i, entries[index[first + i]]);
    return found;
  };
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(d) == 8) return hn::Combine(d, four_from(4), four_from(0));
#endif
  if constexpr (hn::MaxLanes(d) <= 4) return four_from(0);
}

/// `Shared`: the slot of the survivor across the facet is found by vertices alone. Its vertex opposite the
/// facet is the difference of the sums of all vertices of the two cells, but for that of the dead one.
template <int K, cells::VertexIds Ids, bool Shared>
void create_cells(const CellLinks& links, Index apex, const DeadCells& zone, std::span<HorizonFacet> facets) {
  const IdTag<K> d;
  const Pieces<K> pieces(links.k);
  const auto layout = layout_of<K, Ids>(links);
  const std::size_t stride = layout.link_stride(),
                    ids_before_links = layout.words_before_links() * layout.ids_per_word;
  const auto of = [&](Index cell) { return links.first + cell * stride; };
  const auto last_start =
      static_cast<std::ptrdiff_t>(pieces.num_ids) - static_cast<std::ptrdiff_t>(pieces.lanes);
  const auto first_lane =
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(-last_start, 0));  // those before are vertices
  for (std::size_t f = 0; f < facets.size(); ++f) {
    HorizonFacet& facet = facets[f];
    if (f + ahead <
        facets.size()) {  // what is side by side with its links too: the star's functionals are made from it
      const Index* const end = of(facets[f + ahead].survivor) + layout.num_link_ids();
      const Index* const begin = end - layout.num_link_ids() - ids_before_links;
      for (const Index* line = begin; line < end; line += 16) internal::prefetch(line);
      internal::prefetch(end - 1);
    }
    const Index dead = zone.cells[facet.dead];
    const Index* const dead_links = of(dead);
    Index* const created_links = of(facet.created);
    Index* const survivor_links = of(facet.survivor);
    Index* const across_survivor = survivor_links + layout.ids_before_neighbors();
    facet.dead_opposite = layout.vertex(dead_links, facet.slot);  // the new cell may be where the dead one is
    std::ptrdiff_t mirror = 0;
    if constexpr (Shared) {
      const auto vertices_of = [&](const Index* of_cell, std::size_t begin) {
        return hn::IfThenElseZero(hn::FirstN(d, pieces.num_ids - begin),
                                  load_vertices<Ids>(d, of_cell, begin));
      };
      auto difference = hn::Zero(d);
      for (std::size_t begin = 0; begin < pieces.num_ids; begin += pieces.lanes)
        difference =
            hn::Add(difference, hn::Sub(vertices_of(survivor_links, begin), vertices_of(dead_links, begin)));
      const auto opposite = hn::Add(hn::SumOfLanes(d, difference), hn::Set(d, facet.dead_opposite));
      for (std::size_t begin = 0; begin < pieces.num_ids; begin += pieces.lanes) {
        const auto is_mirror = hn::And(hn::FirstN(d, pieces.num_ids - begin),
                                       hn::Eq(load_vertices<Ids>(d, survivor_links, begin), opposite));
        if (const auto found = hn::FindFirstTrue(d, is_mirror); found >= 0)
          mirror = found + static_cast<std::ptrdiff_t>(begin);
      }
    }
    for (std::size_t begin = pieces.num() * pieces.lanes; begin > 0;) {
      begin -= pieces.lanes;
      const auto vertices = load_vertices<Ids>(d, dead_links, begin);
      store_vertices<Ids>(hn::IfThenElse(pieces.is(facet.slot, begin), hn::Set(d, apex), vertices), d,
                          created_links, begin);
      if constexpr (Shared) continue;
      const std::ptrdiff_t start = std::min(static_cast<std::ptrdiff_t>(begin), last_start);
      auto is_mirror = hn::Eq(hn::LoadU(d, across_survivor + start), hn::Set(d, dead));
      if (first_lane > 0) is_mirror = hn::AndNot(hn::FirstN(d, first_lane), is_mirror);
      if ((K > 0 && K < static_cast<int>(pieces.lanes)) || !hn::AllFalse(d, is_mirror))
        mirror = static_cast<std::ptrdiff_t>(hn::FindKnownFirstTrue(d, is_mirror)) + start;
    }
    created_links[layout.ids_before_neighbors() + static_cast<std::size_t>(facet.slot)] = facet.survivor;
    across_survivor[mirror] = facet.created;
    facet.dead_value = zone.values[facet.dead];
    facet.dead = dead;
    facet.survivor_opposite = layout.vertex(survivor_links, static_cast<int>(mirror));
  }
}

template <int K, cells::VertexIds Ids>
void hash_ridges(const CellLinks& links, std::span<const HorizonFacet> facets, std::size_t first,
                 std::size_t last, std::uint32_t* HWY_RESTRICT hashes, Index* HWY_RESTRICT created,
                 const RidgeEntries* table) {
  const IdTag<K> d;
  const Pieces<K> pieces(links.k);
  const std::size_t stride = layout_of<K, Ids>(links).link_stride();
  const int facet_shift = half_ridge_shift(links.k), hash_shift = table != nullptr ? 32 - table->bits : 0;
  std::uint32_t* const entries = table != nullptr ? table->entries : nullptr;
  const std::uint32_t one = table != nullptr ? 1u << table->sum_bits : 0;
  const auto none = hn::Set(d, table != nullptr ? 1u << table->bits : 0);
  for (std::size_t f = first; f < last; ++f) {
    const HorizonFacet& facet = facets[f];
    created[f] = facet.created;
    const Index* const of_cell = links.first + facet.created * stride;
    const std::size_t half = f << facet_shift;
    auto sum = hn::Zero(d);
    for (std::size_t begin = 0; begin < pieces.num_ids; begin += pieces.lanes)
      sum = hn::Add(sum, hn::IfThenElseZero(pieces.others(facet.slot, begin),
                                            tags(d, load_vertices<Ids>(d, of_cell, begin))));
    sum = hn::SumOfLanes(d, sum);
    for (std::size_t begin = 0; begin < pieces.num_ids; begin += pieces.lanes) {
      const auto hash = hn::Sub(sum, tags(d, load_vertices<Ids>(d, of_cell, begin)));
      hn::StoreU(hash, d, hashes + half + begin);
      if (entries == nullptr) continue;
      HWY_ALIGN std::uint32_t selected[pieces.lanes];
      hn::Store(hn::IfThenElse(pieces.others(facet.slot, begin), hn::ShiftRightSame(hash, hash_shift), none),
                d, selected);
      auto more = one + static_cast<std::uint32_t>(half + begin);
      for (std::size_t i = 0; i < std::min(pieces.lanes, pieces.num_ids - begin); ++i)
        entries[selected[i]] += more++;
    }
  }
}

template <int K, cells::VertexIds Ids>
void match_ridges(const CellLinks& links, std::span<const HorizonFacet> facets,
                  const std::uint32_t* HWY_RESTRICT hashes, const Index* HWY_RESTRICT created,
                  const RidgeEntries& table, std::uint8_t* HWY_RESTRICT unmatched) {
  const IdTag<K> d;
  const Pieces<K> pieces(links.k);
  const auto layout = layout_of<K, Ids>(links);
  const std::size_t stride = layout.link_stride();
  const int facet_shift = half_ridge_shift(links.k), hash_shift = 32 - table.bits;
  const std::uint32_t* const entries = table.entries;
  const auto last = hn::Set(d, static_cast<std::uint32_t>((facets.size() << facet_shift) - 1));
  const auto two = hn::Set(d, 2u << table.sum_bits);
  const std::size_t num_bytes = (std::size_t{1} << facet_shift) / 8;
  for (std::size_t f = 0; f < facets.size(); ++f, unmatched += num_bytes) {
    const std::size_t half = f << facet_shift;
    Index* const neighbors = links.first + created[f] * stride + layout.ids_before_neighbors();
    for (std::size_t byte = (pieces.num_ids + 7) / 8; byte < num_bytes; ++byte) unmatched[byte] = 0;
    for (std::size_t begin = 0; begin < pieces.num_ids; begin += pieces.lanes) {
      const auto selected = hn::ShiftRightSame(hn::LoadU(d, hashes + half + begin), hash_shift);
      const std::size_t count = std::min(pieces.lanes, pieces.num_ids - begin);
      const auto entry = look_up(d, entries, selected, count);
      const auto own = pieces.numbers(half + begin);
      const auto valid = pieces.others(facets[f].slot, begin);
      const auto pair = hn::Eq(hn::ShiftRightSame(entry, table.sum_bits), hn::Set(d, 2u));
      const auto matched = hn::And(valid, pair);
      // Clamped, as a count that has overflowed gives a meaningless number.
      const auto other = hn::Min(hn::IfThenElse(matched, hn::Sub(hn::Sub(entry, two), own), own), last);
      const auto across = look_up(d, created, hn::ShiftRightSame(other, facet_shift), count);
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
      hn::BlendedStore(across, valid, d, neighbors + begin);
#else  // there it would read and write the other lanes, too, which may be those of a cell of another thread
      HWY_ALIGN Index ids[pieces.lanes];
      hn::Store(across, d, ids);
      for (std::size_t i = 0; i < count; ++i)
        if (begin + i != static_cast<std::size_t>(facets[f].slot)) neighbors[begin + i] = ids[i];
#endif
      std::uint8_t bits[8];
      hn::StoreMaskBits(d, hn::AndNot(pair, valid), bits);
      const auto shifted = static_cast<std::uint8_t>(bits[0] << begin % 8);
      unmatched[begin / 8] =
          begin % 8 == 0 ? shifted : static_cast<std::uint8_t>(unmatched[begin / 8] | shifted);
    }
  }
}

/// Calls work(k, ids) with constants for the compiled code: the dimension, 0 if it is a variable, and the
/// width of vertices.
template <class Work>
void for_layout(const CellLinks& links, Work&& work) {
  internal::with_compiled_dimension<1, 8>(static_cast<std::size_t>(links.k), [&](auto k) {
    if constexpr (cells::may_be_narrow(k()))
      if (links.ids == cells::VertexIds::narrow)
        return work(k, std::integral_constant<cells::VertexIds, cells::VertexIds::narrow>());
    work(k, std::integral_constant<cells::VertexIds, cells::VertexIds::wide>());
  });
}

void create_cells_here(const CellLinks& links, Index apex, const DeadCells& zone,
                       std::span<HorizonFacet> facets, bool shared) {
  for_layout(links, [&](auto k, auto ids) {
    if constexpr (shares_survivors(k()))
      if (shared) return create_cells<k(), ids(), true>(links, apex, zone, facets);
    create_cells<k(), ids(), false>(links, apex, zone, facets);
  });
}
void hash_ridges_here(const CellLinks& links, std::span<const HorizonFacet> facets, std::size_t first,
                      std::size_t last, std::uint32_t* hashes, Index* created, const RidgeEntries* table) {
  for_layout(links, [&](auto k, auto ids) {
    hash_ridges<k(), ids()>(links, facets, first, last, hashes, created, table);
  });
}
void match_ridges_here(const CellLinks& links, std::span<const HorizonFacet> facets,
                       const std::uint32_t* hashes, const Index* created, const RidgeEntries& table,
                       std::uint8_t* unmatched) {
  for_layout(links, [&](auto k, auto ids) {
    match_ridges<k(), ids()>(links, facets, hashes, created, table, unmatched);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::engine {

HWY_EXPORT(create_cells_here);
HWY_EXPORT(hash_ridges_here);
HWY_EXPORT(match_ridges_here);

void create_cells(const CellLinks& links, Index apex, const DeadCells& zone, std::span<HorizonFacet> facets,
                  bool shares_survivors) {
  HWY_DYNAMIC_DISPATCH(create_cells_here)(links, apex, zone, facets, shares_survivors);
}
void hash_ridges(const CellLinks& links, std::span<const HorizonFacet> facets, std::size_t first,
                 std::size_t last, std::uint32_t* hashes, Index* created, const RidgeEntries* table) {
  HWY_DYNAMIC_DISPATCH(hash_ridges_here)(links, facets, first, last, hashes, created, table);
}
void match_ridges(const CellLinks& links, std::span<const HorizonFacet> facets, const std::uint32_t* hashes,
                  const Index* created, const RidgeEntries& table, std::uint8_t* unmatched) {
  HWY_DYNAMIC_DISPATCH(match_ridges_here)(links, facets, hashes, created, table, unmatched);
}

}  // namespace delone::engine
#endif
