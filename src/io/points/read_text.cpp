// SPDX-License-Identifier: BSD-3-Clause
// Tables of text: csv and tsv with an optional header and quotes, and white space separated rows. One pass
// over the text, numbers are parsed in place; only fields that are needed are read.
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/points/hints.hpp"
#include "io/points/read_points.hpp"
#include "io/points/text_rows.hpp"
#include "io/text_cursor.hpp"
#include "messages/in_quotes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace delone::io {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\n") - first + 1);
}

/// The rows from the cursor on in parts, or nothing if one thread should read them. There are no more lines
/// than there can be points of so many values: in each value there is a character and one after it.
std::vector<LinePart> parts_of_rows(const TextCursor& at, char never, std::size_t width,
                                    const ReadingInParts& how) {
  std::vector<LinePart> parts = split_lines(at.rest(), at.line(), never, how);
  std::size_t num_lines = 0;
  for (const LinePart& part : parts) num_lines += part.num_lines;
  if (num_lines > (at.remaining() + 1) / 2 / width) parts.clear();
  return parts;
}

/// Reads csv and tsv.
class DelimitedReader {
 public:
  DelimitedReader(std::string_view text, const std::string& name, char delimiter, const ColumnChoice& choice,
                  Missing missing = Missing::refused)
      : at_(text, name), delimiter_(delimiter), choice_(choice), missing_(missing) {}

  PointTable read(const ReadingInParts& how) {
    if (!find_row()) fail(Errc::bad_format, "{}: no row and no header in the file", at_.name());
    PointCollector points(missing_);
    read_header(points.table);
    row_.resize(width_);
    const std::vector<LinePart> parts = parts_of_rows(at_, '"', columns_.size(), how);
    if (parts.empty())
      read_rows(points);
    else
      points.add_parts(parts, columns_.size(), how.threads,
                       [&](const LinePart& part, PointCollector& of_part) {
                         DelimitedReader(*this, part).read_rows(of_part);
                       });
    return points.finish();
  }

  /// As TextRows::read().
  std::size_t read_piece(TextCursor at, bool is_last, PointCollector& points) {
    at_ = std::move(at);
    is_last_ = is_last;
    const char* const begin = at_.position();
    const char* end_of_rows = begin;
    std::size_t line = at_.line();
    try {
      while (find_row()) {
        end_of_rows = at_.position();
        line = at_.line();
        if (width_ > 0) {
          read_row(points);
        } else {
          read_header(points.table);
          row_.resize(width_);
        }
      }
    } catch (const Unfinished&) {
      at_ = TextCursor({end_of_rows, static_cast<std::size_t>(at_.end() - end_of_rows)}, at_.name(), line);
    }
    return static_cast<std::size_t>(at_.position() - begin);
  }
  std::string_view format() const { return delimiter_ == ',' ? "csv" : "tsv"; }
  std::size_t num_selected() const { return columns_.size(); }
  std::size_t line() const { return at_.line(); }

 private:
  /// A quoted field that does not end in this piece of the text.
  struct Unfinished {};

  /// Reads a part of the rows, after the header.
  DelimitedReader(const DelimitedReader& all, const LinePart& part) : DelimitedReader(all) {
    at_ = TextCursor(part.text, all.at_.name(), part.first_line);
  }
  DelimitedReader(const DelimitedReader&) = default;

  void read_rows(PointCollector& points) {
    while (find_row()) read_row(points);
  }

  bool is_space(char c) const { return c != delimiter_ && TextCursor::is_blank(c); }
  void skip_spaces() {
    const char* p = at_.position();
    while (p != at_.end() && is_space(*p)) ++p;
    at_.move_to(p);
  }

  /// Whether the field at the cursor is a missing one, as the #N/A of spreadsheets.
  bool at_missing_field() const {
    const char* stop = at_.position();
    while (stop != at_.end() && *stop != delimiter_ && *stop != '\n' && *stop != '\r') ++stop;
    return is_missing(trimmed({at_.position(), static_cast<std::size_t>(stop - at_.position())}));
  }

