// SPDX-License-Identifier: BSD-3-Clause
#include "io/file.hpp"
#include "io/text_cursor.hpp"
#include "messages/in_quotes.hpp"

#include <delone/polyhedron_io.hpp>

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace delone {
namespace {

class RepresentationReader {
 public:
  RepresentationReader(std::string_view text, const std::string& name) : at_(io::text_of(text, name), name) {}

  PolyhedronRows read() {
    while (find_line()) {
      const std::string_view word = at_.token();
      if (word == "begin") {
        if (has_rows_) io::fail(Errc::bad_format, "{}: a second begin", at_.place());
        at_.skip_to_line_end();
        read_rows();
      } else {
        read_setting(word);
        at_.skip_to_line_end();
      }
    }
    if (!has_rows_) io::fail(Errc::bad_format, "{}: there is no begin", at_.name());
    return result();
  }

 private:
  static constexpr std::size_t unknown = std::numeric_limits<std::size_t>::max();

  /// Goes to the next line that is no comment.
  bool find_line() {
    for (; at_.find_content(); at_.skip_to_line_end())
      if (*at_.position() != '*') return true;
    return false;
  }
  void read_setting(std::string_view word) {
    if (word == "V-representation") has_generators_ = true;
    if (word == "H-representation") has_generators_ = false;
    if (word == "nonnegative") is_nonnegative_ = true;
    if (word != "linearity" && word != "equality" && word != "partial_enum") return;
    line_of_linearity_ = at_.line();
    at_.skip_blanks();
    const auto count = at_.count("the number of rows", unknown);
    for (std::uint64_t i = 0; i < count; ++i) {
      at_.skip_blanks();
      linear_rows_.push_back(static_cast<std::size_t>(at_.count("a row", unknown)));
    }
  }
  /// From the sizes to the end.
  void read_rows() {
    has_rows_ = true;
    const std::string_view size = at_.next_token();
    const bool is_open = !size.empty() && size.find_first_not_of('*') == std::string_view::npos;
    const auto given = io::to_count(size);
    if (!is_open && !given)
      io::fail(Errc::bad_format, "{}: expected the number of rows, found {}", at_.place(),
               messages::in_quotes(size));
    at_.skip_blanks();
    width_ = static_cast<std::size_t>(at_.count("the number of columns", std::numeric_limits<int>::max()));
    if (width_ == 0) io::fail(Errc::bad_format, "{}: the number of columns is 0", at_.place());
    at_.skip_blanks();
    const std::string_view type = at_.token();
    if (type != "integer" && type != "rational" && type != "real")
      io::fail(Errc::bad_format, "{}: expected integer, rational or real, found {}", at_.place(),
               messages::in_quotes(type));
    std::vector<Rational> row;
    while (at_.find_content()) {
      const std::string_view token = at_.token();
      if (token == "end") {
        if (!row.empty() || (given && rows_.size() != *given))
          io::fail(Errc::bad_format, "{}: expected {} rows of {} numbers, found {} and {} numbers",
                   at_.place(), size, width_, rows_.size(), row.size());
        at_.skip_to_line_end();
        return;
      }
      if (given && rows_.size() == *given)
        io::fail(Errc::bad_format, "{}: expected end after {} rows of {} numbers, found {}", at_.place(),
                 size, width_, messages::in_quotes(token));
      row.push_back(number(token));
      if (row.size() < width_) continue;
      lines_.push_back(at_.line());
      rows_.push_back(row);
      row.clear();
    }
    io::fail(Errc::bad_format, "{}: there is no end after the rows", at_.place());
  }
  Rational number(std::string_view token) const {
    try {
      return Rational(token);
    } catch (const Error& error) {
      io::fail(error.code(), "{}: {}", at_.place(), error.what());
    }
  }
  Rational negated(const Rational& x) const { return {x, -1}; }

  PolyhedronRows result() const {
    PolyhedronRows result;
    result.dimension = static_cast<int>(width_) - 1;
    result.has_generators = has_generators_;
    std::vector<char> is_linear(rows_.size(), 0);
    for (const std::size_t row : linear_rows_) {
      if (row < 1 || row > rows_.size())
        io::fail(Errc::bad_format, "{}:{}: there is no row {}", at_.name(), line_of_linearity_, row);
      is_linear[row - 1] = 1;
    }
    for (std::size_t i = 0; i < rows_.size(); ++i)
      has_generators_ ? add_generator(i, is_linear[i] != 0, result)
                      : add_inequality(i, is_linear[i] != 0, result);
    for (std::size_t c = 1; is_nonnegative_ && !has_generators_ && c < width_; ++c) {
      std::vector<Rational> row(width_);
      row[c - 1] = -1;
      result.inequalities.push_back(row);
    }
    return result;
  }
  void add_inequality(std::size_t i, bool is_linear, PolyhedronRows& result) const {
    std::vector<Rational> row;
    for (std::size_t c = 1; c < width_; ++c) row.push_back(negated(rows_[i][c]));
    row.push_back(rows_[i][0]);
    (is_linear ? result.equations : result.inequalities).push_back(row);
  }
  void add_generator(std::size_t i, bool is_linear, PolyhedronRows& result) const {
    const Rational& first = rows_[i][0];
    const bool is_vertex = first == Rational(1);
    if (!is_vertex && first != Rational(0))
      io::fail(Errc::bad_format, "{}:{}: a row begins with 1, for a vertex, or with 0, for a ray; found {}",
               at_.name(), lines_[i], first.to_string());
    if (is_vertex && is_linear)
      io::fail(Errc::bad_format, "{}:{}: row {} is no line, because it begins with 1", at_.name(),
               line_of_linearity_, i + 1);
    const std::span<const Rational> coordinates(rows_[i].data() + 1, width_ - 1);
    (is_vertex ? result.vertices : is_linear ? result.lines : result.rays).push_back(coordinates);
  }

  io::TextCursor at_;
  bool has_generators_ = false, is_nonnegative_ = false, has_rows_ = false;
  std::size_t width_ = 0, line_of_linearity_ = 0;
  std::vector<std::size_t> linear_rows_;  // counted from 1
  std::vector<std::vector<Rational>> rows_;
  std::vector<std::size_t> lines_;  // of the file, for each row
};

}  // namespace

PolyhedronRows read_polyhedron(const std::string& path, std::uint64_t max_stream_bytes) {
  const std::string name = io::input_name(path);
  return io::guarded(name, [&] {
    io::refuse_folder(path, "a polyhedron");
    const io::Bytes bytes = io::read_all(
        path, max_stream_bytes, [&](std::string_view opening, bool) { io::require_text(opening, name); });
    return RepresentationReader(bytes.view(), name).read();
  });
}

Polyhedron to_polyhedron(const PolyhedronRows& rows, const Options& options) {
  return rows.has_generators
             ? Polyhedron::from_generators(rows.vertices, rows.rays, rows.lines, rows.dimension, options)
             : Polyhedron::from_inequalities(rows.inequalities, rows.equations, rows.dimension, options);
}

}  // namespace delone
