// SPDX-License-Identifier: BSD-3-Clause
// Tables of minors (kernel/minors.hpp) with one matrix per SIMD lane. Included once for each instruction set,
// after hwy/highway.h. All sets are sets of columns, as bits.
#if defined(DELONE_KERNEL_MINORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DELONE_KERNEL_MINORS_INL
#undef DELONE_KERNEL_MINORS_INL
#else
#define DELONE_KERNEL_MINORS_INL
#endif

#include <bit>
#include <cstddef>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace delone::kernel {
namespace HWY_NAMESPACE {

/// Entries of matrices of Columns columns, row by row, each in Stride lanes.
template <int Columns, std::ptrdiff_t Stride, class D>
struct Entries {
  HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> at(int row, int column) const {
    return hwy::HWY_NAMESPACE::Load(d, first + (row * Columns + column) * Stride);
  }

  static constexpr int columns = Columns;
  D d;
  const hwy::HWY_NAMESPACE::TFromD<D>* first;
};

/// The same with the last row first.
template <class E>
struct FromLastRow {
  HWY_INLINE auto at(int row, int column) const { return entries.at(columns - 1 - row, column); }

  static constexpr int columns = E::columns;
  E entries;
};

/// The minor of the first |Set| rows and a set of columns, from those of one row less, by sets of columns.
template <unsigned Set, class E, class V>
HWY_INLINE V minor_from_smaller(const E& entries, const V* minors) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr int last_row = std::popcount(Set) - 1;
  constexpr int last = std::bit_width(Set) - 1;
  V minor = entries.at(last_row, last);
  if constexpr (last_row > 0) {
    minor = hn::Mul(minor, minors[Set & ~(1u << last)]);
    [&]<int... C>(std::integer_sequence<int, C...>) {
      const auto add = [&]<int Column>(std::integral_constant<int, Column>) {
        if constexpr (Column < last && (Set >> Column & 1) != 0) {
          constexpr bool negative = std::popcount(Set >> Column) % 2 == 0;
          const V entry = entries.at(last_row, Column), smaller = minors[Set & ~(1u << Column)];
          minor = negative ? hn::NegMulAdd(entry, smaller, minor) : hn::MulAdd(entry, smaller, minor);
        }
      };
      (add(std::integral_constant<int, C>{}), ...);
    }
    (std::make_integer_sequence<int, E::columns>{});
  }
  return minor;
}

/// Calls f with the sets First … First + Count − 1 as constants, in several folds, as a single one could nest
/// deeper than compilers allow.
template <unsigned First, unsigned Count, class F>
HWY_INLINE void for_each_set(const F& f) {
  constexpr unsigned most = 255;
  if constexpr (Count > most) {
    for_each_set<First, most>(f);
    for_each_set<First + most, Count - most>(f);
  } else {
    [&]<unsigned... S>(std::integer_sequence<unsigned, S...>) {
      (f(std::integral_constant<unsigned, First + S>{}), ...);
    }
    (std::make_integer_sequence<unsigned, Count>{});
  }
}

/// All minors of up to Rows rows, by sets of columns; that of none is not written.
template <int Rows, class E, class V>
HWY_INLINE void tabulate_minors(const E& entries, V* minors) {
  for_each_set<1, (1u << E::columns) - 1>([&]<unsigned Set>(std::integral_constant<unsigned, Set>) {
    if constexpr (std::popcount(Set) <= Rows) minors[Set] = minor_from_smaller<Set>(entries, minors);
  });
}

/// Whether the columns of one set, then another, then a third, each in ascending order, are an odd
/// permutation.
constexpr bool is_odd(unsigned first, unsigned second, unsigned third) {
  int inversions = 0;
  for (int column = 0; column < 32; ++column) {
    const unsigned below = (1u << column) - 1;
    if ((first >> column & 1) != 0) inversions += std::popcount((second | third) & below);
    if ((second >> column & 1) != 0) inversions += std::popcount(third & below);
  }
  return inversions % 2 != 0;
}

/// The cofactor of an entry of a square matrix, up to a sign that depends on the row only, from the minors of
/// the rows above and below it (those of FromLastRow).
template <int Columns, int Row, int Column, class V>
HWY_INLINE V cofactor(const V* above, const V* below) {
  namespace hn = hwy::HWY_NAMESPACE;
  constexpr unsigned others = ((1u << Columns) - 1) & ~(1u << Column);
  constexpr unsigned first = [] {
    unsigned set = 0;  // as many of the others as there are rows above
    for (int column = 0; std::popcount(set) < Row; ++column) set |= others & 1u << column;
    return set;
  }();
  const auto term = [&]<unsigned Set>(std::integral_constant<unsigned, Set>) {
    constexpr unsigned rest = others & ~Set;
    if constexpr (Set == 0)
      return below[rest];
    else if constexpr (rest == 0)
      return above[Set];
    else
      return hn::Mul(above[Set], below[rest]);
  };
  V sum = term(std::integral_constant<unsigned, first>{});
  if constexpr (is_odd(first, 1u << Column, others & ~first)) sum = hn::Neg(sum);
  for_each_set<0, 1u << Columns>([&]<unsigned Set>(std::integral_constant<unsigned, Set>) {
    if constexpr (std::popcount(Set) == Row && (Set & ~others) == 0 && Set != first) {
      constexpr unsigned rest = others & ~Set;
      sum = is_odd(Set, 1u << Column, rest) ? hn::NegMulAdd(above[Set], below[rest], sum)
                                            : hn::MulAdd(above[Set], below[rest], sum);
    }
  });
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::kernel
HWY_AFTER_NAMESPACE();

#endif
