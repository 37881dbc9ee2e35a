// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/facet_search/tile_search.hpp"

#include "base/compiled_dimension.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "geometry/facet_search/tile_search.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace delone::geometry {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Blocks processed together. The sums of a single block are one chain of dependent additions, longer than
/// what the processor reorders; several chains overlap. Processors with vectors of 512 bits have twice as
/// many registers.
constexpr std::size_t together =
    hn::MaxLanes(hn::CappedTag<float, block>()) == block ? most_together : most_together / 2;

/// An affine function, its coefficients broadcast to all lanes. K is k, or 0 for any k: then coefficients are
/// broadcast at each use.
template <int K, class D>
class Broadcast {
 public:
  using V = hn::Vec<D>;

  Broadcast(D d, const SearchTask& task, Affine function)
      : d_(d),
        k_(static_cast<std::size_t>(K > 0 ? K : task.k)),
        from_(function),
        constant_(hn::Set(d, function[k_])) {
    for (std::size_t r = 0; r < K; ++r) kept_[r] = hn::Set(d, function[r]);
  }

  /// The values at the vertices of `Count` blocks from this image on, in as many lanes of each block as a
  /// vector has.
  template <std::size_t Count>
  HWY_INLINE void values(const float* image, V (&sums)[Count]) const {
    for (V& sum : sums) sum = constant_;
    add_to(sums, image);
  }
  /// The same plus the lifts.
  template <std::size_t Count>
  HWY_INLINE void heights(const float* image, V (&sums)[Count]) const {
#pragma GCC unroll 8
    for (std::size_t b = 0; b < Count; ++b)
      sums[b] = hn::Add(hn::Load(d_, image + (b * (k_ + 1) + k_) * block), constant_);
    add_to(sums, image);
  }

 private:
  HWY_INLINE V coefficient(std::size_t r) const { return K > 0 ? kept_[r] : hn::Set(d_, from_[r]); }
  template <std::size_t Count>
  HWY_INLINE void add_to(V (&sums)[Count], const float* image) const {
#pragma GCC unroll 8
    for (std::size_t r = 0; r < k_; ++r)
#pragma GCC unroll 8
      for (std::size_t b = 0; b < Count; ++b)
        sums[b] = hn::MulAdd(hn::Load(d_, image + (b * (k_ + 1) + r) * block), coefficient(r), sums[b]);
  }

  D d_;
  std::size_t k_;
  Affine from_;
  V constant_;
  V kept_[K > 0 ? K : 1];
};

/// Writes the heights at the vertices of a tile. Returns whether all but those of the cell's own vertices are
/// larger than least_height. K is k, or 0 for any.
template <int K>
bool write_heights(const SearchTask& task, std::size_t first, std::size_t end, std::size_t cell) {
  const hn::CappedTag<float, block> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto k = static_cast<std::size_t>(K > 0 ? K : task.k);
  const Broadcast<K, decltype(d)> function(d, task, task.height_functions + cell * (k + 1));
  const float* HWY_RESTRICT images = task.images;
  float* HWY_RESTRICT heights = task.heights;
  auto minus_low = hn::Zero(di);  // −1 for each that is low
  for (std::size_t start = first; start < end; start += together)
    for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
      hn::Vec<decltype(d)> of_blocks[together];
      function.heights(images + start * block * (k + 1) + lane, of_blocks);
#pragma GCC unroll 8
      for (std::size_t b = 0; b < together; ++b) {
        hn::Store(of_blocks[b], d, heights + (start + b - first) * block + lane);
        const auto is_low = hn::Le(of_blocks[b], hn::Set(d, least_height));
        minus_low = hn::Add(minus_low, hn::VecFromMask(di, hn::RebindMask(di, is_low)));
      }
    }
  std::int32_t num_low = -hn::GetLane(hn::SumOfLanes(di, minus_low));
  for (std::size_t i = 0; i <= k; ++i) {
    // Wraps around where it is negative.
    const std::size_t place = task.cells[cell].vertices[i] - 1 - first * block;
    if (place >= (end - first) * block) continue;
    num_low -= heights[place] <= least_height;
    heights[place] = out_of_reach;
  }
  return num_low == 0;
}

/// Heights divided by the values of an affine function, at the vertices of a tile; out of reach where the
/// values are not positive.
template <int K>
class Ratios {
 public:
  using D = hn::CappedTag<float, block>;
  using DI = hn::RebindToSigned<D>;

  Ratios(const SearchTask& task, std::size_t first, const SoughtFacet& facet)
      : k_(static_cast<std::size_t>(K > 0 ? K : task.k)),
        images_(task.images + first * block * (k_ + 1)),
        heights_(task.heights),
        facet_(facet),
        task_(task),
        function_(D(), task, facet.beyond) {}

