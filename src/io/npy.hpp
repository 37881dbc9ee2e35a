// SPDX-License-Identifier: BSD-3-Clause
// The .npy format of NumPy (format versions 1 to 3): arrays of numbers, alone in a file or as members of an
// .npz. Reference: numpy.lib.format.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace delone::io {

/// An array of integers or floating-point numbers; a view of the bytes it was parsed from.
struct NpyArray {
  char kind = 'f';            ///< 'f' floating point, 'i' signed, 'u' unsigned
  std::size_t item_size = 8;  ///< 4 or 8 for 'f'; 1, 2, 4, 8 for 'i' and 'u'
  bool big_endian = false;
  bool fortran_order = false;
  std::vector<std::size_t> shape;
  std::string_view data;  ///< exactly num_items() · item_size bytes

  std::size_t num_items() const { return data.size() / item_size; }
};

/// Throws bad_format unless a file with this opening can be an .npy file.
void require_npy(std::string_view opening, const std::string& name);

/// Parses a whole .npy file. Throws bad_format, or unsupported for other kinds of data.
NpyArray parse_npy(std::string_view bytes, const std::string& name);

/// The items of a 0-, 1- or 2-D array in row-major order. Integers that binary64 cannot hold are an error
/// (bad_format).
std::vector<double> to_doubles(const NpyArray& array, const std::string& name);
/// The items of an array of integers in row-major order. Throws bad_format for other kinds and for values
/// beyond SignedIndex.
std::vector<SignedIndex> to_indices(const NpyArray& array, const std::string& name);

/// "(3, 4)"
std::string shape_text(const std::vector<std::size_t>& shape);

/// The header of a little-endian, C-ordered array, version 1.0, padded to a multiple of 64 bytes. `type`:
/// "f8", "i4", …
std::string npy_header(std::string_view type, std::initializer_list<std::size_t> shape);

/// The type of SignedIndex: "i4" or "i8".
inline constexpr std::string_view npy_index_type = sizeof(SignedIndex) == 4 ? "i4" : "i8";

}  // namespace delone::io
