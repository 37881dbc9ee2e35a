// SPDX-License-Identifier: BSD-3-Clause
// The sites of rows that come in batches: equal rows, or homogeneous rows on one ray, share a site. Ids of
// sites and numbers of rows are given in order, and never change.
#pragma once

#include "sites/boundary_sites.hpp"
#include "sites/site_table.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace delone::sites {

class GrowingSites : public BoundarySites {
 public:
  using BoundarySites::BoundarySites;
  /// A copy that takes less memory. Nothing can be added to it, and find() finds nothing.
  struct Finished {};
  GrowingSites(const GrowingSites& other, Finished)
      : BoundarySites(other), row_of_site_(other.row_of_site_), site_of_row_(other.site_of_row_) {}

  std::size_t num_rows() const { return site_of_row_.size(); }
  /// invalid_index for a row without a site.
  Index site_of_row(std::size_t row) const { return site_of_row_[row]; }
  /// The first row at a site; invalid_index for a site that was not given by a row. Increasing, but for sites
  /// that were given to earlier rows.
  Index row_of_site(Index site) const { return row_of_site_[site]; }
  /// The site of an equal row; invalid_index if there is none.
  Index find(const double* row) const { return find(row, tag_of(row)); }

  // All that follow give the strong guarantee: they throw std::bad_alloc or succeed.

  /// Adds a site that no row gives.
  Index add_site(const double* row);
  /// Adds a row. Returns its site, which is new if it is the last one and there was none.
  Index add_row(const double* row);
  /// Adds rows; if there is a list `having_site`, increasing, only these of them have sites.
  void add_rows(std::span<const double> rows, const std::vector<Index>* having_site = nullptr);
  /// Gives sites to earlier rows that have none. `point_of`: the row of a number.
  template <class PointOf>
  void give_sites(std::span<const Index> rows, PointOf&& point_of) {
    reserve(rows.size(), 0);
    const auto first = static_cast<Index>(size());
    for (const Index row : rows) {
      const Index site = site_of(point_of(row), row, tag_of(point_of(row)));
      site_of_row_[row] = site;
      row_of_site_[site] = std::min(row_of_site_[site], row);
    }
    include_in_grid(first);
  }

  /// How many rows and sites there are. What is added later can be taken back.
  struct Mark {
    std::size_t rows, sites;
  };
  Mark mark() const { return {num_rows(), size()}; }
  /// Takes back the rows and sites from a mark on. The grid stays as fine as it has become. REQUIRES that no
  /// earlier row was given a site.
  void rollback(const Mark& mark) noexcept;

 private:
  std::size_t row_size() const { return static_cast<std::size_t>(ambient); }
  std::uint64_t tag_of(const double* row) const;
  Index find(const double* row, std::uint64_t tag) const;
  Index site_of(const double* point, std::size_t row, std::uint64_t tag) {
    const Index found = find(point, tag);
    return found != invalid_index ? found : add_site(point, static_cast<Index>(row), tag);
  }
  /// The grid does not know it yet: include_in_grid() follows.
  Index add_site(const double* point, Index row, std::uint64_t tag);
  /// The sites from `first` on.
  void include_in_grid(Index first) {
    if (!is_homogeneous())
      grid.include_all(size() - first, [&](std::size_t i) { return point(first + static_cast<Index>(i)); });
  }
  void reserve(std::size_t more_sites, std::size_t more_rows);

  std::vector<Index> row_of_site_, site_of_row_;
  SiteTable table_;
};

}  // namespace delone::sites
