// SPDX-License-Identifier: BSD-3-Clause
// The columns of a table that a reader is told to take.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace delone::io {

/// Columns by their names, their numbers from 0, or ranges of numbers, as 2-5, both ends included. A text
/// that is a name is that column and no other: the number 5 as the range 5-5 is a number for certain.
struct ColumnChoice {
  std::vector<std::string> wanted;   ///< empty: all, but for `last`
  std::vector<std::string> last;     ///< columns that come after those
  const char* last_name = "values";  ///< the member of options that names those
};

struct ChosenColumns {
  std::vector<std::size_t> columns;  ///< positions: those that are wanted, then the last ones
  std::size_t num_last = 0;
};

/// The columns that are chosen of a table with `width` of them, with the names of a header or without
/// names. Throws bad_format with the name of the file.
ChosenColumns choose_columns(const ColumnChoice& choice, const std::vector<std::string>& names,
                             std::size_t width, const std::string& name);

}  // namespace delone::io
