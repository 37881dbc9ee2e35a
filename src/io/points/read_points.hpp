// SPDX-License-Identifier: BSD-3-Clause
// The readers of points, one per family of formats. They get the bytes of a file and its name for messages,
// and throw Error.
#pragma once

#include "io/line_parts.hpp"

#include <delone/io.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace delone::io {

struct NpyArray;

/// The columns to read of a table with `width` of them and without names: `wanted`, all if it is empty; then,
/// unless empty, `last`, which is not one of all then. Throws bad_format with the name of the file.
std::vector<std::size_t> column_numbers(const std::vector<std::string>& wanted, const std::string& last,
                                        std::size_t width, const std::string& name);

/// csv (',') and tsv (tab). `columns`: names of a header or 0-based numbers; empty for all.
PointTable read_delimited(std::string_view bytes, const std::string& name, char delimiter,
                          const std::vector<std::string>& columns, const ReadingInParts& how = {});
/// txt, xyz, pts: rows of numbers, '#' comments.
PointTable read_white_space(std::string_view bytes, const std::string& name, const ReadingInParts& how = {});
/// Dimension, rest of the line ignored; count; that many rows, in any layout.
PointTable read_qhull(std::string_view bytes, const std::string& name);
/// The rows of a 2-D array, or the items of a 1-D array as points of dimension 1.
PointTable points_of(const NpyArray& array, const std::string& name);
PointTable read_npy(std::string_view bytes, const std::string& name);
/// The vertices of an OFF, COFF or nOFF file.
PointTable read_off(std::string_view bytes, const std::string& name);
/// `columns`: properties of the vertices; empty for x, y and, if there is one, z.
PointTable read_ply(std::string_view bytes, const std::string& name, const std::vector<std::string>& columns);

}  // namespace delone::io
