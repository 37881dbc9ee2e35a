// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/hole_search/hole_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/buffer.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "geometry/hole_search/hole_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace delone::geometry {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// K is k, or 0 for 7 and more.

template <int K>
void replace(int k_given, const double* HWY_RESTRICT functions, int slot, const double* HWY_RESTRICT row,
             double* HWY_RESTRICT replaced) {
  const int k = K > 0 ? K : k_given;
  const hn::CappedTag<double, (K > 0 && K <= 2) ? 4 : 8> d;
  const std::size_t width = width_of_functions(k), lanes = hn::Lanes(d);
  const auto constants = static_cast<std::size_t>(k) * width;
  kernel::Buffer<double, K == 0 ? 0 : static_cast<int>(width_of_functions(K))> buffer(width);
  double* HWY_RESTRICT values = buffer.data();
  for (std::size_t f = 0; f < width; f += lanes) {
    auto value = hn::LoadU(d, functions + constants + f);
    for (int r = 0; r < k; ++r)
      value = hn::MulAdd(hn::Set(d, row[r]),
                         hn::LoadU(d, functions + static_cast<std::size_t>(r) * width + f), value);
    hn::StoreU(value, d, values + f);
  }
  values[k + 1] += row[k];
  const double per_pivot = 1 / values[slot];
  for (std::size_t f = 0; f < width; f += lanes) {
    const auto ratio = hn::Mul(hn::LoadU(d, values + f), hn::Set(d, per_pivot));
    for (std::size_t r = 0; r <= static_cast<std::size_t>(k); ++r) {
      const auto of_pivot = hn::Set(d, functions[r * width + static_cast<std::size_t>(slot)]);
      hn::StoreU(hn::NegMulAdd(ratio, of_pivot, hn::LoadU(d, functions + r * width + f)), d,
                 replaced + r * width + f);
    }
  }
  for (std::size_t r = 0; r <= static_cast<std::size_t>(k); ++r) {
    const std::size_t at = r * width + static_cast<std::size_t>(slot);
    replaced[at] = functions[at] * per_pivot;
  }
}

/// An affine function of an image, in all lanes. Held in registers where the dimension is known: writing to
/// memory would have it loaded again.
template <int K, class D>
class CellFunction {
 public:
  CellFunction(D d, int k, const double* coefficients, std::size_t step, double factor)
      : d_(d), k_(k), coefficients_(coefficients), step_(step), factor_(factor) {
    if constexpr (K > 0)
      for (std::size_t r = 0; r <= K; ++r) held_[r] = read(r);
  }
  /// At images whose coordinates are `stride` entries apart.
  HWY_INLINE hn::Vec<D> at(const double* images, std::size_t stride) const {
    const auto k = static_cast<std::size_t>(K > 0 ? K : k_);
    auto value = coefficient(k);
    for (std::size_t r = 0; r < k; ++r)
      value = hn::MulAdd(coefficient(r), hn::LoadU(d_, images + r * stride), value);
    return value;
  }

 private:
  HWY_INLINE hn::Vec<D> read(std::size_t r) const {
    return hn::Mul(hn::Set(d_, factor_), hn::Set(d_, coefficients_[r * step_]));
  }
  HWY_INLINE hn::Vec<D> coefficient(std::size_t r) const {
    if constexpr (K > 0)
      return held_[r];
    else
      return read(r);
  }

  const D d_;
  const int k_;
  const double* const coefficients_;
  const std::size_t step_;
  const double factor_;
  hn::Vec<D> held_[K > 0 ? K + 1 : 1];
};

/// Bounds on the errors of all functions at candidates, in the order of the functions. Images and lifts are
/// off by a few roundings, and so are functions relative to the magnitudes of their coefficients, which a
/// handful of steps of elimination has magnified.
template <int K>
void bound_functions(int k, const double* HWY_RESTRICT functions, double* HWY_RESTRICT errors) {
  const hn::CappedTag<double, (K > 0 && K <= 2) ? 4 : 8> d;
  const std::size_t width = width_of_functions(k), lanes = hn::Lanes(d);
  for (std::size_t f = 0; f < width; f += lanes) {
    auto sum = hn::Zero(d);
    for (std::size_t r = 0; r <= static_cast<std::size_t>(k); ++r)
      sum = hn::Add(sum, hn::Abs(hn::LoadU(d, functions + r * width + f)));
    hn::StoreU(hn::Mul(sum, hn::Set(d, 0x1p-42)), d, errors + f);
  }
}

