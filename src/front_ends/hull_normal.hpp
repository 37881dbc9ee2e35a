// SPDX-License-Identifier: BSD-3-Clause
// The outward normal of k points of R^k in binary64 with a certified bound: the filter of everything that asks for the side of
// a hyperplane again and again, and the equations of facets.
//
// N_j = (−1)^j·det(edges without coordinate j), so that N·x = det(x, e_1, …, e_(k−1)): positive outwards for a cell oriented as
// in simplicial_hull.hpp. Edges are scaled to length about 1 by powers of two, which scales N by a positive factor. Each
// determinant comes from kernel::factor with its bound.
#pragma once

#include "front_ends/simplicial_hull.hpp"
#include "kernel/determinant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace delone::front_ends {

class HullNormals {
 public:
  /// `scale`: a power of two that brings differences of coordinates to at most a few units.
  explicit HullNormals(int k, double scale) : k_(static_cast<std::size_t>(k)), scale_(scale) {}

  std::size_t stride() const { return k_ + 1; }

  /// Writes N_0 … N_(k−1), then a bound on the error of each of them, or infinity: nothing is known.
  void compute(const HullSites& sites, std::span<const Index> cell, bool reversed, double* record) {
    const std::size_t n = k_ - 1;
    edges_.assign(n * k_, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      double largest = 0;
      double* edge = edges_.data() + i * k_;
      for (std::size_t j = 0; j < k_; ++j) {
        const int axis = sites.axes[j];
        edge[j] = sites.point(cell[i + 1])[axis] - sites.point(cell[0])[axis];
        largest = std::max(largest, std::fabs(edge[j]));
      }
      if (!std::isfinite(largest)) return fail(record);
      if (largest == 0) continue;
      const int exponent = -std::ilogb(largest);  // exact: entries that underflow are far below the bound's allowance
      for (std::size_t j = 0; j < k_; ++j) edge[j] = std::ldexp(edge[j], exponent);
    }
    double error = 0;
    for (std::size_t j = 0; j < k_; ++j) {
      double value = 1;
      if (n > 0) {
        minor_.clear();
        for (std::size_t i = 0; i < n; ++i)
          for (std::size_t r = 0; r < k_; ++r)
            if (r != j) minor_.push_back(edges_[i * k_ + r]);
        row_of_.resize(n);
        // An edge along coordinate j makes the minor 0, but for entries that the scaling took below the least double: side()
        // allows for those.
        if (has_zero_column(n)) {
          value = 0;
        } else {
          const kernel::CertifiedDeterminant det = kernel::factor<0>(minor_.data(), static_cast<int>(n), static_cast<int>(n),
                                                                     {1.01 * kernel::unit_roundoff, 0}, row_of_.data());
          value = det.value;
          error = std::max(error, det.error);
        }
      }
      record[j] = (j % 2 == 1) != reversed ? -value : value;
    }
    if (!std::isfinite(error)) return fail(record);
    record[k_] = error;
  }

  /// The side of the hyperplane through `base` that q is on, if the normal proves it, else zero: + inside, − beyond.
  Sign side(const HullSites& sites, const double* record, const double* base, const double* q) const {
    double value = 0, magnitude = 0, length = 0, weight = 0;
    for (std::size_t j = 0; j < k_; ++j) {
      const int axis = sites.axes[j];
      const double t = (q[axis] - base[axis]) * scale_;
      value += record[j] * t;
      magnitude += std::fabs(record[j] * t);
      length += std::fabs(t);
      weight += std::fabs(record[j]);
    }
    // Rounded differences, products and sums: γ_(k+2) of the magnitude; errors of the normal; t and products that underflow.
    const double n = static_cast<double>(k_);
    const double bound =
        1.01 * (record[k_] * length + (n + 3) * kernel::unit_roundoff * magnitude) + kernel::underflow_allowance * (weight + n);
    return value > bound ? Sign::negative : value < -bound ? Sign::positive : Sign::zero;
  }

  double scale() const { return scale_; }

 private:
  bool has_zero_column(std::size_t n) const {
    for (std::size_t i = 0; i < n; ++i)
      if (std::all_of(minor_.begin() + static_cast<std::ptrdiff_t>(i * n),
                      minor_.begin() + static_cast<std::ptrdiff_t>((i + 1) * n), [](double x) { return x == 0; }))
        return true;
    return false;
  }
  void fail(double* record) const {
    std::fill(record, record + k_, 0.0);
    record[k_] = std::numeric_limits<double>::infinity();
  }

  std::size_t k_;
  double scale_;
  std::vector<double> edges_, minor_;
  std::vector<int> row_of_;
};

/// A power of two that brings differences of these points to at most a few units, as far as there is one.
inline double difference_scale(const HullSites& sites) {
  double largest = 0;
  for (const double x : sites.coordinates) largest = std::max(largest, std::fabs(x));
  return largest == 0 ? 1.0 : std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000));
}

}  // namespace delone::front_ends
