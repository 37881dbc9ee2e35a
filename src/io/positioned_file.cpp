// SPDX-License-Identifier: BSD-3-Clause
// Files that are read and written at any place. See positioned_file.hpp.
#include "io/positioned_file.hpp"

#include "io/file.hpp"

#include <algorithm>
#include <utility>

namespace delone::io {

namespace {

/// Bytes that the system moves at a time.
constexpr std::size_t largest_piece = std::size_t{1} << 24;

}  // namespace

PositionedFile::PositionedFile(const std::string& path, Mode mode, std::string name)
    : name_(name.empty() ? input_name(path) : std::move(name)) {
  const bool writes = mode == Mode::write;
  if (const int error = file_.open(path, writes); error != 0)
    fail(writes ? Errc::cannot_write : Errc::cannot_open, "{}: {}", name_, error_text(error));
}

std::uint64_t PositionedFile::size() const {
  std::uint64_t size = 0;
  if (const int error = file_.size(size); error != 0)
    fail(Errc::cannot_open, "{}: {}", name_, error_text(error));
  return size;
}

std::size_t PositionedFile::read_some(std::uint64_t offset, void* data, std::size_t size) const {
  std::size_t done = 0;
  while (done < size) {
    std::size_t got = 0;
    if (const int error = file_.read_some(offset + done, static_cast<char*>(data) + done,
                                          std::min(size - done, largest_piece), got);
        error != 0)
      fail(Errc::cannot_open, "{}: {}", name_, error_text(error));
    if (got == 0) break;
    done += got;
  }
  return done;
}

void PositionedFile::read(std::uint64_t offset, void* data, std::size_t size) const {
  if (const std::size_t found = read_some(offset, data, size); found < size)
    fail(Errc::bad_format, "{}: truncated: expected {} bytes, found {}", name_, offset + size,
         offset + found);
}

void PositionedFile::write(std::uint64_t offset, const void* data, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    std::size_t put = 0;
    if (const int error = file_.write_some(offset + done, static_cast<const char*>(data) + done,
                                           std::min(size - done, largest_piece), put);
        error != 0)
      fail(Errc::cannot_write, "{}: {}", name_, error_text(error));
    done += put;
  }
}

void PositionedFile::close() {
  if (const int error = file_.close(); error != 0)
    fail(Errc::cannot_write, "{}: {}", name_, error_text(error));
}

}  // namespace delone::io
