// SPDX-License-Identifier: BSD-3-Clause
// Qhull's form of points: the dimension, the rest of its line ignored; the number of points; their
// coordinates in any layout.
#include "io/file.hpp"
#include "io/points/hints.hpp"
#include "io/points/read_points.hpp"
#include "io/points/text_rows.hpp"
#include "messages/in_quotes.hpp"

#include <cstdint>
#include <limits>
#include <memory>

namespace delone::io {

namespace {

class QhullReader {
 public:
  /// Reads what is before the rows; false if it does not end in this piece.
  bool read_head(TextCursor& at, bool is_last) {
    if (dimension_ == 0) {
      if (!at.find_content() && !is_last) return false;
      dimension_ = static_cast<std::size_t>(at.count("the dimension", std::numeric_limits<int>::max()));
      if (dimension_ == 0) fail(Errc::bad_dimension, "{}: the dimension is 0", at.place());
      at.skip_to_line_end();
    }
    if (!has_count_) {
      if (!at.find_content() && !is_last) return false;
      count_ = at.count("the number of points", std::numeric_limits<std::uint64_t>::max());
      has_count_ = true;
    }
    return true;
  }
  /// Reads the rows that end in this piece. REQUIRES the head.
  void read_rows(TextCursor& at, bool is_last, PointCollector& points) {
    for (; num_rows_ < count_; ++num_rows_) {
      const char* const begin = at.position();
      const std::size_t line = at.line();
      if (!read_row(at, points)) {
        if (is_last)
          fail(Errc::bad_format, "{}: expected {} points of {} coordinates, the file ends after {} numbers",
               at.place(), count_, dimension_, num_rows_ * dimension_ + row_.size());
        at = TextCursor({begin, static_cast<std::size_t>(at.end() - begin)}, at.name(), line);
        return;
      }
      for (const double value : row_) points.add(value, [&] { return not_finite_; });
    }
    if (at.find_content())
      fail(Errc::bad_format, "{}: expected {} points of {} coordinates, but more follows: {}", at.place(),
           count_, dimension_, messages::in_quotes(at.token()));
  }
  std::size_t dimension() const { return dimension_; }
  std::uint64_t count() const { return count_; }

 private:
  /// False if the piece ends before the row does.
  bool read_row(TextCursor& at, const PointCollector& points) {
    row_.clear();
    while (row_.size() < dimension_) {
      if (!at.find_content()) return false;
      const char* const start = at.position();
      const double value = read_coordinate(at, points);
      if (is_refused(value, points.missing()) && not_finite_.empty())
        not_finite_ = place_of_value(at, row_.size(), start);
      row_.push_back(value);
    }
    return true;
  }

  std::size_t dimension_ = 0;
  bool has_count_ = false;
  std::uint64_t count_ = 0, num_rows_ = 0;
  std::vector<double> row_;
  std::string not_finite_;
};

class QhullRows final : public TextRowsInPieces {
 public:
  explicit QhullRows(const std::string& name) : TextRowsInPieces(name) {}
  std::size_t read(std::string_view text, bool is_last, PointCollector& rows) override {
    TextCursor at = cursor(text);
    const char* const begin = at.position();
    if (reader_.read_head(at, is_last)) reader_.read_rows(at, is_last, rows);
    return finish(static_cast<std::size_t>(at.position() - begin), at.line());
  }
  std::size_t width() const override { return reader_.dimension(); }

 private:
  QhullReader reader_;
};

}  // namespace

std::string place_of_value(const TextCursor& at, std::size_t column, const char* start) {
  return fmt::format("{}: column {}: {}", at.place(), column,
                     describe_not_finite({start, static_cast<std::size_t>(at.position() - start)}));
}

PointTable read_qhull(std::string_view bytes, const std::string& name, Missing missing) {
  TextCursor at(text_of(bytes, name), name);
  QhullReader reader;
  PointCollector points(missing);
  with_hint(bytes, "qhull", [&] { reader.read_head(at, true); });
  points.table.dimension = static_cast<int>(reader.dimension());
  // Each number takes two bytes at least: what the file cannot hold is never allocated.
  const std::size_t most = at.remaining() / 2 + 1;
  if (reader.count() <= most / reader.dimension())
    points.table.coordinates.reserve(static_cast<std::size_t>(reader.count()) * reader.dimension());
  reader.read_rows(at, true, points);
  return points.finish();
}

std::unique_ptr<TextRows> open_qhull_rows(const std::string& name) {
  return std::make_unique<QhullRows>(name);
}

}  // namespace delone::io
