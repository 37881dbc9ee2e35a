// SPDX-License-Identifier: BSD-3-Clause
// The canonical hash of a periodic triangulation, the same for all points and bases that stand for the set.
//
// All numbers are integers in units of the finest bit of lattice and vertices. The lattice enters by its
// Hermite normal form, which is unique, a vertex by its translate that is reduced by that form, and a cell by
// its smallest vertex and the differences of the others from it.
#pragma once

#include "complex/canonical_hash.hpp"
#include "periodic/ghost_triangulation.hpp"

#include <delone/complex.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace delone::periodic {

/// What the hash is a sum of.
class PeriodicTags {
 public:
  /// `grid`: units are 2^grid, the finest bit of lattice and vertices, or no_grid if all of them are zero.
  /// REQUIRES that the set, which needs no rows, outlives the object.
  PeriodicTags(const PeriodicSet& set, int grid);
  PeriodicTags(const PeriodicTags&) = delete;
  PeriodicTags& operator=(const PeriodicTags&) = delete;
  ~PeriodicTags();

  /// Counts as one more vertex.
  complex::PointTag of_lattice() const;
  /// Of any translate. `with_weight`: the number d of the point counts, too.
  complex::PointTag of_vertex(const double* point, bool with_weight);
  /// A cell is the sum of the tag of its smallest vertex, and of the differences of all vertices from it, d
  /// numbers of units each.
  complex::PointTag of_difference(std::span<const std::uint64_t> units) const;
  /// A coordinate in units, modulo 2^64. Coordinates in use are below 2^53 units of the grid of the set, and
  /// that of the hash is no finer.
  std::uint64_t units(double x) const {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::ldexp(x, -grid_)));
  }

 private:
  class HermiteForm;

  const PeriodicSet& set_;
  const int grid_;
  std::unique_ptr<const HermiteForm> form_;
  std::vector<kernel::Integer> x_;
};

inline constexpr int no_grid = std::numeric_limits<int>::max();
/// The finest bit of a lattice, or of some numbers.
int finest_bit(const Period& period);
int finest_bit(const double* x, std::size_t d);

CanonicalHash hash_of(const GhostTriangulation& ghosts, const PeriodicSet& set);

}  // namespace delone::periodic
