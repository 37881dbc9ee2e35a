// SPDX-License-Identifier: BSD-3-Clause
#include "tiles_folder.hpp"

#include "command.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace delone::cli {

bool is_folder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

TilesIndex read_finished(const std::string& folder) {
  if (const auto unfinished = find_unfinished_tiles(folder))
    throw Error(
        Errc::cannot_open,
        fmt::format("{}: not finished: {} of {} tiles are done; the command that made it continues with it",
                    input_name(folder), unfinished->num_finished, unfinished->num_tiles));
  return read_tiles_index(folder);
}

}  // namespace delone::cli
