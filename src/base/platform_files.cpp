// SPDX-License-Identifier: BSD-3-Clause
#include "base/platform_files.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <utility>

#if DELONE_POSIX
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#elif DELONE_WINDOWS
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>
#else
#include <fstream>
#include <mutex>
#endif

namespace delone::platform {

namespace fs = std::filesystem;

#if DELONE_WINDOWS

namespace {

int error_of_system() {
  switch (GetLastError()) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
      return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
      return EACCES;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
      return ENOSPC;
    default:
      return EIO;
  }
}

/// Windows says of a folder that access to it is denied.
int error_of(const fs::path& path, int error) {
  std::error_code ignored;
  return error == EACCES && fs::is_directory(path, ignored) ? EISDIR : error;
}

}  // namespace

std::FILE* open_file(const std::string& path, const char* mode) {
  const fs::path name = path_of(path);
  const std::wstring wide_mode(mode, mode + 2);
  std::FILE* const file = _wfopen(name.c_str(), wide_mode.c_str());
  if (file == nullptr) errno = error_of(name, errno);
  return file;
}

std::FILE* create_file(const std::string& path) {
  const int file = _wopen(path_of(path).c_str(), _O_CREAT | _O_EXCL | _O_WRONLY | _O_BINARY | _O_NOINHERIT,
                          _S_IREAD | _S_IWRITE);
  return file < 0 ? nullptr : _fdopen(file, "wb");
}

void remove_file(const std::string& path) { _wremove(path_of(path).c_str()); }

void pass_bytes(std::FILE* stream) { _setmode(_fileno(stream), _O_BINARY); }

/// Others may open, rename and remove the file meanwhile, as elsewhere.
struct RawFile::Handle {
  HANDLE file = INVALID_HANDLE_VALUE;
};

int RawFile::open(const std::string& path, bool writes) {
  const fs::path name = path_of(path);
  handle_->file = CreateFileW(name.c_str(), writes ? GENERIC_READ | GENERIC_WRITE : GENERIC_READ,
                              FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                              writes ? CREATE_ALWAYS : OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  return handle_->file == INVALID_HANDLE_VALUE ? error_of(name, error_of_system()) : 0;
}

int RawFile::close() {
  if (handle_ == nullptr || handle_->file == INVALID_HANDLE_VALUE) return 0;
  return CloseHandle(std::exchange(handle_->file, INVALID_HANDLE_VALUE)) != 0 ? 0 : error_of_system();
}

int RawFile::size(std::uint64_t& size) const {
  LARGE_INTEGER found{};
  if (GetFileSizeEx(handle_->file, &found) == 0) return error_of_system();
  size = static_cast<std::uint64_t>(found.QuadPart);
  return 0;
}

namespace {

OVERLAPPED at(std::uint64_t offset) {
  OVERLAPPED place{};
  place.Offset = static_cast<DWORD>(offset);
  place.OffsetHigh = static_cast<DWORD>(offset >> 32);
  return place;
}
DWORD size_of_piece(std::size_t size) {
  return static_cast<DWORD>(std::min<std::size_t>(size, std::size_t{1} << 30));
}

}  // namespace

int RawFile::read_some(std::uint64_t offset, void* data, std::size_t size, std::size_t& done) const {
  OVERLAPPED place = at(offset);
  DWORD got = 0;
  const bool read = ReadFile(handle_->file, data, size_of_piece(size), &got, &place) != 0;
  done = got;
  return read || GetLastError() == ERROR_HANDLE_EOF ? 0 : error_of_system();
}

int RawFile::write_some(std::uint64_t offset, const void* data, std::size_t size, std::size_t& done) {
  OVERLAPPED place = at(offset);
  DWORD put = 0;
  const bool written = WriteFile(handle_->file, data, size_of_piece(size), &put, &place) != 0;
  done = put;
  return written ? 0 : error_of_system();
}

namespace {

/// Some devices, and folders of some file systems, have nothing to flush.
int flush(HANDLE file) {
  if (FlushFileBuffers(file) != 0) return 0;
  const DWORD error = GetLastError();
  return error == ERROR_INVALID_FUNCTION || error == ERROR_NOT_SUPPORTED || error == ERROR_INVALID_HANDLE
             ? 0
             : error_of_system();
}

/// Flushing needs the right to write.
int flush(const std::string& path, DWORD flags) {
  const fs::path name = path_of(path);
  const HANDLE file =
      CreateFileW(name.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                  nullptr, OPEN_EXISTING, flags, nullptr);
  if (file == INVALID_HANDLE_VALUE) return error_of_system();
  const int error = flush(file);
  CloseHandle(file);
  return error;
}

}  // namespace

int sync_stream(std::FILE* stream) {
  return flush(reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(stream))));
}

