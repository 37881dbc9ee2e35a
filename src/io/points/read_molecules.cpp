// SPDX-License-Identifier: BSD-3-Clause
// The atoms of molecules: the chemists' xyz and the Protein Data Bank's format. Points have no names, so only
// the coordinates are kept.
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/points/read_points.hpp"
#include "io/points/text_rows.hpp"
#include "io/text_cursor.hpp"
#include "messages/in_quotes.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

namespace delone::io {

namespace {

/// Reads the number of atoms; a line of comment; a line for each atom: its element, x, y, z, and what
/// follows.
class XyzRows final : public TextRowsInPieces {
 public:
  explicit XyzRows(const std::string& name) : TextRowsInPieces(name) {}
  std::size_t read(std::string_view text, bool is_last, PointCollector& rows) override {
    TextCursor at = cursor(text);
    const char* const begin = at.position();
    for (; !at.at_end(); at.take_line_end()) read_line(at, rows);
    if (is_last && num_atoms_ < count_)
      fail(Errc::bad_format, "{}: expected {} atoms, the file ends after {}", at.place(), count_, num_atoms_);
    return finish(static_cast<std::size_t>(at.position() - begin), at.line());
  }
  std::size_t width() const override { return num_lines_ == 0 ? 0 : 3; }

 private:
  /// Leaves the cursor at the end of the line.
  void read_line(TextCursor& at, PointCollector& rows) {
    at.skip_blanks();
    if (num_lines_ == 0) {
      count_ = at.count("the number of atoms", std::numeric_limits<std::uint64_t>::max());
    } else if (num_lines_ > 1 && num_atoms_ < count_) {
      read_atom(at, rows);
      ++num_atoms_;
    } else if (num_lines_ > 1 && !at.at_line_end()) {
      const std::string_view more = at.rest_of_line();
      if (to_count(more))
        fail(Errc::bad_format, "{}: a second frame begins; keep one, the first ends in line {}", at.place(),
             count_ + 2);
      fail(Errc::bad_format, "{}: more than the {} atoms of the first line: {}", at.place(), count_,
           messages::in_quotes(more));
    }
    at.skip_to_line_end();
    ++num_lines_;
  }

  void read_atom(TextCursor& at, PointCollector& rows) {
    const auto require_more = [&](std::size_t found) {
      at.skip_blanks();
      if (at.at_line_end())
        fail(Errc::bad_format, "{}: expected an element and 3 coordinates, found {} field{}", at.place(),
             found, found == 1 ? "" : "s");
    };
    require_more(0);
    while (!at.at_line_end() && !TextCursor::is_blank(*at.position())) at.move_to(at.position() + 1);
    for (std::size_t column = 1; column < 4; ++column) {
      require_more(column);
      const char* const start = at.position();
      rows.add(read_coordinate(at, rows), [&] { return place_of_value(at, column, start); });
    }
  }

  std::uint64_t count_ = 0, num_atoms_ = 0;
  std::uint64_t num_lines_ = 0;
};

/// Reads the columns 31 to 54 of an atom: three numbers of eight characters.
void read_pdb_atom(std::string_view record, const TextCursor& at, PointCollector& points) {
  if (record.size() < 54)
    fail(Errc::bad_format,
         "{}: an atom's line ends in column {}; its coordinates are in the columns 31 to 54", at.place(),
         record.size());
  for (std::size_t i = 0; i < 3; ++i) {
    const auto place = [&] {
      return fmt::format("{}: columns {} to {}", at.place(), 31 + 8 * i, 38 + 8 * i);
    };
    TextCursor field(record.substr(30 + 8 * i, 8), {});
    const std::string_view text = field.rest_of_line();
    const std::optional<double> value = to_number(text);
    if (!value && !is_missing(text))
      fail(Errc::bad_format, "{}: {} is not a number", place(), messages::in_quotes(text));
    if (!value && points.missing() == Missing::refused)
      throw MissingValue(Errc::bad_format,
                         fmt::format("{}: {} is not a number", place(), messages::in_quotes(text)));
    points.add(value.value_or(std::numeric_limits<double>::quiet_NaN()),
               [&] { return place() + ": " + describe_not_finite(text); });
  }
}

}  // namespace

std::unique_ptr<TextRows> open_xyz_rows(const std::string& name) { return std::make_unique<XyzRows>(name); }

PointTable read_xyz(std::string_view bytes, const std::string& name, Missing missing) {
  PointCollector points(missing);
  points.table.dimension = 3;
  XyzRows(name).read(bytes, true, points);
  return points.finish();
}

PointTable read_pdb(std::string_view bytes, const std::string& name, Missing missing) {
  PointCollector points(missing);
  points.table.dimension = 3;
  bool is_first_model = true;
  for (TextCursor at(text_of(bytes, name), name); !at.at_end(); at.take_line_end()) {
    const char* const start = at.position();
    at.skip_to_line_end();
    const std::string_view record(start, static_cast<std::size_t>(at.position() - start));
    if (record.starts_with("ATOM  ") || record.starts_with("HETATM")) {
      read_pdb_atom(record, at, points);
    } else if (record.starts_with("MODEL ")) {
      if (!is_first_model)
        fail(Errc::bad_format, "{}: a second model begins; keep one, the first by awk '/^ENDMDL/ {{exit}} 1'",
             at.place());
      is_first_model = false;
    }
  }
  if (points.table.coordinates.empty())
    fail(Errc::bad_format, "{}: no line of an atom (ATOM or HETATM) in the file", name);
  return points.finish();
}

}  // namespace delone::io
