// SPDX-License-Identifier: BSD-3-Clause
// Tables of text in pieces, for files that do not fit into memory.
#pragma once

#include "io/collect.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace delone::io {

/// Reads csv, tsv (all columns), or white space separated rows, as read_points() does, with its messages.
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

/// `format`: csv, tsv, txt, xyz or pts.
std::unique_ptr<TextRows> open_text_rows(const std::string& format, const std::string& name);

}  // namespace delone::io
