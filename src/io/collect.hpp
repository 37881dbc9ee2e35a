// SPDX-License-Identifier: BSD-3-Clause
// Collecting points while a file is read. Values that are not finite do not stop the reading, so that the
// error can name every row concerned. Missing ones are refused, or stand as NaN until all rows are read.
#pragma once

#include "base/parallel_parts.hpp"
#include "io/line_parts.hpp"
#include "io/text_cursor.hpp"

#include <delone/error.hpp>
#include <delone/io.hpp>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace delone::io {

/// What becomes of rows with missing values.
enum class Missing { refused, left_out };

/// Whether the value is an error.
inline bool is_refused(double value, Missing missing) {
  return !std::isfinite(value) && (missing == Missing::refused || !std::isnan(value));
}

/// Whether a field says that there is no value: it is blank, or one of the words that pandas and R write or
/// read for it, or '-'.
bool is_missing(std::string_view field);

/// What is thrown if missing values, and nothing else, are refused.
class MissingValue : public Error {
 public:
  using Error::Error;
};

/// Throws not_finite, with the rows that hold a NaN or an infinity, if there are any; NaN is allowed if it
/// will be left out. `first` describes the first value concerned; when empty it is made of `name` and the
/// row. Rows count from `first_row`.
void require_finite(std::span<const double> coordinates, int dimension, const std::string& name,
                    const std::string& first = {}, std::size_t first_row = 0,
                    Missing missing = Missing::refused);

/// Leaves out the rows with a NaN, and notes them as skipped.
void leave_out_missing(PointTable& table);

/// "'nan' is not finite", or for decimals "'1e999' is beyond the range of double precision".
std::string describe_not_finite(std::string_view text);

class PointCollector {
 public:
  PointTable table;

  explicit PointCollector(Missing missing = Missing::refused) : missing_(missing) {}
  /// Writes the values to `room` instead of the table.
  PointCollector(double* room, Missing missing) : missing_(missing), room_(room), end_(room) {}

  Missing missing() const { return missing_; }

  /// REQUIRES that values arrive row by row. `describe` is called at most once, for the message.
  template <class Describe>
  void add(double value, Describe&& describe) {
    if (is_refused(value, missing_) && first_.empty()) first_ = describe();
    if (room_ != nullptr)
      *end_++ = value;
    else
      table.coordinates.push_back(value);
  }
  /// The table, or Error{not_finite} with its rows, which count from `first_row`.
  PointTable finish(std::size_t first_row = 0);

  /// Appends the values of a text in parts: read(part, collector) reads those of a part, at most `width` per
  /// line, to another collector, in any of the threads. Of several exceptions, that of the first part is
  /// passed on.
  template <class Read>
  void add_parts(std::span<const LinePart> parts, std::size_t width, unsigned threads, const Read& read);

 private:
  void close_gaps(std::span<const PointCollector> parts, std::size_t end);

  Missing missing_;
  std::string first_;
  double *room_ = nullptr, *end_ = nullptr;
};

template <class Read>
void PointCollector::add_parts(std::span<const LinePart> parts, std::size_t width, unsigned threads,
                               const Read& read) {
  std::vector<double>& values = table.coordinates;
  const std::size_t before = values.size();
  std::vector<std::size_t> begin(parts.size() + 1, before);
  for (std::size_t p = 0; p < parts.size(); ++p) begin[p + 1] = begin[p] + parts[p].num_lines * width;
  values.resize(begin.back());
  std::vector<PointCollector> collectors(parts.size());
  internal::for_parts(threads, parts.size(), 1,
                      [&](std::size_t p, std::size_t, const internal::StopPoint& stop) {
                        stop();
                        PointCollector collector(values.data() + begin[p], missing_);
                        read(parts[p], collector);
                        collectors[p] = std::move(collector);
                      });
  close_gaps(collectors, before);
}

/// The number at the cursor, or NaN for a missing one that is not refused.
double read_coordinate(TextCursor& at, const PointCollector& points);

}  // namespace delone::io