  /// The ratios at the vertices of `together` blocks of the tile, from a lane on in as many as a vector has.
  HWY_INLINE void ratios(std::size_t start, std::size_t lane, hn::Vec<D> (&ratios)[together]) const {
    hn::Vec<D> values[together];
    function_.values(images_ + start * block * (k_ + 1) + lane, values);
#pragma GCC unroll 8
    for (std::size_t b = 0; b < together; ++b) {
      const auto ratio = hn::Div(hn::Load(D(), heights_ + (start + b) * block + lane), values[b]);
      ratios[b] = hn::IfThenElse(hn::Gt(values[b], hn::Zero(D())), ratio, hn::Set(D(), out_of_reach));
    }
  }
  /// The keys of the ratios, larger than largest_key where these are out of reach. REQUIRES that all heights
  /// are larger than least_height.
  HWY_INLINE void keys(std::size_t start, std::size_t lane, hn::Vec<DI> (&keys)[together]) const {
    hn::Vec<D> values[together];
    function_.values(images_ + start * block * (k_ + 1) + lane, values);
#pragma GCC unroll 8
    for (std::size_t b = 0; b < together; ++b) {
      const auto height = hn::BitCast(DI(), hn::Load(D(), heights_ + (start + b) * block + lane));
      keys[b] = hn::Sub(height, hn::Max(hn::BitCast(DI(), values[b]), hn::Zero(DI())));
    }
  }
  /// The ratio at one vertex of the tile.
  float ratio(std::size_t vertex) const {
    const hn::CappedTag<float, 1> d;  // rounded like the others
    hn::Vec<decltype(d)> value[1];
    const Broadcast<0, decltype(d)> function(d, task_, facet_.beyond);
    function.values(images_ + vertex / block * block * (k_ + 1) + vertex % block, value);
    return hn::GetLane(value[0]) > 0 ? heights_[vertex] / hn::GetLane(value[0]) : out_of_reach;
  }

 private:
  std::size_t k_;
  const float* images_;
  const float* heights_;
  const SoughtFacet& facet_;
  const SearchTask& task_;
  Broadcast<K, D> function_;
};

/// The bits of a mask that has at most as many lanes as a block.
template <class D, class M>
HWY_INLINE std::uint64_t bits_of(D d, M mask) {
  std::uint8_t bytes[8] = {};  // written in whole words
  hn::StoreMaskBits(d, mask, bytes);
  return hn::MaxLanes(d) > 8 ? bytes[0] | std::uint64_t{bytes[1]} << 8 : bytes[0];
}

/// Lists the vertices of a tile whose ratio is at most the bound, as far as there is room, and counts all of
/// them.
template <int K>
void list_in_tile(const Ratios<K>& ratios, std::size_t first, std::size_t end, float bound,
                  std::span<std::uint32_t> list, std::size_t& count) {
  const typename Ratios<K>::D d;
  for (std::size_t start = first; start < end; start += together) {
    std::uint64_t listed[together] = {};
    for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
      hn::Vec<decltype(d)> of_blocks[together];
      ratios.ratios(start - first, lane, of_blocks);
      for (std::size_t b = 0; b < together; ++b)
        listed[b] |= bits_of(d, hn::Le(of_blocks[b], hn::Set(d, bound))) << lane;
    }
    for (std::size_t b = 0; b < together; ++b)
      for (; listed[b] != 0; listed[b] &= listed[b] - 1, ++count)
        if (count < list.size())
          list[count] = static_cast<std::uint32_t>((start + b) * block) +
                        static_cast<std::uint32_t>(std::countr_zero(listed[b]));
  }
}

/// Lists the vertices of a tile that may have the least ratio, which is at most `least` in this tile.
template <int K>
void list_least(const Ratios<K>& ratios, std::size_t first, std::size_t end, float least,
                SoughtFacet& facet) {
  facet.least = std::min(facet.least, least);
  const float bound = std::min(bound_of(facet.least), largest_ratio);
  list_in_tile<K>(ratios, first, end, bound, facet.listed, facet.num_listed);
  facet.listed_up_to = std::min(facet.listed_up_to, bound);
}

/// Finds the least ratio of a tile, and lists the vertices that may have it.
template <int K>
void search_tile(const SearchTask& task, std::size_t first, std::size_t end, SoughtFacet& facet) {
  const typename Ratios<K>::D d;
  const Ratios<K> ratios(task, first, facet);
  auto least = hn::Set(d, out_of_reach);
  for (std::size_t start = 0; start < end - first; start += together)
    for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
      hn::Vec<decltype(d)> of_blocks[together];
      ratios.ratios(start, lane, of_blocks);
      for (const auto& of_block : of_blocks) least = hn::Min(of_block, least);
    }
  list_least<K>(ratios, first, end, hn::GetLane(hn::MinOfLanes(d, least)), facet);
}

