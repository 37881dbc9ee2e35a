// SPDX-License-Identifier: BSD-3-Clause
// The hyperplane through k points of R^k in binary64 with certified bounds, from one elimination, O(k³), or,
// in code compiled for k = 3 and 4, from minors: its outward normal (the filter of check() and the equations
// of facets), the (k−1)-volume of the simplex of the points, and the k-volume of its join with a point.
// Proof: docs/predicates.md, "Normals of hull cells".
//
// With edges e_1 … e_(k−1), N·x = det(x, e_1, …, e_(k−1)) is positive outwards for a cell oriented as in
// simplicial_hull.hpp, and |N| is (k−1)! times the volume. Scaling the edges to length about 1 by powers of
// two scales N by a positive factor. Elimination with row pivoting chooses k−1 coordinates as pivots and
// leaves one, p. With y ⊥ e_i and y_p = 1, N = N_p·y.
#pragma once

#include "compiled/simplicial_hull.hpp"
#include "kernel/buffer.hpp"
#include "kernel/determinant.hpp"

#include <delone/convex_hull.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace delone::hull {

using sites::BoundarySites;

/// D is k, or 0 for k chosen at run time.
template <int D>
class HullNormal {
 public:
  explicit HullNormal(int k)
      : k_(static_cast<std::size_t>(k)),
        edges_((k_ - 1) * k_),
        factors_((k_ - 1) * k_),
        row_of_(k_),
        zeros_(k_),
        normal_(k_),
        factorial_(std::tgamma(static_cast<double>(k))) {}

