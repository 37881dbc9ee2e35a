// SPDX-License-Identifier: BSD-3-Clause
// A file that is read and written at any place, by several threads at once: what is too large for memory.
#pragma once

#include "base/platform_files.hpp"

#include <cstddef>
#include <cstdint>
#include <string>

namespace delone::io {

class PositionedFile {
 public:
  enum class Mode { read, write };
  /// Opens a file for reading, or creates one for both; what it held before is lost. `name`: what messages
  /// call it, if that is not its path. Throws cannot_open, or cannot_write, with the system's reason.
  explicit PositionedFile(const std::string& path, Mode mode = Mode::read, std::string name = {});
  PositionedFile(PositionedFile&& other) noexcept = default;
  PositionedFile& operator=(PositionedFile&&) = delete;
  ~PositionedFile() = default;

  /// As the system has it now.
  std::uint64_t size() const;
  /// Fewer bytes than `size` only at the end of the file. Throws cannot_open.
  std::size_t read_some(std::uint64_t offset, void* data, std::size_t size) const;
  /// Throws bad_format if the file ends before that.
  void read(std::uint64_t offset, void* data, std::size_t size) const;
  /// Throws cannot_write.
  void write(std::uint64_t offset, const void* data, std::size_t size);
  /// Closes a file that was written, so that errors which the system has put off are seen. Throws
  /// cannot_write.
  void close();

  const std::string& name() const { return name_; }

 private:
  std::string name_;
  platform::RawFile file_;
};

}  // namespace delone::io