/// The same by keys: divisions only where several vertices are close. Where a single vertex is listed, as
/// mostly, all branches are predictable. The least and the second least key of every lane are kept; if the
/// second least of a lane is listed too, the lanes do not know all vertices to be listed, and ratios tell.
template <int K>
void search_tile_by_keys(const SearchTask& task, std::size_t first, std::size_t end, SoughtFacet& facet) {
  const typename Ratios<K>::DI d;
  using V = hn::Vec<decltype(d)>;
  const Ratios<K> ratios(task, first, facet);
  const std::size_t parts = block / hn::Lanes(d);                                  // of a block: vectors
  V least = hn::Set(d, std::numeric_limits<std::int32_t>::max()), second = least;  // of each lane
  const V next_block = hn::Set(d, static_cast<std::int32_t>(parts)), key_mask = hn::Set(d, ~place_mask);
  for (std::size_t start = 0; start < end - first; start += together)
    for (std::size_t part = 0; part < parts; ++part) {
      V of_blocks[together];
      ratios.keys(start, part * hn::Lanes(d), of_blocks);
      V place = hn::Set(d, static_cast<std::int32_t>(start * parts + part));  // numbers vectors
#pragma GCC unroll 8
      for (const V& of_block : of_blocks) {
        const V key = hn::OrAnd(place, of_block, key_mask);
        second = hn::Min(second, hn::Max(least, key));
        least = hn::Min(least, key);
        place = hn::Add(place, next_block);
      }
    }
  const std::int32_t bound =
      std::min({hn::GetLane(hn::MinOfLanes(d, least)) + doubt, key_above(facet.least), largest_key});
  const auto lanes_up_to_bound = [&](V keys) { return bits_of(d, hn::Lt(keys, hn::Set(d, bound + 1))); };
  std::uint64_t lanes = lanes_up_to_bound(least);
  HWY_ALIGN std::int32_t least_of_lanes[block];
  hn::Store(least, d, least_of_lanes);
  const auto least_in = [&](std::uint64_t bits) {  // the vertex of the least key in the first of these lanes
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    return static_cast<std::size_t>(least_of_lanes[lane] & place_mask) * hn::Lanes(d) + lane;
  };
  constexpr int few = 3;
  if (lanes_up_to_bound(second) != 0 || std::popcount(lanes) > few) [[unlikely]] {
    float least_ratio = out_of_reach;
    for (; lanes != 0; lanes &= lanes - 1) least_ratio = std::min(least_ratio, ratios.ratio(least_in(lanes)));
    return list_least<K>(ratios, first, end, least_ratio, facet);
  }
  for (; lanes != 0; lanes &= lanes - 1, ++facet.num_listed)
    if (facet.num_listed < facet.listed.size())
      facet.listed[facet.num_listed] = static_cast<std::uint32_t>(first * block + least_in(lanes));
  facet.listed_up_to = std::min(facet.listed_up_to, ratio_below(bound));
  facet.least = std::min(facet.least, bound_of(facet.listed_up_to));
}

template <int K>
void search_all(const SearchTask& task) {
  for (std::size_t first = 0; first < task.num_blocks; first += task.tile_blocks) {
    const std::size_t end = std::min(first + task.tile_blocks, task.num_blocks);
    std::size_t facet = 0;
    for (std::size_t cell = 0; cell < task.cells.size(); ++cell) {
      const auto search = write_heights<K>(task, first, end, cell) ? search_tile_by_keys<K> : search_tile<K>;
      for (; facet < task.facets.size() && task.facets[facet].cell == cell; ++facet)
        search(task, first, end, task.facets[facet]);
    }
  }
}

/// Lists all vertices whose ratio is at most the bound; returns how many there are.
template <int K>
std::size_t list_all(const SearchTask& task, const SoughtFacet& facet, float bound,
                     std::span<std::uint32_t> list) {
  std::size_t count = 0;
  for (std::size_t first = 0; first < task.num_blocks; first += task.tile_blocks) {
    const std::size_t end = std::min(first + task.tile_blocks, task.num_blocks);
    write_heights<K>(task, first, end, facet.cell);
    list_in_tile<K>(Ratios<K>(task, first, facet), first, end, bound, list, count);
  }
  return count;
}

void search_here(const SearchTask& task) {
  internal::with_compiled_dimension<7, 8>(static_cast<std::size_t>(task.k),
                                          [&](auto k) { search_all<k()>(task); });
}
std::size_t list_here(const SearchTask& task, const SoughtFacet& facet, float bound,
                      std::span<std::uint32_t> list) {
  return internal::with_compiled_dimension<7, 8>(
      static_cast<std::size_t>(task.k), [&](auto k) { return list_all<k()>(task, facet, bound, list); });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(search_here);
HWY_EXPORT(list_here);

void search_tiles(const SearchTask& task) { HWY_DYNAMIC_DISPATCH(search_here)(task); }
std::size_t list_up_to(const SearchTask& task, const SoughtFacet& facet, float bound,
                       std::span<std::uint32_t> list) {
  return HWY_DYNAMIC_DISPATCH(list_here)(task, facet, bound, list);
}

}  // namespace delone::geometry
#endif
