// SPDX-License-Identifier: BSD-3-Clause
// delone check of files that hold a Voronoi or power diagram.
#pragma once

#include <string>

namespace delone::cli {

/// Checks a file for which holds_voronoi() is true, up to a level; prints the report, returns the exit
/// status.
int run_voronoi_check(const std::string& path, const std::string& format, int level);

/// The levels, for the help.
std::string voronoi_levels_text();

}  // namespace delone::cli
