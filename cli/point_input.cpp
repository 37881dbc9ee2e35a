// SPDX-License-Identifier: BSD-3-Clause
// The options that say how to read points, and the formats by name.
#include "command.hpp"
#include "messages/in_quotes.hpp"
#include "numbers.hpp"
#include "output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <system_error>

namespace delone::cli {

void PointInput::add_to(CLI::App& command, const std::string& name, const std::string& description) {
  command.add_option(name, path, description)->required()->type_name("");
  command.add_option("--format", options.format, "Format of " + name + ", if not told by its extension")
      ->check(CLI::IsMember(point_formats()));
  add_columns(command, "--columns", options.columns);
  add_skip_missing(command, options.skip_missing);
  add_max_stream(command, options.max_stream_bytes);
}

std::string in_command_words(std::string message, const std::string& format_option,
                             const std::string& columns_option) {
  const auto replace = [&](const std::string& words, const std::string& by) {
    const std::size_t at = message.find(words);
    if (at != std::string::npos) message.replace(at, words.size(), by);
    return at;
  };
  replace("; raise max_stream_bytes or", "; raise --max-stream or");
  replace("; skip_missing leaves", "; --skip-missing leaves");
  replace(" with resume off", " with --no-resume");
  replace(": columns: ", ": " + columns_option + ": ");
  for (const char* const name : {"values", "weights"})
    replace(fmt::format(": {}: there is no column", name), fmt::format(": --{}: there is no column", name));
  const std::string words = ": format = \"";
  if (const std::size_t at = replace(words, ": " + format_option + " "); at != std::string::npos)
    if (const std::size_t quote = message.find('"', at); quote != std::string::npos) message.erase(quote, 1);
  return message;
}

void add_max_stream(CLI::App& command, std::uint64_t& bytes) {
  add_size(command, "--max-stream", bytes,
           "The most bytes to read from a pipe or device, such as 500MB or 8GiB; 4GiB if not given");
}

void add_size(CLI::App& command, const std::string& name, std::uint64_t& bytes,
              const std::string& description, std::uint64_t least) {
  command
      .add_option_function<std::string>(
          name,
          [&bytes, name, least](const std::string& text) {
            constexpr std::uint64_t largest = std::numeric_limits<std::int64_t>::max();
            const std::optional<std::uint64_t> size = parse_size(text);
            if (size && *size < least)
              throw CLI::ValidationError(
                  name, fmt::format("{} is too little: a size of at least {} byte{} was expected",
                                    messages::in_quotes(text), least, least == 1 ? "" : "s"));
            if (!size || *size > largest)
              throw CLI::ValidationError(
                  name, messages::in_quotes(text) +
                            " is no size: a whole number of bytes below 2^63, or with a unit, KB, MB, "
                            "GB, TB (powers of 1000) or KiB, MiB, GiB, TiB (powers of 1024)");
            bytes = *size;
          },
          description)
      ->type_name("SIZE");
}

void add_duration(CLI::App& command, const std::string& name, double& seconds,
                  const std::string& description) {
  command
      .add_option_function<std::string>(
          name,
          [&seconds, name](const std::string& text) {
            const std::optional<double> duration = parse_duration(text);
            if (!duration)
              throw CLI::ValidationError(name, messages::in_quotes(text) +
                                                   " is no time: a number of seconds above 0, or with a "
                                                   "unit, s, m, h or d");
            seconds = *duration;
          },
          description)
      ->type_name("TIME");
}

void add_columns(CLI::App& command, const std::string& name, std::vector<std::string>& columns) {
  command
      .add_option_function<std::string>(
          name, [&columns](const std::string& list) { columns = split_list(list); },
          "Columns with the coordinates: names, numbers from 0, or ranges such as 2-5")
      ->type_name("A,B,...");
}

void add_skip_missing(CLI::App& command, bool& skip_missing) {
  command.add_flag("--skip-missing", skip_missing,
                   "Leave out rows with blank, NA, NaN or other missing values, and say which");
}

void add_queries(CLI::App& command, PointInput& queries, const std::string& description) {
  queries.format_option = "--query-format";
  queries.columns_option = "--query-columns";
  command.add_option("--queries", queries.path, description)->required()->type_name("FILE");
  command
      .add_option("--query-format", queries.options.format,
                  "Format of the queries, if not told by the extension")
      ->check(CLI::IsMember(point_formats()));
  add_columns(command, "--query-columns", queries.options.columns);
}

namespace {

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + printable(name);
  return text;
}

/// "2, 5 to 9", and so on; long lists are cut.
std::string listed(const std::vector<std::size_t>& rows) {
  constexpr std::size_t most = 50;
  std::string text;
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); ++count) {
    std::size_t end = i + 1;
    while (end < rows.size() && rows[end] == rows[end - 1] + 1) ++end;
    if (!text.empty()) text += ", ";
    if (count == most) return text + "…";
    text += std::to_string(rows[i]);
    if (end > i + 1) text += (end > i + 2 ? " to " : ", ") + std::to_string(rows[end - 1]);
    i = end;
  }
  return text;
}

