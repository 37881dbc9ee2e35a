// SPDX-License-Identifier: BSD-3-Clause
// write_points: tables of points in the formats that read_points reads.
#include "io/atomic_file.hpp"
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/text_cursor.hpp"
#include "io/utf8.hpp"
#include "io/write_npy.hpp"

#include <delone/io.hpp>

#include <algorithm>
#include <cmath>

namespace delone {

namespace {

/// The names as a header line. Left out when every one of them is a number or empty: the line would be read
/// as a point. Beside others such a name is in quotes.
void write_header(io::AtomicFile& file, const std::vector<std::string>& names, char delimiter) {
  if (std::all_of(names.begin(), names.end(),
                  [](const auto& n) { return n.empty() || io::to_number(n).has_value(); }))
    return;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) file.put(delimiter);
    const std::string& name = names[i];
    const bool is_mark = name.starts_with("\xEF\xBB\xBF");  // a byte order mark, which readers skip
    if (!is_mark && !io::to_number(name) && name.find_first_of(" ,\t\"\r\n#") == std::string::npos) {
      file.write(name);
      continue;
    }
    file.put('"');
    for (const char c : name) {
      if (c == '"') file.put('"');
      file.put(c);
    }
    file.put('"');
  }
  file.put('\n');
}

void write_rows(io::AtomicFile& file, const PointTable& points, char delimiter) {
  const auto dimension = static_cast<std::size_t>(points.dimension);
  std::size_t column = 0;
  for (const double x : points.coordinates) {
    file.put(x);
    column = column + 1 == dimension ? 0 : column + 1;
    file.put(column == 0 ? '\n' : delimiter);
  }
}

/// Throws unless the numbers fit the dimension, and the format the path.
void require_table(const std::string& path, const PointTable& table, const std::string& chosen,
                   const std::string& name) {
  if (path == "-" && chosen == "npy")
    io::fail(Errc::unsupported, "format 'npy' is binary and is not written to standard output");
  if (table.dimension < 1)
    io::fail(Errc::bad_dimension, "{}: cannot write: the dimension is {}", name, table.dimension);
  if (table.coordinates.size() % static_cast<std::size_t>(table.dimension) != 0)
    io::fail(Errc::invalid_argument, "{}: cannot write: the coordinates are no multiple of the dimension",
             name);
}

void write_npy(io::AtomicFile& file, const PointTable& table) {
  std::string storage;
  file.write(io::npy_header("f8", {table.num_points(), static_cast<std::size_t>(table.dimension)}));
  file.write(io::little_endian_bytes(std::span<const double>(table.coordinates), storage));
}

void write_delimited(io::AtomicFile& file, const PointTable& table, char delimiter) {
  if (table.column_names.size() == static_cast<std::size_t>(table.dimension))
    write_header(file, table.column_names, delimiter);
  write_rows(file, table, delimiter);
}

void write_json(io::AtomicFile& file, const PointTable& table) {
  const auto width = static_cast<std::size_t>(table.dimension);
  file.write("{\"columns\": [");
  for (std::size_t j = 0; j < width; ++j) {
    file.write(j == 0 ? "" : ", ");
    file.write(
        io::json_of_text(table.column_names.size() == width ? table.column_names[j] : std::to_string(j)));
  }
  file.write("],\n\"data\": [");
  for (std::size_t i = 0; i < table.coordinates.size(); ++i) {
    file.write(i % width != 0 ? ", " : i == 0 ? "\n[" : "],\n[");
    if (const double x = table.coordinates[i]; std::isfinite(x))
      file.put(x);
    else
      file.write("null");
  }
  file.write(table.coordinates.empty() ? "]}\n" : "]\n]}\n");
}

}  // namespace

void write_table(const std::string& path, const PointTable& table, const std::string& format) {
  const std::string chosen = io::choose_format(path, format, "csv", {"npy", "csv", "tsv", "txt", "json"},
                                               io::Use::writing, "a table");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    require_table(path, table, chosen, name);
    io::AtomicFile file(path);
    if (chosen == "npy")
      write_npy(file, table);
    else if (chosen == "json")
      write_json(file, table);
    else if (chosen == "txt")
      write_rows(file, table, ' ');
    else
      write_delimited(file, table, chosen == "csv" ? ',' : '\t');
    file.commit();
  });
}

void write_points(const std::string& path, const PointTable& points, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "qhull", {"npy", "csv", "tsv", "txt", "xyz", "pts", "off", "qhull"},
                        io::Use::writing, "points");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    require_table(path, points, chosen, name);
    const auto dimension = static_cast<std::size_t>(points.dimension);
    io::require_finite(points.coordinates, points.dimension, name);
    io::AtomicFile file(path);
    const std::size_t n = points.num_points();
    if (chosen == "npy") {
      write_npy(file, points);
    } else if (chosen == "csv" || chosen == "tsv") {
      write_delimited(file, points, chosen == "csv" ? ',' : '\t');
    } else {
      if (chosen == "qhull") file.print("{}\n{}\n", dimension, n);
      if (chosen == "off" && dimension == 3) file.print("OFF\n{} 0 0\n", n);
      if (chosen == "off" && dimension != 3) file.print("nOFF\n{}\n{} 0 0\n", dimension, n);
      write_rows(file, points, ' ');
    }
    file.commit();
  });
}

}  // namespace delone
