// SPDX-License-Identifier: BSD-3-Clause
#include "engine/wrap/facet_table_kernel.hpp"

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "engine/wrap/facet_table_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace delone::engine {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::uint64_t, 8>;

/// A bit for each lane.
HWY_INLINE std::uint32_t bits(hn::Mask<Tag> mask) {
  std::uint8_t bytes[8] = {};  // written in whole words
  hn::StoreMaskBits(Tag(), mask, bytes);
  return bytes[0];
}

void find_here(const FacetLine* lines, std::size_t num_lines, std::span<const std::uint64_t> keys,
               FacetPlaces* places) {
  const Tag d;
  constexpr std::size_t lanes = hn::MaxLanes(Tag());
  constexpr std::uint32_t all = (1u << FacetLine::room) - 1;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto* const line =
        reinterpret_cast<const std::uint64_t*>(&lines[FacetLine::place(keys[i], num_lines)]);
    const auto key = hn::Set(d, keys[i]);
    FacetPlaces found{0, 0};
    for (std::size_t begin = 0; begin < FacetLine::room; begin += lanes) {
      const auto piece = hn::LoadU(d, line + begin);
      found.hits |= bits(hn::Eq(piece, key)) << begin;
      found.vacancies |= bits(hn::Eq(piece, hn::Zero(d))) << begin;
    }
    places[i] = {found.hits & all, found.vacancies & all};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::engine {

HWY_EXPORT(find_here);

void find_facets(const FacetLine* lines, std::size_t num_lines, std::span<const std::uint64_t> keys,
                 FacetPlaces* places) {
  HWY_DYNAMIC_DISPATCH(find_here)(lines, num_lines, keys, places);
}

}  // namespace delone::engine
#endif
