// SPDX-License-Identifier: BSD-3-Clause
// Whole files in memory, the choice of a format, safe quoting. See file.hpp.
#include "io/file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace delone::io {

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string out = "'";
  for (char c : text.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f)
      out += c;
    else
      out += fmt::format("\\x{:02x}", byte);
  }
  if (text.size() > longest) out += "…";
  return out + "'";
}

std::string joined(const std::vector<std::string>& items) {
  return fmt::format("{}", fmt::join(items, ", "));
}

std::string error_text(int error) {
  // Not strerror: several threads may fail at once.
  return std::generic_category().message(error);
}

std::string input_name(const std::string& path) { return path == "-" ? "standard input" : path; }

namespace {

/// The size of a regular file, as a hint only: pipes, /proc and files that grow have another.
std::size_t size_hint(const std::string& path) {
  std::error_code ignored;
  const auto size = std::filesystem::file_size(path, ignored);
  return ignored || size > SIZE_MAX / 2 ? 0 : static_cast<std::size_t>(size);
}

void read_to_end(std::FILE* file, const std::string& name, Bytes& bytes) {
  for (;;) {
    if (bytes.size() == bytes.capacity()) bytes.reserve(bytes.capacity() + bytes.capacity() / 2 + 4096);
    errno = 0;
    bytes.set_size(bytes.size() +
                   std::fread(bytes.data() + bytes.size(), 1, bytes.capacity() - bytes.size(), file));
    if (std::ferror(file) != 0) {
      if (errno != EINTR) fail(Errc::cannot_open, "{}: {}", name, error_text(errno));
      std::clearerr(file);
    } else if (std::feof(file) != 0) {
      return;
    }
  }
}

}  // namespace

Bytes read_all(const std::string& path) {
  if (path == "-") {
    Bytes bytes(std::size_t{1} << 16);
    read_to_end(stdin, input_name(path), bytes);
    return bytes;
  }
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  errno = 0;
  std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (!file) fail(Errc::cannot_open, "{}: {}", path, error_text(errno));
  std::setvbuf(file.get(), nullptr, _IONBF, 0);
  Bytes bytes(size_hint(path) + 1);  // one more, so that the end is seen without growing
  read_to_end(file.get(), path, bytes);
  return bytes;
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
    fail(Errc::unsupported, "{}: format {} cannot be used for {}; available: {}", path, in_quotes(chosen),
         purpose, fmt::join(known, ", "));
  fail(Errc::unsupported, "{}: no extension tells the format for {}; name it: {}", path, purpose,
       fmt::join(known, ", "));
}

}  // namespace delone::io
