// SPDX-License-Identifier: BSD-3-Clause
// A file that appears whole or not at all: written beside its target under another name, renamed by commit(),
// removed by the destructor if that was not reached. Text is collected in a buffer and every write is
// checked.
#pragma once

#include "io/crc32.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <type_traits>

namespace delone::io {

class AtomicFile {
 public:
  /// "-" is standard output. An existing target that is not a regular file (a device, a pipe) is written to
  /// directly; a symbolic link is followed. Throws cannot_write with the system's reason, as all members do.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    print_formatted(format, fmt::make_format_args(args...));
  }
  /// A number in decimal, a double in the fewest digits that read back as the same value.
  template <class Number>
  void put(Number value) {
    if constexpr (std::is_integral_v<Number>)
      put_number(
          static_cast<std::conditional_t<std::is_signed_v<Number>, long long, unsigned long long>>(value));
    else {
      static_assert(std::is_same_v<Number, double>);
      put_number(value);
    }
  }
  void put(char c) { buffer_.push_back(c); }
  void write(std::string_view text) { write(text.data(), text.size()); }
  void write(const void* data, std::size_t size);

  /// From here on counts what is written, and computes its checksum: REQUIRES that nothing is written yet.
  void track_content() { tracks_content_ = true; }
  /// What is written so far.
  const FileContent& content();

  /// Completes the file and gives it its name. Nothing may be written afterwards.
  void commit() { complete(false); }
  /// The same, and on return the file and its name are on the disk; whenever the power fails, the file is
  /// there whole or not at all.
  void commit_durably() { complete(true); }

  /// The target, as messages name it.
  const std::string& name() const { return name_; }

 private:
  static constexpr std::size_t flush_at = std::size_t{1} << 16;

  // Compiled once, as formatting takes seconds to compile.
  void print_formatted(fmt::string_view format, fmt::format_args args);
  void put_number(double value);
  void put_number(long long value);
  void put_number(unsigned long long value);
  void flush();
  void write_now(const char* data, std::size_t size);
  void complete(bool durably);
  [[noreturn]] void fail_with(int error) const;

  std::string name_, target_;
  std::string temporary_;  ///< empty when the target is written directly
  std::FILE* file_ = nullptr;
  fmt::memory_buffer buffer_;
  bool tracks_content_ = false;
  FileContent content_;
};

}  // namespace delone::io
