// SPDX-License-Identifier: BSD-3-Clause
// The pass of one site: volume, first moment and faces of its cell, from where its neighbors are. It knows no
// triangulation, and no coordinates of the site: neighbors may be images of sites in a periodic set.
#pragma once

#include "base/compensated_sum.hpp"
#include "particles/wide_pieces.hpp"

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

  /// The next site has so many neighbors.
  void begin(std::size_t num_neighbors);
  /// Neighbor i is at `to` for the site at `from`: d coordinates, then the weight if there are weights.
  void set_neighbor(std::size_t i, const double* from, const double* to);
  /// `corners`: of each finite cell at the site its k neighbors, increasing. Sums are in this order.
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
  void scale();
  void measure_neighbors();
  void find_pieces();
  void improve();
  double most_error(double sum);
  template <class Sum, class Add, class Value>
  void sum_up(std::vector<Sum>& shares, std::vector<Sum>& moment, Add add, Value value);
  void finish();
  double& piece(std::size_t i, std::size_t cell) { return pieces_[i * stride_ + cell]; }
  double& size_of(std::size_t cell) { return piece(k_ + d_, cell); }
  double& error_of(std::size_t cell) { return piece(k_ + d_ + 1, cell); }
  template <class Find>
  void replace(std::size_t cell, const Find& find);

  std::size_t k_, d_;
  bool weighted_;
  int unit_;
  double coordinate_factor_, weight_factor_;
  std::vector<double> high_, low_, weight_high_, weight_low_;
  std::span<const std::uint32_t> corners_;
  std::size_t num_neighbors_ = 0, num_cells_ = 0, stride_ = 0;
  int exponent_ = 0;
  bool is_moderate_ = true;  // whether rounded numbers will do
  std::vector<double> records_, pieces_, one_;
  std::vector<double> positions_;  // by neighbor: t, where the bisector meets its line
  double volume_ = 0;
  std::vector<double> offset_, areas_, distances_, shares_, moment_;
  std::vector<internal::CompensatedSum> long_shares_, long_moment_;  // of large stars
  std::size_t num_in_pairs_ = 0, num_exact_ = 0;
};

}  // namespace delone::particles
