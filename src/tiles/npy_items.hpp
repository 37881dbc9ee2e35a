// SPDX-License-Identifier: BSD-3-Clause
// Arrays of one type exactly, as .npy files of parts hold them: float64, int64 and int32, in C order.
#pragma once

#include "io/file.hpp"
#include "io/npy.hpp"

#include <delone/export.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace delone::tiles {

template <class T>
DELONE_HIDDEN inline constexpr std::string_view npy_type = std::is_same_v<T, double>         ? "f8"
                                                           : std::is_same_v<T, std::int64_t> ? "i8"
                                                                                             : "i4";

/// Throws bad_format unless the array has the type T, C order, and so many dimensions.
template <class T>
std::vector<T> npy_items(const io::NpyArray& array, std::size_t rank, const std::string& name) {
  static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::int64_t> ||
                std::is_same_v<T, std::int32_t>);
  if (array.kind != npy_type<T>[0] || array.item_size != sizeof(T) || array.big_endian)
    io::fail(Errc::bad_format, "{}: expected numbers of type <{}, found {}{}{}", name, npy_type<T>,
             array.big_endian ? '>' : '<', array.kind, array.item_size);
  if (array.shape.size() != rank || (rank > 1 && array.fortran_order))
    io::fail(Errc::bad_format, "{}: expected a {}-D array, found shape {}{}", name, rank,
             io::shape_text(array.shape), array.fortran_order ? " in Fortran order" : "");
  std::vector<T> items(array.num_items());
  if (!items.empty()) std::memcpy(items.data(), array.data.data(), array.data.size());
  if constexpr (std::endian::native == std::endian::big)
    for (T& item : items) {
      auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(item);
      std::reverse(bytes.begin(), bytes.end());
      item = std::bit_cast<T>(bytes);
    }
  return items;
}

}  // namespace delone::tiles
