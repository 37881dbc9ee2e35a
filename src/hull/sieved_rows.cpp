// SPDX-License-Identifier: BSD-3-Clause
#include "hull/sieved_rows.hpp"

#include "complex/canonical_hash.hpp"
#include "kernel/stages.hpp"
#include "sites/site_table.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace delone::hull {

SievedRows::SievedRows(const SievedRows& other)
    : coordinates_(other.coordinates_), dimension_(other.dimension_), rows_(other.rows_) {
  const std::lock_guard lock(other.mutex_);
  first_rows_ = other.first_rows_;
}

SievedRows& SievedRows::operator=(SievedRows&& other) noexcept {
  coordinates_ = std::move(other.coordinates_);
  dimension_ = other.dimension_;
  rows_ = std::move(other.rows_);
  other.rows_.clear();
  first_rows_ = std::exchange(other.first_rows_, std::nullopt);
  return *this;
}

const std::vector<Index>& SievedRows::first_rows() const {
  const std::lock_guard lock(mutex_);
  if (first_rows_) return *first_rows_;
  sites::SiteTable table;
  table.reserve(rows_.size());
  std::vector<Index> first(rows_.size());
  // Tags are known some rows ahead: the table is large, and what is asked of it is not in the cache.
  constexpr std::size_t ahead = 16;
  std::uint64_t tags[ahead] = {};
  const auto foresee = [&](std::size_t i) {
    if (i >= rows_.size()) return;
    tags[i % ahead] = complex::point_tag(point(rows_[i]), dimension_).low;
    table.prefetch(tags[i % ahead]);
  };
  for (std::size_t i = 0; i < ahead; ++i) foresee(i);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::uint64_t tag = tags[i % ahead];
    foresee(i + ahead);
    const Index found = table.find(
        tag, [&](Index row) { return kernel::equal_points(point(row), point(rows_[i]), dimension_); });
    first[i] = found != invalid_index ? found : rows_[i];
    if (found == invalid_index) table.add(tag, rows_[i]);
  }
  first_rows_ = std::move(first);
  return *first_rows_;
}

std::size_t SievedRows::num_duplicates() const {
  const std::vector<Index>& first = first_rows();
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) count += first[i] != rows_[i] ? 1 : 0;
  return count;
}

}  // namespace delone::hull
