// SPDX-License-Identifier: BSD-3-Clause
// Standard output and whole files.
#include "output.hpp"

#include "command.hpp"
#include "interrupt.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
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

std::string output_name(const std::string& path) {
  return path == "-" ? "standard output" : input_name(path);
}

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

void print_note(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

void save_text(const std::string& path, std::string_view text) {
  const StageGuard guard(stage_of_writing(path));
  about(output_name(path), [&] { write_text(path, text); });
}

void check_writable(const std::string& path) {
  if (path == "-") return;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  const std::string name = output_name(path);
  if (fs::is_directory(status)) fail_writing(name, EISDIR);
  if (fs::exists(status)) {
    if (access(path.c_str(), W_OK) != 0) fail_writing(name, errno);
    if (!fs::is_regular_file(status)) return;
  }
  const fs::path folder = fs::path(write_target(path)).parent_path();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) fail_writing(name, errno);
}

namespace {

/// A regular file by its numbers, or one that is not there yet by the path at which it will be.
struct Place {
  bool exists = false;
  dev_t device = 0;
  ino_t number = 0;
  fs::path path;
  friend bool operator==(const Place&, const Place&) = default;
};

/// Nothing for pipes and devices. "-" is what the standard stream of that number is connected to.
std::optional<Place> place_of(const std::string& path, int standard_stream) {
  struct stat status {};
  if ((path == "-" ? fstat(standard_stream, &status) : stat(path.c_str(), &status)) == 0) {
    if (!S_ISREG(status.st_mode)) return std::nullopt;
    return Place{true, status.st_dev, status.st_ino, {}};
  }
  std::error_code error;
  const fs::path target = fs::absolute(write_target(path), error);
  const fs::path where = error ? fs::path() : fs::weakly_canonical(target, error);
  if (path == "-" || error) return std::nullopt;
  return Place{false, 0, 0, where};
}

}  // namespace

void protect_files(const std::vector<std::string>& inputs, const std::vector<Output>& outputs,
                   std::optional<bool> force) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (output->path.empty()) continue;
    const std::optional<Place> place = place_of(output->path, STDOUT_FILENO);
    for (const std::string& input : inputs)
      if (!force.value_or(false) && place && place->exists && !input.empty() &&
          place == place_of(input, STDIN_FILENO))
        throw UsageError(fmt::format("{} is also an input{}", output_name(output->path),
                                     force ? "; --force overwrites it" : ""));
    for (auto other = outputs.begin(); other != output; ++other) {
      if (other->path == "-" && output->path == "-")
        throw UsageError(fmt::format("{} and {} both want standard output", other->name, output->name));
      if (place && !other->path.empty() && place == place_of(other->path, STDOUT_FILENO))
        throw UsageError(
            fmt::format("{} and {} are one file: {}", other->name, output->name, output_name(output->path)));
    }
  }
}

void check_complex_output(const std::string& path, const std::string& format, int dimension) {
  check_output(path, format, [&](const std::string& nowhere, const std::string& chosen) {
    ComplexData nothing;
    nothing.dimension = dimension;
    write(nowhere, nothing, chosen);
  });
}

}  // namespace delone::cli
