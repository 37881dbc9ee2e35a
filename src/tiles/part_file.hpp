// SPDX-License-Identifier: BSD-3-Clause
// The files of a part: part-0000.npz, the part itself, and part-0000.seams.npy, the cells of other parts
// across its seams.
#pragma once

#include "io/crc32.hpp"
#include "tiles/finished_tile.hpp"

#include <delone/tiles.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
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

/// What the index says of the two files of a part.
inline io::FileContent content_of_part(const TilePart& part) { return {part.num_bytes, part.crc32}; }
inline io::FileContent content_of_seams(const TilePart& part) {
  return {part.num_seam_bytes, part.seam_crc32};
}

inline void set_content_of_seams(TilePart& part, const io::FileContent& content) {
  part.num_seam_bytes = content.num_bytes;
  part.seam_crc32 = content.crc32;
}

/// Writes FOLDER/part-0000.npz, whole or not at all. Throws cannot_write with the system's reason;
/// bad_format, and changes nothing, unless the file becomes `expected`.
io::FileContent write_part(const std::string& folder, std::size_t number, const TileData& data,
                           const std::optional<io::FileContent>& expected = {});

/// Writes FOLDER/part-0000.seams.npy, in the same way: of each seam the cell, and `rank` offsets.
io::FileContent write_seams(const std::string& folder, std::size_t number,
                            std::span<const std::int64_t> seams, std::size_t rank,
                            const std::optional<io::FileContent>& expected = {});

/// The part without its seams. Shapes and ranges of all arrays are right: cells are numbers of points,
/// entries of `neighbors` are −1, cells of the part, or −2 − s with each s = 0, 1, … once. Throws
/// cannot_open, or bad_format with the name of the file and of the array, or if the file is not `expected`.
TileData read_part(const std::string& folder, std::size_t number,
                   const std::optional<io::FileContent>& expected = {});
/// Adds the seams of a part; each is −1 or a cell among `num_cells` in all, in an open set of another part.
void read_seams(const std::string& folder, std::size_t number, std::int64_t first_cell,
                std::int64_t num_cells, TileData& data, const std::optional<io::FileContent>& expected = {});

/// Part i of a finished folder with this index: the part and its seams, which are as the index says.
TileData read_tile_of(const std::string& folder, const TilesIndex& index, std::size_t i);

/// How many seams the neighbors of a part refer to.
std::size_t count_seams(const TileData& data);

}  // namespace delone::tiles
