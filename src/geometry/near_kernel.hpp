// SPDX-License-Identifier: BSD-3-Clause
// Certificates from the edges between points, one cell per SIMD lane. The certificates of the pencil hold in
// the whole box and depend on the sphere of a cell only; for flat cells, as among points of a surface, they
// are too weak near the cell, where nearly all queries are. Compiled for several instruction sets; the best
// one of the machine is chosen at run time.
#pragma once

#include "cells/cell_memory.hpp"
#include "geometry/vertex_rows.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <span>

namespace delone::geometry {

/// The number of cells per call.
inline constexpr std::size_t near_lanes = 8;

/// Cells, and the point at which edges start.
struct NearTask {
  int k;
  std::span<const Index> cells;  ///< at least one, at most near_lanes
  const double* functionals;     ///< of all cells, as in CellRecords
  const double* certificates;
  const Index* links;    ///< of all cells, as in CellLayout
  cells::VertexIds ids;  ///< as in CellLayout
  VertexRows rows;       ///< images and lifts, of all vertices; computed for can_compute_rows(k) only
  const double* row;     ///< of the point
  // Constants of the frame.
  double evaluation_error;  ///< of a rounded evaluation, relative to the sum of the magnitudes of a
                            ///< functional's terms
  double largest_lift;      ///< of a point of the box
  double edge_error;        ///< of edges between rows, and of their heights over planes
  double bend;  ///< a bound on how far lifts deviate in the box from a plane that touches them; 0: not known
  const double* lift_weight;  ///< per axis, of the square of an image in the lift
};

/// The dimensions in which thresholds for a point can be found.
constexpr bool can_find_thresholds(int k) { return k >= 1 && k <= 16; }

/// Writes a threshold of each cell for this point alone: the cached one, or a smaller one. Cost O(k²) per
/// cell. REQUIRES can_find_thresholds(k).
void find_thresholds(const NearTask& task, double* thresholds);

/// What is proved of a functional.
struct EdgeCertificate {
  double threshold;  ///< a value beyond it has the sign of h, for all points of the box; one within it is off
                     ///< by no more
  double error;      ///< |h̃| is below it at the vertices
  double determinant;  ///< a lower bound on the magnitude of that of the edge vectors; 0: none is known
  bool is_final;       ///< elimination could hardly prove more; else it must be tried
};

/// The dimensions in which functionals can be certified by edges.
constexpr bool can_certify_by_edges(int k) { return k >= 2 && k <= 6; }

/// Certifies functionals by their values at the vertices and the determinants of the edges. Cells that are
/// too flat for a proof get an infinite threshold. Cost O(k·2^k) per cell. REQUIRES that the point is that of
/// `apex`, a vertex of all cells, can_certify_by_edges(k), and that the cached determinants are lower bounds.
void certify_by_edges(const NearTask& task, Index apex, EdgeCertificate* certificates);

}  // namespace delone::geometry
