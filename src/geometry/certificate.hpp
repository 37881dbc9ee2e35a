// SPDX-License-Identifier: BSD-3-Clause
// What is cached for a cell besides the k + 1 coefficients of its functional: the threshold of the filter,
// and the error at the vertices and the determinant, from which the certificates of later cells are computed.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace delone::geometry {

/// The certificate of a functional h̃ that stands for h (docs/predicates.md, "The filter"), in 64 bits.
/// Fields are binary32 without sign, in full or cut to 16 bits, always rounded to the safe side:
///   bits  0…30  threshold    a rounded h̃ beyond it has the sign of h in the frame's box, one within it is off by no more
///   bit     31  infinite     whether the cell is infinite
///   bits 32…46  error        a bound on |h̃| at the cell's own vertices
///   bits 48…62  determinant  a lower bound on |det| of the edge vectors; 0: none is known
/// Bits 47 and 63 are the engine's (cell_memory.hpp). All numbers are clamped to [smallest, largest], so that
/// they are normal in binary32, except that the determinant may be 0 and a threshold beyond the largest is
/// infinite.
namespace certificate {

constexpr double smallest = 0x1p-126, largest = 0x1p126;
/// From the bits of a number in binary64 to those in binary32: the difference of the exponents' biases and of
/// the widths of the fractions.
constexpr std::uint64_t bias = std::uint64_t{1023 - 127} << 52;
constexpr int fraction_shift = 52 - 23;
constexpr int short_shift = fraction_shift + 16;

/// The field of a threshold, rounded up.
inline std::uint64_t pack_threshold(double threshold) {
  constexpr std::uint64_t infinity = 0x7f800000;  // also for NaN: never certain
  if (!(threshold < largest)) return infinity;
  return ((std::bit_cast<std::uint64_t>(std::max(threshold, smallest)) - bias) >> fraction_shift) + 1;
}

inline std::uint64_t pack(double threshold, double error, double determinant, bool infinite) {
  const auto clamped = [](double x) { return x < largest ? std::max(x, smallest) : largest; };
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x) - bias; };
  const std::uint64_t error_up = (bits(clamped(error)) >> short_shift) + 1;
  const std::uint64_t down =
      determinant >= smallest ? bits(std::min(determinant, largest)) >> short_shift : 0;
  return pack_threshold(threshold) | std::uint64_t{infinite} << 31 | error_up << 32 | down << 48;
}

inline double threshold(std::uint64_t packed) {
  return std::fabs(std::bit_cast<float>(static_cast<std::uint32_t>(packed)));
}
inline double error(std::uint64_t packed) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(packed >> 32 & 0x7fff) << 16);
}
inline double determinant(std::uint64_t packed) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(packed >> 48 & 0x7fff) << 16);
}
inline bool infinite(std::uint64_t packed) { return (packed >> 31 & 1) != 0; }
/// All ones for a finite cell, zero for an infinite one: a mask, as a branch on this would be unpredictable.
inline std::uint64_t finite_mask(std::uint64_t packed) {
  return ~static_cast<std::uint64_t>(static_cast<std::int64_t>(packed << 32) >> 63);
}

}  // namespace certificate
}  // namespace delone::geometry
