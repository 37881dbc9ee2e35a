// SPDX-License-Identifier: BSD-3-Clause
// All barycentric coordinates of a point in a simplex at once, up to a common factor, with a certified error
// bound.
//
// With the rows a_j = p_j − q of K+1 vertices, the coordinate at vertex i is proportional to w_i =
// (−1)^i·det(a_j, j ≠ i): expand det(a_j, 1), which is (−1)^K·det(p_1 − p_0, …, p_K − p_0) for every q, along
// its last column. For a positively oriented simplex all w_i are positive inside.
//
// All K+1 determinants come from one table of the minors of the first columns, indexed by the set of rows
// (Laplace expansion along the last column).
//
// Error. A minor of s columns is a sum of products. Besides the errors of the smaller minor, each product
// carries the rounding of its new entry (a difference), its own, and that of s−1 sums: e_1 = 1, e_s = e_(s−1)
// + s + 1, so e_K = K(K+3)/2 − 1. So the computed value is the sum over the K! permutations with each product
// off by a factor within 1 ± γ(e_K) (Higham 2002, lemma 3.1), and |ŵ − w| ≤ γ(e_K)·K!·Π_c max_j |a_jc| with
// exact differences. Computed differences are smaller by at most a factor 1 − u each, and the product in the
// bound has K more roundings: γ(e_K + 3K) covers both.
//
// Range. All column maxima are in [2^−100, 2^100]. A product that underflows is off by 2^−1075, times at most
// the minors of the other columns. The share of the same columns in the bound is at least 2^−53·2^−600, so
// the slack of 1 % covers even 2^20 such errors. Nothing overflows: K!·2^600.
#pragma once

#include "base/compiler.hpp"
#include "kernel/determinant.hpp"

#include <bit>
#include <cstddef>
#include <limits>
#include <utility>

namespace delone::queries {

/// Two doubles that are computed with together, for two queries at once.
using TwoNumbers = internal::Lanes<double, 2>;

/// T: double, or TwoNumbers for two queries, maybe in different cells.
template <int K, class T = double>
class CellMinors {
  static_assert(K >= 1 && K <= 6);

 public:
  /// Evaluates all coordinates. difference(j, c) is coordinate c of p_j − q. Where the numbers are outside
  /// the range of the bound, the bound is infinite, and the coordinates mean nothing.
  template <class Difference>
  void evaluate(Difference difference) {
    const T infinite = T{} + std::numeric_limits<double>::infinity();
    T bound = T{} + slack, least = infinite, most = T{};
    for (int c = 0; c < K; ++c) {
      T largest = T{};
      for (int j = 0; j <= K; ++j) {
        const T x = difference(j, c);
        a_[j * K + c] = x;
        largest = larger(largest, larger(x, -x));
      }
      least = internal::select(least < largest, least, largest);
      most = larger(most, largest);
      bound *= largest;
    }
    const T in_range = internal::select(most <= T{} + 0x1p100, bound, infinite);
    bound_ = internal::select(least >= T{} + 0x1p-100, in_range, infinite);
    minors_[0] = T{} + 1;
    [&]<unsigned... S>(std::integer_sequence<unsigned, S...>) { ((minors_[S + 1] = minor<S + 1>()), ...); }
    (std::make_integer_sequence<unsigned, (2u << K) - 2>{});
    for (int i = 0; i <= K; ++i) {
      const T det = minors_[((2u << K) - 1) ^ (1u << i)];
      weights_[i] = i % 2 == 0 ? det : -det;
    }
  }
  /// The same for one query. Returns false if the numbers are outside the range of the bound.
  bool evaluate(const double* const* vertices, const double* q) {
    evaluate([&](int j, int c) { return vertices[j][c] - q[c]; });
    return bound_ <= std::numeric_limits<double>::max();
  }
  T weight(int i) const { return weights_[i]; }
  T bound() const { return bound_; }  ///< every weight is off by less

 private:
  static constexpr double factorial = K == 1 ? 1 : K == 2 ? 2 : K == 3 ? 6 : K == 4 ? 24 : K == 5 ? 120 : 720;
  static constexpr double slack = 1.01 * (K * (K + 3) / 2 - 1 + 3 * K) * kernel::unit_roundoff * factorial;

  static T larger(T x, T y) { return internal::select(x > y, x, y); }

  /// The minor of the rows in a bit set and of as many first columns.
  template <unsigned Rows>
  T minor() const {
    constexpr int column = std::popcount(Rows) - 1;
    T sum = T{};
    [&]<int... R>(std::integer_sequence<int, R...>) {
      const auto add = [&]<int Row>(std::integral_constant<int, Row>) {
        if constexpr ((Rows >> Row & 1) != 0) {
          const T term = a_[Row * K + column] * minors_[Rows & ~(1u << Row)];
          sum = std::popcount(Rows >> Row) % 2 == 0 ? sum - term : sum + term;
        }
      };
      (add(std::integral_constant<int, R>{}), ...);
    }
    (std::make_integer_sequence<int, K + 1>{});
    return sum;
  }

  T a_[(K + 1) * K];
  T minors_[2u << K];
  T weights_[K + 1];
  T bound_ = T{};
};

}  // namespace delone::queries
