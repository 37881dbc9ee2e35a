// SPDX-License-Identifier: BSD-3-Clause
// The bound. Let u = 2^−53, A the rounded row, x the rounded ray, S the sum of |A[i]|, m the largest |x[i]|.
// Rounding the entries changes the product by at most (4u + O(u²))·S·m, and the sum, fused or not, by at most
// d·u/(1 − d·u) times Σ|A[i]·x[i]| ≤ S·m. The computed S is at least (1 − d·u) of the exact one. So
// 2·(d + 8)·u·S·m, which has four more roundings, bounds the error for d ≤ 2^20. Entries are integers, so
// nothing underflows; if S·m may overflow, no sign is certain. If S·m < 9·10^15 < 2^53, all entries are exact
// and every partial sum is an integer below 2^53: the result is exact.
#include "polyhedra/sign_kernel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "polyhedra/sign_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace delone::polyhedra {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using RowTag = hn::CappedTag<double, RoundedRows::block>;

/// The mask as bits, lane 0 first.
HWY_INLINE unsigned bits_of(hn::Mask<RowTag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(RowTag(), mask, bytes);
  return bytes[0];
}

std::size_t Signs(const RoundedRows& rows, const double* ray, std::size_t first, std::uint64_t* zeros,
                  std::uint64_t* open) {
  const RowTag tag;
  const std::size_t d = rows.dimension(), m = rows.size(), stride = rows.stride(), lanes = hn::Lanes(tag);
  double largest = 0;
  for (std::size_t i = 0; i < d; ++i) largest = std::max(largest, std::abs(ray[i]));
  const auto size = hn::Set(tag, largest),
             factor = hn::Set(tag, largest * (static_cast<double>(d) + 8) * 0x1p-52),
             exact_below = hn::Set(tag, 9e15), finite_below = hn::Set(tag, 1e300), zero = hn::Zero(tag);
  for (std::size_t block = first & ~(RoundedRows::block - 1); block < m; block += RoundedRows::block) {
    unsigned is_negative = 0, is_zero = 0, is_open = 0;
    for (std::size_t lane = 0; lane < RoundedRows::block; lane += lanes) {
      const double* at = rows.column(0) + block + lane;
      auto sum = zero;
      for (std::size_t i = 0; i < d; ++i)
        sum = hn::MulAdd(hn::LoadU(tag, at + i * stride), hn::Set(tag, ray[i]), sum);
      const auto of_row = hn::LoadU(tag, rows.sums() + block + lane);
      const auto product = hn::Mul(of_row, size), bound = hn::Mul(of_row, factor);
      const auto is_exact = hn::Lt(product, exact_below), is_finite = hn::Lt(product, finite_below);
      const auto below = hn::Lt(sum, hn::Neg(bound)), above = hn::Lt(bound, sum);
      const auto negative = hn::And(is_finite, hn::Or(below, hn::And(is_exact, hn::Lt(sum, zero))));
      const auto positive = hn::And(is_finite, hn::Or(above, hn::And(is_exact, hn::Lt(zero, sum))));
      const auto none = hn::And(is_exact, hn::Eq(sum, zero));
      is_negative |= bits_of(negative) << lane;
      is_zero |= bits_of(none) << lane;
      is_open |= bits_of(hn::Not(hn::Or(hn::Or(negative, positive), none))) << lane;
    }
    unsigned within = 0xff;
    if (block < first) within &= 0xffu << (first - block);
    if (block + RoundedRows::block > m) within &= (1u << (m - block)) - 1;
    const unsigned negatives = is_negative & within;
    if (negatives != 0) within &= (negatives & (0 - negatives)) - 1;  // rows before the first of them
    zeros[block / 64] |= std::uint64_t{is_zero & within} << (block % 64);
    open[block / 64] |= std::uint64_t{is_open & within} << (block % 64);
    if (negatives != 0) return block + static_cast<std::size_t>(std::countr_zero(negatives));
  }
  return m;
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::polyhedra
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::polyhedra {

HWY_EXPORT(Signs);

std::size_t find_signs(const RoundedRows& rows, std::span<const double> ray, std::size_t first,
                       std::span<std::uint64_t> zeros, std::span<std::uint64_t> open) {
  return HWY_DYNAMIC_DISPATCH(Signs)(rows, ray.data(), first, zeros.data(), open.data());
}

}  // namespace delone::polyhedra
#endif
