// SPDX-License-Identifier: BSD-3-Clause
// Folders of tiles, where other commands take files.
#pragma once

#include <delone/tiles.hpp>

#include <string>

namespace delone::cli {

/// Whether the path is that of a folder.
bool is_folder(const std::string& path);

/// Throws Error unless the folder has an index: cannot_open, and how many tiles are done if it is not
/// finished.
TilesIndex read_finished(const std::string& folder);

}  // namespace delone::cli