/// Removes the rows of a file that are in `rows`, both lists increasing, from those that are left.
void leave_out(PointTable& table, const std::vector<std::size_t>& rows) {
  const auto width = static_cast<std::ptrdiff_t>(table.dimension);
  auto end = table.coordinates.begin(), from = end;
  auto skipped = table.skipped_rows.begin();
  auto leaving = rows.begin();
  for (std::size_t row = 0, n = num_rows(table); row < n; ++row) {
    const bool leaves = leaving != rows.end() && *leaving == row;
    if (leaves) ++leaving;
    if (skipped != table.skipped_rows.end() && *skipped == row) {
      ++skipped;
      continue;
    }
    if (!leaves) end = end == from ? from + width : std::copy(from, from + width, end);
    from += width;
  }
  table.coordinates.erase(end, table.coordinates.end());
  table.skipped_rows = rows;
}

}  // namespace

void require_fitting(const PointTable& queries, const PointTable& points, const PointInput& from) {
  if (queries.dimension != points.dimension)
    throw Error(
        Errc::bad_dimension,
        fmt::format("{}: queries of dimension {} for points of dimension {}; --query-columns and --columns "
                    "say which columns are coordinates",
                    input_name(from.path), queries.dimension, points.dimension));
  if (from.options.columns.empty() && !queries.column_names.empty() && !points.column_names.empty() &&
      queries.column_names != points.column_names)
    throw Error(
        Errc::bad_format,
        fmt::format("{}: the columns {}, not {}, in this order; --query-columns chooses them",
                    input_name(from.path), listed(queries.column_names), listed(points.column_names)));
}

void add_force(CLI::App& command, bool& force) {
  command.add_flag("--force", force, "Write to a file even if it is also an input");
}

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& description) {
  // The parser reads −1 as 2^64 − 1, and so it does all that is larger.
  const auto a_seed = [](const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size()
               ? ""
               : "must be a whole number from 0 to 2^64 - 1";
  };
  command.add_option("-s,--seed", seed, description)->check(CLI::Validator(a_seed, ""))->type_name("S");
}

namespace {

/// `tells_of_none`: whether a note says so where no row was left out.
PointTable read_table(const PointInput& from, unsigned threads, bool tells_of_none) {
  const ReadOptions& options = from.options;
  try {
    PointTable table =
        about(input_name(from.path), [&] { return read_points(from.path, options, {.threads = threads}); });
    if (options.skip_missing && (tells_of_none || !table.skipped_rows.empty()))
      print_note(fmt::format("delone: {}: {} with missing values left out{}{}\n", input_name(from.path),
                             counted(table.skipped_rows.size(), "row"),
                             table.skipped_rows.empty() ? "" : ": ", listed(table.skipped_rows)));
    return table;
  } catch (const Error& e) {
    std::string message = in_command_words(e.what(), from.format_option, from.columns_option);
    const bool has_no_format = e.code() == Errc::unsupported && options.format.empty();
    if (has_no_format && !from.format_option.empty() && message.find("; available: ") != std::string::npos)
      message += fmt::format("; name it with {}", from.format_option);
    throw Error(e.code(), message, e.rows());
  }
}

}  // namespace

PointTable PointInput::read(unsigned threads) const { return read_table(*this, threads, true); }

PointTable PointInput::read_beside(const std::string& other_path, unsigned threads) const {
  PointInput other;
  other.path = other_path;
  other.options.max_stream_bytes = options.max_stream_bytes;
  other.options.skip_missing = options.skip_missing;
  other.format_option.clear();  // it is that of the points
  return read_table(other, threads, false);
}

void keep_common_rows(PointTable& points, PointTable& beside) {
  std::vector<std::size_t> rows;
  std::set_union(points.skipped_rows.begin(), points.skipped_rows.end(), beside.skipped_rows.begin(),
                 beside.skipped_rows.end(), std::back_inserter(rows));
  leave_out(points, rows);
  leave_out(beside, rows);
}

bool names_a_file(const std::string& columns_or_file) {
  if (columns_or_file == "-") return true;
  std::error_code unused;
  return columns_or_file.find_first_not_of("0123456789,-") != std::string::npos &&
         std::filesystem::exists(columns_or_file, unused);
}

const std::vector<std::string>& point_formats() {
  static const std::vector<std::string> formats{"npy", "csv", "tsv", "txt", "xyz", "pts",
                                                "dat", "off", "ply", "pdb", "las", "qhull"};
  return formats;
}

const std::vector<std::string>& complex_formats() {
  static const std::vector<std::string> formats{"npz", "vtu", "off", "ply", "json",
                                                "svg", "txt", "npy", "html"};
  return formats;
}

const std::vector<std::string>& readable_complex_formats() {
  static const std::vector<std::string> formats{"npz", "json", "off"};
  return formats;
}

}  // namespace delone::cli