  /// Goes to the next line that is neither blank nor a comment.
  bool find_row() {
    for (;;) {
      const char* start = at_.position();
      at_.skip_blanks();
      if (!at_.at_end() && *at_.position() == '#' && !at_missing_field()) at_.skip_to_line_end();
      if (!at_.at_line_end()) {
        at_.move_to(start);  // the blanks may be empty fields of a tsv row
        return true;
      }
      if (at_.at_end()) return false;
      at_.take_line_end();
    }
  }

  /// The field at the cursor as text, without quotes or spaces around it; leaves the cursor at a delimiter or
  /// line end.
  std::string field() {
    skip_spaces();
    std::string text;
    if (!at_.at_end() && *at_.position() == '"') {
      const std::string opened = at_.place();
      at_.move_to(at_.position() + 1);
      for (;;) {
        if (at_.at_end() && !is_last_) throw Unfinished();
        if (at_.at_end()) fail(Errc::bad_format, "{}: a quoted field is not closed", opened);
        const char* p = at_.position();
        if (*p == '"') {
          at_.move_to(p + 1);
          if (at_.at_end() || *at_.position() != '"') break;
        }
        if (at_.at_line_end()) {
          at_.take_line_end();
          text += '\n';
        } else {
          text += *at_.position();
          at_.move_to(at_.position() + 1);
        }
      }
      skip_spaces();
      if (!at_field_end()) fail(Errc::bad_format, "{}: text after a closing quote", at_.place());
      return text;
    }
    const char* start = at_.position();
    skip_plain_field();
    const char* stop = at_.position();
    while (stop != start && is_space(stop[-1])) --stop;
    return {start, stop};
  }

  bool at_field_end() const { return at_.at_line_end() || *at_.position() == delimiter_; }
  void skip_plain_field() {
    const char* p = at_.position();
    while (p != at_.end() && *p != delimiter_ && *p != '\n' && *p != '\r') ++p;
    at_.move_to(p);
  }
  /// Past a delimiter; false at the end of the line.
  bool next_field() {
    if (at_.at_line_end()) return false;
    at_.move_to(at_.position() + 1);
    return true;
  }

  /// A field of the first line.
  struct FirstField {
    std::string text;
    bool quoted = false;
    bool is_number() const { return to_number(trimmed(text)).has_value(); }
    bool is_name() const { return !trimmed(text).empty() && !is_number(); }
  };

  /// Throws bad_format for a field that is no number.
  [[noreturn]] void fail_field(std::size_t column, std::size_t line, std::string_view field,
                               std::string_view more = {}) const {
    const std::string_view text = trimmed(field);
    const std::string message =
        field_place(column, line) +
        (text.empty() ? ": the field is empty" : ": " + messages::in_quotes(field) + " is not a number") +
        std::string(more);
    if (is_missing(text)) throw MissingValue(Errc::bad_format, message);
    throw Error(Errc::bad_format, message);
  }

  /// Whether the first line has names. A line of numbers and empty fields has not: it is a row, perhaps a
  /// faulty one; nor has one of numbers and missing fields that are left out. Beside a name, a number in
  /// quotes is one, too; any other number there is refused, as the line may be a damaged row, unless a name
  /// of the line is among the columns that are chosen.
  bool is_header(const std::vector<FirstField>& fields, std::size_t line) const {
    const auto name = std::find_if(fields.begin(), fields.end(), [&](const auto& f) {
      return f.is_name() && (missing_ == Missing::refused || !is_missing(trimmed(f.text)));
    });
    if (name == fields.end()) return false;
    const auto is_chosen = [&](const FirstField& f) {
      const auto in = [&](const std::vector<std::string>& list) {
        return std::find(list.begin(), list.end(), f.text) != list.end();
      };
      return f.is_name() && (in(choice_.wanted) || in(choice_.last));
    };
    if (std::none_of(fields.begin(), fields.end(),
                     [](const auto& f) { return f.is_number() && !f.quoted; }) ||
        std::any_of(fields.begin(), fields.end(), is_chosen))
      return true;
    fail_field(static_cast<std::size_t>(name - fields.begin()), line, name->text,
               "; a header has names only, or numbers in quotes");
  }

