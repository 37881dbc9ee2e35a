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
  using T = hn::TFromD<D>;

 public:
  CellFunction(D d, int k, const double* coefficients, std::size_t step, double factor)
      : d_(d), k_(k), coefficients_(coefficients), step_(step), factor_(factor) {
    if constexpr (K > 0)
      for (std::size_t r = 0; r <= K; ++r) held_[r] = read(r);
  }
  /// At images whose coordinates are `stride` entries apart.
  HWY_INLINE hn::Vec<D> at(const T* images, std::size_t stride) const {
    const auto k = static_cast<std::size_t>(K > 0 ? K : k_);
    auto value = coefficient(k);
    for (std::size_t r = 0; r < k; ++r)
      value = hn::MulAdd(coefficient(r), hn::LoadU(d_, images + r * stride), value);
    return value;
  }

 private:
  HWY_INLINE hn::Vec<D> read(std::size_t r) const {
    return hn::Set(d_, static_cast<T>(factor_ * coefficients_[r * step_]));
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

/// The sums of the magnitudes of the coefficients of all functions, in the order of the functions.
template <int K>
void add_magnitudes(int k, const double* HWY_RESTRICT functions, double* HWY_RESTRICT sums) {
  const hn::CappedTag<double, (K > 0 && K <= 2) ? 4 : 8> d;
  const std::size_t width = width_of_functions(k), lanes = hn::Lanes(d);
  for (std::size_t f = 0; f < width; f += lanes) {
    auto sum = hn::Zero(d);
    for (std::size_t r = 0; r <= static_cast<std::size_t>(k); ++r)
      sum = hn::Add(sum, hn::Abs(hn::LoadU(d, functions + r * width + f)));
    hn::StoreU(sum, d, sums + f);
  }
}

/// A bound on the error of a function at candidates, relative to the sum of the magnitudes of its
/// coefficients, and of a lift. Images and lifts are off by a few roundings in binary64, and so are
/// functions, which a handful of steps of elimination has magnified: that is 2^-42. In binary32 there are
/// more, of u = 2^-24 each: of the image, of the coefficient, of k products and k + 1 sums, 2k + 3 in all, as
/// magnitudes are at most 1. The comparisons of ratios add five, relative to a height, which the sum bounds
/// as well.
template <class T>
double relative_error([[maybe_unused]] int k) {
  if constexpr (sizeof(T) == sizeof(float)) return 0x1p-42 + (2 * k + 16) * 0x1p-24;
  return 0x1p-42;
}

template <int K, class T>
void find(const PencilTask<T>& task, std::uint64_t* found) {
  const hn::CappedTag<T, 64 / sizeof(T)> d;
  using V = hn::Vec<decltype(d)>;
  const int k = K > 0 ? K : task.k;
  const std::size_t width = width_of_functions(k), lanes = hn::Lanes(d), stride = task.stride;
  const auto last = static_cast<std::size_t>(k);
  constexpr T infinity = std::numeric_limits<T>::infinity();
  kernel::Buffer<double, K == 0 ? 0 : static_cast<int>(width_of_functions(K))> sums(width);
  add_magnitudes<K>(k, task.functions, sums.data());
  const double relative = relative_error<T>(k), sum_of_height = sums.data()[last + 1] + task.largest_lift;
  [[maybe_unused]] constexpr double largest = 0x1p60;  // no product of two is beyond the range of float
  const CellFunction<K, decltype(d)> height_of(d, k, task.functions + last + 1, width, 1);
  for (std::size_t i = 0; i < stride; i += lanes)
    hn::StoreU(hn::Add(height_of.at(task.rows + i, stride), hn::LoadU(d, task.rows + last * stride + i)), d,
               task.heights + i);
  for (std::size_t i = 0; i < task.num_own; ++i) task.heights[task.own[i]] = infinity;

  const V height_error = hn::Set(d, static_cast<T>(relative * sum_of_height)), zero = hn::Zero(d);
  for (std::size_t s = 0; s < task.num_slots; ++s) {
    const auto slot = static_cast<std::size_t>(task.slots[s]);
    if constexpr (sizeof(T) == sizeof(float))
      if (!(sum_of_height < largest && sums.data()[slot] < largest)) [[unlikely]] {
        found = std::fill_n(found, words_of_candidates(stride), ~std::uint64_t{0});
        task.is_certain[s] = false;
        continue;
      }
    const CellFunction<K, decltype(d)> distance_of(d, k, task.functions + slot, width, task.side);
    // The least of the largest possible ratios, in each lane, without division. The vertices of the facet are
    // too near to count.
    const V distance_error = hn::Set(d, static_cast<T>(relative * sums.data()[slot])),
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
    V best_height = hn::Set(d, infinity), best_distance = hn::Set(d, T{1});
    for (std::size_t i = 0; i < stride; i += lanes) look_at(i, best_height, best_distance);
    const V least = hn::MinOfLanes(d, hn::Div(best_height, best_distance));
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
      word |= (bits[0] | std::uint64_t{bits[1]} << 8) << (i % 64);
      if ((i + lanes) % 64 == 0) *found++ = std::exchange(word, 0);
    }
    if (stride % 64 != 0) *found++ = word;
    task.is_certain[s] = hn::GetLane(least) < infinity;
  }
}

void replace_here(int k, const double* functions, int slot, const double* row, double* replaced) {
  internal::with_compiled_dimension<1, 6>(
      static_cast<std::size_t>(k), [&](auto known) { replace<known()>(k, functions, slot, row, replaced); });
}
template <class T>
void find_in(const PencilTask<T>& task, std::uint64_t* found) {
  internal::with_compiled_dimension<1, 6>(static_cast<std::size_t>(task.k),
                                          [&](auto known) { find<known(), T>(task, found); });
}
void find_in_float_here(const PencilTask<float>& task, std::uint64_t* found) { find_in(task, found); }
void find_in_double_here(const PencilTask<double>& task, std::uint64_t* found) { find_in(task, found); }

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(replace_here);
HWY_EXPORT(find_in_float_here);
HWY_EXPORT(find_in_double_here);

void replace_vertex(int k, const double* functions, int slot, const double* row, double* replaced) {
  HWY_DYNAMIC_DISPATCH(replace_here)(k, functions, slot, row, replaced);
}
void find_first(const PencilTask<float>& task, std::uint64_t* found) {
  HWY_DYNAMIC_DISPATCH(find_in_float_here)(task, found);
}
void find_first(const PencilTask<double>& task, std::uint64_t* found) {
  HWY_DYNAMIC_DISPATCH(find_in_double_here)(task, found);
}

}  // namespace delone::geometry
#endif
