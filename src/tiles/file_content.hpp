// SPDX-License-Identifier: BSD-3-Clause
// Whether the files of a folder are as they were written, and that they stay so at a power cut.
#pragma once

#include "io/crc32.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace delone::tiles {

/// Throws bad_format, as "part-0000.npz: truncated: 1000 bytes, not 52344", unless the bytes are those of
/// `expected`.
void require_content(std::string_view bytes, const io::FileContent& expected, const std::string& name);

/// What is wrong with a file that should hold `expected`, as require_content() says it; also if it cannot be
/// read. Calls read(bytes) for each piece of some milliseconds.
std::optional<std::string> find_damage(const std::string& path, const io::FileContent& expected,
                                       const std::function<void(std::int64_t)>& read);

/// Waits until a file is on the disk. Can be cancelled where platform::sync_piece() does something. Throws
/// cannot_write.
void sync_file(const std::string& path);
/// The same for the names in a folder, and for the name of the folder itself.
void sync_folder(const std::string& path);

}  // namespace delone::tiles
