// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/file_content.hpp"

#include "base/platform_files.hpp"
#include "base/progress_meter.hpp"
#include "io/file.hpp"
#include "io/positioned_file.hpp"

#include <filesystem>
#include <system_error>

namespace delone::tiles {

namespace {

/// Throws unless `found` is `expected`.
void require(const io::FileContent& found, const io::FileContent& expected, const std::string& name) {
  if (found.num_bytes != expected.num_bytes)
    io::fail(Errc::bad_format, "{}: {}: {} bytes, not {}", name,
             found.num_bytes < expected.num_bytes ? "truncated" : "damaged", found.num_bytes,
             expected.num_bytes);
  if (found.crc32 != expected.crc32)
    io::fail(Errc::bad_format, "{}: damaged: its CRC-32 is {:08x}, not {:08x}", name, found.crc32,
             expected.crc32);
}

void require_synced(int error, const std::string& path) {
  if (error != 0) io::fail(Errc::cannot_write, "{}: {}", io::output_name(path), io::error_text(error));
}

}  // namespace

void require_content(std::string_view bytes, const io::FileContent& expected, const std::string& name) {
  io::FileContent found{static_cast<std::int64_t>(bytes.size()), expected.crc32};
  require(found, expected, name);  // before all bytes are looked at
  found = {};
  found.add(bytes);
  require(found, expected, name);
}

std::optional<std::string> find_damage(const std::string& path, const io::FileContent& expected,
                                       const std::function<void(std::int64_t)>& read) {
  constexpr std::size_t piece = std::size_t{1} << 20;
  return io::guarded(io::input_name(path), [&]() -> std::optional<std::string> {
    try {
      const io::PositionedFile file(path);
      require({static_cast<std::int64_t>(file.size()), expected.crc32}, expected, file.name());
      io::FileContent found;
      std::string bytes(piece, '\0');
      while (const std::size_t size =
                 file.read_some(static_cast<std::uint64_t>(found.num_bytes), bytes.data(), piece)) {
        found.add(std::string_view(bytes).substr(0, size));
        read(static_cast<std::int64_t>(size));
      }
      require(found, expected, file.name());
      return std::nullopt;
    } catch (const Error& error) {
      if (error.code() != Errc::bad_format && error.code() != Errc::cannot_open) throw;
      return error.what();
    }
  });
}

void sync_file(const std::string& path) {
  constexpr std::uint64_t piece = std::uint64_t{32} << 20;
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  for (std::uint64_t offset = 0; !error && offset < size; offset += piece) {
    internal::cancellation_point();
    require_synced(platform::sync_piece(path, offset, piece), path);
  }
  require_synced(platform::sync_file(path), path);
}

void sync_folder(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(path, error);
  require_synced(platform::sync_folder(path), path);
  if (!error && folder.has_parent_path())
    require_synced(platform::sync_folder(folder.parent_path().string()), path);
}

}  // namespace delone::tiles
