// SPDX-License-Identifier: BSD-3-Clause
// Files as the operating system has them. Paths are in UTF-8. Errors are errno values on every system.
#pragma once

#include "base/platform.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace delone::platform {

/// A path of a UTF-8 text. On Windows std::filesystem::path takes texts to be in another encoding.
inline std::filesystem::path path_of(const std::string& text) {
#if DELONE_WINDOWS
  return std::filesystem::path(std::u8string(text.begin(), text.end()));
#else
  return text;
#endif
}
/// The UTF-8 text of a path.
inline std::string text_of(const std::filesystem::path& path) {
#if DELONE_WINDOWS
  const std::u8string text = path.u8string();
  return std::string(text.begin(), text.end());
#else
  return path.string();
#endif
}

/// std::fopen, for bytes: "rb", "wb" or "ab". Sets errno on failure.
std::FILE* open_file(const std::string& path, const char* mode);
/// Opens a new file for writing. Fails with EEXIST if there is one. Sets errno on failure.
std::FILE* create_file(const std::string& path);
/// Removes a file, if it is there. Outside Windows without memory, unlike std::filesystem.
void remove_file(const std::string& path);
/// Lets a standard stream pass bytes as they are; Windows would change line ends.
void pass_bytes(std::FILE* stream);

/// A file that is read and written at any place, by several threads at once. Functions return an errno value,
/// 0 for success.
class RawFile {
 public:
  RawFile();
  RawFile(RawFile&& other) noexcept;
  RawFile& operator=(RawFile&&) = delete;
  ~RawFile();

  /// Opens a file to be read or, created or emptied, to be written too.
  [[nodiscard]] int open(const std::string& path, bool writes);
  /// Once it was closed, or if it was never open, it is closed already.
  [[nodiscard]] int close();
  [[nodiscard]] int size(std::uint64_t& size) const;
  /// At least one byte, unless the file ends at `offset`. Sets `done` to their number.
  [[nodiscard]] int read_some(std::uint64_t offset, void* data, std::size_t size, std::size_t& done) const;
  /// At least one byte.
  [[nodiscard]] int write_some(std::uint64_t offset, const void* data, std::size_t size, std::size_t& done);

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

/// Wait until what was written of a stream without a buffer, or of a file by whomever, is on the disk, so
/// that it outlasts a power cut. Return 0, or an errno value; 0 also where there is no such thing as that, be
/// it of the system or of its file.
[[nodiscard]] int sync_stream(std::FILE* stream);
[[nodiscard]] int sync_file(const std::string& path);
/// The same for the names in a folder: of files that were created, renamed or removed.
[[nodiscard]] int sync_folder(const std::string& path);
/// Waits for a piece of a file, so that sync_file(), which nothing can stop, has little left to do. Does
/// nothing where the system cannot do that.
[[nodiscard]] int sync_piece(const std::string& path, std::uint64_t offset, std::uint64_t size);

/// A file that one process at a time may hold: given back at the end of this object, or of the process.
class FileLock {
 public:
  /// Creates the file if need be.
  explicit FileLock(const char* path);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();
  /// Whether this process holds it. True where the system has no such locks, or not for this file.
  bool is_held() const { return is_held_; }

 private:
  std::intptr_t file_ = -1;
  bool is_held_ = true;
};

}  // namespace delone::platform
