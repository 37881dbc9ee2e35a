// SPDX-License-Identifier: BSD-3-Clause
// Ratios of heights and values in binary32, and the integers by which they are compared without division.
//
// The bits of a positive number in binary32, read as an integer, are its logarithm to base 2 in units of
// 2^−23, up to a constant: of 2^e·(1 + m), 0 ≤ m < 1, they give e + m where the logarithm is e + log2(1 + m).
// That is too small by at most `logarithm_error`: log2(1 + m) − m is largest at m = 1/ln 2 − 1, where it is
// 0.0860714 (Mitchell, Computer multiplication and division using binary logarithms, 1962,
// doi:10.1109/TEC.1962.5219391). The key of a ratio, the bits of the height less those of the value, is
// therefore the logarithm of the ratio up to `logarithm_error` in either direction.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace delone::geometry {

/// The height of vertices that must not be found, those of the cell itself and those that fill the last
/// blocks; and the ratio of vertices that are not beyond the facet.
inline constexpr float out_of_reach = std::numeric_limits<float>::infinity();
/// Only vertices whose ratio is at most this are listed.
inline constexpr float largest_ratio = 0x1p80f;
/// If `least` is the least ratio in binary32, the vertex of the least exact ratio has at most this one.
inline float bound_of(float least) { return least + 0x1p-6f * std::fabs(least); }

/// Ratios are compared by keys where all heights are larger than this.
inline constexpr float least_height = 0x1p-40f;
/// How much the key grows when the ratio doubles.
inline constexpr std::int32_t octave = 1 << 23;
inline constexpr std::int32_t logarithm_error = 722'100;  // 0.0860714 octaves, rounded up
/// These lowest bits of a key are replaced by the place of the vertex in its tile.
inline constexpr std::int32_t place_mask = 1023;
/// The least ratio has a key of at most the least key + doubt; and `ratio_below(least key + doubt)` is no
/// less than the ratio of the vertex with the least key.
inline constexpr std::int32_t doubt = 2 * (logarithm_error + place_mask);
/// Only vertices whose key is at most this are listed. Vertices that are not beyond the facet have larger
/// keys: their value counts as 0, and the bits of a height are at least 127 − 40 = 87 octaves. So have those
/// out of reach: the bits of infinity are 255 octaves, those of a value, which is less than 2^40, at most
/// 167.
inline constexpr std::int32_t largest_key = 80 * octave;

/// Ratios with larger keys are not less than this.
inline float ratio_below(std::int32_t key) {
  return std::exp2(static_cast<float>(key - place_mask - logarithm_error) / octave) * (1 - 0x1p-18f);
}
/// Positive ratios up to this one have no larger keys.
inline std::int32_t key_above(float ratio) {
  constexpr std::int32_t bits_of_one = std::bit_cast<std::int32_t>(1.0f);
  return std::bit_cast<std::int32_t>(std::max(ratio, 0.0f)) - bits_of_one +
         2 * (logarithm_error + place_mask);
}

}  // namespace delone::geometry
