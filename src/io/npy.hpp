// SPDX-License-Identifier: BSD-3-Clause
// The .npy format of NumPy (format versions 1 to 3): arrays of numbers, alone in a file or as members of an
// .npz. Reference: numpy.lib.format.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
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

/// What the header of an .npy file says.
struct NpyOpening {
  NpyArray array;              ///< without data
  std::size_t data_begin = 0;  ///< where the data begin in the file
};
/// Parses the header from the first bytes of a file of `file_size` bytes: all of them, or largest_npy_header.
/// Throws bad_format, also for sizes that disagree, or unsupported for other kinds of data.
NpyOpening parse_npy_opening(std::string_view opening, std::size_t file_size, const std::string& name);
inline constexpr std::size_t largest_npy_header = std::size_t{1} << 20;

/// Parses a whole .npy file. Throws as parse_npy_opening().
NpyArray parse_npy(std::string_view bytes, const std::string& name);

/// The items of a 0-, 1- or 2-D array in row-major order. Integers that binary64 cannot hold are an error
/// (bad_format). `first_row`: the number of the first row, for messages.
std::vector<double> to_doubles(const NpyArray& array, const std::string& name, std::size_t first_row = 0);
/// The items of an array of integers in row-major order. Throws bad_format for other kinds and for values
/// beyond SignedIndex.
std::vector<SignedIndex> to_indices(const NpyArray& array, const std::string& name);

/// The texts of an .npy file with an array of Unicode strings (type U), in UTF-8; `rank`: of how many
/// dimensions, 1 or 0, which is one text. Throws bad_format.
std::vector<std::string> parse_npy_texts(std::string_view bytes, const std::string& name,
                                         std::size_t rank = 1);
/// A whole .npy file of one text in ASCII, an array of no dimension.
std::string npy_of_text(std::string_view text);
/// A whole .npy file of texts in UTF-8; bytes that are none become U+FFFD.
std::string npy_of_texts(const std::vector<std::string>& texts);

/// "(3, 4)"
std::string shape_text(const std::vector<std::size_t>& shape);

/// The header of a little-endian, C-ordered array, version 1.0, padded to a multiple of 64 bytes. `type`:
/// "f8", "i4", …
std::string npy_header(std::string_view type, const std::vector<std::size_t>& shape);

/// The type of SignedIndex: "i4" or "i8".
inline constexpr std::string_view npy_index_type = sizeof(SignedIndex) == 4 ? "i4" : "i8";

}  // namespace delone::io
