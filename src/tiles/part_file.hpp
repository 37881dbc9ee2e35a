// SPDX-License-Identifier: BSD-3-Clause
// The files of a part: part-0000.npz, the part itself, and part-0000.seams.npy, the cells of other parts
// across its seams.
#pragma once

#include "tiles/finished_tile.hpp"

#include <delone/tiles.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delone::tiles {

/// "part-0000.npz"
std::string part_name(std::size_t number);
/// "part-0000.seams.npy"
std::string seams_name(std::size_t number);
/// FOLDER/name, as paths of this system are.
std::string path_in(const std::string& folder, const std::string& name);

/// Writes FOLDER/part-0000.npz, whole or not at all, and returns its size in bytes. Throws cannot_write with
/// the system's reason.
std::uint64_t write_part(const std::string& folder, std::size_t number, const FinishedTile& tile);
std::uint64_t write_part(const std::string& folder, std::size_t number, const TileData& data);

/// Writes FOLDER/part-0000.seams.npy, whole or not at all.
void write_seams(const std::string& folder, std::size_t number, std::span<const std::int64_t> seams);

/// The part without its seams. Shapes and ranges of all arrays are right: cells are numbers of points,
/// entries of `neighbors` are −1, cells of the part, or −2 − s with each s = 0, 1, … once. Throws
/// cannot_open, or bad_format with the name of the file and of the array.
TileData read_part(const std::string& folder, std::size_t number);
/// The seams of a part that has so many; each is −1 or a cell of another part among `num_cells` in all.
std::vector<std::int64_t> read_seams(const std::string& folder, std::size_t number, std::size_t num_seams,
                                     std::int64_t first_cell, std::int64_t num_cells_of_part,
                                     std::int64_t num_cells);

/// Part i of a finished folder with this index: the part and its seams, which agree with the index.
TileData read_tile_of(const std::string& folder, const TilesIndex& index, std::size_t i);

/// How many seams the neighbors of a part refer to.
std::size_t count_seams(const TileData& data);

}  // namespace delone::tiles
