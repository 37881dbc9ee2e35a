// SPDX-License-Identifier: BSD-3-Clause
#include "memory_limit.hpp"

#include <delone/error.hpp>

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace delone::cli {
namespace {

/// The limit of this process. It stays after the object, for the message.
std::uint64_t memory_limit = 0;
rlimit data_before{};

/// What this process has, in bytes: resident, and what could become so without another allocation.
struct Memory {
  std::uint64_t resident = 0, data = 0;
};

std::optional<Memory> memory_now() {
  std::optional<Memory> memory;
#ifdef __linux__
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    unsigned long long resident = 0, data = 0;
    if (std::fscanf(file, "%*u %llu %*u %*u %*u %llu", &resident, &data) == 2) {
      const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
      memory = Memory{resident * page, data * page};
    }
    std::fclose(file);
  }
#endif
  return memory;
}

}  // namespace

MemoryLimit::MemoryLimit(std::uint64_t bytes) {
  memory_limit = bytes;
  if (bytes == 0) return;
  getrlimit(RLIMIT_DATA, &data_before);
  scope_.emplace([](double) { return memory_suffices(); });
  if (!memory_suffices()) throw Error(Errc::out_of_memory, memory_message());
}

MemoryLimit::~MemoryLimit() {
  if (scope_) setrlimit(RLIMIT_DATA, &data_before);
}

bool memory_suffices() {
  if (memory_limit == 0) return true;
  const std::optional<Memory> memory = memory_now();
  if (!memory) return true;
  // Pages of memory that was allocated before can be written until the next call.
  const std::uint64_t margin = std::min<std::uint64_t>(memory_limit / 8, std::uint64_t{64} << 20);
  const std::uint64_t end = memory_limit - margin;
  if (memory->resident > end) return false;
  rlimit data = data_before;
  data.rlim_cur = std::min<rlim_t>(memory->data + (end - memory->resident), data.rlim_max);
  setrlimit(RLIMIT_DATA, &data);
  return true;
}

std::string memory_message() {
  if (memory_limit == 0) return {};
  return fmt::format(
      "more memory is needed than --memory allows, {} bytes; with a folder as output, as in -o OUT/, the "
      "triangulation is made in tiles",
      memory_limit);
}

}  // namespace delone::cli
