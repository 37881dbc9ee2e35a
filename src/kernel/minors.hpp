// SPDX-License-Identifier: BSD-3-Clause
// Determinants of a few columns by a table of the minors of the first rows: Laplace expansion without
// divisions and, if the number of columns is known at compile time, without loops or branches.
#pragma once

#include <bit>
#include <cstddef>
#include <utility>

namespace delone::kernel {

/// Whether the table of minors is faster than elimination for N columns.
template <int N>
inline constexpr bool tabulates_minors = N > 0 && N <= 6;

namespace detail {

/// The minor of the first |Columns| rows and the columns of a bit set, from the minors of one row less:
/// expansion along the last row, in which the cofactor of the last column is positive and signs alternate.
template <int N, unsigned Columns, class Number>
Number minor_from_smaller(const Number* a, const Number* minors) {
  constexpr int last_row = std::popcount(Columns) - 1;
  if constexpr (last_row == 0) return a[std::countr_zero(Columns)];
  Number sum{};
  [&]<int... C>(std::integer_sequence<int, C...>) {
    const auto add = [&]<int Column>(std::integral_constant<int, Column>) {
      if constexpr ((Columns >> Column & 1) != 0) {
        constexpr bool negative = std::popcount(Columns >> Column) % 2 == 0;
        constexpr bool first = (Columns & ((1u << Column) - 1)) == 0;
        const Number term = a[last_row * N + Column] * minors[Columns & ~(1u << Column)];
        if constexpr (first)
          sum = negative ? -term : term;
        else
          sum = negative ? sum - term : sum + term;
      }
    };
    (add(std::integral_constant<int, C>{}), ...);
  }
  (std::make_integer_sequence<int, N>{});
  return sum;
}

}  // namespace detail

/// The determinant of N rows of N entries. In row s a product goes through one multiplication and at most s −
/// 1 additions, in all rows through fewer than n = N(N + 1)/2 roundings. Barring underflow, the error is at
/// most γ_n times the permanent of the magnitudes.
template <int N, class Number>
Number determinant_by_minors(const Number* a) {
  Number minors[std::size_t{1} << N];  // by the set of columns; that of none is not used
  [&]<unsigned... S>(std::integer_sequence<unsigned, S...>) {
    ((minors[S + 1] = detail::minor_from_smaller<N, S + 1>(a, minors)), ...);
  }
  (std::make_integer_sequence<unsigned, (1u << N) - 1>{});
  return minors[(1u << N) - 1];
}

/// The same for a number of columns chosen at run time. REQUIRES room for 2^n minors.
template <class Number>
Number determinant_by_minors(const Number* a, std::size_t n, Number* minors) {
  const std::size_t all = (std::size_t{1} << n) - 1;
  for (std::size_t columns = 1; columns <= all; ++columns) {
    const std::size_t last_row = static_cast<std::size_t>(std::popcount(columns)) - 1;
    const auto term = [&](int column) {
      const Number& entry = a[last_row * n + static_cast<std::size_t>(column)];
      return last_row == 0 ? entry : entry * minors[columns & ~(std::size_t{1} << column)];
    };
    bool negative = last_row % 2 != 0;  // the cofactor of the last column is positive
    const Number first = term(std::countr_zero(columns));
    Number sum = negative ? -first : first;
    for (std::size_t rest = columns & (columns - 1); rest != 0; rest &= rest - 1) {
      negative = !negative;
      sum = negative ? sum - term(std::countr_zero(rest)) : sum + term(std::countr_zero(rest));
    }
    minors[columns] = sum;
  }
  return minors[all];
}

/// A non-negative number that is never subtracted: determinant_by_minors() of magnitudes is their permanent.
struct Magnitude {
  double value;
  friend Magnitude operator-(Magnitude x) { return x; }
  friend Magnitude operator+(Magnitude x, Magnitude y) { return {x.value + y.value}; }
  friend Magnitude operator-(Magnitude x, Magnitude y) { return x + y; }
  friend Magnitude operator*(Magnitude x, Magnitude y) { return {x.value * y.value}; }
};

}  // namespace delone::kernel
