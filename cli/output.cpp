// SPDX-License-Identifier: BSD-3-Clause
// Standard output and whole files.
#include "output.hpp"

#include "command.hpp"
#include "interrupt.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace delone::cli {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_writing(const std::string& name, int error) {
  throw Error(Errc::cannot_write, name + ": " + std::generic_category().message(error));
}

/// Writes and closes, or (standard output) flushes. Returns 0 or an errno value.
int put(std::FILE* file, std::string_view text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int error = written ? 0 : errno;
  errno = 0;
  const bool finished = (file == stdout ? std::fflush(file) : std::fclose(file)) == 0;
  return written ? (finished ? 0 : errno) : error;
}

}  // namespace

std::string output_name(const std::string& path) { return path == "-" ? "standard output" : path; }

std::string chosen_format(const std::string& path, const std::string& format) {
  if (!format.empty()) return format;
  const std::string extension = fs::path(path).extension().string();
  if (path == "-" || extension.size() < 2)
    throw Error(Errc::unsupported, output_name(path) + ": name the format with --output-format");
  return extension.substr(1);
}

// Only regular files can be left behind half written.
Stage stage_of_writing(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return path != "-" && (!fs::exists(status) || fs::is_regular_file(status)) ? Stage::writing : Stage::plain;
}

void print_output(std::string_view text) {
  if (const int error = put(stdout, text); error != 0) fail_writing("standard output", error);
}

void write_text(const std::string& path, std::string_view text) {
  if (path == "-") return print_output(text);
  const StageGuard guard(stage_of_writing(path));
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  const bool direct = fs::exists(status) && !fs::is_regular_file(status);
  const fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path) : fs::path(path);
  const std::string written =
      direct ? path : (target.parent_path() / fmt::format(".delone-partial-{}", getpid())).string();
  errno = 0;
  std::FILE* file = std::fopen(written.c_str(), direct ? "wb" : "wbx");
  if (file == nullptr) fail_writing(path, errno);
  int error = put(file, text);
  if (direct) {
    if (error != 0) fail_writing(path, error);
    return;
  }
  if (error == 0 && std::rename(written.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    std::remove(written.c_str());
    fail_writing(path, error);
  }
}

void check_writable(const std::string& path) {
  if (path == "-") return;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail_writing(path, EISDIR);
  if (fs::exists(status)) {
    if (access(path.c_str(), W_OK) != 0) fail_writing(path, errno);
    if (!fs::is_regular_file(status)) return;
  }
  const fs::path folder = fs::path(path).parent_path();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) fail_writing(path, errno);
}

void check_complex_output(const std::string& path, const std::string& format, int dimension) {
  check_output(path, format, [&](const std::string& nowhere, const std::string& chosen) {
    ComplexData nothing;
    nothing.dimension = dimension;
    write(nowhere, nothing, chosen);
  });
}

}  // namespace delone::cli
