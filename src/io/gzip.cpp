// SPDX-License-Identifier: BSD-3-Clause
#include "io/gzip.hpp"

#include "io/file.hpp"

#include <algorithm>
#include <utility>

#if DELONE_WITH_ZLIB
#include <zlib.h>

#include <limits>
#include <new>
#include <vector>
#endif

namespace delone::io {

bool is_gzip(std::string_view opening) { return opening.starts_with("\x1f\x8b"); }

bool has_gzip_name(std::string_view path) {
  if (path.size() < 4) return false;
  path.remove_prefix(path.size() - 3);
  return path == ".gz" || path == ".GZ";
}

std::string without_gzip_name(const std::string& path) {
  return has_gzip_name(path) ? path.substr(0, path.size() - 3) : path;
}

ReadBytes with_opening(std::string opening, ReadBytes rest) {
  return [opening = std::move(opening), at = std::size_t{0}, rest = std::move(rest)](
             char* to, std::size_t size) mutable {
    const std::size_t found = std::string_view(opening).substr(at).copy(to, size);
    at += found;
    return found == size ? found : found + rest(to + found, size - found);
  };
}

ReadBytes maybe_decompressed(ReadBytes read, const std::string& name) {
  std::string opening(2, '\0');
  std::size_t size = 0;
  for (std::size_t found = 1; size < opening.size() && found > 0; size += found)
    found = read(opening.data() + size, opening.size() - size);
  opening.resize(size);
  const bool is_compressed = is_gzip(opening);
  ReadBytes all = with_opening(std::move(opening), std::move(read));
  return is_compressed ? decompressed(std::move(all), name) : all;
}

#if !DELONE_WITH_ZLIB

ReadBytes decompressed(ReadBytes, const std::string& name) {
  fail(Errc::unsupported, "{}: compressed by gzip, and this build of delone has no zlib; decompress it first",
       name);
}

#else

namespace {

class Gunzip {
 public:
  Gunzip(ReadBytes compressed, std::string name)
      : compressed_(std::move(compressed)), name_(std::move(name)), input_(std::size_t{1} << 18) {
    constexpr int largest_window = 15, with_gzip_header = 16;
    if (inflateInit2(&stream_, largest_window + with_gzip_header) != Z_OK) throw std::bad_alloc();
  }
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;
  ~Gunzip() { inflateEnd(&stream_); }

  std::size_t read(char* to, std::size_t size) {
    std::size_t done = 0;
    while (done < size && !at_end_) {
      if (stream_.avail_in == 0) refill();
      if (is_between_members_ && !begin_member()) break;
      if (stream_.avail_in == 0) fail(Errc::bad_format, "{}: the compressed file ends too early", name_);
      const auto room =
          static_cast<uInt>(std::min<std::size_t>(size - done, std::numeric_limits<uInt>::max()));
      stream_.next_out = reinterpret_cast<Bytef*>(to + done);
      stream_.avail_out = room;
      const int result = inflate(&stream_, Z_NO_FLUSH);
      done += room - stream_.avail_out;
      if (result == Z_MEM_ERROR) throw std::bad_alloc();
      if (result == Z_STREAM_END)
        is_between_members_ = true;
      else if (result != Z_OK && result != Z_BUF_ERROR)
        fail(Errc::bad_format, "{}: the compressed file is damaged: {}", name_,
             stream_.msg != nullptr ? stream_.msg : "no member of gzip");
    }
    return done;
  }

 private:
  void refill() {
    const std::size_t found = compressed_(input_.data(), input_.size());
    stream_.next_in = reinterpret_cast<Bytef*>(input_.data());
    stream_.avail_in = static_cast<uInt>(found);
  }
  /// False, and at the end, if there are only zeros, or nothing.
  bool begin_member() {
    bool is_padding = false;
    for (; stream_.avail_in > 0; stream_.avail_in == 0 ? refill() : void()) {
      if (*stream_.next_in != 0) {
        if (is_padding)
          fail(Errc::bad_format, "{}: the compressed file is damaged: zeros between its members", name_);
        if (inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
        is_between_members_ = false;
        return true;
      }
      is_padding = true;
      ++stream_.next_in;
      --stream_.avail_in;
    }
    at_end_ = true;
    return false;
  }

  ReadBytes compressed_;
  std::string name_;
  std::vector<char> input_;
  z_stream stream_{};
  bool is_between_members_ = false, at_end_ = false;
};

}  // namespace

ReadBytes decompressed(ReadBytes compressed, const std::string& name) {
  const auto gunzip = std::make_shared<Gunzip>(std::move(compressed), name);
  return [gunzip](char* to, std::size_t size) { return gunzip->read(to, size); };
}

#endif

}  // namespace delone::io
