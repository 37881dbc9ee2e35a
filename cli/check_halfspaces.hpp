// SPDX-License-Identifier: BSD-3-Clause
// delone check of what `delone halfspaces` wrote.
#pragma once

#include <delone/halfspaces.hpp>

#include <string>

namespace delone::cli {

/// Examines an intersection up to a level, prints what was found, returns the exit status.
int run_halfspaces_check(const IntersectionData& data, const std::string& path, int level);

/// The levels, for --help.
std::string halfspaces_check_footer();

}  // namespace delone::cli
