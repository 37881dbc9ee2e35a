// SPDX-License-Identifier: BSD-3-Clause
// Cells in the order of their rows. They are first sorted by the first row alone, by counting, and then those
// of each row by the others: few cells have a row in common.
#include "base/parallel.hpp"

#include <delone/data.hpp>
#include <delone/error.hpp>

#include <algorithm>
#include <cstddef>
#include <new>
#include <numeric>
#include <utility>
#include <vector>

namespace delone {
namespace {

/// Sorts the vertices of a cell, and its neighbors with them, up to one exchange that keeps the orientation.
void sort_vertices(SignedIndex* vertices, SignedIndex* neighbors, std::size_t size) {
  bool is_odd = false;
  const auto exchange = [&](std::size_t i, std::size_t j) {
    std::swap(vertices[i], vertices[j]);
    if (neighbors != nullptr) std::swap(neighbors[i], neighbors[j]);
    is_odd = !is_odd;
  };
  for (std::size_t i = 1; i < size; ++i)
    for (std::size_t j = i; j > 0 && vertices[j] < vertices[j - 1]; --j) exchange(j, j - 1);
  if (is_odd) exchange(size - 2, size - 1);
}

std::vector<SignedIndex> numbers(ComplexData& data, unsigned threads) {
  const std::size_t count = data.num_cells(), size = static_cast<std::size_t>(data.affine_dimension + 1);
  std::vector<SignedIndex>& cells = data.cells;
  const bool has_neighbors = data.neighbors.size() == cells.size();
  constexpr std::size_t part = 8192;
  std::vector<SignedIndex> number(count);
  if (count == 0) return number;
  SignedIndex last_row = 0;
  for (const SignedIndex row : cells) last_row = std::max(last_row, row);
  std::vector<std::size_t> begin(static_cast<std::size_t>(last_row) + 2,
                                 0);  // of the cells with that first row
  internal::parallel_for(threads, count, part, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c)
      sort_vertices(cells.data() + c * size, has_neighbors ? data.neighbors.data() + c * size : nullptr,
                    size);
  });
  const auto first_row = [&](std::size_t c) { return static_cast<std::size_t>(cells[c * size]); };
  for (std::size_t c = 0; c < count; ++c) ++begin[first_row(c) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<SignedIndex> order(count);
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t c = 0; c < count; ++c) order[next[first_row(c)]++] = static_cast<SignedIndex>(c);
  internal::parallel_for(threads, begin.size() - 1, part, [&](std::size_t first, std::size_t last) {
    const auto is_before = [&](SignedIndex a, SignedIndex b) {
      const SignedIndex* const of_a = cells.data() + static_cast<std::size_t>(a) * size;
      const SignedIndex* const of_b = cells.data() + static_cast<std::size_t>(b) * size;
      return std::lexicographical_compare(of_a + 1, of_a + size, of_b + 1, of_b + size);
    };
    for (std::size_t row = first; row < last; ++row)
      std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin[row]),
                order.begin() + static_cast<std::ptrdiff_t>(begin[row + 1]), is_before);
  });
  for (std::size_t n = 0; n < count; ++n)
    number[static_cast<std::size_t>(order[n])] = static_cast<SignedIndex>(n);
  std::vector<SignedIndex> moved(cells.size());
  const auto move = [&](std::vector<SignedIndex>& rows, auto&& entry) {
    internal::parallel_for(threads, count, part, [&](std::size_t first, std::size_t last) {
      for (std::size_t n = first; n < last; ++n)
        for (std::size_t i = 0; i < size; ++i)
          moved[n * size + i] = entry(rows[static_cast<std::size_t>(order[n]) * size + i]);
    });
    rows.swap(moved);
  };
  move(cells, [](SignedIndex row) { return row; });
  if (has_neighbors)
    move(data.neighbors,
         [&](SignedIndex cell) { return cell < 0 ? cell : number[static_cast<std::size_t>(cell)]; });
  return number;
}

}  // namespace

std::vector<SignedIndex> number_canonically(ComplexData& data, unsigned threads) {
  try {
    return numbers(data, internal::threads_to_use(threads));
  } catch (const std::bad_alloc&) {
    throw Error(Errc::out_of_memory, "not enough memory for numbers of cells");
  }
}

}  // namespace delone
