// SPDX-License-Identifier: BSD-3-Clause
// read_points: chooses the reader by the format.
#include "io/points/read_points.hpp"

#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/text_cursor.hpp"

namespace delone {

namespace {

/// Keeps the columns with the given 0-based numbers, for formats without names.
PointTable with_columns(PointTable table, const std::vector<std::string>& wanted, const std::string& name) {
  if (wanted.empty()) return table;
  const auto width = static_cast<std::size_t>(table.dimension);
  const std::vector<std::size_t> columns = io::column_numbers(wanted, {}, width, name);
  PointTable out;
  out.dimension = static_cast<int>(columns.size());
  const std::size_t rows = table.num_points();
  out.coordinates.reserve(rows * columns.size());
  for (std::size_t row = 0; row < rows; ++row)
    for (const std::size_t column : columns)
      out.coordinates.push_back(table.coordinates[row * width + column]);
  return out;
}

/// Refuses what cannot be of this format by its first bytes. Where the first word is wrong the reader says
/// so.
void check_opening(const std::string& format, std::string_view opening, bool is_whole,
                   const std::string& name) {
  if (is_whole) return;  // read at once
  if (format == "npy") return io::require_npy(opening, name);
  if (format == "ply") {
    if (!opening.starts_with("ply")) io::read_ply(opening, name, {});
    return;
  }
  const std::string_view text = io::text_of(opening, name);
  io::require_text(text, name);
  io::TextCursor at(text, name);
  const std::string_view word = at.next_token();
  if (word.empty() || at.at_end()) return;  // there may be more of it
  if (format == "off" && !word.ends_with("OFF")) io::read_off(text, name);
  if (format == "qhull" && !io::to_count(word)) io::read_qhull(text, name);
  if ((format == "txt" || format == "xyz" || format == "pts") && !io::to_number(word))
    io::read_white_space(text, name);
}

}  // namespace

std::vector<std::size_t> io::column_numbers(const std::vector<std::string>& wanted, const std::string& last,
                                            std::size_t width, const std::string& name) {
  const auto number_of = [&](const std::string& one) {
    const auto number = to_count(one);
    if (!number || *number >= width)
      fail(Errc::bad_format, "{}: there is no column {}; the columns are 0 to {}", name, in_quotes(one),
           width - 1);
    return static_cast<std::size_t>(*number);
  };
  std::vector<std::size_t> columns;
  for (const std::string& one : wanted) columns.push_back(number_of(one));
  const std::size_t after = last.empty() ? width : number_of(last);
  for (std::size_t i = 0; wanted.empty() && i < width; ++i)
    if (i != after) columns.push_back(i);
  if (!last.empty()) columns.push_back(after);
  return columns;
}

PointTable read_points(const std::string& path, const ReadOptions& options) {
  const std::string format =
      io::choose_format(path, options.format, "qhull",
                        {"npy", "csv", "tsv", "txt", "xyz", "pts", "off", "ply", "qhull"}, "reading points");
  const std::string name = io::input_name(path);
  return io::guarded(name, [&] {
    const io::Bytes file = io::read_all(
        path, options.max_stream_bytes,
        [&](std::string_view opening, bool is_whole) { check_opening(format, opening, is_whole, name); });
    const std::string_view bytes = file.view();
    const io::ReadingInParts how{.threads = options.threads};
    if (format == "csv" || format == "tsv")
      return io::read_delimited(bytes, name, format == "csv" ? ',' : '\t', options.columns, how);
    if (format == "ply") return io::read_ply(bytes, name, options.columns);
    PointTable table = format == "npy"     ? io::read_npy(bytes, name)
                       : format == "off"   ? io::read_off(bytes, name)
                       : format == "qhull" ? io::read_qhull(bytes, name)
                                           : io::read_white_space(bytes, name, how);
    return with_columns(std::move(table), options.columns, name);
  });
}

}  // namespace delone
