// SPDX-License-Identifier: BSD-3-Clause
// perturbed_in_sphere_on_grid() with a cell in every lane. On a small grid all that is computed is exact
// (docs/predicates.md, "Small lattices"), in whatever order and with whatever instructions.
#include "kernel/tie_kernel.hpp"

#include <algorithm>
#include <bit>
#include <utility>

// Vectors of these are no longer than those of SSE2, and the unrolled minors take their time to compile for each.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/tie_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef DELONE_TIE_LIMITS
#define DELONE_TIE_LIMITS
namespace delone::kernel {
constexpr std::size_t most_lanes = 8;
}
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::kernel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Entries of K rows and K + 1 columns, each in all lanes.
template <int K, class D>
struct Entries {
  HWY_INLINE hn::Vec<D> at(int row, int column) const { return hn::Load(d, first + (row * (K + 1) + column) * stride); }

  static constexpr std::ptrdiff_t stride = most_lanes;
  D d;
  const double* first;
};

/// The minor of the first |Columns| rows and a set of columns, from those of one row less, by sets of columns
/// (kernel/minors.hpp).
template <int K, unsigned Columns, class D>
HWY_INLINE hn::Vec<D> minor_from_smaller(const Entries<K, D>& entries, const hn::Vec<D>* minors) {
  constexpr int last_row = std::popcount(Columns) - 1;
  constexpr int last = std::bit_width(Columns) - 1;
  auto minor = entries.at(last_row, last);
  if constexpr (last_row > 0) {
    minor = hn::Mul(minor, minors[Columns & ~(1u << last)]);
    [&]<int... C>(std::integer_sequence<int, C...>) {
      const auto add = [&]<int Column>(std::integral_constant<int, Column>) {
        if constexpr (Column < last && (Columns >> Column & 1) != 0) {
          constexpr bool negative = std::popcount(Columns >> Column) % 2 == 0;
          const auto entry = entries.at(last_row, Column), smaller = minors[Columns & ~(1u << Column)];
          minor = negative ? hn::NegMulAdd(entry, smaller, minor) : hn::MulAdd(entry, smaller, minor);
        }
      };
      (add(std::integral_constant<int, C>{}), ...);
    }
    (std::make_integer_sequence<int, K + 1>{});
  }
  return minor;
}

/// All minors, by sets of columns: those of K columns leave out one each.
template <int K, class D>
HWY_INLINE void tabulate_minors(const Entries<K, D>& entries, hn::Vec<D>* minors) {
  [&]<unsigned... S>(std::integer_sequence<unsigned, S...>) {
    ((minors[S + 1] = minor_from_smaller<K, S + 1>(entries, minors)), ...);
  }
  (std::make_integer_sequence<unsigned, (1u << (K + 1)) - 2>{});
}

/// Writes the differences of the vertices of two cells and the query to two lanes side by side.
template <int K>
HWY_INLINE void write_differences(const TieTask& task, const Index* cell, const Index* other, double* HWY_RESTRICT lanes) {
  for (std::size_t i = 0; i <= K; ++i) {
    const double* const point = task.coordinates + cell[i] * task.row_size;
    const double* const other_point = task.coordinates + other[i] * task.row_size;
    const auto entry = [&](std::size_t r) { return lanes + (r * (K + 1) + i) * most_lanes; };
    std::size_t r = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::FixedTag<double, 2> two;
    for (; r + 1 < K; r += 2) {
      const auto origin = hn::LoadU(two, task.query + r);
      const auto x = hn::Sub(hn::LoadU(two, point + r), origin), y = hn::Sub(hn::LoadU(two, other_point + r), origin);
      hn::Store(hn::InterleaveLower(two, x, y), two, entry(r));
      hn::Store(hn::InterleaveUpper(two, x, y), two, entry(r + 1));
    }
#endif
    for (; r < K; ++r) {
      entry(r)[0] = point[r] - task.query[r];
      entry(r)[1] = other_point[r] - task.query[r];
    }
  }
}

template <int K>
void break_ties_in(const TieTask& task) {
  const hn::CappedTag<double, most_lanes> d;
  using V = hn::Vec<decltype(d)>;
  HWY_ALIGN double differences[K * (K + 1) * most_lanes];  // of the points and the query, axis by axis
  HWY_ALIGN double sides[most_lanes];
  const V zero = hn::Zero(d);
  for (std::size_t first = 0; first < task.cells.size(); first += hn::Lanes(d)) {
    const std::size_t lanes = hn::Lanes(d), used = std::min(lanes, task.cells.size() - first);
    const auto vertices = [&](std::size_t lane) { return task.cells[first + std::min(lane, used - 1)]; };  // the last to spare
    for (std::size_t lane = 0; lane < lanes; lane += 2)
      write_differences<K>(task, vertices(lane), vertices(lane + 1), differences + lane);
    const Entries<K, decltype(d)> entries{d, differences};
    V minors[std::size_t{1} << (K + 1)];
    tabulate_minors(entries, minors);
    // The query decides unless a point is larger and matters: the largest one, by the orientation with the query in its place,
    // which takes as many exchanges to come first.
    V largest = zero, side = hn::Set(d, 1.0);
    for (int i = 0; i <= K; ++i) {
      V key = zero;  // of the difference
      for (int r = 0; r < K; ++r) key = hn::MulAdd(entries.at(r, i), hn::Set(d, task.key_weights[r]), key);
      const V volume = minors[((1u << (K + 1)) - 1) ^ (1u << i)];
      const auto decides = hn::And(hn::Gt(key, largest), hn::Ne(volume, zero));
      largest = hn::IfThenElse(decides, key, largest);
      side = hn::IfThenElse(decides, i % 2 == 0 ? hn::Neg(volume) : volume, side);
    }
    hn::Store(side, d, sides);
    for (std::size_t lane = 0; lane < used; ++lane)
      task.sides[first + lane] = sides[lane] < 0 ? Sign::negative : Sign::positive;
  }
}

void break_ties_here(const TieTask& task) {
  switch (task.k) {
    case 3:
      return break_ties_in<3>(task);
    case 4:
      return break_ties_in<4>(task);
    case 5:
      return break_ties_in<5>(task);
    case 6:
      return break_ties_in<6>(task);
    case 7:
      return break_ties_in<7>(task);
    case 8:
      return break_ties_in<8>(task);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::kernel
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::kernel {

HWY_EXPORT(break_ties_here);

void break_ties(const TieTask& task) { HWY_DYNAMIC_DISPATCH(break_ties_here)(task); }

}  // namespace delone::kernel
#endif
