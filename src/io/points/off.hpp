// SPDX-License-Identifier: BSD-3-Clause
// The OFF formats of Geomview: OFF (3-D), COFF (3-D, colours after each vertex) and nOFF (any dimension).
#pragma once

#include "io/collect.hpp"

#include <delone/io.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace delone::io {

struct OffHeader {
  int dimension = 3;
  bool colours = false;
  std::uint64_t num_vertices = 0, num_cells = 0;
  std::string_view comments;  ///< what is before the counts
};

/// How the comment begins that says what data the file holds; the name of the kind follows.
inline constexpr std::string_view off_kind_comment = "# delone: ";

/// Reads up to the counts and the end of their line.
OffHeader read_off_header(TextCursor& at);
/// Reads the vertices, one per line.
PointTable read_off_vertices(TextCursor& at, const OffHeader& header, Missing missing = Missing::refused);
/// Vertices and cells; all cells must have the same number of vertices, k + 1.
ComplexData read_off_complex(std::string_view bytes, const std::string& name);

}  // namespace delone::io
