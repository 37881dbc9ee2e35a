// SPDX-License-Identifier: BSD-3-Clause
// Tables of text in pieces, for files that do not fit into memory.
#pragma once

#include "io/collect.hpp"
#include "io/points/columns.hpp"
#include "io/text_cursor.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace delone::io {

/// Reads csv, tsv, white space separated rows, or Qhull's form, as read_points() does, with its
/// messages.
class TextRows {
 public:
  virtual ~TextRows() = default;
  /// Reads the rows of `text`, the next piece of the table, and returns the size of what was read. The rest,
  /// of which the end is missing, belongs to the next piece, which begins with it; there is none at the end.
  /// REQUIRES a piece of whole lines, unless it is the last.
  virtual std::size_t read(std::string_view text, bool is_last, PointCollector& rows) = 0;
  /// Numbers per row; 0 before the first row or header.
  virtual std::size_t width() const = 0;
};

/// `format`: csv, tsv, txt, xyz, pts or qhull. Of csv and tsv the columns that are chosen; the other formats
/// have all.
std::unique_ptr<TextRows> open_text_rows(const std::string& format, const std::string& name,
                                         ColumnChoice choice = {});
std::unique_ptr<TextRows> open_qhull_rows(const std::string& name);
std::unique_ptr<TextRows> open_xyz_rows(const std::string& name);

/// Counts the lines of the pieces.
class TextRowsInPieces : public TextRows {
 protected:
  explicit TextRowsInPieces(const std::string& name) : name_(name) {}
  /// The cursor at a piece: the byte order mark of the first is skipped.
  TextCursor cursor(std::string_view text) {
    const std::string_view shown = is_first_ ? text_of(text, name_) : text;
    skipped_ = text.size() - shown.size();
    return {shown, name_, line_};
  }
  std::size_t finish(std::size_t size, std::size_t line) {
    is_first_ = is_first_ && size == 0;
    line_ = line;
    return size == 0 ? 0 : size + skipped_;
  }

  std::string name_;

 private:
  bool is_first_ = true;
  std::size_t line_ = 1, skipped_ = 0;
};

/// What to say of the value that was just read, from `start` to the cursor.
std::string place_of_value(const TextCursor& at, std::size_t column, const char* start);

}  // namespace delone::io
