// SPDX-License-Identifier: BSD-3-Clause
// Collecting points while a file is read. Values that are not finite do not stop the reading, so that the
// error can name every row concerned.
#pragma once

#include <delone/io.hpp>

#include <cmath>
#include <span>
#include <string>
#include <string_view>

namespace delone::io {

/// Throws not_finite, with the rows that hold a NaN or an infinity, if there are any. `first` describes the
/// first value concerned; when empty it is made of `name` and the row.
void require_finite(std::span<const double> coordinates, int dimension, const std::string& name,
                    const std::string& first = {});

/// "'nan' is not finite", or for decimals "'1e999' is beyond the range of double precision".
std::string describe_not_finite(std::string_view text);

class PointCollector {
 public:
  PointTable table;

  /// REQUIRES that values arrive row by row. `describe` is called at most once, for the message.
  template <class Describe>
  void add(double value, Describe&& describe) {
    if (!std::isfinite(value) && first_.empty()) first_ = describe();
    table.coordinates.push_back(value);
  }
  /// The table, or Error{not_finite} with its rows.
  PointTable finish();

 private:
  std::string first_;
};

}  // namespace delone::io
