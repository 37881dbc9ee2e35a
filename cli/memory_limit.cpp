// SPDX-License-Identifier: BSD-3-Clause
#include "memory_limit.hpp"

#include "interrupt.hpp"
#include "output.hpp"
#include "system.hpp"

#include <delone/error.hpp>
#include <delone/forecast.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace delone::cli {
namespace {

/// The limit of this process. It stays after the object, for the message.
std::uint64_t memory_limit = 0;
bool may_tile = false;
std::string input;

}  // namespace

MemoryLimit::MemoryLimit(const std::string& name, std::uint64_t bytes, bool can_tile) {
  input = name;
  memory_limit = bytes;
  may_tile = can_tile;
  if (bytes == 0) return;
  scope_.emplace([](double) { return memory_suffices(); });
  if (!memory_suffices()) throw Error(Errc::out_of_memory, memory_message());
}

MemoryLimit::~MemoryLimit() {
  if (scope_) system::restore_limit_of_data();
}

void MemoryLimit::set_points(const PointTable& table) {
  if (memory_limit > 0)
    may_tile = may_tile && tiles_pay(table.dimension, PointsView(table.coordinates, table.dimension).size(),
                                     memory_limit);
}

void warn_of_memory(const PointTable& table, const BuildOptions& build) {
  constexpr double short_time = 60;
  if (build.quiet || build.memory > 0 || (build.time > 0 && build.time < short_time)) return;
  const StageGuard guard(Stage::building);
  const std::string text = memory_warning(PointsView(table.coordinates, table.dimension), table.dimension,
                                          {.threads = build.threads});
  if (!text.empty()) print_note(fmt::format("delone: warning: {}\n", text));
}

bool memory_suffices() {
  if (memory_limit == 0) return true;
  const std::optional<system::Memory> memory = system::memory_now();
  if (!memory) return true;
  // Pages of memory that was allocated before can be written until the next call.
  const std::uint64_t margin = std::min<std::uint64_t>(memory_limit / 8, std::uint64_t{64} << 20);
  const std::uint64_t end = memory_limit - margin;
  if (memory->resident > end) return false;
  system::limit_data(memory->data + (end - memory->resident));
  return true;
}

std::string memory_message(const std::string& known) {
  if (memory_limit == 0) return {};
  // The library says how far it came and what the whole would have taken.
  const bool says_all = known.find("stopped at the limit") != std::string::npos;
  std::string text = says_all ? known
                              : fmt::format("{}: more memory is needed than --memory allows, {} byte{}",
                                            input, memory_limit, memory_limit == 1 ? "" : "s");
  if (may_tile) text += "; with a folder as output, as in -o OUT/, the triangulation is made in tiles";
  return text;
}

}  // namespace delone::cli