  /// The first line gives the number of columns, and their names if it has names.
  void read_header(PointTable& table) {
    const TextCursor start = at_;
    std::vector<FirstField> fields;
    do {
      skip_spaces();
      const bool quoted = !at_.at_end() && *at_.position() == '"';
      fields.push_back({field(), quoted});
    } while (next_field());
    width_ = fields.size();
    const bool header = is_header(fields, start.line());
    if (header) {
      for (FirstField& f : fields) names_.push_back(std::move(f.text));
      at_.take_line_end();
    } else {
      at_ = start;
    }
    ChosenColumns chosen = choose_columns(choice_, names_, width_, at_.name());
    columns_ = std::move(chosen.columns);
    table.num_values = static_cast<int>(chosen.num_last);
    selected_.assign(width_, false);
    for (std::size_t column : columns_) selected_[column] = true;
    table.dimension = static_cast<int>(columns_.size());
    if (header)
      for (std::size_t column : columns_) table.column_names.push_back(names_[column]);
  }

  /// The number of the next field, NaN if it is missing and left out. A quoted field may span lines: errors
  /// name the line where the row starts.
  double number_field(std::size_t column, std::size_t row_line) {
    skip_spaces();
    const char* start = at_.position();
    double value = 0;
    if (const char* stop = parse_number(start, at_.end(), value); stop != nullptr) {
      at_.move_to(stop);
      skip_spaces();
      if (at_field_end()) {
        if (is_refused(value, missing_))
          note_not_finite(column, row_line, {start, static_cast<std::size_t>(stop - start)});
        return value;
      }
      at_.move_to(start);
    }
    const std::string text = field();
    const std::string_view number_text = trimmed(text);
    const auto number = to_number(number_text);
    if (!number) {
      if (missing_ == Missing::refused || !is_missing(number_text)) fail_field(column, row_line, text);
      return std::numeric_limits<double>::quiet_NaN();
    }
    if (is_refused(*number, missing_)) note_not_finite(column, row_line, number_text);
    return *number;
  }

  std::string field_place(std::size_t column, std::size_t row_line) const {
    const std::string label =
        names_.empty() ? std::string{} : fmt::format(" ({})", printable(names_[column]));
    return fmt::format("{}:{}: column {}{}", at_.name(), row_line, column, label);
  }

  void note_not_finite(std::size_t column, std::size_t row_line, std::string_view text) {
    if (not_finite_.empty()) not_finite_ = field_place(column, row_line) + ": " + describe_not_finite(text);
  }

  void read_row(PointCollector& points) {
    const std::size_t row_line = at_.line();
    std::size_t found = 0;
    do {
      if (found < width_ && selected_[found])
        row_[found] = number_field(found, row_line);
      else if (skip_spaces(); !at_.at_end() && *at_.position() == '"')
        field();
      else
        skip_plain_field();
      ++found;
    } while (next_field());
    if (found != width_)
      fail(Errc::bad_format, "{}:{}: expected {} field{}, found {}", at_.name(), row_line, width_,
           width_ == 1 ? "" : "s", found);
    at_.take_line_end();
    for (std::size_t column : columns_) points.add(row_[column], [&] { return not_finite_; });
  }

  TextCursor at_;
  char delimiter_;
  const ColumnChoice& choice_;
  Missing missing_;
  std::size_t width_ = 0;
  std::vector<std::string> names_;
  std::vector<std::size_t> columns_;
  std::vector<bool> selected_;
  std::vector<double> row_;
  std::string not_finite_;
  bool is_last_ = true;  // nothing follows the text
};

/// Reads white space separated rows; all have as many numbers as the first.
class WhiteSpaceReader {
 public:
  std::size_t width() const { return width_; }

  /// REQUIRES content at the cursor.
  void read_first_row(TextCursor& at, PointCollector& points) {
    width_ = read_row(at, points);
    points.table.dimension = static_cast<int>(width_);
    at.take_line_end();
  }
  void read_rows(TextCursor& at, PointCollector& points) const {
    for (; at.find_content(); at.take_line_end())
      if (const std::size_t found = read_row(at, points); found != width_)
        fail(Errc::bad_format, "{}: expected {} number{}, found {}", at.place(), width_,
             width_ == 1 ? "" : "s", found);
  }

 private:
  std::size_t read_row(TextCursor& at, PointCollector& points) const {
    std::size_t found = 0;
    for (; !at.skip_to_content(); ++found) {
      const char* start = at.position();
      const double value = read_coordinate(at, points);
      if (width_ == 0 || found < width_) points.add(value, [&] { return place_of_value(at, found, start); });
    }
    return found;
  }

