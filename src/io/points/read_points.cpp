// SPDX-License-Identifier: BSD-3-Clause
// read_points: chooses the reader by the format.
#include "io/points/read_points.hpp"
#include "base/progress_meter.hpp"

#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/points/hints.hpp"
#include "io/text_cursor.hpp"

namespace delone {

namespace {

/// Keeps the columns that are chosen, for formats without names.
PointTable with_columns(PointTable table, const io::ColumnChoice& choice, const std::string& name) {
  if (choice.wanted.empty() && choice.last.empty()) return table;
  const auto width = static_cast<std::size_t>(table.dimension);
  const auto [columns, num_last] = io::choose_columns(choice, {}, width, name);
  PointTable out;
  out.num_values = static_cast<int>(num_last);
  out.dimension = static_cast<int>(columns.size());
  const std::size_t rows = table.num_points();
  out.coordinates.reserve(rows * columns.size());
  for (std::size_t row = 0; row < rows; ++row)
    for (const std::size_t column : columns)
      out.coordinates.push_back(table.coordinates[row * width + column]);
  return out;
}

/// Takes the last columns, of which there are num_values, for the values.
PointTable with_values(PointTable table, const std::string& name) {
  if (table.num_values == 0) return table;
  if (table.num_values == table.dimension)
    io::fail(Errc::bad_dimension, "{}: beside the values there is no column of coordinates", name);
  const auto width = static_cast<std::size_t>(table.dimension),
             num_values = static_cast<std::size_t>(table.num_values), num_coordinates = width - num_values;
  const std::size_t n = table.num_points();
  table.values.reserve(n * num_values);
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t j = 0; j < width; ++j) {
      const double x = table.coordinates[row * width + j];
      if (j < num_coordinates)
        table.coordinates[row * num_coordinates + j] = x;
      else
        table.values.push_back(x);
    }
  table.coordinates.resize(n * num_coordinates);
  table.dimension = static_cast<int>(num_coordinates);
  if (table.column_names.size() == width) {
    const auto first = table.column_names.begin() + static_cast<std::ptrdiff_t>(num_coordinates);
    table.value_names.assign(first, table.column_names.end());
    table.column_names.erase(first, table.column_names.end());
  }
  return table;
}

/// Refuses what cannot be of this format by its first bytes. Where the first word is wrong the reader says
/// so.
void check_opening(const std::string& format, std::string_view opening, bool is_whole,
                   const std::string& name) {
  if (is_whole) return;  // read at once
  if (format == "npy") return io::with_hint(opening, format, [&] { io::require_npy(opening, name); });
  if (format == "ply") {
    if (!opening.starts_with("ply")) io::read_ply(opening, name, {});
    return;
  }
  const std::string_view text = io::text_of(opening, name);
  io::with_hint(opening, format, [&] { io::require_text(text, name); });
  io::TextCursor at(text, name);
  const std::string_view word = at.next_token();
  if (word.empty() || at.at_end()) return;  // there may be more of it
  if (format == "off" && !word.ends_with("OFF")) io::read_off(text, name);
  if (format == "qhull" && !io::to_count(word)) io::read_qhull(text, name);
  if ((format == "txt" || format == "xyz" || format == "pts" || format == "dat") && !io::to_number(word))
    io::read_white_space(text, name);
}

}  // namespace

PointTable read_points(const std::string& path, const ReadOptions& options, const Execution& how) {
  const internal::ProgressMeter meter(how.progress);
  io::refuse_folder(path, "a file of points");
  const std::string format = io::choose_format(
      path, options.format, "qhull", {"npy", "csv", "tsv", "txt", "xyz", "pts", "dat", "off", "ply", "qhull"},
      io::Use::reading, "points");
  const std::string name = io::input_name(path);
  return io::guarded(name, [&] {
    const io::Bytes file = io::read_all(
        path, options.max_stream_bytes,
        [&](std::string_view opening, bool is_whole) { check_opening(format, opening, is_whole, name); });
    const std::string_view bytes = file.view();
    const io::ReadingInParts in_parts{.threads = how.threads};
    const io::ColumnChoice choice{.wanted = options.columns, .last = options.values};
    if (format == "csv" || format == "tsv")
      return with_values(io::read_delimited(bytes, name, format == "csv" ? ',' : '\t', choice, in_parts),
                         name);
    if (format == "ply") return with_values(io::read_ply(bytes, name, choice), name);
    PointTable table =
        format == "npy"     ? io::with_hint(bytes, format, [&] { return io::read_npy(bytes, name); })
        : format == "off"   ? io::with_hint(bytes, format, [&] { return io::read_off(bytes, name); })
        : format == "qhull" ? io::read_qhull(bytes, name)
                            : io::read_white_space(bytes, name, in_parts);
    return with_values(with_columns(std::move(table), choice, name), name);
  });
}

}  // namespace delone
