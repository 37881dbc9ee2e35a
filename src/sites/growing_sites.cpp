// SPDX-License-Identifier: BSD-3-Clause
#include "sites/growing_sites.hpp"

#include "base/large_vector.hpp"
#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "kernel/hull_stages.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace delone::sites {

/// Equal for equal rows, −0 and +0 being so, and for homogeneous rows on one ray: quotients of equal value
/// are rounded to equal doubles.
std::uint64_t GrowingSites::tag_of(const double* row) const {
  std::size_t last = row_size() - 1;
  double unit = 1;
  if (is_homogeneous()) {
    while (last > 0 && row[last] == 0) --last;
    unit = std::fabs(row[last]);
  }
  std::uint64_t tag = last;
  for (std::size_t j = 0; j <= last; ++j)
    tag = random::mix(tag + 0x9e3779b97f4a7c15u + std::bit_cast<std::uint64_t>(row[j] / unit + 0.0));
  return tag;
}

Index GrowingSites::find(const double* row, std::uint64_t tag) const {
  const kernel::Flat flat{ambient, {}, form};
  return table_.find(tag, [&](Index site) { return kernel::equal_rows(flat, point(site), row); });
}

Index GrowingSites::add_site(const double* row, Index number, std::uint64_t tag) {
  const auto site = static_cast<Index>(row_of_site_.size());
  try {
    row_of_site_.push_back(number);
    for (std::size_t j = 0; j < row_size(); ++j) coordinates.push_back(row[j]);
    table_.add(tag, site);
  } catch (...) {
    rollback({num_rows(), site});
    throw;
  }
  return site;
}

Index GrowingSites::add_site(const double* row) {
  const Index site = add_site(row, invalid_index, tag_of(row));
  include_in_grid(site);
  return site;
}

Index GrowingSites::add_row(const double* row) {
  reserve(0, 1);
  const auto first = static_cast<Index>(size());
  const Index site = site_of(row, num_rows(), tag_of(row));
  site_of_row_.push_back(site);
  include_in_grid(first);
  return site;
}

void GrowingSites::add_rows(std::span<const double> rows, const std::vector<Index>* having_site) {
  const Mark before = mark();
  const std::size_t num_added = rows.size() / row_size(), n = having_site ? having_site->size() : num_added;
  const auto row_at = [&](std::size_t i) { return having_site ? (*having_site)[i] : i; };
  const auto point_at = [&](std::size_t i) { return rows.data() + row_at(i) * row_size(); };
  // Tags are known some rows ahead: the table is large, and what is asked of it is not in the cache.
  constexpr std::size_t ahead = 16;
  std::uint64_t tags[ahead];
  const auto foresee = [&](std::size_t i) {
    if (i >= n) return;
    tags[i % ahead] = tag_of(point_at(i));
    table_.prefetch(tags[i % ahead]);
  };
  try {
    reserve(n, num_added);
    site_of_row_.resize(before.rows + num_added, invalid_index);
    for (std::size_t i = 0; i < ahead; ++i) foresee(i);
    for (std::size_t i = 0; i < n; ++i) {
      internal::cancellation_point();
      const std::uint64_t tag = tags[i % ahead];
      foresee(i + ahead);
      const std::size_t row = before.rows + row_at(i);
      site_of_row_[row] = site_of(point_at(i), row, tag);
    }
    include_in_grid(static_cast<Index>(before.sites));
  } catch (...) {
    rollback(before);
    throw;
  }
}

/// Where few are added, vectors grow by more than that.
void GrowingSites::reserve(std::size_t more_sites, std::size_t more_rows) {
  const auto make_room = [](auto& items, std::size_t more) {
    const std::size_t size = items.size();
    if (more > items.capacity() - size) items.reserve(size + std::max(more, more < size / 8 ? size / 2 : 0));
  };
  if (more_sites > 0) table_.reserve(size() + more_sites);
  make_room(coordinates, more_sites * row_size());
  make_room(row_of_site_, more_sites);
  make_room(site_of_row_, more_rows);
}

void GrowingSites::rollback(const Mark& mark) noexcept {
  for (auto site = static_cast<Index>(size()); site-- > mark.sites;)
    table_.remove_last(tag_of(point(site)), site);
  const auto cut = [](auto& items, std::size_t most) {
    if (items.size() > most) items.resize(most);
    internal::shrink_large(items);
  };
  cut(coordinates, mark.sites * row_size());
  cut(row_of_site_, mark.sites);
  cut(site_of_row_, mark.rows);
  if (!duals.empty()) cut(duals, mark.sites * 2 * static_cast<std::size_t>(dimension()));
}

}  // namespace delone::sites
