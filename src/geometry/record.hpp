// SPDX-License-Identifier: BSD-3-Clause
// What is cached for a cell, in k + 2 doubles: the functional's k coefficients and constant, and packed into the last the
// threshold of the filter, the error at the vertices and the determinant, which the functionals of later cells are made from.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace delone::geometry {

/// A positive number in 16 bits: sign-less binary32 cut to 8 significant bits, rounded towards a chosen side.
inline std::uint16_t pack_up(double x) {
  constexpr double largest = 0x1p126;
  if (!(x < largest)) return 0x7f80;  // infinity
  const float f = static_cast<float>(x * (1 + 0x1p-22)) + std::numeric_limits<float>::min();
  return static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(f) + 0xffff) >> 16);
}
inline std::uint16_t pack_down(double x) {
  const float f = static_cast<float>(x * (1 - 0x1p-22));
  return f >= std::numeric_limits<float>::min() ? static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(f) >> 16)
                                                : std::uint16_t{0};
}
inline double unpack(std::uint16_t bits) { return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16); }

/// The certificate of a functional h̃ that stands for h (docs/predicates.md, "The filter").
struct Certificate {
  float threshold;      ///< |h̃ − h| with rounded evaluation stays below it in the frame's box; negated for an infinite cell
  std::uint16_t error;  ///< packed bound on |h̃| at the cell's own vertices
  std::uint16_t determinant;  ///< packed lower bound on |det| of the edge vectors; 0: none is known
};
static_assert(sizeof(Certificate) == sizeof(double));

inline Certificate make_certificate(double threshold, double error, double determinant, bool infinite) {
  // Rounded up to float; whatever is not a number or too large means: never certain.
  constexpr double largest = std::numeric_limits<float>::max() / 2;
  const float t = threshold < largest ? static_cast<float>(threshold * (1 + 0x1p-22)) + std::numeric_limits<float>::min()
                                      : std::numeric_limits<float>::infinity();
  return {infinite ? -t : t, pack_up(error), pack_down(determinant)};
}

inline Certificate load_certificate(const double* slot) { return std::bit_cast<Certificate>(*slot); }
inline void store_certificate(double* slot, const Certificate& certificate) { *slot = std::bit_cast<double>(certificate); }

}  // namespace delone::geometry
