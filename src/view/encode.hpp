// SPDX-License-Identifier: BSD-3-Clause
// Arrays as bytes of a page. viewer/src/decode.js reads them.
//
//   planes      numbers below 256^b: first all lowest bytes, then all second ones, …, each number as the
//               difference from the one `stride` before it, modulo 256^b
//   simplices   seven bits a byte, lowest first, the eighth bit: there are more; differences d as 2d, or
//               −2d−1: corner 0 from corner 0 of the simplex before, other corners from the corner before
//   polytopes   the same code: number of faces; for each the number of its vertices, then these as
//               differences from the vertex before
//   numbers     planes of codes: equal steps from low to high, of logarithms if `log`; the largest code: none
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delone::view {

struct Box {
  std::vector<double> low, high;
};

/// The bounding box of points of d coordinates each, enlarged to contain `box` if that has limits. NaN, the
/// coordinates of removed rows, is nowhere.
Box box_of(std::span<const double> points, int dimension, Box box = {});

inline constexpr int position_bytes = 3;

/// Each coordinate as the nearest of 256^3 equal steps between the limits of its axis. Clamped to these.
std::vector<std::uint32_t> codes_of_positions(std::span<const double> points, const Box& box);

/// The rounding of positions, at most, along any axis.
double position_error(const Box& box);

/// Numbers as codes. Those that are not finite, or not positive with `log`, have none.
struct Numbers {
  std::vector<std::uint32_t> codes;
  int bytes = 3;
  double low = 0, high = 0;  ///< of the logarithms if `log`
  bool log = false;
};
Numbers codes_of_numbers(std::span<const double> numbers, int bytes, bool log = false);

std::string planes(std::span<const std::uint32_t> items, int bytes, std::size_t stride);
/// The bytes that numbers up to `largest` take.
int bytes_for(std::uint64_t largest);
std::string simplices(std::span<const SignedIndex> cells, int corners);
std::string polytopes(std::span<const SignedIndex> face_counts, std::span<const SignedIndex> face_sizes,
                      std::span<const SignedIndex> face_vertices);

/// Compressed (zlib, RFC 1950) if the build has zlib and this makes it smaller; says whether. `tell` hears
/// from time to time which part is done, 0 … 1.
bool deflate(std::string& bytes, const std::function<void(double)>& tell = {});

void append_base64(std::string& text, std::string_view bytes);

}  // namespace delone::view
