// SPDX-License-Identifier: BSD-3-Clause
#include "faces/orthosphere_kernel.hpp"

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "faces/orthosphere_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "faces/orthosphere_solver-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace delone::internal {
namespace HWY_NAMESPACE {

/// N edges in D dimensions; D = 0: `size` of them.
template <int N, int D>
void find(std::size_t size, bool weighted, bool want_square, const double* HWY_RESTRICT vertices,
          OrthosphereBlock& found) {
  constexpr std::size_t block = orthosphere_block;
  const std::size_t dimension = D > 0 ? static_cast<std::size_t>(D) : size;
  const hn::CappedTag<double, block> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  using V = hn::Vec<decltype(d)>;
  const V one = number<V>(1);
  for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
    const auto vertex = [&](std::size_t i, std::size_t j) {
      return hn::LoadU(d, vertices + (i * (dimension + 1) + j) * block + lane);
    };
    OrthosphereSolver<V, N, D> solver(N, dimension, weighted, vertex);
    const Mask<V> certain = solver.solve();
    Bits<V> beyond;
    const Mask<V> beyond_is_certain = both(certain, solver.find_beyond(beyond));
    hn::StoreU(beyond, du, found.beyond + lane);
    hn::StoreU(hn::IfThenElseZero(beyond_is_certain, one), d, found.beyond_is_certain + lane);
    const auto square = solver.approximate_square();
    hn::StoreU(square.value - square.error, d, found.least + lane);
    hn::StoreU(square.value + square.error, d, found.most + lane);
    hn::StoreU(hn::IfThenElseZero(certain, one), d, found.range_is_certain + lane);
    if (!want_square) continue;
    const RoundedUp<V> rounded = solver.square_above();
    hn::StoreU(rounded.value, d, found.square + lane);
    hn::StoreU(hn::IfThenElseZero(both(certain, rounded.is_settled), one), d, found.square_is_certain + lane);
  }
}

void find_orthospheres_here(std::size_t n, std::size_t d, bool weighted, bool want_square,
                            const double* vertices, OrthosphereBlock& found) {
  const auto choose = [&]() {
    if constexpr (HWY_TARGET != HWY_SCALAR)
      if (d == 3 && n <= 3) return n == 1 ? &find<1, 3> : n == 2 ? &find<2, 3> : &find<3, 3>;
    return n == 1   ? &find<1, 0>
           : n == 2 ? &find<2, 0>
           : n == 3 ? &find<3, 0>
           : n == 4 ? &find<4, 0>
                    : &find<5, 0>;
  };
  choose()(d, weighted, want_square, vertices, found);
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::internal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::internal {

HWY_EXPORT(find_orthospheres_here);

void find_orthospheres_in_lanes(std::size_t n, std::size_t d, bool weighted, bool want_square,
                                const double* vertices, OrthosphereBlock& found) {
  HWY_DYNAMIC_DISPATCH(find_orthospheres_here)(n, d, weighted, want_square, vertices, found);
}

}  // namespace delone::internal
#endif
