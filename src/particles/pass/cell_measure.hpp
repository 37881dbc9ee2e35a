// SPDX-License-Identifier: BSD-3-Clause
// The pass of one site: volume, first moment and faces of its cell, from where its neighbors are. It knows no
// triangulation, and no coordinates of the site: neighbors may be images of sites in a periodic set.
#pragma once

#include "particles/pass/wide_pieces.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::particles {

class CellMeasure {
 public:
  /// Cells of k dimensions in R^d. Coordinates are multiplied by 2^−unit before anything else, so that their
  /// differences are in range; weights by 2^(−2·unit).
  CellMeasure(std::size_t k, std::size_t d, bool weighted, int unit = 0);

  /// Begins the next site, which is at `from`: d coordinates, then the weight if there are weights. It has
  /// this number of neighbors. What pointers point to must not change until measure() is done.
  void begin(const double* from, std::size_t num_neighbors) {
    from_ = from;
    to_.resize(num_neighbors);
  }
  /// Neighbor i is at `to`.
  void set_neighbor(std::size_t i, const double* to) { to_[i] = to; }
  /// `corners`: of each finite cell at the site its k neighbors, increasing. No result depends on the order
  /// of the cells.
  void measure(std::span<const std::uint32_t> corners);

  /// Off by at most 10⁻¹² of the sum of the absolute values of the pieces; see site_cells().
  double volume() const { return volume_; }
  /// The centroid less the site; 0 where the volume is 0.
  std::span<const double> offset() const { return offset_; }
  /// By neighbor: the (k−1)-volume of the face, and the distance of the neighbor.
  std::span<const double> areas() const { return areas_; }
  std::span<const double> distances() const { return distances_; }
  /// How many cells were measured in pairs of doubles so far, and how many in integers.
  std::size_t num_in_pairs() const { return num_in_pairs_; }
  std::size_t num_exact() const { return num_exact_; }

 private:
  template <int D>
  void measure_neighbors();
  void find_exact_differences();
  void keep_coordinates();
  void find_pieces();
  void improve();
  double total_of_scratch() const;
  double most_error(double sum);
  void sum_pieces();
  void sum_up();
  void unscale();
  double& piece(std::size_t i, std::size_t cell) { return pieces_[i * stride_ + cell]; }
  std::span<double> column(std::size_t i) { return {pieces_.data() + i * stride_, num_cells_}; }
  double& size_of(std::size_t cell) { return piece(k_ + d_, cell); }
  double& error_of(std::size_t cell) { return piece(k_ + d_ + 1, cell); }
  template <class Find>
  void replace(std::size_t cell, const Find& find);

  std::size_t k_, d_;
  bool weighted_;
  int unit_;
  double coordinate_factor_, weight_factor_;
  const double* from_ = nullptr;
  std::vector<const double*> to_;
  std::span<const std::uint32_t> corners_;
  std::size_t num_cells_ = 0, stride_ = 0;
  int exponent_ = 0;
  bool is_moderate_ = true;  // whether rounded numbers will do
  std::vector<double> records_, pieces_, one_;
  std::vector<double> positions_;  // by neighbor: t, where the bisector meets its line
  double volume_ = 0;
  std::vector<double> offset_, areas_, distances_, shares_, parts_, first_parts_;
  // For single cells.
  std::vector<double> high_, low_, weight_high_, weight_low_, scratch_;
  std::size_t num_in_pairs_ = 0, num_exact_ = 0;
};

}  // namespace delone::particles
