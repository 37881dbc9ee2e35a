// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/common_zeros_kernel.hpp"

#include <bit>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "polyhedra/common_zeros_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef DELONE_COMMON_ZEROS_KERNEL
#define DELONE_COMMON_ZEROS_KERNEL
namespace delone::polyhedra {

/// A word of a set that is not 0, and where the same word of the others begins.
struct PartOfSet {
  std::uint64_t word;
  const std::uint64_t* of_others;
};

}  // namespace delone::polyhedra
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::polyhedra {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<std::uint64_t, 8>;

/// Vectors that are compared before it is asked whether any of them has a set.
constexpr std::size_t unrolled = 4;

template <bool IsOneWord>
void find(std::span<const PartOfSet> parts, std::size_t first, std::size_t size, std::uint32_t least,
          std::vector<Overlap>& found) {
  const Tag tag;
  const hn::RebindToSigned<Tag> signed_tag;
  const std::size_t lanes = hn::Lanes(tag), step = unrolled * lanes;
  const auto too_few = hn::Set(signed_tag, static_cast<std::int64_t>(least) - 1);
  alignas(64) std::uint64_t counts[8];
  for (std::size_t i = first / step * step; i < size; i += step) {
    hn::Vec<Tag> sums[unrolled];
    for (std::size_t k = 0; k < unrolled; ++k) {
      const auto common = [&](const PartOfSet& part) {
        return hn::PopulationCount(
            hn::And(hn::Set(tag, part.word), hn::LoadU(tag, part.of_others + i + k * lanes)));
      };
      if constexpr (IsOneWord) {
        sums[k] = common(parts[0]);
      } else {
        sums[k] = hn::Zero(tag);
        for (const PartOfSet& part : parts) sums[k] = hn::Add(sums[k], common(part));
      }
    }
    auto most = sums[0];
    for (std::size_t k = 1; k < unrolled; ++k) most = hn::Max(most, sums[k]);
    if (hn::AllFalse(signed_tag, hn::Gt(hn::BitCast(signed_tag, most), too_few))) continue;
    for (std::size_t k = 0; k < unrolled; ++k) {
      const auto enough = hn::Gt(hn::BitCast(signed_tag, sums[k]), too_few);
      if (hn::AllFalse(signed_tag, enough)) continue;
      std::uint8_t bytes[8] = {};
      hn::StoreMaskBits(signed_tag, enough, bytes);
      hn::Store(sums[k], tag, counts);
      for (unsigned bits = bytes[0]; bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
        const std::size_t set = i + k * lanes + lane;
        if (set >= first && set < size)
          found.push_back({static_cast<std::uint32_t>(set), static_cast<std::uint32_t>(counts[lane])});
      }
    }
  }
}

void Overlaps(std::span<const PartOfSet> parts, std::size_t first, std::size_t size, std::uint32_t least,
              std::vector<Overlap>& found) {
  if (parts.size() == 1)
    find<true>(parts, first, size, least, found);
  else
    find<false>(parts, first, size, least, found);
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::polyhedra
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::polyhedra {

HWY_EXPORT(Overlaps);

void find_overlaps(const std::uint64_t* words, std::size_t stride, std::size_t size,
                   std::span<const std::uint64_t> set, std::size_t first, std::uint32_t least,
                   std::vector<Overlap>& found) {
  thread_local std::vector<PartOfSet> parts;
  parts.clear();
  for (std::size_t w = 0; w < set.size(); ++w)
    if (set[w] != 0) parts.push_back({set[w], words + w * stride});
  HWY_DYNAMIC_DISPATCH(Overlaps)(parts, first, size, least, found);
}

}  // namespace delone::polyhedra
#endif