  /// The hyperplane through points[0 … k−1], projected to the given axes. Returns false if binary64 cannot
  /// certify it.
  bool compute(const double* const* points, std::span<const int> axes, bool reversed) {
    points_base_ = points[0];
    int exponent = 0;
    for (std::size_t i = 0; i + 1 < k(); ++i) {
      double* edge = edges_.data() + i * k();
      double largest = 0;
      for (std::size_t j = 0; j < k(); ++j) {
        const auto axis = static_cast<std::size_t>(axes[j]);
        edge[j] = points[i + 1][axis] - points_base_[axis];
        largest = std::max(largest, std::fabs(edge[j]));
      }
      if (!(largest > 0x1p-1000 && largest < 0x1p1000)) return false;
      const auto biased = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52);
      const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(2046 - biased) << 52);
      for (std::size_t j = 0; j < k(); ++j) edge[j] *= scale;
      exponent += biased - 1023;
    }
    if constexpr (D == 3 || D == 4) return finish_by_minors(exponent, reversed);
    std::copy_n(edges_.data(), (k() - 1) * k(), factors_.data());
    const int n = static_cast<int>(k()) - 1;
    constexpr int N = D > 1 ? D - 1 : 0;
    const kernel::CertifiedDeterminant det =
        kernel::factor<N>(factors_.data(), n, n + 1, {1.01 * kernel::unit_roundoff, 0}, row_of_.data());
    const double least = std::fabs(det.value) - det.error;
    if (!(least > 0)) return false;
    std::fill_n(zeros_.data(), k(), 0.0);
    normal_[k() - 1] = 1;
    kernel::solve_transposed<N>(factors_.data(), n, n + 1, row_of_.data(), zeros_.data(), normal_.data());

    double residual = 0, square = 0;
    for (std::size_t i = 0; i + 1 < k(); ++i) {
      const double* edge = edges_.data() + i * k();
      double sum = 0, magnitude = 0;
      for (std::size_t j = 0; j < k(); ++j) {
        const double product = edge[j] * normal_[j];
        sum += product;
        magnitude += std::fabs(product);
      }
      residual = std::max(residual, std::fabs(sum) + rounding(3) * magnitude);
    }
    for (std::size_t j = 0; j < k(); ++j) square += normal_[j] * normal_[j];
    length_ = std::sqrt(square);
    error_ = 1.01 * (residual + 1e-290) * det.norm_product * det.inverse_norm_sum / least;
    if (k() == 1) error_ = 0;
    // N is (−1)^(k−1) times the determinant of (e_1, …, e_(k−1), x).
    if ((det.value > 0) == (reversed != (k() % 2 == 0)))
      for (std::size_t j = 0; j < k(); ++j) normal_[j] = -normal_[j];
    weight_ = times_power(std::fabs(det.value), exponent);
    weight_error_ = times_power(det.error, exponent);
    return error_ < 0.125 * length_;
  }

  /// The outward normal with one entry ±1. Some exact normal of the hyperplane is within error() of it in
  /// 2-norm.
  const double* normal() const { return normal_.data(); }
  double error() const { return error_; }
  double length() const { return length_; }

  /// content() and cone() need a volume of the edges' parallelepiped that neither overflows nor underflows.
  bool has_measures() const { return weight_ > 1e-250 && weight_ < 1e250; }
  Measure content() const {
    const double value = weight_ * length_ / factorial_;
    return {value, 1.01 * (weight_ * error_ + weight_error_ * (length_ + error_)) / factorial_ +
                       rounding(8) * value};
  }
  /// The k-volume of the simplex of the points and an apex that is not beyond the hyperplane.
  Measure cone(const double* apex, std::span<const int> axes) const {
    double height = 0, magnitude = 0, square = 0;
    for (std::size_t j = 0; j < k(); ++j) {
      const auto axis = static_cast<std::size_t>(axes[j]);
      const double t = points_base_[axis] - apex[axis];
      height += normal_[j] * t;
      magnitude += std::fabs(normal_[j] * t);
      square += t * t;
    }
    const double height_error =
        error_ * std::sqrt(square) + rounding(3) * magnitude + 1e-150 * error_ + 1e-320;
    const double factorial = factorial_ * static_cast<double>(k()),
                 value = weight_ * std::max(height, 0.0) / factorial;
    return {value,
            1.01 * (weight_ * height_error + weight_error_ * (std::fabs(height) + height_error)) / factorial +
                rounding(8) * value + std::numeric_limits<double>::denorm_min()};
  }

 private:
  /// N of two or three edges by its minors, each beside the sum of the magnitudes of its terms.
  bool finish_by_minors(int exponent, bool reversed) requires(D == 3 || D == 4) {
    constexpr int roundings = D == 3 ? 4 : 8;  // of a term: of its entries, of products and of sums
    const double* const e = edges_.data();
    double magnitudes[D];
    const auto minor = [](const double* u, const double* v, int i, int j, double& magnitude) {
      const double first = u[i] * v[j], second = u[j] * v[i];
      magnitude = std::fabs(first) + std::fabs(second);
      return first - second;
    };
    if constexpr (D == 3) {
      for (int j = 0; j < 3; ++j)
        normal_[static_cast<std::size_t>(j)] = minor(e, e + 3, (j + 1) % 3, (j + 2) % 3, magnitudes[j]);
    } else {
      const double *const u = e + 4, *const v = e + 8;
      double m01, m02, m03, m12, m13, m23;
      const double d01 = minor(u, v, 0, 1, m01), d02 = minor(u, v, 0, 2, m02), d03 = minor(u, v, 0, 3, m03),
                   d12 = minor(u, v, 1, 2, m12), d13 = minor(u, v, 1, 3, m13), d23 = minor(u, v, 2, 3, m23);
      const double a0 = std::fabs(e[0]), a1 = std::fabs(e[1]), a2 = std::fabs(e[2]), a3 = std::fabs(e[3]);
      normal_[0] = e[1] * d23 - e[2] * d13 + e[3] * d12;
      normal_[1] = e[2] * d03 - e[0] * d23 - e[3] * d02;
      normal_[2] = e[0] * d13 - e[1] * d03 + e[3] * d01;
      normal_[3] = e[1] * d02 - e[0] * d12 - e[2] * d01;
      magnitudes[0] = a1 * m23 + a2 * m13 + a3 * m12;
      magnitudes[1] = a2 * m03 + a0 * m23 + a3 * m02;
      magnitudes[2] = a0 * m13 + a1 * m03 + a3 * m01;
      magnitudes[3] = a1 * m02 + a0 * m12 + a2 * m01;
    }
    double largest = 0;
    for (std::size_t j = 0; j < D; ++j) largest = std::max(largest, std::fabs(normal_[j]));
    if (!(largest > 1e-200)) return false;
    double square = 0, square_of_errors = 0;
    for (std::size_t j = 0; j < D; ++j) {
      normal_[j] /= largest;
      if (reversed) normal_[j] = -normal_[j];
      square += normal_[j] * normal_[j];
      square_of_errors += magnitudes[j] * magnitudes[j];
    }
    length_ = std::sqrt(square);
    error_ = 1.01 * ((roundings * kernel::unit_roundoff * std::sqrt(square_of_errors) + 1e-290) / largest +
                     kernel::unit_roundoff * length_);
    weight_ = times_power(largest, exponent);
    weight_error_ = 0;
    return error_ < 0.125 * length_;
  }

  std::size_t k() const { return D > 0 ? static_cast<std::size_t>(D) : k_; }
  /// x·2^exponent.
  static double times_power(double x, int exponent) {
    if (exponent < -1000 || exponent > 1000) return std::ldexp(x, exponent);
    return x * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
  }
  /// γ_(k + more).
  double rounding(int more) const { return 1.01 * (static_cast<double>(k()) + more) * kernel::unit_roundoff; }

  static constexpr int entries = D > 1 ? (D - 1) * D : 0;

  std::size_t k_;
  kernel::Buffer<double, entries> edges_, factors_;  // columns
  kernel::Buffer<int, D> row_of_;
  kernel::Buffer<double, D> zeros_, normal_;
  double factorial_;  // (k−1)!
  const double* points_base_ = nullptr;
  double length_ = 0, error_ = 0;
  double weight_ = 0, weight_error_ = 0;  // |N_p|, unscaled
};

