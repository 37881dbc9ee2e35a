// SPDX-License-Identifier: BSD-3-Clause
// Whole files in memory, the choice of a format. See file.hpp.
#include "io/file.hpp"

#include "base/platform_files.hpp"
#include "base/progress_meter.hpp"
#include "io/gzip.hpp"
#include "messages/in_quotes.hpp"

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

/// The rest of a file. Sets errno to what its errors are.
ReadBytes reader_of(std::FILE* file, const std::string& name) {
  return [file, name](char* to, std::size_t size) {
    for (std::size_t done = 0;;) {
      errno = 0;
      done += std::fread(to + done, 1, size - done, file);
      if (std::ferror(file) != 0) {
        if (errno != EINTR) fail(Errc::cannot_open, "{}: {}", name, error_text(errno));
        std::clearerr(file);
      } else if (done == size || std::feof(file) != 0) {
        return done;
      }
    }
  };
}

/// Reads to the end, or until there are `most` bytes; true at the end.
bool read_up_to(std::size_t most, const ReadBytes& read, Bytes& bytes) {
  while (bytes.size() < most) {
    if (bytes.size() == bytes.capacity()) bytes.reserve(bytes.capacity() + bytes.capacity() / 2 + 4096);
    const std::size_t room = std::min({bytes.capacity() - bytes.size(), most - bytes.size(), piece});
    bytes.prepare(bytes.size() + room);
    internal::cancellation_point();
    const std::size_t found = read(bytes.data() + bytes.size(), room);
    bytes.set_size(bytes.size() + found);
    if (found < room) return true;
  }
  return false;
}

/// As many bytes of a stream as can be read.
std::size_t limit_of_streams(std::uint64_t max_stream_bytes) {
  return static_cast<std::size_t>(std::min<std::uint64_t>(max_stream_bytes, SIZE_MAX / 2));
}

/// `compressed`: the opening of the file, which was read from it.
Bytes read_compressed(std::string_view compressed, const ReadBytes& rest, const std::string& name,
                      std::uint64_t max_stream_bytes, const CheckOpening& check_opening) {
  const ReadBytes read = decompressed(with_opening(std::string(compressed), rest), name);
  Bytes bytes(opening_size);
  const std::size_t most = limit_of_streams(max_stream_bytes);
  bool at_end = read_up_to(std::min(opening_size, most + 1), read, bytes);
  check_opening(bytes.view(), at_end);
  if (!at_end) at_end = read_up_to(most + 1, read, bytes);
  if (!at_end && bytes.size() > most)
    fail(Errc::out_of_memory,
         "{}: more than {} bytes when decompressed; raise max_stream_bytes or decompress it first", name,
         max_stream_bytes);
  return bytes;
}

/// `size`: that of a regular file when it was opened, otherwise 0.
Bytes read_file(std::FILE* file, const std::string& path, std::size_t size, std::uint64_t max_stream_bytes,
                const CheckOpening& check_opening) {
  const std::string name = input_name(path);
  const ReadBytes read = reader_of(file, name);
  Bytes bytes(std::min(size, opening_size - 1) + 1);
  const std::size_t most = std::max(size, limit_of_streams(max_stream_bytes));
  bool at_end = read_up_to(std::min(opening_size, most + 1), read, bytes);
  if (is_gzip(bytes.view()))
    return read_compressed(bytes.view(), read, name, max_stream_bytes, check_opening);
  if (has_gzip_name(path) && bytes.size() > 0)
    fail(Errc::bad_format, "{}: not compressed by gzip, which its name says", name);
  check_opening(bytes.view(), at_end);
  if (!at_end) {
    bytes.reserve(size + 1);  // one more, so that the end is seen without growing
    at_end = read_up_to(most + 1, read, bytes);
  }
  if (!at_end && bytes.size() > most)
    fail(Errc::out_of_memory, "{}: a stream of more than {} bytes; raise max_stream_bytes or read a file",
         name, max_stream_bytes);
  return bytes;
}

}  // namespace

Bytes read_all(const std::string& path, std::uint64_t max_stream_bytes, const CheckOpening& check_opening) {
  if (path == "-") {
    platform::pass_bytes(stdin);
    return read_file(stdin, path, 0, max_stream_bytes, check_opening);
  }
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  errno = 0;
  std::unique_ptr<std::FILE, Close> file(platform::open_file(path, "rb"));
  if (!file) fail(Errc::cannot_open, "{}: {}", input_name(path), error_text(errno));
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  return read_file(file.get(), path, size_hint(path), max_stream_bytes, check_opening);
}

void refuse_folder(const std::string& path, std::string_view expected) {
  std::error_code ignored;
  if (path != "-" && std::filesystem::is_directory(platform::path_of(path), ignored))
    fail(Errc::cannot_open, "{}: this is a folder; expected {}", input_name(path), expected);
}

void require_text(std::string_view opening, const std::string& name) {
  if (const auto zero = opening.find('\0'); zero != std::string_view::npos)
    fail(Errc::bad_format, "{}: this is a binary file, not text: byte {} is zero", name, zero);
}

std::string choose_format(const std::string& path, const std::string& format,
                          std::string_view standard_stream, std::initializer_list<std::string_view> known,
                          Use use, std::string_view what) {
  std::string chosen = format;
  if (chosen.empty() && path == "-") chosen = standard_stream;
  if (chosen.empty()) {
    chosen = std::filesystem::path(use == Use::reading ? without_gzip_name(path) : path).extension().string();
    if (chosen.size() > 1) chosen.erase(0, 1);
  }
  std::transform(chosen.begin(), chosen.end(), chosen.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (std::find(known.begin(), known.end(), chosen) != known.end()) return chosen;
  if (chosen == "gz" && format.empty())
    fail(Errc::unsupported, "{}: files are not written compressed; write {} and compress it",
         printable(path, std::string::npos), printable(without_gzip_name(path), std::string::npos));
  if (chosen == "laz" && use == Use::reading)
    fail(Errc::unsupported, "{}: {}", printable(path, std::string::npos), laz_advice);
  const std::string purpose = fmt::format("{} {}", use == Use::reading ? "reading" : "writing", what);
  const char* more = use == Use::writing_mesh ? "; more by to_meshio() in Python" : "";
  if (!format.empty() || chosen.size() > 1)
    fail(Errc::unsupported, "{}: format {} cannot be used for {}; available: {}{}",
         printable(path, std::string::npos), messages::in_quotes(chosen), purpose, fmt::join(known, ", "),
         more);
  fail(Errc::unsupported, "{}: no extension tells the format for {}; name it: {}",
       printable(path, std::string::npos), purpose, fmt::join(known, ", "));
}

}  // namespace delone::io
