// SPDX-License-Identifier: BSD-3-Clause
// FOLDER/index.json: what a finished folder of tiles holds. It is written last.
#pragma once

#include <delone/tiles.hpp>

#include <string>

namespace delone::tiles {

inline constexpr const char* index_name = "index.json";

/// Writes the index, whole or not at all, also at a power cut. `fingerprint` tells the input; see Plan.
void write_tiles_index(const std::string& folder, const TilesIndex& index, const std::string& fingerprint);

/// The index and the fingerprint that was written with it. Throws cannot_open, or bad_format unless all
/// numbers are possible and agree with each other.
TilesIndex read_tiles_index(const std::string& folder, std::string& fingerprint);

bool has_tiles_index(const std::string& folder);

/// Whether an index that cannot be read is one nevertheless, and not a file of others: beside it is a part,
/// and it has our format, or is no JSON at all.
bool is_damaged_index(const std::string& folder);

}  // namespace delone::tiles
