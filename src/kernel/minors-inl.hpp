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

/// The operations of a term, for one kind of vector: the compiler chooses among the overloads of Highway
/// here, and not at each term of a determinant, which would take it half of its time.
template <class V>
struct Terms {
  static HWY_INLINE V product(V a, V b) { return hwy::HWY_NAMESPACE::Mul(a, b); }
  static HWY_INLINE V added(V a, V b, V sum) { return hwy::HWY_NAMESPACE::MulAdd(a, b, sum); }
  static HWY_INLINE V subtracted(V a, V b, V sum) { return hwy::HWY_NAMESPACE::NegMulAdd(a, b, sum); }
};

/// The column of a set that follows `before` others of the set.
constexpr int column_of(unsigned set, int before) {
  for (; before > 0; --before) set &= set - 1;
  return std::countr_zero(set);
}

/// The minor of the first |Set| rows and a set of columns, from those of one row less, by sets of columns.
/// `row`: the entries of row |Set| − 1. Before: 0 … |Set| − 2.
template <unsigned Set, class V, int... Before>
HWY_INLINE V minor_from_smaller(const V* row, const V* minors, std::integer_sequence<int, Before...>) {
  constexpr int last = std::bit_width(Set) - 1;
  V minor = row[last];
  if constexpr (sizeof...(Before) > 0) {
    minor = Terms<V>::product(minor, minors[Set & ~(1u << last)]);
    ((minor = (sizeof...(Before) - Before) % 2 != 0
                  ? Terms<V>::subtracted(row[column_of(Set, Before)],
                                         minors[Set & ~(1u << column_of(Set, Before))], minor)
                  : Terms<V>::added(row[column_of(Set, Before)],
                                    minors[Set & ~(1u << column_of(Set, Before))], minor)),
     ...);
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
HWY_INLINE void tabulate_minors(const E& matrix, V* minors) {
  V entries[Rows * E::columns];
  for (int row = 0; row < Rows; ++row)
    for (int column = 0; column < E::columns; ++column)
      entries[row * E::columns + column] = matrix.at(row, column);
  for_each_set<1, (1u << E::columns) - 1>([&]<unsigned Set>(std::integral_constant<unsigned, Set>) {
    constexpr int size = std::popcount(Set);
    if constexpr (size <= Rows)
      minors[Set] = minor_from_smaller<Set>(entries + (size - 1) * E::columns, minors,
                                            std::make_integer_sequence<int, size - 1>{});
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

/// The terms of the cofactor of an entry of a square matrix: the sets of Row of the other columns, in
/// ascending order, and whether each is subtracted.
template <int Columns, int Row, int Column>
struct CofactorTerms {
  static constexpr unsigned others = ((1u << Columns) - 1) & ~(1u << Column);
  static constexpr bool has(unsigned set) { return std::popcount(set) == Row && (set & ~others) == 0; }
  static constexpr std::size_t count = [] {
    std::size_t n = 0;
    for (unsigned set = 0; set <= others; ++set) n += has(set);
    return n;
  }();

  constexpr CofactorTerms() {
    std::size_t n = 0;
    for (unsigned set = 0; set <= others; ++set)
      if (has(set)) {
        sets[n] = set;
        odd[n++] = is_odd(set, 1u << Column, others & ~set);
      }
  }
  unsigned sets[count] = {};
  bool odd[count] = {};
};

/// The cofactor of an entry of a square matrix, up to a sign that depends on the row only, from the minors of
/// the rows above and below it (those of FromLastRow).
template <int Columns, int Row, int Column, class V>
HWY_INLINE V cofactor(const V* above, const V* below) {
  constexpr CofactorTerms<Columns, Row, Column> terms;
  constexpr unsigned first = terms.sets[0], others = terms.others;
  V sum = Row == 0 ? below[others] : above[first];  // there is no minor of no rows
  if constexpr (Row > 0 && Row < Columns - 1) sum = Terms<V>::product(sum, below[others & ~first]);
  if constexpr (terms.odd[0]) sum = hwy::HWY_NAMESPACE::Neg(sum);
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((sum = terms.odd[I + 1]
                ? Terms<V>::subtracted(above[terms.sets[I + 1]], below[others & ~terms.sets[I + 1]], sum)
                : Terms<V>::added(above[terms.sets[I + 1]], below[others & ~terms.sets[I + 1]], sum)),
     ...);
  }
  (std::make_index_sequence<terms.count - 1>{});
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::kernel
HWY_AFTER_NAMESPACE();

#endif
