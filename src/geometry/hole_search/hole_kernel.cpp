// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/hole_search/hole_kernel.hpp"

#include "kernel/buffer.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

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

template <int K>
std::size_t find(const PencilTask& task, std::uint32_t* found) {
  const hn::CappedTag<double, 8> d;
  using V = hn::Vec<decltype(d)>;
  const int k = K > 0 ? K : task.k;
  const std::size_t width = width_of_functions(k), lanes = hn::Lanes(d), stride = task.stride;
  // Held in registers where the dimension is known: writing to memory would have them loaded again.
  const auto coefficient = [&](std::size_t r, std::size_t f) {
    return hn::Set(d, task.functions[r * width + f]);
  };
  V of_height[K > 0 ? K + 1 : 1], of_distance[K > 0 ? K + 1 : 1];
  if constexpr (K > 0)
    for (std::size_t r = 0; r <= K; ++r) {
      of_height[r] = coefficient(r, K + 1);
      of_distance[r] = hn::Mul(hn::Set(d, task.side), coefficient(r, static_cast<std::size_t>(task.slot)));
    }
  const auto height_at = [&](std::size_t r) {
    if constexpr (K > 0)
      return of_height[r];
    else
      return coefficient(r, static_cast<std::size_t>(k) + 1);
  };
  const auto distance_at = [&](std::size_t r) {
    if constexpr (K > 0)
      return of_distance[r];
    else
      return hn::Mul(hn::Set(d, task.side), coefficient(r, static_cast<std::size_t>(task.slot)));
  };
  const auto last = static_cast<std::size_t>(k);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // The least of the largest possible ratios, in each lane, without division. The vertices of the facet are
  // too near to count.
  const V height_error = hn::Set(d, task.height_error), distance_error = hn::Set(d, task.distance_error);
  const V least_distance = hn::Add(distance_error, distance_error), zero = hn::Zero(d);
  V best_height = hn::Set(d, infinity), best_distance = hn::Set(d, 1.0);
  for (std::size_t i = 0; i < stride; i += lanes) {
    V height = hn::Add(height_at(last), hn::LoadU(d, task.rows + last * stride + i));
    V distance = distance_at(last);
    for (std::size_t r = 0; r < last; ++r) {
      const V x = hn::LoadU(d, task.rows + r * stride + i);
      height = hn::MulAdd(height_at(r), x, height);
      distance = hn::MulAdd(distance_at(r), x, distance);
    }
    hn::StoreU(height, d, task.heights + i);
    hn::StoreU(distance, d, task.distances + i);
    // The largest possible ratio has the least distance if the height is positive, and else the largest.
    const V highest = hn::Add(height, height_error);
    const V divisor = hn::IfThenElse(hn::Lt(highest, zero), hn::Add(distance, distance_error),
                                     hn::Sub(distance, distance_error));
    const auto better = hn::And(hn::Gt(distance, least_distance),
                                hn::Lt(hn::Mul(highest, best_distance), hn::Mul(best_height, divisor)));
    best_height = hn::IfThenElse(better, highest, best_height);
    best_distance = hn::IfThenElse(better, divisor, best_distance);
  }
  for (std::size_t i = 0; i < task.num_own; ++i) task.heights[task.own[i]] = infinity;
  const V least = hn::MinOfLanes(d, hn::Div(best_height, best_distance));
  std::size_t num_found = 0;
  const V none = hn::Set(d, infinity), too_near = hn::Neg(distance_error);
  for (std::size_t i = 0; i < stride; i += lanes) {
    const V height = hn::LoadU(d, task.heights + i), distance = hn::LoadU(d, task.distances + i);
    const V lowest = hn::Sub(height, height_error);
    const auto is_below = hn::Lt(lowest, zero);
    const V divisor =
        hn::IfThenElse(is_below, hn::Sub(distance, distance_error), hn::Add(distance, distance_error));
    const auto is_uncertain = hn::And(is_below, hn::Le(divisor, zero));
    const auto may_be_first = hn::And(hn::And(hn::Gt(distance, too_near), hn::Lt(height, none)),
                                      hn::Or(is_uncertain, hn::Le(lowest, hn::Mul(least, divisor))));
    if (hn::AllFalse(d, may_be_first)) continue;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, may_be_first, bits);
    for (unsigned mask = bits[0]; mask != 0; mask &= mask - 1)
      found[num_found++] = static_cast<std::uint32_t>(i) + static_cast<std::uint32_t>(std::countr_zero(mask));
  }
  return num_found;
}

void replace_here(int k, const double* functions, int slot, const double* row, double* replaced) {
  switch (k) {
    case 1:
      return replace<1>(k, functions, slot, row, replaced);
    case 2:
      return replace<2>(k, functions, slot, row, replaced);
    case 3:
      return replace<3>(k, functions, slot, row, replaced);
    case 4:
      return replace<4>(k, functions, slot, row, replaced);
    case 5:
      return replace<5>(k, functions, slot, row, replaced);
    case 6:
      return replace<6>(k, functions, slot, row, replaced);
    default:
      return replace<0>(k, functions, slot, row, replaced);
  }
}

std::size_t find_here(const PencilTask& task, std::uint32_t* found) {
  switch (task.k) {
    case 1:
      return find<1>(task, found);
    case 2:
      return find<2>(task, found);
    case 3:
      return find<3>(task, found);
    case 4:
      return find<4>(task, found);
    case 5:
      return find<5>(task, found);
    case 6:
      return find<6>(task, found);
    default:
      return find<0>(task, found);
  }
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
std::size_t find_first(const PencilTask& task, std::uint32_t* found) {
  return HWY_DYNAMIC_DISPATCH(find_here)(task, found);
}

}  // namespace delone::geometry
#endif
