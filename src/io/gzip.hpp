// SPDX-License-Identifier: BSD-3-Clause
// Compressed files: gzip (RFC 1952), by zlib if the build has it.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace delone::io {

/// Whether a file with this opening is compressed by gzip. Nothing else that is read begins so but raw
/// numbers, of which any bytes may be the first.
bool is_gzip(std::string_view opening);

/// Whether the last extension of a path is .gz.
bool has_gzip_name(std::string_view path);
/// The path without that extension, if it has it.
std::string without_gzip_name(const std::string& path);

/// Up to `size` bytes into `to`; fewer, or none, only at the end. Throws cannot_open.
using ReadBytes = std::function<std::size_t(char* to, std::size_t size)>;

/// What `compressed` gives, decompressed: all members of the file, one after the other; zeros after them are
/// padding. Reading throws bad_format for a damaged or truncated file. Throws unsupported if the build has no
/// zlib.
ReadBytes decompressed(ReadBytes compressed, const std::string& name);

/// What was read before, and then the rest.
ReadBytes with_opening(std::string opening, ReadBytes rest);

/// What `read` gives, decompressed if gzip has compressed it.
ReadBytes maybe_decompressed(ReadBytes read, const std::string& name);

}  // namespace delone::io
