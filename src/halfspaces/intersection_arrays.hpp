// SPDX-License-Identifier: BSD-3-Clause
// The state of an intersection of halfspaces, and the arrays that describe it.
#pragma once

#include "halfspaces/halfspace_dual.hpp"
#include "hull/boundary.hpp"
#include "hull/site_table.hpp"

#include <delone/halfspaces.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace delone::internal {

/// The rows as sites, an interior point, and the cone of the sites. Rows on one ray share a site; site 0 is
/// the row at infinity.
struct IntersectionParts {
  explicit IntersectionParts(std::size_t d);
  IntersectionParts(const IntersectionParts& other);
  IntersectionParts& operator=(const IntersectionParts&) = delete;

  int rank() const { return sites.axes.empty() ? 0 : sites.dimension(); }
  /// Makes room for so many more rows.
  void reserve(std::size_t more);
  void add_dual(Index site);
  /// The site of a row's ray, which is new if it is the last one: of row r. REQUIRES a normal.
  Index site_of_ray(const double* row, SignedIndex r);
  /// Takes back the sites and rows from these on, some of which may have been added in part only.
  void drop_sites(Index first_site, std::size_t first_row) noexcept;

  SiteSet sites;
  SiteTable site_at;
  std::vector<SignedIndex> row_of_site{-1};  // the first row of each site; −1 for the row at infinity
  std::vector<Index> site_of_row;            // invalid_index for rows without a normal
  std::vector<Index> basis;                  // k+1 independent sites, increasing; the first is site 0
  InteriorPoint interior;
  IntersectionState state = IntersectionState::full;
  std::vector<SignedIndex> witness;
  std::optional<Boundary> cone;  // empty while the rank is 0
};

/// Whether n·p + c < 0. Exact.
bool is_strictly_inside(const double* row, const InteriorPoint& p);

/// All of IntersectionData except the halfspaces.
IntersectionData intersection_arrays(const IntersectionParts& parts);

/// The volume of the hull of the rounded dual points, or the area of its boundary; NaN for k < d.
double dual_measure(const IntersectionParts& parts, bool volume);

}  // namespace delone::internal
