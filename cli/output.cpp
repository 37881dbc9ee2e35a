// SPDX-License-Identifier: BSD-3-Clause
// Standard output and whole files.
#include "output.hpp"

#include "command.hpp"
#include "interrupt.hpp"
#include "messages/in_quotes.hpp"
#include "system.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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

void require_format(const std::string& path, std::string& format,
                    std::initializer_list<std::string_view> known, const char* what) {
  std::transform(format.begin(), format.end(), format.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (std::find(known.begin(), known.end(), format) == known.end())
    throw Error(Errc::unsupported,
                fmt::format("{}: format {} cannot be used for writing {}; available: {}", output_name(path),
                            messages::in_quotes(format), what, fmt::join(known, ", ")));
}

void require_extension(const std::string& path, std::initializer_list<std::string_view> known,
                       const char* what) {
  std::string extension = fs::path(path).extension().string();
  if (path == "-" || extension.size() < 2) return;
  extension.erase(0, 1);
  require_format(path, extension, known, what);
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
    if (const int error = system::why_not_writable(path); error != 0) fail_writing(name, error);
    if (!fs::is_regular_file(status)) return;
  }
  const fs::path folder = fs::path(write_target(path)).parent_path();
  const int error = system::why_not_writable_folder(folder.empty() ? "." : folder.string());
  if (error == 0) return;
  const bool is_missing = !folder.empty() && !fs::is_directory(folder, ignored);
  fail_writing(is_missing ? fmt::format("{}: the folder {}", name, output_name(folder.string())) : name,
               error);
}

namespace {

/// A regular file by its numbers, or one without numbers by its path: one that is not there yet, for example.
struct Place {
  std::optional<system::FileNumber> number;
  fs::path path;
  bool exists = false;
  friend bool operator==(const Place&, const Place&) = default;
};

/// Nothing for pipes and devices. "-" is what the standard stream is connected to.
std::optional<Place> place_of(const std::string& path, system::StandardStream stream) {
  const system::FoundFile found = path == "-" ? system::find_file(stream) : system::find_file(path);
  if (found.number) return Place{found.number, {}, true};
  if (found.exists || path == "-") return std::nullopt;
  std::error_code error;
  const fs::path target = fs::absolute(write_target(path), error);
  const fs::path where = error ? fs::path() : fs::weakly_canonical(target, error);
  if (error) return std::nullopt;
  const fs::file_status status = fs::status(where, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return std::nullopt;
  return Place{std::nullopt, where, fs::is_regular_file(status)};
}

}  // namespace

void protect_files(const std::vector<std::string>& inputs, const std::vector<Output>& outputs,
                   std::optional<bool> force) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (output->path.empty()) continue;
    const std::optional<Place> place = place_of(output->path, system::StandardStream::output);
    for (const std::string& input : inputs)
      if (!force.value_or(false) && place && place->exists && !input.empty() &&
          place == place_of(input, system::StandardStream::input))
        throw UsageError(fmt::format("{} is also an input{}", output_name(output->path),
                                     force ? "; --force overwrites it" : ""));
    for (auto other = outputs.begin(); other != output; ++other) {
      if (other->path == "-" && output->path == "-")
        throw UsageError(fmt::format("{} and {} both want standard output", other->name, output->name));
      if (place && !other->path.empty() && place == place_of(other->path, system::StandardStream::output))
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
