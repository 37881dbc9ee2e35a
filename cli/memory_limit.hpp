// SPDX-License-Identifier: BSD-3-Clause
// --memory where all has to be in memory: the command ends at the limit, before the machine suffers.
#pragma once

#include "build_options.hpp"

#include <delone/progress.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace delone::cli {

/// While it lives, the resident memory of the process stays within a limit. Progress callbacks ask
/// memory_suffices(), so that work ends some megabytes below the limit. What may still be allocated is
/// limited at the same time (RLIMIT_DATA, or by a job of Windows) to what is left, so that no array between
/// two such calls goes beyond it. Systems that do not tell their memory have no limit.
class MemoryLimit {
 public:
  /// 0: none. `name`: of the input, for messages. `can_tile`: whether the same could be made in tiles.
  MemoryLimit(const std::string& name, std::uint64_t bytes, bool can_tile = false);
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;
  ~MemoryLimit();

  /// Which points they are: tiles are recommended only where they pay.
  void set_points(const PointTable& table);

 private:
  std::optional<ProgressScope> scope_;
};

/// Says on standard error, unless `quiet`, that the triangulation of points is expected to need more memory
/// than is available. Where there is a limit of memory, or of time below a minute, that will say it.
void warn_of_memory(const PointTable& table, const BuildOptions& build);

/// False once the limit of memory is reached.
bool memory_suffices();

/// What to say where memory was not enough; empty if there is no limit. `known`: what the library says.
std::string memory_message(const std::string& known = {});

}  // namespace delone::cli
