// SPDX-License-Identifier: BSD-3-Clause
// The state of an intersection of halfspaces, and the arrays that describe it.
#pragma once

#include "halfspaces/halfspace_dual.hpp"
#include "hull/boundary.hpp"
#include "sites/growing_sites.hpp"

#include <delone/halfspaces.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace delone::halfspaces {

/// The rows as sites, an interior point, and the cone of the sites. Rows on one ray share a site; site 0 is
/// the row at infinity.
struct IntersectionParts {
  explicit IntersectionParts(std::size_t d);
  IntersectionParts(const IntersectionParts& other);
  IntersectionParts& operator=(const IntersectionParts&) = delete;

  int rank() const { return sites.axes.empty() ? 0 : sites.dimension(); }
  /// Adds rows; those in the list have a normal. If it throws, they may have been added in part.
  void add_rows(std::span<const double> rows, const std::vector<Index>& having_normal);
  /// Gives sites to the redundant rows, so that later rows can be compared with all earlier ones. All or
  /// none.
  void give_redundant_rows_sites(std::span<const double> rows);
  /// Computes the dual points of the sites from `first` on, if the axes are known.
  void add_duals(Index first);
  /// The first row of a site; −1 for the row at infinity.
  SignedIndex row_of_site(Index site) const { return static_cast<SignedIndex>(sites.row_of_site(site)); }

  sites::GrowingSites sites;     // rows without a normal have none
  std::vector<Index> redundant;  // rows that are so by a margin, and have no sites yet; increasing
  std::vector<Index> basis;      // k+1 independent sites, increasing; the first is site 0
  InteriorPoint interior;
  IntersectionState state = IntersectionState::full;
  std::vector<SignedIndex> witness;
  std::optional<hull::Boundary> cone;  // empty while the rank is 0
};

/// Whether n·p + c < 0. Exact.
bool is_strictly_inside(const double* row, const InteriorPoint& p);

/// All of IntersectionData except the halfspaces. REQUIRES that all rows with normals have sites.
IntersectionData intersection_arrays(const IntersectionParts& parts);
/// Some of that.
IntersectionVertices intersection_vertices(const IntersectionParts& parts);

/// The volume of a bounded intersection of full dimension, from its faces; 0 if it has no interior.
double volume_of_faces(const IntersectionParts& parts);

/// The volume of the hull of the rounded dual points, or the area of its boundary; NaN for k < d.
Measure dual_measure(const IntersectionParts& parts, bool volume);

}  // namespace delone::halfspaces
