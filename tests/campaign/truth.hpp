// SPDX-License-Identifier: BSD-3-Clause
// The right answers of a campaign: signs of linear functions with integer coefficients. A simplex, a facet or
// rows become a function once, and each query costs one scalar product, so that most of the time goes to the
// predicates. In 128 bits where everything fits, else in integers of any size.
#pragma once

#include "brute_force.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace delone::campaign {

__extension__ typedef __int128 Int128;  // NOLINT(modernize-use-using): the extension mark needs it

/// An integer that a double holds.
template <class Int>
Int integer_of(double x) {
  int exponent;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  const int shift = exponent - 53;
  if (mantissa == 0) return Int(0);
  if (shift >= 0) return Int(Int(mantissa) << shift);
  return Int(mantissa >> -shift);
}

template <class Int>
Sign sign_of(const Int& x) {
  return x > 0 ? Sign::positive : x < 0 ? Sign::negative : Sign::zero;
}

/// The determinant of n rows of n entries. Laplace expansion over sets of columns, from the last row up, in
/// 128 bits; fraction-free elimination of the tests' own beyond.
inline Int128 determinant_of(const std::vector<Int128>& a, std::size_t n) {
  if (n == 0) return 1;
  std::vector<Int128> minors(std::size_t{1} << n, 0);  // of the last |columns| rows
  minors[0] = 1;
  for (std::size_t columns = 1; columns < minors.size(); ++columns) {
    const std::size_t row = n - static_cast<std::size_t>(std::popcount(columns));
    Int128 sum = 0;
    bool negative = false;
    for (std::size_t c = 0; c < n; ++c) {
      if ((columns >> c & 1) == 0) continue;
      const Int128 term = a[row * n + c] * minors[columns & ~(std::size_t{1} << c)];
      sum += negative ? -term : term;
      negative = !negative;
    }
    minors[columns] = sum;
  }
  return minors.back();
}
inline test::Integer determinant_of(const std::vector<test::Integer>& a, std::size_t n) {
  test::Matrix rows;
  for (std::size_t i = 0; i < n; ++i)
    rows.emplace_back(a.begin() + static_cast<std::ptrdiff_t>(i * n),
                      a.begin() + static_cast<std::ptrdiff_t>((i + 1) * n));
  return test::determinant(rows);
}

