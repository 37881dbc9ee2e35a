// SPDX-License-Identifier: BSD-3-Clause
// Files that appear whole or not at all. See atomic_file.hpp.
#include "io/atomic_file.hpp"

#include "base/platform_files.hpp"
#include "base/progress_meter.hpp"
#include "io/file.hpp"

#include <fmt/compile.h>
#include <delone/io.hpp>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

namespace delone::io {

namespace fs = std::filesystem;

namespace {

/// Bytes that are written at a time.
constexpr std::size_t largest_write = std::size_t{1} << 24;

/// Creates a new file next to `target`: the same directory, hence the same file system, so that renaming is
/// atomic. The name is short whatever the target's is, and `x` refuses to touch a file that exists.
std::FILE* create_beside(const fs::path& target, std::string& name) {
  static std::atomic<std::uint64_t> counter{0};
  for (int attempt = 0; attempt < 100; ++attempt) {
    const auto ticks =
        static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
    const std::uint64_t tag = (ticks + ++counter) * 0x9e3779b97f4a7c15u;
    name = platform::text_of(target.parent_path() / fmt::format(".delone-partial-{:016x}", tag));
    errno = 0;
    if (std::FILE* file = platform::create_file(name)) return file;
    if (errno != EEXIST) break;
  }
  return nullptr;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : name_(output_name(path)), target_(path) {
  if (path == "-") {
    file_ = stdout;
    platform::pass_bytes(file_);
    return;
  }
  std::error_code error;
  const fs::file_status status = fs::status(platform::path_of(path), error);
  if (fs::is_directory(status)) fail_with(EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    errno = 0;
    file_ = platform::open_file(path, "wb");
  } else {
    target_ = write_target(path);
    if (fs::is_symlink(platform::path_of(target_), error)) fail_with(ELOOP);
    file_ = create_beside(platform::path_of(target_), temporary_);
    if (file_ == nullptr) temporary_.clear();
  }
  if (file_ == nullptr) fail_with(errno);
  std::setvbuf(file_, nullptr, _IONBF, 0);  // buffer_ is the only buffer
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
  if (!temporary_.empty()) platform::remove_file(temporary_);
}

void AtomicFile::fail_with(int error) const { fail(Errc::cannot_write, "{}: {}", name_, error_text(error)); }

void AtomicFile::write(const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  if (size >= flush_at) {
    flush();
    write_now(bytes, size);
    return;
  }
  buffer_.append(bytes, bytes + size);
  if (buffer_.size() >= flush_at) flush();
}

void AtomicFile::print_formatted(fmt::string_view format, fmt::format_args args) {
  fmt::vformat_to(fmt::appender(buffer_), format, args);
  if (buffer_.size() >= flush_at) flush();
}

void AtomicFile::put_number(double value) {
  fmt::format_to(fmt::appender(buffer_), FMT_COMPILE("{}"), value);
  if (buffer_.size() >= flush_at) flush();
}

void AtomicFile::put_number(long long value) {
  fmt::format_to(fmt::appender(buffer_), FMT_COMPILE("{}"), value);
  if (buffer_.size() >= flush_at) flush();
}

void AtomicFile::put_number(unsigned long long value) {
  fmt::format_to(fmt::appender(buffer_), FMT_COMPILE("{}"), value);
  if (buffer_.size() >= flush_at) flush();
}

void AtomicFile::flush() {
  write_now(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void AtomicFile::write_now(const char* data, std::size_t size) {
  while (size > 0) {
    internal::cancellation_point();
    errno = 0;
    // Of a large block the system would write all before anything can stop it.
    const std::size_t wanted = std::min(size, largest_write);
    const std::size_t written = std::fwrite(data, 1, wanted, file_);
    if (tracks_content_) content_.add({data, written});
    data += written;
    size -= written;
    if (written < wanted) {
      if (errno != EINTR) fail_with(errno);
      std::clearerr(file_);
    }
  }
}

const FileContent& AtomicFile::content() {
  flush();
  return content_;
}

void AtomicFile::complete(bool durably) {
  flush();
  errno = 0;
  if (file_ == stdout) {
    if (std::fflush(stdout) != 0) fail_with(errno);
    return;
  }
  if (const int unsynced = durably ? platform::sync_stream(file_) : 0; unsynced != 0) fail_with(unsynced);
  const int closed = std::fclose(std::exchange(file_, nullptr));
  if (closed != 0) fail_with(errno);
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(platform::path_of(temporary_), platform::path_of(target_), error);
  if (error) fail(Errc::cannot_write, "{}: {}", name_, error.message());
  temporary_.clear();
  if (!durably) return;
  const std::string folder = platform::text_of(fs::absolute(platform::path_of(target_), error).parent_path());
  if (const int unsynced = platform::sync_folder(folder); unsynced != 0) fail_with(unsynced);
}

}  // namespace delone::io

namespace delone {

std::string write_target(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int longest_chain = 40;  // as Linux has it
  fs::path target = platform::path_of(path);
  std::error_code error;
  for (int link = 0; path != "-" && fs::is_symlink(target, error); ++link) {
    const fs::path next = fs::read_symlink(target, error);
    if (error || link == longest_chain) return path;
    target = target.parent_path() / next;  // an absolute one replaces it
  }
  return platform::text_of(target);
}

void write_text(const std::string& path, std::string_view text) {
  io::guarded(io::output_name(path), [&] {
    io::AtomicFile file(path);
    file.write(text);
    file.commit();
  });
}

}  // namespace delone
