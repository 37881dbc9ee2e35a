// SPDX-License-Identifier: BSD-3-Clause
#include "solve/center_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "kernel/linear_bound.hpp"

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "solve/center_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "solve/linear_system-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace delone::solve {
namespace HWY_NAMESPACE {

/// Solves the equations of a center. `corner(i, j)`: coordinate j of point i. `weight(i)`: of point i, if
/// there are weights. Calls finish(j, z_j/2, correction, radius, extent) for each coordinate j: that of the
/// center less the first point is z_j/2 + correction, up to the radius, in cells that are certain.
///
/// A is scaled by a power of two such that its largest entry is in [1/2, 1), the right-hand sides by its
/// square. Results below 10⁻²⁹⁰ that underflowed are covered, as |z⁰| and the entries of R are below 10⁸.
template <class T, int N, class Corner, class Weight, class Finish>
HWY_INLINE Mask<T> solve_center(std::size_t size, Corner corner, bool weighted, Weight weight,
                                Finish finish) {
  LinearSystem<T, N> system(size);
  const std::size_t n = system.size();
  kernel::Buffer<T, N * N> low(n * n);
  auto& high = system.a;
  T largest = number<T>(0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const Pair<T> edge = two_sum(corner(i + 1, j), minus(corner(0, j)));
      high[i * n + j] = edge.high;
      low[i * n + j] = edge.low;
      largest = max(largest, abs(edge.high));
    }
  Mask<T> certain = both(largest > 0x1p-100, largest < 0x1p200);
  const auto [unscale, scale] = powers_of_two(select(certain, largest, number<T>(1)));
  for (std::size_t i = 0; i < n * n; ++i) {
    high[i] = high[i] * scale;
    low[i] = low[i] * scale;
  }
  kernel::Buffer<Pair<T>, N> weight_difference(n);
  for (std::size_t i = 0; i < n; ++i) {
    weight_difference[i] = {number<T>(0), number<T>(0)};
    if (weighted) {
      const Pair<T> difference = two_sum(weight(i + 1), minus(weight(0)));
      weight_difference[i] = {difference.high * scale * scale, difference.low * scale * scale};
    }
    system.b[i] = minus(weight_difference[i].high);
    for (std::size_t j = 0; j < n; ++j) system.b[i] = system.b[i] + high[i * n + j] * high[i * n + j];
  }
  certain = both(certain, system.solve(1e8, 1e8));
  if constexpr (is_one_lane<T>)
    if (!certain) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Residual<T> residual =
        sphere_residual(n, high.data() + i * n, low.data() + i * n, system.x.data(), weight_difference[i]);
    system.residual[i] = residual.value;
    system.error[i] = residual.error;
  }
  system.correct(1e-280);
  for (std::size_t j = 0; j < n; ++j) {
    T extent = number<T>(0);
    for (std::size_t i = 0; i < n; ++i) extent = max(extent, abs(high[i * n + j]));
    certain = both(certain, finish(j, system.x[j] * unscale, system.correction[j] * unscale,
                                   system.radius[j] * unscale, extent * unscale));
  }
  return certain;
}

template <int N>
void find(const double* HWY_RESTRICT corners, const double* HWY_RESTRICT weights,
          double* HWY_RESTRICT centers, double* HWY_RESTRICT settled) {
  constexpr std::size_t n = static_cast<std::size_t>(N);
  const hn::CappedTag<double, center_block> d;
  using V = hn::Vec<decltype(d)>;
  for (std::size_t lane = 0; lane < center_block; lane += hn::Lanes(d)) {
    const auto corner = [&](std::size_t i, std::size_t j) {
      return hn::LoadU(d, corners + (i * n + j) * center_block + lane);
    };
    const auto weight = [&](std::size_t i) { return hn::LoadU(d, weights + i * center_block + lane); };
    const auto finish = [&](std::size_t j, V offset, V correction, V radius, V) {
      const Nearest<V> center = nearest_double(two_sum(corner(0, j), offset), correction, radius);
      hn::StoreU(center.value + 0.0, d, centers + j * center_block + lane);
      return center.is_settled;
    };
    const Mask<V> certain = solve_center<V, N>(n, corner, weights != nullptr, weight, finish);
    hn::StoreU(hn::IfThenElseZero(certain, hn::Set(d, 1.0)), d, settled + lane);
  }
}

void find_centers_here(std::size_t n, const double* corners, const double* weights, double* centers,
                       double* settled) {
  internal::with_compiled_dimension<least_center_lanes, most_center_lanes>(n, [&](auto dimension) {
    if constexpr (dimension() > 0) find<dimension()>(corners, weights, centers, settled);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::solve
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::solve {

HWY_EXPORT(find_centers_here);

void find_centers_in_lanes(std::size_t n, const double* corners, const double* weights, double* centers,
                           double* settled) {
  HWY_DYNAMIC_DISPATCH(find_centers_here)(n, corners, weights, centers, settled);
}

namespace {

template <class Finish>
bool solve_one(std::span<const int> axes, const double* const* points, const double* weights,
               const Finish& finish) {
  const auto corner = [&](std::size_t i, std::size_t j) { return points[i][axes[j]]; };
  const auto weight = [&](std::size_t i) { return weights[i]; };
  return internal::with_compiled_dimension<1, most_center_lanes>(axes.size(), [&](auto n) {
    return HWY_NAMESPACE::solve_center<double, n()>(axes.size(), corner, weights != nullptr, weight, finish);
  });
}

}  // namespace

bool find_center(std::span<const int> axes, const double* const* points, const double* weights,
                 double* center) {
  return solve_one(axes, points, weights,
                   [&](std::size_t j, double offset, double correction, double radius, double) {
                     const auto start = HWY_NAMESPACE::two_sum(points[0][axes[j]], offset);
                     const auto nearest = HWY_NAMESPACE::nearest_double(start, correction, radius);
                     center[axes[j]] = nearest.value + 0.0;
                     return nearest.is_settled;
                   });
}

bool find_center_offset(std::span<const int> axes, const double* const* points, double* offset) {
  return solve_one(axes, points, nullptr,
                   [&](std::size_t j, double start, double correction, double radius, double extent) {
                     const double value = start + correction;
                     offset[axes[j]] = value;
                     return radius <= kernel::unit_roundoff / 4 * (std::abs(value) + extent);
                   });
}

}  // namespace delone::solve
#endif
