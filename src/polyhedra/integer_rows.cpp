// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/integer_rows.hpp"

#include "base/progress_meter.hpp"
#include "polyhedra/common_divisor.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delone::polyhedra {

namespace mp = boost::multiprecision;

namespace {

/// row := row·|factor| − other·…, so that the entry at the pivot of `other` becomes 0. The pivot of `other`
/// is positive, so `row` is multiplied by a positive number.
void eliminate(Row& row, const Row& other, std::size_t pivot) {
  if (row[pivot] == 0) return;
  const Integer common = common_divisor(row[pivot], other[pivot]);
  const Integer scale = other[pivot] / common, factor = row[pivot] / common;
  for (std::size_t c = 0; c < row.size(); ++c) {
    if (scale != 1) row[c] *= scale;
    if (other[c] != 0) row[c] -= factor * other[c];
  }
}

}  // namespace

bool is_zero(const Row& row) {
  return std::all_of(row.begin(), row.end(), [](const Integer& x) { return x == 0; });
}

Integer scalar_product(const Row& a, const Row& b) {
  Integer sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != 0 && b[i] != 0) sum += a[i] * b[i];
  return sum;
}

void make_primitive(Row& row) {
  Integer common = 0;
  for (const Integer& x : row) {
    if (x == 0) continue;
    common = common_divisor(common, x);
    if (common == 1) return;
  }
  if (common == 0) return;
  for (Integer& x : row)
    if (x != 0) x /= common;
}

Echelon::Echelon(std::size_t width, const Rows& rows) : width_(width) {
  for (const Row& row : rows) add(row);
}

void Echelon::reduce(Row& row) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) eliminate(row, rows_[i], pivots_[i]);
  make_primitive(row);
}

bool Echelon::add(Row row) {
  internal::cancellation_point();
  reduce(row);
  std::size_t pivot = 0;
  while (pivot < width_ && row[pivot] == 0) ++pivot;
  if (pivot == width_) return false;
  if (row[pivot] < 0)
    for (Integer& x : row) x = -x;
  for (Row& other : rows_)
    if (other[pivot] != 0) {
      eliminate(other, row, pivot);
      make_primitive(other);
    }
  rows_.push_back(std::move(row));
  pivots_.push_back(pivot);
  return true;
}

Rows Echelon::sorted_rows() const {
  std::vector<std::size_t> order(rank());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return pivots_[a] < pivots_[b]; });
  Rows sorted;
  for (const std::size_t i : order) sorted.push_back(rows_[i]);
  return sorted;
}

Rows Echelon::kernel() const {
  std::vector<char> is_pivot(width_, 0);
  for (const std::size_t pivot : pivots_) is_pivot[pivot] = 1;
  Rows kernel;
  for (std::size_t free = 0; free < width_; ++free) {
    if (is_pivot[free]) continue;
    Integer scale = 1;
    for (std::size_t i = 0; i < rank(); ++i)
      if (rows_[i][free] != 0) scale = mp::lcm(scale, rows_[i][pivots_[i]]);
    Row vector(width_, Integer(0));
    vector[free] = scale;
    for (std::size_t i = 0; i < rank(); ++i)
      if (rows_[i][free] != 0) vector[pivots_[i]] = -rows_[i][free] * (scale / rows_[i][pivots_[i]]);
    make_primitive(vector);
    kernel.push_back(std::move(vector));
  }
  return kernel;
}

}  // namespace delone::polyhedra