/// Σ c_j·x_j, which vanishes on n − 1 rows of n entries: det(rows, x).
template <class Int>
std::vector<Int> vanishing_on(const std::vector<Int>& rows, std::size_t n) {
  std::vector<Int> coefficients;
  for (std::size_t omitted = 0; omitted < n; ++omitted) {
    std::vector<Int> minor;
    for (std::size_t i = 0; i + 1 < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (j != omitted) minor.push_back(rows[i * n + j]);
    const Int value = determinant_of(minor, n - 1);
    coefficients.push_back((n - 1 + omitted) % 2 == 0 ? value : Int(-value));
  }
  return coefficients;
}

template <class Int>
Int value_at(const std::vector<Int>& coefficients, const std::vector<Int>& x) {
  Int sum = 0;
  for (std::size_t j = 0; j < x.size(); ++j) sum += coefficients[j] * x[j];
  return sum;
}

/// What is known of k+1 points of a flat that projects one-to-one on its first k coordinates. Rows have
/// `ambient` coordinates, and then a weight.
template <class Int>
class Simplex {
 public:
  Simplex(const std::vector<std::vector<double>>& rows, std::size_t k, std::size_t ambient)
      : k_(k), ambient_(ambient) {
    for (std::size_t i = 0; i <= k; ++i) points_.push_back(integers(rows[i]));
    std::vector<Int> edges, lifted;
    for (std::size_t i = 1; i <= k; ++i) {
      const std::vector<Int> difference = lifted_difference(points_[i]);
      lifted.insert(lifted.end(), difference.begin(), difference.end());
      edges.insert(edges.end(), difference.begin(), difference.begin() + static_cast<std::ptrdiff_t>(k));
    }
    sphere_ = vanishing_on(lifted, k + 1);
    orientation_ = sign_of(determinant_of(edges, k));
    edges.resize((k - 1) * k);
    plane_ = vanishing_on(edges, k);
  }

  std::vector<Int> integers(const std::vector<double>& row) const {
    std::vector<Int> result;
    for (const double x : row) result.push_back(integer_of<Int>(x));
    result.resize(ambient_ + 1, Int(0));
    return result;
  }

  Sign orientation() const { return orientation_; }
  /// The sign of det(p_1 − p_0, …, p_(k−1) − p_0, q − p_0).
  Sign side_of_facet(const std::vector<Int>& q) const { return sign_of(value_at(plane_, difference(q))); }
  /// + outside the sphere, − inside, that of the lifts that fall with weights.
  Sign side_of_sphere(const std::vector<Int>& q) const {
    // The last coefficient is the determinant of the edges: positive above, where the lift is large.
    return sign_of(value_at(sphere_, lifted_difference(q))) * orientation_;
  }
  /// The power of q over the lift: what a weight of q has to be, about, for q to be on the sphere.
  double weight_on_sphere(const std::vector<Int>& q) const {
    std::vector<Int> row = q;
    row.back() = 0;
    return static_cast<double>(value_at(sphere_, lifted_difference(row))) /
           static_cast<double>(sphere_.back());
  }

  /// The tie-break by its definition, for a q on the sphere that is none of the points: each point is lifted
  /// by an ε of its own, larger for lexicographically larger points.
  Sign perturbed(const std::vector<Int>& q) const { return largest_decides(q, k_ + 1); }
  /// The same for a q on the hyperplane of the first k points, which move towards the last one.
  Sign perturbed_side_of_facet(const std::vector<Int>& q) const { return largest_decides(q, k_); }

 private:
  Sign largest_decides(const std::vector<Int>& q, std::size_t size) const {
    const auto less = [&](const std::vector<Int>& a, const std::vector<Int>& b) {
      return std::lexicographical_compare(a.begin(), a.end() - 1, b.begin(), b.end() - 1);
    };
    std::vector<std::size_t> order(size);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return less(points_[b], points_[a]); });
    for (const std::size_t i : order) {
      if (less(points_[i], q)) return Sign::positive;
      if (const Sign coordinate = barycentric_sign(q, i); coordinate != Sign::zero) return -coordinate;
    }
    return Sign::positive;
  }
  Sign barycentric_sign(const std::vector<Int>& q, std::size_t i) const {
    std::vector<std::vector<Int>> moved = points_;
    moved[i] = q;
    std::vector<Int> edges;
    for (std::size_t r = 1; r <= k_; ++r)
      for (std::size_t j = 0; j < k_; ++j) edges.push_back(moved[r][j] - moved[0][j]);
    return sign_of(determinant_of(edges, k_)) * orientation_;
  }
  std::vector<Int> difference(const std::vector<Int>& q) const {
    std::vector<Int> result;
    for (std::size_t j = 0; j < k_; ++j) result.push_back(q[j] - points_[0][j]);
    return result;
  }
  /// q − p_0 on the axes of the flat, and |q − p_0|² − w_q + w_0.
  std::vector<Int> lifted_difference(const std::vector<Int>& q) const {
    std::vector<Int> result = difference(q);
    Int lift = 0;
    for (std::size_t j = 0; j < ambient_; ++j) {
      const Int x = q[j] - points_[0][j];
      lift += x * x;
    }
    lift -= q[ambient_] - points_[0][ambient_];
    result.push_back(lift);
    return result;
  }

  std::size_t k_, ambient_;
  std::vector<std::vector<Int>> points_;
  std::vector<Int> sphere_, plane_;
  Sign orientation_ = Sign::zero;
};

}  // namespace delone::campaign
