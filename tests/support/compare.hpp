// SPDX-License-Identifier: BSD-3-Clause
// Triangulations as sets of cells, and comparisons whose failures can be read and reproduced.
#pragma once

#include <delone/complex.hpp>
#include <delone/data.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>
#include <vector>

namespace delone::test {

using Cells = std::vector<std::vector<SignedIndex>>;

/// Each cell as increasing rows, the cells in increasing order.
inline Cells sorted_cells(std::span<const SignedIndex> cells, int affine_dimension) {
  Cells result;
  const auto corners = static_cast<std::size_t>(affine_dimension + 1);
  for (std::size_t first = 0; corners > 0 && first + corners <= cells.size(); first += corners) {
    const auto cell = cells.subspan(first, corners);
    result.emplace_back(cell.begin(), cell.end());
    std::sort(result.back().begin(), result.back().end());
  }
  std::sort(result.begin(), result.end());
  return result;
}
inline Cells sorted_cells(const ComplexData& data) { return sorted_cells(data.cells, data.affine_dimension); }

inline std::string to_text(std::span<const SignedIndex> rows) {
  std::string text = "{";
  for (const SignedIndex row : rows) text += (text.size() > 1 ? ", " : "") + std::to_string(row);
  return text + "}";
}

/// The points in the text form that the command reads from standard input; up to 40 of them.
inline std::string to_text(std::span<const double> points, int dimension) {
  const std::size_t d = static_cast<std::size_t>(dimension), n = points.size() / d;
  std::string text = std::to_string(d) + "\n" + std::to_string(n) + "\n";
  for (std::size_t i = 0; i < std::min<std::size_t>(n, 40) * d; ++i) {
    char number[40];
    std::snprintf(number, sizeof number, "%.17g", points[i]);
    text += number;
    text += (i + 1) % d == 0 ? '\n' : ' ';
  }
  return n > 40 ? text + "…\n" : text;
}

/// Success if both are the same set of cells; otherwise the first cells that only one of them has.
inline ::testing::AssertionResult same_cells(const Cells& expected, const Cells& actual) {
  if (expected == actual) return ::testing::AssertionSuccess();
  auto result = ::testing::AssertionFailure();
  result << actual.size() << " cells instead of " << expected.size();
  const auto list = [&](const char* title, const Cells& a, const Cells& b) {
    Cells only;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
    result << "\n  " << title << " (" << only.size() << "):";
    for (std::size_t i = 0; i < std::min<std::size_t>(only.size(), 8); ++i) result << ' ' << to_text(only[i]);
  };
  list("missing", expected, actual);
  list("unexpected", actual, expected);
  return result;
}

}  // namespace delone::test
