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
                   const std::string& name, io::Missing missing) {
  if (is_whole) return;  // read at once
  if (format == "npy") return io::with_hint(opening, format, [&] { io::require_npy(opening, name); });
  if (format == "ply") {
    if (!opening.starts_with("ply")) io::read_ply(opening, name, {});
    return;
  }
  if (format == "las") {
    if (!opening.starts_with("LASF")) io::read_las(opening, name);
    return;
  }
  const std::string_view text = io::text_of(opening, name);
  io::with_hint(opening, format, [&] { io::require_text(text, name); });
  io::TextCursor at(text, name);
  const std::string_view word = at.next_token();
  if (word.empty() || at.at_end()) return;  // there may be more of it
  if (format == "off" && !word.ends_with("OFF")) io::read_off(text, name);
  if (format == "qhull" && !io::to_count(word)) io::read_qhull(text, name);
  const bool is_value = io::to_number(word) || (missing == io::Missing::left_out && io::is_missing(word));
  if ((format == "txt" || format == "xyz" || format == "pts" || format == "dat") && !is_value)
    io::read_white_space(text, name);
}

/// The columns that are chosen, in which missing values are NaN.
PointTable read_columns(std::string_view bytes, const std::string& format, const std::string& name,
                        const ReadOptions& options, unsigned threads, io::Missing missing) {
  const io::ReadingInParts in_parts{.threads = threads};
  const io::ColumnChoice choice{.wanted = options.columns, .last = options.values};
  if (format == "csv" || format == "tsv")
    return io::read_delimited(bytes, name, format == "csv" ? ',' : '\t', choice, in_parts, missing);
  if (format == "ply") return io::read_ply(bytes, name, choice, missing);
  const auto read = [&]() -> PointTable {
    if (format == "npy") return io::read_npy(bytes, name, missing);
    if (format == "off") return io::read_off(bytes, name, missing);
    return io::read_las(bytes, name, missing);
  };
  if (format == "npy" || format == "off" || format == "las")
    return with_columns(io::with_hint(bytes, format, read), choice, name);
  const bool is_xyz = format == "xyz" && io::is_xyz_form(bytes);
  return with_columns(is_xyz              ? io::read_xyz(bytes, name, missing)
                      : format == "pdb"   ? io::read_pdb(bytes, name, missing)
                      : format == "qhull" ? io::read_qhull(bytes, name, missing)
                                          : io::read_white_space(bytes, name, in_parts, missing),
                      choice, name);
}

}  // namespace

PointTable read_points(const std::string& path, const ReadOptions& options, const Execution& how) {
  const internal::ProgressMeter meter(how.progress);
  io::refuse_folder(path, "a file of points");
  const std::string format = io::choose_format(
      path, options.format, "qhull",
      {"npy", "csv", "tsv", "txt", "xyz", "pts", "dat", "off", "ply", "pdb", "las", "qhull"},
      io::Use::reading, "points");
  const std::string name = io::input_name(path);
  const io::Missing missing = options.skip_missing ? io::Missing::left_out : io::Missing::refused;
  return io::guarded(name, [&] {
    const auto check = [&](std::string_view opening, bool is_whole) {
      check_opening(format, opening, is_whole, name, missing);
    };
    const io::Bytes file = io::read_all(path, options.max_stream_bytes, check);
    try {
      PointTable table = read_columns(file.view(), format, name, options, how.threads, missing);
      if (options.skip_missing) io::leave_out_missing(table);
      return with_values(std::move(table), name);
    } catch (const io::MissingValue& e) {
      throw Error(e.code(), std::string(e.what()) + "; skip_missing leaves out rows with missing values",
                  e.rows());
    }
  });
}

}  // namespace delone
