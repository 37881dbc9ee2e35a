// SPDX-License-Identifier: BSD-3-Clause
// The cut into tiles as a file: other ranks would choose another sample, and cut elsewhere.
#pragma once

#include "tiles/split_tree.hpp"

#include <optional>
#include <string>

namespace delone::mpi {

/// Writes FOLDER/work/split.json atomically.
void write_split_tree(const std::string& work, const tiles::SplitTree& tree);
/// Nothing if there is no such file. Throws bad_format unless it is a tree of so many tiles.
std::optional<tiles::SplitTree> read_split_tree(const std::string& work, int dimension,
                                                std::size_t num_tiles);

}  // namespace delone::mpi
