// SPDX-License-Identifier: BSD-3-Clause
// Whole files in memory, the choice of a format. See file.hpp.
#include "io/file.hpp"

#include "base/platform_files.hpp"
#include "base/progress_meter.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace delone::io {

std::string joined(const std::vector<std::string>& items) {
  constexpr std::size_t long_enough = 400;
  std::string out;
  for (const std::string& item : items) {
    if (out.size() > long_enough) return out + fmt::format(", … ({} in all)", items.size());
    out += (&item == items.data() ? "" : ", ") + printable(item);
  }
  return out;
}

std::string error_text(int error) {
  // Not strerror: several threads may fail at once.
  return std::generic_category().message(error);
}

std::string input_name(const std::string& path) {
  return path == "-" ? "standard input" : printable(path, std::string::npos);
}

std::string output_name(const std::string& path) {
  return path == "-" ? "standard output" : printable(path, std::string::npos);
}

namespace {

constexpr std::size_t opening_size = std::size_t{1} << 16;
/// Files are read in pieces of so many bytes.
constexpr std::size_t piece = std::size_t{4} << 20;

/// The size of a regular file, as a hint only: pipes, /proc and files that grow have another.
std::size_t size_hint(const std::string& path) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(platform::path_of(path), ignored);
  return ignored || size > SIZE_MAX / 2 ? 0 : static_cast<std::size_t>(size);
}

/// Reads to the end of the file, or until there are `most` bytes; true at the end.
bool read_up_to(std::size_t most, std::FILE* file, const std::string& name, Bytes& bytes) {
  while (bytes.size() < most) {
    if (bytes.size() == bytes.capacity()) bytes.reserve(bytes.capacity() + bytes.capacity() / 2 + 4096);
    const std::size_t room = std::min({bytes.capacity() - bytes.size(), most - bytes.size(), piece});
    bytes.prepare(bytes.size() + room);
    internal::cancellation_point();
    errno = 0;
    bytes.set_size(bytes.size() + std::fread(bytes.data() + bytes.size(), 1, room, file));
    if (std::ferror(file) != 0) {
      if (errno != EINTR) fail(Errc::cannot_open, "{}: {}", name, error_text(errno));
      std::clearerr(file);
    } else if (std::feof(file) != 0) {
      return true;
    }
  }
  return false;
}

/// `size`: that of a regular file when it was opened, otherwise 0.
Bytes read_file(std::FILE* file, const std::string& name, std::size_t size, std::uint64_t max_stream_bytes,
                const CheckOpening& check_opening) {
  Bytes bytes(std::min(size, opening_size - 1) + 1);
  const std::uint64_t most =
      std::max<std::uint64_t>(size, std::min<std::uint64_t>(max_stream_bytes, SIZE_MAX / 2));
  bool at_end = read_up_to(std::min(opening_size, static_cast<std::size_t>(most) + 1), file, name, bytes);
  check_opening(bytes.view(), at_end);
  if (!at_end) {
    bytes.reserve(size + 1);  // one more, so that the end is seen without growing
    at_end = read_up_to(static_cast<std::size_t>(most) + 1, file, name, bytes);
  }
  if (!at_end && bytes.size() > most)
    fail(Errc::out_of_memory,
         "{}: a stream of more than {} bytes; raise this limit (--max-stream, max_stream_bytes) or read a "
         "file",
         name, max_stream_bytes);
  return bytes;
}

}  // namespace

Bytes read_all(const std::string& path, std::uint64_t max_stream_bytes, const CheckOpening& check_opening) {
  const std::string name = input_name(path);
  if (path == "-") {
    platform::pass_bytes(stdin);
    return read_file(stdin, name, 0, max_stream_bytes, check_opening);
  }
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  errno = 0;
  std::unique_ptr<std::FILE, Close> file(platform::open_file(path, "rb"));
  if (!file) fail(Errc::cannot_open, "{}: {}", name, error_text(errno));
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  return read_file(file.get(), name, size_hint(path), max_stream_bytes, check_opening);
}

void require_text(std::string_view opening, const std::string& name) {
  if (const auto zero = opening.find('\0'); zero != std::string_view::npos)
    fail(Errc::bad_format, "{}: not text: byte {} is zero", name, zero);
}

std::string choose_format(const std::string& path, const std::string& format,
                          std::string_view standard_stream, std::initializer_list<std::string_view> known,
                          std::string_view purpose) {
  std::string chosen = format;
  if (chosen.empty() && path == "-") chosen = standard_stream;
  if (chosen.empty()) {
    chosen = std::filesystem::path(path).extension().string();
    if (chosen.size() > 1) chosen.erase(0, 1);
  }
  std::transform(chosen.begin(), chosen.end(), chosen.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (std::find(known.begin(), known.end(), chosen) != known.end()) return chosen;
  if (!format.empty() || chosen.size() > 1)
    fail(Errc::unsupported, "{}: format {} cannot be used for {}; available: {}",
         printable(path, std::string::npos), in_quotes(chosen), purpose, fmt::join(known, ", "));
  fail(Errc::unsupported, "{}: no extension tells the format for {}; name it: {}",
       printable(path, std::string::npos), purpose, fmt::join(known, ", "));
}

}  // namespace delone::io
