// SPDX-License-Identifier: BSD-3-Clause
// The pencil for all cells of a new star at once, one facet per SIMD lane. Compiled for several instruction
// sets; the best one of the machine is chosen at run time.
#pragma once

#include "cells/cell_memory.hpp"
#include "cells/horizon_facet.hpp"
#include "geometry/vertex_rows.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <span>

namespace delone::geometry {

/// The constants of a frame that certificates depend on (docs/predicates.md, "The pencil").
struct FrameConstants {
  double evaluation_error;   ///< of a rounded evaluation, relative to the sum of the magnitudes of a
                             ///< functional's terms
  double largest_reference;  ///< the largest reference entry of a row
  double finite_spread;  ///< Σ|barycentric coordinates| − 1 is at most finite_spread·R^(k−1)/det in the box
  double infinite_spread;  ///< the same for infinite cells, over det
  double largest_radius;   ///< of a ball that contains the box
  bool uses_radius;        ///< false: finite_spread/det is the bound, whatever the radius
  double bend;  ///< a bound on how far lifts deviate in the box from a plane that touches them; 0: not known
  double per_bend;  ///< 1/bend, or 0 if that is not known
  double flatness;  ///< for radii L beyond the box, finite_spread's bound times flatness·(bend + |value|)/L
                    ///< is one
  const double* extent_ratio;  ///< per axis, the frame's scale over that of lifts
};

/// The functionals of a star's cells from those of the cells on the two sides of each facet.
struct StarTask {
  std::span<const cells::HorizonFacet> facets;
  int k;
  bool lifted;           ///< whether rows are (X, 1 | ℓ), else (X | 1)
  cells::VertexIds ids;  ///< as in CellLayout
  double* functionals;   ///< of all cells, as in CellRecords
  double* certificates;
  VertexRows rows;          ///< (X, ℓ), or X; computed for can_compute_rows(k) only
  const double* query_row;  ///< that of the new vertex
  FrameConstants frame;
  double* scratch;      ///< star_scratch(k) doubles
  std::uint32_t* weak;  ///< receives the facets whose certificate is too weak: their cells need elimination
};

/// How many doubles of scratch memory a star of dimension k takes.
std::size_t star_scratch(int k);

/// Computes the functionals and certificates of all created cells, and returns how many entries of `weak` it
/// has written. Cost O(k) per facet.
std::size_t combine_star(const StarTask& task);

}  // namespace delone::geometry