template <int K>
void find(const PencilTask& task, std::uint64_t* found) {
  const hn::CappedTag<double, 8> d;
  using V = hn::Vec<decltype(d)>;
  const int k = K > 0 ? K : task.k;
  const std::size_t width = width_of_functions(k), lanes = hn::Lanes(d), stride = task.stride;
  const auto last = static_cast<std::size_t>(k);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  kernel::Buffer<double, K == 0 ? 0 : static_cast<int>(width_of_functions(K))> errors(width);
  bound_functions<K>(k, task.functions, errors.data());
  const CellFunction<K, decltype(d)> height_of(d, k, task.functions + last + 1, width, 1);
  for (std::size_t i = 0; i < stride; i += lanes)
    hn::StoreU(hn::Add(height_of.at(task.rows + i, stride), hn::LoadU(d, task.rows + last * stride + i)), d,
               task.heights + i);
  for (std::size_t i = 0; i < task.num_own; ++i) task.heights[task.own[i]] = infinity;

  const V height_error = hn::Set(d, errors.data()[last + 1] + 0x1p-42 * task.largest_lift),
          zero = hn::Zero(d);
  for (std::size_t s = 0; s < task.num_slots; ++s) {
    const auto slot = static_cast<std::size_t>(task.slots[s]);
    const CellFunction<K, decltype(d)> distance_of(d, k, task.functions + slot, width, task.side);
    // The least of the largest possible ratios, in each lane, without division. The vertices of the facet are
    // too near to count.
    const V distance_error = hn::Set(d, errors.data()[slot]),
            least_distance = hn::Add(distance_error, distance_error);
    const auto look_at = [&](std::size_t i, V& best_height, V& best_distance) HWY_ATTR {
      const V distance = distance_of.at(task.rows + i, stride);
      hn::StoreU(distance, d, task.distances + i);
      // The largest possible ratio has the least distance if the height is positive, and else the largest.
      const V highest = hn::Add(hn::LoadU(d, task.heights + i), height_error);
      const V divisor = hn::IfThenElse(hn::Lt(highest, zero), hn::Add(distance, distance_error),
                                       hn::Sub(distance, distance_error));
      const auto better = hn::And(hn::Gt(distance, least_distance),
                                  hn::Lt(hn::Mul(highest, best_distance), hn::Mul(best_height, divisor)));
      best_height = hn::IfThenElse(better, highest, best_height);
      best_distance = hn::IfThenElse(better, divisor, best_distance);
    };
    V best_height = hn::Set(d, infinity), best_distance = hn::Set(d, 1.0);
    V other_height = best_height, other_distance = best_distance;  // so that steps wait less for each other
    for (std::size_t i = 0; i < stride; i += 2 * lanes) {
      look_at(i, best_height, best_distance);
      look_at(i + lanes, other_height, other_distance);
    }
    const V least = hn::MinOfLanes(
        d, hn::Min(hn::Div(best_height, best_distance), hn::Div(other_height, other_distance)));
    const V none = hn::Set(d, infinity), too_near = hn::Neg(distance_error);
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < stride; i += lanes) {
      const V height = hn::LoadU(d, task.heights + i), distance = hn::LoadU(d, task.distances + i);
      const V lowest = hn::Sub(height, height_error);
      const auto is_below = hn::Lt(lowest, zero);
      const V divisor =
          hn::IfThenElse(is_below, hn::Sub(distance, distance_error), hn::Add(distance, distance_error));
      const auto is_uncertain = hn::And(is_below, hn::Le(divisor, zero));
      const auto may_be_first = hn::And(hn::And(hn::Gt(distance, too_near), hn::Lt(height, none)),
                                        hn::Or(is_uncertain, hn::Le(lowest, hn::Mul(least, divisor))));
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, may_be_first, bits);
      word |= std::uint64_t{bits[0]} << (i % 64);
      if ((i + lanes) % 64 == 0) *found++ = std::exchange(word, 0);
    }
    if (stride % 64 != 0) *found++ = word;
  }
}

void replace_here(int k, const double* functions, int slot, const double* row, double* replaced) {
  internal::with_compiled_dimension<1, 6>(static_cast<std::size_t>(k), [&](auto compiled) {
    replace<compiled()>(k, functions, slot, row, replaced);
  });
}

void find_here(const PencilTask& task, std::uint64_t* found) {
  internal::with_compiled_dimension<1, 6>(static_cast<std::size_t>(task.k),
                                          [&](auto k) { find<k()>(task, found); });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(replace_here);
HWY_EXPORT(find_here);

void replace_vertex(int k, const double* functions, int slot, const double* row, double* replaced) {
  HWY_DYNAMIC_DISPATCH(replace_here)(k, functions, slot, row, replaced);
}
void find_first(const PencilTask& task, std::uint64_t* found) {
  HWY_DYNAMIC_DISPATCH(find_here)(task, found);
}

}  // namespace delone::geometry
#endif
