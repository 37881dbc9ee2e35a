// SPDX-License-Identifier: BSD-3-Clause
// What insertions into a ConvexHullBase change: rows to distinct sites, the affine hull, the boundary.
#pragma once

#include "base/progress_meter.hpp"
#include "compiled/simplicial_hull.hpp"
#include "hull/boundary.hpp"
#include "hull/sieved_rows.hpp"
#include "kernel/predicates.hpp"
#include "sites/growing_sites.hpp"

#include <delone/convex_hull.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace delone::hull {

class HullState {
 public:
  explicit HullState(int dimension) : sites_(dimension), affine_hull_(dimension) {}
  HullState(const HullState& other);
  /// The rows of another state, but the boundary of the hull of some of its sites only, after projection on
  /// axes, in which these sites are extreme. REQUIRES at least one site.
  HullState(const HullState& all, std::span<const Index> vertices, std::vector<int> axes,
            const Options& options);
  HullState& operator=(const HullState&) = delete;

  /// Inserts rows, all or none: if it throws, or `approve`, called in the end, does, all is as it was.
  /// REQUIRES finite coordinates, and room for as many ids.
  void insert_range(std::span<const double> coordinates, const Options& options,
                    const std::function<void()>& approve = {});
  /// Inserts a row that is in the affine hull; the strong guarantee.
  HullInsertResult insert_in_flat(const double* point);
  /// Adds a row without inserting its point: the boundary stays that of the hull of the others, and nothing
  /// can be inserted any more. Returns the site; an earlier one, and there is no new row, if it is at the
  /// point. Strong guarantee.
  Index add_without_inserting(const double* point);
  /// A point that is a duplicate, or in the affine hull, does not raise the dimension.
  bool raises_dimension(const double* point) const;

  const BoundarySites& sites() const { return sites_; }
  /// The site of an equal row; invalid_index if there is none.
  Index find(const double* row) const { return sites_.find(row); }
  const kernel::AffineHull& affine_hull() const { return affine_hull_; }
  /// Sites that span the flat.
  const std::vector<Index>& basis() const { return basis_; }
  std::size_t num_rows() const { return sites_.num_rows(); }
  /// Rows that are equal to earlier ones.
  std::size_t num_duplicates() const;
  /// invalid_index for a row that is interior for certain and has no site; see sieved_rows().
  Index site_of_row(std::size_t row) const { return sites_.site_of_row(row); }
  const double* point_of_row(std::size_t row) const {
    return site_of_row(row) != invalid_index ? sites_.point(site_of_row(row)) : sieved_.point(row);
  }
  /// The first row at a site; increasing, but for sites that are surely interior.
  SignedIndex row(Index site) const { return static_cast<SignedIndex>(sites_.row_of_site(site)); }
  const SievedRows& sieved_rows() const { return sieved_; }
  /// Whether a site was found in the interior when it was inserted. Others may be in the interior, too.
  bool is_surely_interior(Index site) const { return boundary_ && boundary_->is_surely_interior(site); }

  /// None while the affine dimension is below 1.
  const Boundary* boundary() const { return boundary_.get(); }
  const SimplicialHull& hull() const;
  Statistics statistics() const;

 private:
  class Rollback;

  std::size_t ambient() const { return static_cast<std::size_t>(sites_.ambient); }
  bool raise(Index site);
  void make_boundary();
  void restart(Rollback& rollback);
  void note_effort(Statistics& sum) const;
  struct Shell;
  Shell sieve(std::span<const double> coordinates, unsigned threads);
  void give_sieved_rows_sites();
  bool sweep_walls(std::span<const Index> sites, const std::function<void(std::size_t)>& tick);
  void insert_in_threads(std::span<const Index> sites, std::span<const std::size_t> rounds,
                         const Options& options, std::span<const Index> first,
                         const std::function<void(std::size_t)>& progress);
  std::vector<std::size_t> put_in_order(std::vector<Index>& sites, const Options& options) const;

  sites::GrowingSites sites_;
  kernel::AffineHull affine_hull_;
  std::vector<Index> basis_;
  SievedRows sieved_;
  std::unique_ptr<Boundary> boundary_;
  Statistics earlier_;  // of builders that were given up, and the times
};

}  // namespace delone::hull
