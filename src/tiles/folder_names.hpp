// SPDX-License-Identifier: BSD-3-Clause
// What belongs to a folder of tiles, finished or not, and what is somebody else's.
#pragma once

#include "base/platform_files.hpp"

#include <memory>
#include <string>
#include <system_error>

namespace delone::tiles {

/// The folder in a folder of tiles that has what is needed to go on.
inline constexpr const char* work_name = "work";

/// Throws cannot_write with the system's reason.
[[noreturn]] void cannot_write(const std::string& path, const std::error_code& error);

/// The names in the folder, and in its folder `work`, that no folder of tiles has, as messages say them;
/// empty if there are none.
std::string foreign_names(const std::string& folder);

/// Removes what folders of tiles have, the plan and the index last.
void remove_parts(const std::string& folder);

/// Locks FOLDER/work, which has to be there. Throws cannot_write if another process has it.
std::unique_ptr<platform::FileLock> lock_work(const std::string& folder);
/// Removes FOLDER/work, of which this is the lock.
void remove_work(const std::string& folder, std::unique_ptr<platform::FileLock> lock);
/// Removes FOLDER/work from a finished folder, if a call has ended just before it did so: nothing of others
/// is there, and no process works there.
void remove_leftover_work(const std::string& folder);

}  // namespace delone::tiles