/// Certified normals of many cells, stored by the caller as records, and the sides that they prove.
template <int D>
class HullNormalsIn {
 public:
  explicit HullNormalsIn(int k) : normal_(k), k_(static_cast<std::size_t>(k)) {}

  std::size_t stride() const { return k_ + 1; }

  /// Writes k numbers, the normal, then a bound on its error in 2-norm: infinity if nothing is known.
  void compute(const BoundarySites& sites, std::span<const Index> cell, bool reversed, double* record) {
    points_.clear();
    for (const Index site : cell) points_.push_back(sites.point(site));
    const bool known = normal_.compute(points_.data(), sites.axes, reversed);
    for (std::size_t j = 0; j < k_; ++j) record[j] = known ? normal_.normal()[j] : 0.0;
    record[k_] = known ? normal_.error() : std::numeric_limits<double>::infinity();
  }

  /// The side of q with respect to the hyperplane through `base`, + inside and − beyond, if the normal proves
  /// it; else zero.
  Sign side(const BoundarySites& sites, const double* record, const double* base, const double* q) const {
    double value = 0, magnitude = 0, length = 0;
    for (std::size_t j = 0; j < k_; ++j) {
      const auto axis = static_cast<std::size_t>(sites.axes[j]);
      const double t = q[axis] - base[axis];
      value += record[j] * t;
      magnitude += std::fabs(record[j] * t);
      length += std::fabs(t);
    }
    // Rounded differences, products and sums: γ_(k+2) of the magnitude. Then the error of the normal, and
    // products that underflow.
    const double n = static_cast<double>(k_);
    const double bound = 1.01 * (record[k_] * length + (n + 3) * kernel::unit_roundoff * magnitude) +
                         kernel::underflow_allowance;
    return value > bound ? Sign::negative : value < -bound ? Sign::positive : Sign::zero;
  }

 private:
  HullNormal<D> normal_;
  std::size_t k_;
  std::vector<const double*> points_;
};
using HullNormals = HullNormalsIn<0>;

}  // namespace delone::hull
