// SPDX-License-Identifier: BSD-3-Clause
// All of the command that depends on the operating system: POSIX, Windows, or with DELONE_PORTABLE none.
// Where a system does not offer something, the function does nothing and says so. Errors are errno values.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace delone::cli::system {

/// To be called first: standard streams pass bytes as they are, and large blocks, such as the contents of
/// files, are returned to the system as soon as they are freed.
void prepare_process();

/// Whether standard error is a terminal. False where that is not known.
bool is_terminal();

/// Whether that file, or a file in that folder, can be written: 0, or why not.
int why_not_writable(const std::string& path);
int why_not_writable_folder(const std::string& path);

/// Where nothing is kept of what is written: a device, or on Windows, whose NUL is no file that can be asked
/// about, a file that is removed.
std::string null_device();
/// To be called after such a write.
void remove_null(const std::string& path);

/// A regular file, whatever its path.
struct FileNumber {
  std::uint64_t device = 0, number = 0;
  friend bool operator==(const FileNumber&, const FileNumber&) = default;
};
enum class StandardStream { input, output };
/// What is found at a path, or behind a standard stream.
struct FoundFile {
  bool exists = false;               ///< and is known
  std::optional<FileNumber> number;  ///< of a regular file
};
FoundFile find_file(const std::string& path);
FoundFile find_file(StandardStream stream);

/// The most memory that this process had in use, in bytes; 0 if it is not known.
std::size_t peak_memory();
/// What this process has, in bytes: resident, and what could become so without another allocation. Nothing
/// if it is not known.
struct Memory {
  std::uint64_t resident = 0, data = 0;
};
std::optional<Memory> memory_now();
/// Lets allocations fail beyond so much data, or as before.
void limit_data(std::uint64_t bytes);
void restore_limit_of_data();

/// Calls `caught` with SIGINT or SIGTERM as soon as such a signal arrives, and `grace_over` after `grace`
/// seconds more, both at any place of the program or in another thread. A signal that was ignored stays
/// ignored. Without an operating system `grace_over` is not called.
void watch_signals(void (*caught)(int signal), void (*grace_over)());
/// Makes every further write to a regular file fail, where that is possible. May be called by `caught`.
void refuse_writes();
/// Writes to standard error. May be called by `grace_over`.
void write_error(std::string_view text);

}  // namespace delone::cli::system
