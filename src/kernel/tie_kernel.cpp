// SPDX-License-Identifier: BSD-3-Clause
// perturbed_in_sphere_on_grid() with one cell per lane. On a small grid all intermediate results are exact
// (docs/predicates.md, "Small lattices"), in any order and with any instructions.
#include "kernel/tie_kernel.hpp"

#include <algorithm>

#if defined(__x86_64__) || defined(_M_X64)
#undef HWY_DISABLED_TARGETS  // Here CMake's definition lacks SSE4.
// Their vectors are as short as those of SSE2, and the unrolled minors are slow to compile.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#endif
#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "kernel/tie_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "kernel/minors-inl.hpp"

#ifndef DELONE_TIE_LIMITS
#define DELONE_TIE_LIMITS
namespace delone::kernel {
template <class T>
constexpr std::size_t most_lanes = 64 / sizeof(T);
}
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::kernel {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Writes the differences of the vertices of two cells and the query to two lanes side by side: binary32 in
/// units of the grid.
template <int K, class T>
HWY_INLINE void write_differences(const TieTask& task, const Index* cell, const Index* other,
                                  T* HWY_RESTRICT lanes) {
  constexpr bool in_units = sizeof(T) < sizeof(double);
  for (std::size_t i = 0; i <= K; ++i) {
    const double* const point = task.coordinates + cell[i] * task.row_size;
    const double* const other_point = task.coordinates + other[i] * task.row_size;
    const auto entry = [&](std::size_t r) { return lanes + (r * (K + 1) + i) * most_lanes<T>; };
    std::size_t r = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::FixedTag<double, 2> two;
    for (; r + 1 < K; r += 2) {
      const auto origin = hn::LoadU(two, task.query + r);
      auto x = hn::Sub(hn::LoadU(two, point + r), origin),
           y = hn::Sub(hn::LoadU(two, other_point + r), origin);
      if constexpr (in_units) {
        const auto scale = hn::LoadU(two, task.per_unit + r);
        x = hn::Mul(x, scale);
        y = hn::Mul(y, scale);
      }
      const auto first = hn::InterleaveLower(two, x, y), second = hn::InterleaveUpper(two, x, y);
      if constexpr (in_units) {
        const hn::FixedTag<float, 2> two_short;
        hn::StoreU(hn::DemoteTo(two_short, first), two_short, entry(r));
        hn::StoreU(hn::DemoteTo(two_short, second), two_short, entry(r + 1));
      } else {
        hn::Store(first, two, entry(r));
        hn::Store(second, two, entry(r + 1));
      }
    }
#endif
    for (; r < K; ++r) {
      const double scale =
          in_units || (HWY_TARGET == HWY_SCALAR && task.per_unit != nullptr) ? task.per_unit[r] : 1.0;
      entry(r)[0] = static_cast<T>((point[r] - task.query[r]) * scale);
      entry(r)[1] = static_cast<T>((other_point[r] - task.query[r]) * scale);
    }
  }
}

template <int K, class T>
void break_ties_of(const TieTask& task) {
  const hn::CappedTag<T, most_lanes<T>> d;
  using V = hn::Vec<decltype(d)>;
  HWY_ALIGN T differences[K * (K + 1) * most_lanes<T>];  // of the points and the query, axis by axis
  HWY_ALIGN T sides[most_lanes<T>];
  const V zero = hn::Zero(d);
  for (std::size_t first = 0; first < task.cells.size(); first += hn::Lanes(d)) {
    const std::size_t lanes = hn::Lanes(d), used = std::min(lanes, task.cells.size() - first);
    const auto vertices = [&](std::size_t lane) {
      return task.cells[first + std::min(lane, used - 1)];
    };  // the last one fills the lanes to spare
    for (std::size_t lane = 0; lane < lanes; lane += 2)
      write_differences<K, T>(task, vertices(lane), vertices(lane + 1), differences + lane);
    const Entries<K + 1, most_lanes<T>, decltype(d)> entries{d, differences};
    V minors[std::size_t{1} << (K + 1)];
    tabulate_minors<K>(entries, minors);
    // The query decides unless larger points have a coefficient that is not zero: then the largest of them
    // does, by the orientation with the query in its place, which takes i exchanges to come first.
    V largest = zero, side = hn::Set(d, T{1});
    for (int i = 0; i <= K; ++i) {
      V key = zero;  // of the difference
      for (int r = 0; r < K; ++r)
        key = hn::MulAdd(entries.at(r, i), hn::Set(d, static_cast<T>(task.key_weights[r])), key);
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

template <int K>
void break_ties_in(const TieTask& task) {
  if constexpr (can_break_in_binary32(K) &&
                HWY_TARGET != HWY_SCALAR)  // whose one lane is no faster in binary32
    if (task.per_unit != nullptr) return break_ties_of<K, float>(task);
  break_ties_of<K, double>(task);
}

void break_ties_here(const TieTask& task) {
  internal::with_compiled_dimension<3>(static_cast<std::size_t>(task.k), [&](auto k) {
    if constexpr (k() > 0) break_ties_in<k()>(task);
  });
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
