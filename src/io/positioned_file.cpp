// SPDX-License-Identifier: BSD-3-Clause
// Files that are read and written at any place. See positioned_file.hpp.
#include "io/positioned_file.hpp"

#include "io/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace delone::io {

namespace {

/// Bytes that the system moves at a time.
constexpr std::size_t largest_piece = std::size_t{1} << 24;

}  // namespace

PositionedFile::PositionedFile(const std::string& path, Mode mode, std::string name)
    : name_(name.empty() ? input_name(path) : std::move(name)) {
  const bool writes = mode == Mode::write;
  do
    file_ =
        ::open(path.c_str(), writes ? O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC : O_RDONLY | O_CLOEXEC, 0666);
  while (file_ < 0 && errno == EINTR);
  if (file_ < 0) fail(writes ? Errc::cannot_write : Errc::cannot_open, "{}: {}", name_, error_text(errno));
}

PositionedFile::PositionedFile(PositionedFile&& other) noexcept
    : name_(std::move(other.name_)), file_(std::exchange(other.file_, -1)) {}

PositionedFile::~PositionedFile() {
  if (file_ >= 0) ::close(file_);
}

std::uint64_t PositionedFile::size() const {
  struct stat status {};
  if (::fstat(file_, &status) != 0) fail(Errc::cannot_open, "{}: {}", name_, error_text(errno));
  return static_cast<std::uint64_t>(status.st_size);
}

std::size_t PositionedFile::read_some(std::uint64_t offset, void* data, std::size_t size) const {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::pread(file_, static_cast<char*>(data) + done, std::min(size - done, largest_piece),
                                static_cast<off_t>(offset + done));
    if (got == 0) break;
    if (got > 0)
      done += static_cast<std::size_t>(got);
    else if (errno != EINTR)
      fail(Errc::cannot_open, "{}: {}", name_, error_text(errno));
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
    const ssize_t put = ::pwrite(file_, static_cast<const char*>(data) + done,
                                 std::min(size - done, largest_piece), static_cast<off_t>(offset + done));
    if (put >= 0)
      done += static_cast<std::size_t>(put);
    else if (errno != EINTR)
      fail(Errc::cannot_write, "{}: {}", name_, error_text(errno));
  }
}

void PositionedFile::close() {
  if (file_ >= 0 && ::close(std::exchange(file_, -1)) != 0)
    fail(Errc::cannot_write, "{}: {}", name_, error_text(errno));
}

}  // namespace delone::io
