// SPDX-License-Identifier: BSD-3-Clause
// The lattice of a periodic set: a short basis a_1 … a_r of r ≤ d vectors of R^d on a grid, and the fractions
// of points, f_i(x) with f_i(a_j) = 1 for i = j and 0 otherwise, which are 0 on what is orthogonal to all.
//
// Images. Let ρ be the covering radius of the lattice in its span, 2ρ ≤ √Σ|a_i|². Let p be a vertex of a cell
// with center c. If any point of the periodic set is in conflict with the cell, then one is in conflict whose
// fractions differ from those of p by 2ρ|g_i| at most, g_i the gradient of f_i: (1) If some translate of p is
// nearer to c than p, so is one by a Voronoi vector of the lattice, which is not longer than 2ρ, and it is in
// conflict as it has the weight of p. (2) Otherwise p is within ρ of c along the lattice, and so is the point
// of least power to c, which has the least power of its own translates. So with fractions of own points in
// [0, 1) it is enough to look at their translates by Σ k_i a_i with |k_i| ≤ ⌈2ρ|g_i|⌉: the reach.
#pragma once

#include "kernel/fractions.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::periodic {

class Period {
 public:
  Period() = default;
  /// Of linearly independent vectors, row by row.
  Period(std::vector<double> vectors, std::size_t rank, std::size_t dimension);

  std::size_t rank() const { return rank_; }
  std::size_t dimension() const { return dimension_; }
  const double* vector(std::size_t i) const { return vectors_.data() + i * dimension_; }
  /// g_i, rounded correctly.
  const double* gradient(std::size_t i) const { return gradients_.data() + i * dimension_; }
  double gradient_length(std::size_t i) const { return lengths_[i]; }
  int reach(std::size_t i) const { return reaches_[i]; }
  /// The length of the shortest vector of the basis.
  double shortest() const { return shortest_; }

  /// f_i, rounded: off by at most fraction_slack(i, x).
  double fraction(std::size_t i, const double* x) const {
    double sum = 0;
    for (std::size_t j = 0; j < dimension_; ++j) sum += gradient(i)[j] * x[j];
    return sum;
  }
  double fraction_slack(std::size_t i, const double* x) const {
    double sum = 0;
    for (std::size_t j = 0; j < dimension_; ++j) sum += std::abs(gradient(i)[j] * x[j]);
    return static_cast<double>(dimension_ + 4) * 0x1p-52 * sum;
  }
  /// The largest integer that is not above f_i(x). Exact.
  kernel::Integer floor_of_fraction(std::size_t i, const double* x) const;

  /// Moves x into the box, where all fractions are in [0, 1), and adds to `wraps` how many of each vector it
  /// has subtracted. Exact for a vector on the grid of 2^grid, but for rounding coordinates to 53 bits.
  /// Returns false if it is more than 2^29 periods away, or where rounding does not tell.
  bool wrap(int grid, double* x, std::int32_t* wraps) const;

  /// Adds Σ k_i a_i. Exact if all sums are: points on the grid with fractions that the reach bounds.
  void translate(std::span<const std::int32_t> k, double* x) const {
    for (std::size_t i = 0; i < rank_; ++i) {
      if (k[i] == 0) continue;
      for (std::size_t j = 0; j < dimension_; ++j) x[j] += k[i] * vector(i)[j];
    }
  }

 private:
  /// Whether all fractions are certain to be in (0, 1).
  bool is_inside(const double* x) const;
  void subtract(std::span<const std::int32_t> step, bool is_near, int grid, double* x) const;

  std::size_t rank_ = 0, dimension_ = 0;
  std::vector<double> vectors_, gradients_, lengths_;
  std::vector<int> reaches_;
  double shortest_ = 0;
  int grid_ = 0;
  std::vector<kernel::Integer> integers_, gram_;  // of the vectors, in units of 2^grid
  kernel::Integer determinant_ = 1;               // of the Gram matrix
};

}  // namespace delone::periodic
