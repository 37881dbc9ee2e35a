// SPDX-License-Identifier: BSD-3-Clause
// The readers of points, one per family of formats. They get the bytes of a file and its name for messages,
// and throw Error. Where missing values are left out they are NaN in the table.
#pragma once

#include "io/collect.hpp"
#include "io/line_parts.hpp"
#include "io/points/columns.hpp"

#include <delone/io.hpp>

#include <string>
#include <string_view>

namespace delone::io {

struct NpyArray;

/// csv (',') and tsv (tab).
PointTable read_delimited(std::string_view bytes, const std::string& name, char delimiter,
                          const ColumnChoice& choice = {}, const ReadingInParts& how = {},
                          Missing missing = Missing::refused);
/// txt, xyz, pts: rows of numbers, '#' comments.
PointTable read_white_space(std::string_view bytes, const std::string& name, const ReadingInParts& how = {},
                            Missing missing = Missing::refused);
/// Dimension, rest of the line ignored; count; that many rows, in any layout.
PointTable read_qhull(std::string_view bytes, const std::string& name, Missing missing = Missing::refused);
/// The chemists' xyz: a count, a comment, and an element and three coordinates per line.
PointTable read_xyz(std::string_view bytes, const std::string& name, Missing missing = Missing::refused);
/// The lines ATOM and HETATM of the Protein Data Bank's format.
PointTable read_pdb(std::string_view bytes, const std::string& name, Missing missing = Missing::refused);
/// LAS 1.0 to 1.4, not compressed.
PointTable read_las(std::string_view bytes, const std::string& name, Missing missing = Missing::refused);
/// The rows of a 2-D array, or the items of a 1-D array as points of dimension 1.
PointTable points_of(const NpyArray& array, const std::string& name, Missing missing = Missing::refused);
PointTable read_npy(std::string_view bytes, const std::string& name, Missing missing = Missing::refused);
/// The vertices of an OFF, COFF or nOFF file.
PointTable read_off(std::string_view bytes, const std::string& name, Missing missing = Missing::refused);
/// Chooses properties of the vertices, by their names: x, y and, if there is one, z, unless told otherwise.
PointTable read_ply(std::string_view bytes, const std::string& name, const ColumnChoice& choice = {},
                    Missing missing = Missing::refused);

}  // namespace delone::io
