// SPDX-License-Identifier: BSD-3-Clause
// The pieces of the cell of a site, for each cell of the triangulation at the site: in binary64, one cell per
// SIMD lane, for the best instruction set of the processor. Results have the same bits for each of them.
//
// Let the site be the origin, e_1 … e_k the other vertices of a cell of the triangulation, and
//     α_i = (|e_i|² + w_0 − w_i)/2,    x·e_i = α_i,
// so x is the center of the cell, and the bisector with e_i meets the line of e_i at t_i·e_i, t_i =
// α_i/|e_i|². For a set F of vertices, c_F is the center of the face of the site and F: the point of span(F)
// nearest to x. A *piece* is the simplex of 0, c_{i}, c_{ij}, …, x for one order of the vertices. With r_w
// the part of e_w that is orthogonal to F, and α^F_w = r_w·x, the step from c_F to the center of F ∪ {w} is
// r_w·α^F_w/|r_w|². All these steps are orthogonal, and Π |r_w| is the same for all orders, the volume D of
// the box of the e_i. So the signed volume of a piece is Π α^F_w/(k!·D).
//
// Of each cell these are computed:
//     W_i, |e_i| times the (k−1)-volume of the part of the face with neighbor i;
//     the first moment of all pieces, less Σ_i W_i·t_i²·e_i/(k(k+1)), the share of the centers of edges in it;
//     the sum of the absolute volumes of pieces, Σ|piece|;
//     a bound on what Σ_i W_i·t_i/k, their volume, is off by, in whatever way the computed pieces were rounded.
#pragma once

#include <cstddef>
#include <cstdint>

namespace delone::particles {

/// Lanes are for so many dimensions of cells and of the space; see has_lanes().
inline constexpr std::size_t most_lanes_dimension = 6;
inline bool has_lanes(std::size_t k, std::size_t d) { return k == d && k >= 2 && k <= most_lanes_dimension; }

/// The numbers that a neighbor is given by: d coordinates, then these.
inline constexpr std::size_t square = 0;  ///< |e|²
inline constexpr std::size_t alpha = 1;   ///< α
inline constexpr std::size_t magnitude = 2;  ///< s² = (|e|² + |w_0 − w|)²/|e|², so |e| ≤ s and 2|α| ≤ s·|e|
inline constexpr std::size_t num_neighbor_numbers = 3;
constexpr std::size_t record_size(std::size_t d) { return d + num_neighbor_numbers; }

/// What is computed of a cell: k numbers W, d of the moment, and these.
constexpr std::size_t piece_size(std::size_t k, std::size_t d) { return k + d + 2; }

/// Of `count` cells. `records`: of the neighbors; `corners`: k neighbors for each cell. `pieces`: number i of
/// cell c goes to i·stride + c; the stride is a multiple of 8 and at least `count`. Without weights α is
/// |e|²/2, and s² is |e|². REQUIRES has_lanes(d, d), the largest coordinate in [1/2, 1), |e|² ≥ 2⁻²⁰⁰, and s²
/// ≤ 2²⁰⁰.
void find_pieces_in_lanes(std::size_t d, bool weighted, std::size_t count, const double* records,
                          const std::uint32_t* corners, std::size_t stride, double* pieces);

/// The sums of absolute volumes and of bounds over `count` cells. They do not depend on the order of the
/// cells, as terms are rounded to a grid first, which changes sums by less than 2^−40 of themselves for a few
/// hundred cells.
struct PieceTotals {
  double size, error;
};
PieceTotals find_totals(std::size_t count, const double* sizes, const double* errors);

/// Sums by exact_sums.hpp, with two levels. Each W becomes what the second one takes of it; what the first
/// one takes goes to `first_parts`, k columns like those of pieces. `moment`: d sums. REQUIRES count ≤ 4096.
void split_pieces(std::size_t k, std::size_t d, std::size_t count, std::size_t stride, double* pieces,
                  double* first_parts, double* moment);
inline constexpr std::size_t most_split_cells = 4096;

}  // namespace delone::particles
