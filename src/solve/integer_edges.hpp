// SPDX-License-Identifier: BSD-3-Clause
// The points of a simplex as integers: what decides where a certified path is not enough.
#pragma once

#include "kernel/fractions.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace delone::solve {

/// Points p_0 … p_m of R^d, by differences from p_0 in units of 2^grid, and their weights w_i, by differences
/// in units of 2^(2·grid).
class IntegerEdges {
 public:
  int grid;
  std::vector<kernel::Integer> edges;   ///< m×d, p_i − p_0
  std::vector<kernel::Integer> rights;  ///< m, |p_i − p_0|² − (w_i − w_0)

  /// `weights`: as many as points, or none for zero weights.
  IntegerEdges(std::span<const double* const> points, std::span<const double> weights, std::size_t dimension);

  /// The product of edges a and b.
  kernel::Integer dot(std::size_t a, std::size_t b) const;

  /// That of all, row by row.
  std::vector<kernel::Integer> gram() const;

  /// The y with G·y = right, for the Gram matrix G of the first k edges; see kernel::solve_exactly().
  kernel::Fractions solve_gram(std::span<const kernel::Integer> right) const;

  /// 2(c − p_0) in units of 2^grid, in all d coordinates, for the center c of the sphere of p_0 … p_k in
  /// their flat.
  kernel::Fractions twice_center(std::size_t k) const;

 private:
  std::size_t dimension_;
};

}  // namespace delone::solve
