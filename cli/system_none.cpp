// SPDX-License-Identifier: BSD-3-Clause
// No operating system that is known: standard C++ only. See system.hpp.
#include <delone/config.hpp>

#if DELONE_PORTABLE || (!defined(_WIN32) && !__has_include(<unistd.h>))

#include "system.hpp"

#include <cerrno>
#include <csignal>
#include <system_error>

namespace delone::cli::system {
namespace {

namespace fs = std::filesystem;

void (*on_signal)(int) = nullptr;

extern "C" void handle_signal(int signal) {
  std::signal(signal, handle_signal);
  on_signal(signal);
}

}  // namespace

void prepare_process() {}
bool is_terminal() { return false; }

int why_not_writable(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return ENOENT;
  return (status.permissions() &
          (fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write)) == fs::perms::none
             ? EACCES
             : 0;
}
int why_not_writable_folder(const std::string& path) { return why_not_writable(path); }

std::string null_device() {
  std::error_code ignored;
  return fs::is_character_file("/dev/null", ignored)
             ? "/dev/null"
             : (fs::temp_directory_path() / "delone-nothing").string();
}
void remove_null(const std::string& path) {
  std::error_code ignored;
  if (path != "/dev/null") fs::remove(path, ignored);
}

/// Files have no numbers; protect_files() then compares paths.
FoundFile find_file(const std::string&) { return {}; }
FoundFile find_file(StandardStream) { return {}; }

std::size_t peak_memory() { return 0; }
std::optional<Memory> memory_now() { return std::nullopt; }
void limit_data(std::uint64_t) {}
void restore_limit_of_data() {}

void watch_signals(void (*caught)(int), void (*)()) {
  on_signal = caught;
  for (const int signal : {SIGINT, SIGTERM})
    if (std::signal(signal, handle_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}
void refuse_writes() {}
void write_error(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

}  // namespace delone::cli::system

#endif
