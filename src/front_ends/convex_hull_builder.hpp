// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a convex hull by incremental insertion: a cell in conflict with the new site is found in the fan of the
// boundary, all of them by search over neighbors, and the cone over their horizon takes their place. Signs come from certified
// normals, and where these cannot tell from the exact predicates.
#pragma once

#include "front_ends/hull_fan.hpp"
#include "front_ends/hull_normal.hpp"
#include "front_ends/simplicial_hull.hpp"
#include "stage_counts.hpp"

#include <cstdint>
#include <vector>

namespace delone::front_ends {

class ConvexHullBuilder {
 public:
  /// The boundary of the simplex of k+1 affinely independent sites, k ≥ 1. `sites` must outlive this object and may grow.
  ConvexHullBuilder(const HullSites& sites, std::vector<Index> simplex);

  /// Inserts a site, distinct from all earlier ones. False if it is in conflict with no cell: it is hidden. If it throws, the
  /// boundary is as it was.
  bool insert(Index site);

  const SimplicialHull& hull() const { return hull_; }
  std::uint64_t created_cells() const { return created_cells_; }
  std::uint64_t insertions() const { return insertions_; }
  const StageCounts& stages() const { return stages_; }
  std::size_t bytes() const {
    return (hull_.cells.capacity() + hull_.neighbors.capacity()) * sizeof(Index) + normals_.capacity() * sizeof(double) +
           fan_.bytes() + marks_.capacity();
  }
  /// A copy that reads the sites from another place.
  ConvexHullBuilder moved_to(const HullSites& sites) const;

 private:
  ConvexHullBuilder(const HullSites& sites, const ConvexHullBuilder& other);

  enum class Mark : char { unseen, in_conflict, not_in_conflict };
  struct HorizonRidge {
    std::size_t cell, slot;
  };
  /// The cells over the horizon, numbered from 0, before they get their places.
  struct Cone {
    std::vector<Index> cells, neighbors, places;
  };

  bool insert_end(Index site);
  std::size_t find_conflict(const double* q);
  void find_zone(std::size_t first, const double* q);
  void forget_marks();
  Cone make_cone(Index site) const;
  void replace_zone(const Cone& cone);
  void close_gaps(std::size_t born);

  bool in_conflict(std::size_t c, const double* q);
  void gather(std::size_t c);
  const double* inner_site(std::size_t c);
  void orient(std::size_t c);
  void update_normal(std::size_t c);
  void resize(std::size_t cells);

  const HullSites* sites_;
  std::vector<Index> simplex_;  // the sites it began with
  SimplicialHull hull_;
  HullNormals certified_;
  std::vector<double> normals_;  // m×(k+1): see HullNormals
  HullFan fan_;
  std::size_t last_ = 0;  // a cell of the last insertion

  // Of the present insertion.
  std::vector<Mark> marks_;             // by cell
  std::vector<std::size_t> dead_;       // in conflict
  std::vector<std::size_t> survivors_;  // not in conflict, and marked so
  std::vector<HorizonRidge> horizon_;
  std::vector<const double*> scratch_;

  std::uint64_t created_cells_ = 0, insertions_ = 0;
  StageCounts stages_;
};

}  // namespace delone::front_ends
