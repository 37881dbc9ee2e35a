// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/optimal_scaling.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace delone::kernel {

// Shortest augmenting paths (Kuhn 1955, doi:10.1002/nav.3800020109; Edmonds and Karp 1972,
// doi:10.1145/321694.321699): rows are assigned one after the other; the cost of an entry is its exponent
// with the opposite sign. Column n is where the path of the new row starts. All along, cost ≥ row + column,
// and equality holds at assigned entries.
bool scale_optimally(std::span<const std::int64_t> exponents, int n, std::int64_t* row,
                     std::int64_t* column) {
  constexpr std::int64_t infinity = std::numeric_limits<std::int64_t>::max();
  constexpr std::size_t size = most_scaled_columns + 1;
  std::int64_t of_row[size] = {}, of_column[size] = {}, distance[size];
  int row_at[size], before[size];
  bool is_done[size];
  const auto cost = [&](int i, int j) { return -exponents[static_cast<std::size_t>(i * n + j)]; };
  for (int j = 0; j < n; ++j) {
    row_at[j] = -1;
    of_column[j] = cost(0, j);
    for (int i = 1; i < n; ++i) of_column[j] = std::min(of_column[j], cost(i, j));
  }
  bool is_assigned[size] = {};
  for (int i = 0; i < n; ++i) {
    of_row[i] = cost(i, 0) - of_column[0];
    for (int j = 1; j < n; ++j) of_row[i] = std::min(of_row[i], cost(i, j) - of_column[j]);
    for (int j = 0; j < n && !is_assigned[i]; ++j)
      if (row_at[j] < 0 && cost(i, j) == of_row[i] + of_column[j]) {
        row_at[j] = i;
        is_assigned[i] = true;
      }
  }
  for (int i = 0; i < n; ++i) {
    if (is_assigned[i]) continue;
    row_at[n] = i;
    for (int j = 0; j < n; ++j) {
      distance[j] = infinity;
      is_done[j] = false;
    }
    int at = n;
    do {
      if (at < n) is_done[at] = true;
      const int from = row_at[at];
      std::int64_t step = infinity;
      int next = n;
      for (int j = 0; j < n; ++j) {
        if (is_done[j]) continue;
        if (const std::int64_t slack = cost(from, j) - of_row[from] - of_column[j]; slack < distance[j]) {
          distance[j] = slack;
          before[j] = at;
        }
        if (distance[j] < step) {
          step = distance[j];
          next = j;
        }
      }
      of_row[i] += step;
      for (int j = 0; j < n; ++j) {
        if (!is_done[j]) {
          distance[j] -= step;
        } else {
          of_row[row_at[j]] += step;
          of_column[j] -= step;
        }
      }
      at = next;
    } while (row_at[at] >= 0);
    for (; at != n; at = before[at]) row_at[at] = row_at[before[at]];
  }
  bool has_term = true;
  for (int j = 0; j < n; ++j) {
    has_term = has_term && cost(row_at[j], j) != -exponent_of_zero;
    column[j] = -of_column[j];
  }
  for (int i = 0; i < n; ++i) row[i] = -of_row[i];
  return has_term;
}

}  // namespace delone::kernel
