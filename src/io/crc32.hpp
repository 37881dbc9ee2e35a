// SPDX-License-Identifier: BSD-3-Clause
// The checksum of zip archives, which also tells whether a file is still what was written.
#pragma once

#include <cstdint>
#include <string_view>

namespace delone::io {

/// The CRC-32 of zip (reflected polynomial 0xedb88320), continued from `crc`.
std::uint32_t crc32(std::string_view bytes, std::uint32_t crc = 0);

/// What a file holds, in two numbers.
struct FileContent {
  std::int64_t num_bytes = 0, crc32 = 0;

  void add(std::string_view bytes) {
    num_bytes += static_cast<std::int64_t>(bytes.size());
    crc32 = io::crc32(bytes, static_cast<std::uint32_t>(crc32));
  }
  friend bool operator==(const FileContent&, const FileContent&) = default;
};

}  // namespace delone::io
