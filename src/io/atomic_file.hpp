// SPDX-License-Identifier: BSD-3-Clause
// A file that appears whole or not at all: written beside its target under another name, renamed by commit(), removed by
// the destructor if that was not reached. Text is collected in a buffer and every write is checked.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace delone::io {

class AtomicFile {
 public:
  /// "-" is standard output. An existing target that is not a regular file (a device, a pipe) is written to directly; a
  /// symbolic link is followed. Throws cannot_write with the system's reason, as all members do.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
    if (buffer_.size() >= flush_at) flush();
  }
  /// A number in decimal, a double in the fewest digits that read back as the same value.
  template <class Number>
  void put(Number value) {
    fmt::format_to(std::back_inserter(buffer_), FMT_COMPILE("{}"), value);
    if (buffer_.size() >= flush_at) flush();
  }
  void put(char c) { buffer_.push_back(c); }
  void write(std::string_view text) { write(text.data(), text.size()); }
  void write(const void* data, std::size_t size);

  /// Completes the file and gives it its name. Nothing may be written afterwards.
  void commit();

  /// The target, as messages name it.
  const std::string& name() const { return name_; }

 private:
  static constexpr std::size_t flush_at = std::size_t{1} << 16;

  void flush();
  void write_now(const char* data, std::size_t size);
  [[noreturn]] void fail_with(int error) const;

  std::string name_, target_;
  std::string temporary_;  ///< empty when the target is written directly
  std::FILE* file_ = nullptr;
  fmt::memory_buffer buffer_;
};

}  // namespace delone::io