  std::size_t width_ = 0;
};

class WhiteSpaceRows final : public TextRowsInPieces {
 public:
  WhiteSpaceRows(const std::string& name, bool may_be_molecule)
      : TextRowsInPieces(name), may_be_molecule_(may_be_molecule) {}
  std::size_t read(std::string_view text, bool is_last, PointCollector& rows) override {
    if (is_first_ && is_qhull_form(text)) other_ = open_qhull_rows(name_);
    if (is_first_ && may_be_molecule_ && is_xyz_form(text)) other_ = open_xyz_rows(name_);
    is_first_ = false;
    if (other_) return other_->read(text, is_last, rows);
    TextCursor at = cursor(text);
    const char* const begin = at.position();
    if (width() > 0 || at.find_content()) {
      if (width() == 0) with_hint(text, "txt", [&] { reader_.read_first_row(at, rows); });
      reader_.read_rows(at, rows);
    } else if (is_last) {
      fail(Errc::bad_format, "{}: no row in the file", name_);
    }
    return finish(static_cast<std::size_t>(at.position() - begin), at.line());
  }
  std::size_t width() const override { return other_ ? other_->width() : reader_.width(); }

 private:
  WhiteSpaceReader reader_;
  const bool may_be_molecule_;
  std::unique_ptr<TextRows> other_;  // where the text is in Qhull's or the chemists' form
  bool is_first_ = true;
};

class DelimitedRows final : public TextRowsInPieces {
 public:
  DelimitedRows(const std::string& name, char delimiter, ColumnChoice choice)
      : TextRowsInPieces(name), choice_(std::move(choice)), reader_({}, name, delimiter, choice_) {}
  std::size_t read(std::string_view text, bool is_last, PointCollector& rows) override {
    const auto read_piece = [&] { return reader_.read_piece(cursor(text), is_last, rows); };
    const std::size_t size = width() > 0 ? read_piece() : with_hint(text, reader_.format(), read_piece);
    if (is_last && width() == 0) fail(Errc::bad_format, "{}: no row and no header in the file", name_);
    return finish(size, reader_.line());
  }
  std::size_t width() const override { return reader_.num_selected(); }

 private:
  const ColumnChoice choice_;
  DelimitedReader reader_;
};

PointTable read_rows(std::string_view bytes, const std::string& name, const ReadingInParts& how,
                     Missing missing) {
  TextCursor at(text_of(bytes, name), name);
  if (!at.find_content()) fail(Errc::bad_format, "{}: no row in the file", name);
  WhiteSpaceReader reader;
  PointCollector points(missing);
  reader.read_first_row(at, points);
  const std::vector<LinePart> parts = parts_of_rows(at, 0, reader.width(), how);
  if (parts.empty())
    reader.read_rows(at, points);
  else
    points.add_parts(parts, reader.width(), how.threads, [&](const LinePart& part, PointCollector& of_part) {
      TextCursor rows(part.text, name, part.first_line);
      reader.read_rows(rows, of_part);
    });
  return points.finish();
}

}  // namespace

PointTable read_delimited(std::string_view bytes, const std::string& name, char delimiter,
                          const ColumnChoice& choice, const ReadingInParts& how, Missing missing) {
  return with_hint(bytes, delimiter == ',' ? "csv" : "tsv", [&] {
    return DelimitedReader(text_of(bytes, name), name, delimiter, choice, missing).read(how);
  });
}

PointTable read_white_space(std::string_view bytes, const std::string& name, const ReadingInParts& how,
                            Missing missing) {
  if (is_qhull_form(bytes)) return read_qhull(bytes, name, missing);
  return with_hint(bytes, "txt", [&] { return read_rows(bytes, name, how, missing); });
}

std::unique_ptr<TextRows> open_text_rows(const std::string& format, const std::string& name,
                                         ColumnChoice choice) {
  if (format == "csv" || format == "tsv")
    return std::make_unique<DelimitedRows>(name, format == "csv" ? ',' : '\t', std::move(choice));
  if (format == "qhull") return open_qhull_rows(name);
  return std::make_unique<WhiteSpaceRows>(name, format == "xyz");
}

}  // namespace delone::io