int sync_file(const std::string& path) { return flush(path, FILE_ATTRIBUTE_NORMAL); }

// Not everyone who may create files in a folder may open the folder itself to write.
int sync_folder(const std::string& path) {
  const int error = flush(path, FILE_FLAG_BACKUP_SEMANTICS);
  return error == EACCES ? 0 : error;
}

// The folder of the file can be emptied meanwhile, but nobody else can open the file.
FileLock::FileLock(const char* path) {
  const HANDLE file = CreateFileW(path_of(path).c_str(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_DELETE,
                                  nullptr, OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (file != INVALID_HANDLE_VALUE)
    file_ = reinterpret_cast<std::intptr_t>(file);
  else
    is_held_ = GetLastError() != ERROR_SHARING_VIOLATION;
}

FileLock::~FileLock() {
  if (file_ != -1) CloseHandle(reinterpret_cast<HANDLE>(file_));
}

#else

std::FILE* open_file(const std::string& path, const char* mode) { return std::fopen(path.c_str(), mode); }

std::FILE* create_file(const std::string& path) { return std::fopen(path.c_str(), "wbx"); }

void remove_file(const std::string& path) { std::remove(path.c_str()); }

void pass_bytes(std::FILE*) {}

#endif

#if DELONE_POSIX

struct RawFile::Handle {
  int file = -1;
};

int RawFile::open(const std::string& path, bool writes) {
  do
    handle_->file =
        ::open(path.c_str(), writes ? O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC : O_RDONLY | O_CLOEXEC, 0666);
  while (handle_->file < 0 && errno == EINTR);
  return handle_->file < 0 ? errno : 0;
}

int RawFile::close() {
  if (handle_ == nullptr || handle_->file < 0) return 0;
  return ::close(std::exchange(handle_->file, -1)) == 0 ? 0 : errno;
}

int RawFile::size(std::uint64_t& size) const {
  struct stat status {};
  if (::fstat(handle_->file, &status) != 0) return errno;
  size = static_cast<std::uint64_t>(status.st_size);
  return 0;
}

int RawFile::read_some(std::uint64_t offset, void* data, std::size_t size, std::size_t& done) const {
  ssize_t got = 0;
  do got = ::pread(handle_->file, data, size, static_cast<off_t>(offset));
  while (got < 0 && errno == EINTR);
  done = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  return got < 0 ? errno : 0;
}

int RawFile::write_some(std::uint64_t offset, const void* data, std::size_t size, std::size_t& done) {
  ssize_t put = 0;
  do put = ::pwrite(handle_->file, data, size, static_cast<off_t>(offset));
  while (put < 0 && errno == EINTR);
  done = static_cast<std::size_t>(std::max<ssize_t>(put, 0));
  return put < 0 ? errno : 0;
}

namespace {

int sync_descriptor(int file) {
#ifdef F_FULLFSYNC
  if (::fcntl(file, F_FULLFSYNC) == 0) return 0;  // fsync() ends at the cache of the disk there
#endif
  int done = 0;
  do done = ::fsync(file);
  while (done != 0 && errno == EINTR);
  return done == 0 || errno == EINVAL || errno == EROFS || errno == ENOSYS || errno == ENOTSUP ? 0 : errno;
}

int sync_path(const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = sync_descriptor(file);
  ::close(file);
  return error;
}

}  // namespace

int sync_stream(std::FILE* stream) { return sync_descriptor(::fileno(stream)); }

int sync_file(const std::string& path) { return sync_path(path, 0); }

// Not everyone who may create files in a folder may read its names.
int sync_folder(const std::string& path) {
  const int error = sync_path(path, O_DIRECTORY);
  return error == EACCES ? 0 : error;
}

FileLock::FileLock(const char* path) {
  file_ = ::open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ >= 0) is_held_ = ::flock(static_cast<int>(file_), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(static_cast<int>(file_));
}

#elif !DELONE_WINDOWS

/// A stream has one place where it is: threads take turns.
struct RawFile::Handle {
  std::fstream file;
  std::mutex mutex;
};

int RawFile::open(const std::string& path, bool writes) {
  const fs::path name(path);
  std::error_code error;
  if (!writes && fs::is_directory(name, error)) return EISDIR;
  const auto mode = std::ios::binary | std::ios::in;
  errno = 0;
  handle_->file.open(name, writes ? mode | std::ios::out | std::ios::trunc : mode);
  return handle_->file.is_open() ? 0 : errno != 0 ? errno : EIO;
}

int RawFile::close() {
  if (handle_ == nullptr || !handle_->file.is_open()) return 0;
  handle_->file.clear();  // of the end of the file
  errno = 0;
  handle_->file.close();
  return handle_->file.fail() ? errno != 0 ? errno : EIO : 0;
}

int RawFile::size(std::uint64_t& size) const {
  const std::lock_guard guard(handle_->mutex);
  handle_->file.clear();
  handle_->file.seekg(0, std::ios::end);
  const auto end = static_cast<std::streamoff>(handle_->file.tellg());
  size = static_cast<std::uint64_t>(end);
  return end < 0 ? EIO : 0;
}

int RawFile::read_some(std::uint64_t offset, void* data, std::size_t size, std::size_t& done) const {
  const std::lock_guard guard(handle_->mutex);
  std::fstream& file = handle_->file;
  file.clear();
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(static_cast<char*>(data), static_cast<std::streamsize>(size));
  done = static_cast<std::size_t>(file.gcount());
  return file.bad() ? EIO : 0;
}

int RawFile::write_some(std::uint64_t offset, const void* data, std::size_t size, std::size_t& done) {
  const std::lock_guard guard(handle_->mutex);
  std::fstream& file = handle_->file;
  file.clear();
  errno = 0;
  file.seekp(static_cast<std::streamoff>(offset));
  // Flushed, so that errors are those of this call.
  file.write(static_cast<const char*>(data), static_cast<std::streamsize>(size)).flush();
  done = size;
  return file.good() ? 0 : errno != 0 ? errno : EIO;
}

int sync_stream(std::FILE* stream) { return std::fflush(stream) == 0 ? 0 : errno; }
int sync_file(const std::string&) { return 0; }
int sync_folder(const std::string&) { return 0; }

FileLock::FileLock(const char*) {}
FileLock::~FileLock() = default;

#endif

RawFile::RawFile() : handle_(std::make_unique<Handle>()) {}
RawFile::RawFile(RawFile&& other) noexcept = default;
RawFile::~RawFile() { [[maybe_unused]] const int ignored = close(); }

int sync_piece([[maybe_unused]] const std::string& path, [[maybe_unused]] std::uint64_t offset,
               [[maybe_unused]] std::uint64_t size) {
#if DELONE_LINUX
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return errno;
  // Errors are those of sync_file(): some file systems cannot wait for a piece.
  [[maybe_unused]] const int ignored =
      ::sync_file_range(file, static_cast<off64_t>(offset), static_cast<off64_t>(size),
                        SYNC_FILE_RANGE_WAIT_BEFORE | SYNC_FILE_RANGE_WRITE | SYNC_FILE_RANGE_WAIT_AFTER);
  ::close(file);
#endif
  return 0;
}

}  // namespace delone::platform
