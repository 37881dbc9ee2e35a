// SPDX-License-Identifier: BSD-3-Clause
// What the command writes itself: text on standard output or in a file that appears whole or not at all, and
// early checks of outputs, so that hours of work do not end in a misspelt path.
#pragma once

#include "command.hpp"
#include "interrupt.hpp"
#include "system.hpp"

#include <delone/delone.hpp>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace delone::cli {

/// Text to standard output. Throws cannot_write.
void print_output(std::string_view text);

/// Text to standard error. Where that is closed or full, nobody can be told, and nothing else fails.
void print_note(const std::string& text);

/// Text to a file, or to standard output for "-", so that Ctrl-C leaves no partial file. Throws cannot_write.
void save_text(const std::string& path, std::string_view text);

/// A path as messages name it.
std::string output_name(const std::string& path);

/// The format that was chosen, or else the extension of the path. Throws unsupported if there is neither.
std::string chosen_format(const std::string& path, const std::string& format);

/// Throws unsupported, as the library does, if the format, in letters of either case, is not one of `known`
/// for writing `what`.
void require_format(const std::string& path, std::string& format,
                    std::initializer_list<std::string_view> known, const char* what);

/// The same where there is one kind of output, by the extension of the path; without one all is well.
void require_extension(const std::string& path, std::initializer_list<std::string_view> known,
                       const char* what);

/// Whether Ctrl-C has a partial file to remove while this path is written to.
Stage stage_of_writing(const std::string& path);

/// Writes points, or data of another kind, so that Ctrl-C leaves no partial file: write(path, data...).
template <class Data, class... Details>
void write_output(const std::string& path, const Data& data, const Details&... details) {
  const StageGuard guard(stage_of_writing(path));
  about(output_name(path), [&] {
    if constexpr (std::is_same_v<Data, PointTable>)
      write_points(path, data, details...);
    else
      write(path, data, details...);
  });
}

/// Where a command writes, as messages name it: an option, or what is printed. The path is "-" for standard
/// output, and empty for nowhere.
struct Output {
  std::string name, path;
};

/// Throws UsageError if an output is a file that is also an input, by whatever path, unless `force`; and if
/// it is that of another output, be the file there or not. Standard output is a file if it was redirected to
/// one. `force` is nothing for a command without that option. Paths may be empty.
void protect_files(const std::vector<std::string>& inputs, const std::vector<Output>& outputs,
                   std::optional<bool> force = std::nullopt);

/// Throws cannot_write if no file can be made at that path.
void check_writable(const std::string& path);

/// Throws what the writing would throw in the end: an unknown format, one that does not suit the dimension, a
/// folder that is missing or not writable. `write_nothing(path, format)` writes an empty result.
template <class WriteNothing>
void check_output(const std::string& path, const std::string& format, WriteNothing write_nothing) {
  const std::string chosen = chosen_format(path, format);
  const std::string nowhere = system::null_device();
  try {
    write_nothing(nowhere, chosen);
    system::remove_null(nowhere);
  } catch (const Error& e) {
    std::string message = e.what();
    if (message.rfind(nowhere, 0) == 0) message.replace(0, nowhere.size(), output_name(path));
    throw Error(e.code(), message);
  }
  check_writable(path);
}

/// Writes a product in the form of Qhull, as write_output().
template <class Product>
void write_qhull_output(const std::string& path, const Product& product, const std::string& outputs) {
  const StageGuard guard(stage_of_writing(path));
  about(output_name(path), [&] { write_qhull(path, product, outputs); });
}

/// Throws what that would throw in the end, as far as a small product tells.
template <class Product>
void check_qhull_output(const std::string& path, const Product& small, const std::string& outputs) {
  const std::string nowhere = system::null_device();
  about(output_name(path), [&] { write_qhull(nowhere, small, outputs); });
  system::remove_null(nowhere);
  check_writable(path);
}

/// The same for a triangulation or a hull of points of this dimension.
void check_complex_output(const std::string& path, const std::string& format, int dimension);

}  // namespace delone::cli
