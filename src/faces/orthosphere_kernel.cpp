// SPDX-License-Identifier: BSD-3-Clause
// Computes what the certified stage of Orthospheres does, with bounds that are proved in orthosphere.cpp;
// they hold for any approximate inverse.
#include "faces/orthosphere_kernel.hpp"

#include "kernel/linear_bound.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "faces/orthosphere_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "kernel/linear-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace delone::internal {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using kernel::HWY_NAMESPACE::inverse_defect;
using kernel::HWY_NAMESPACE::invert;
using kernel::HWY_NAMESPACE::Pair;
using kernel::HWY_NAMESPACE::two_product;
using kernel::HWY_NAMESPACE::two_sum;

/// N edges in D dimensions; D = 0: `size` of them.
template <int N, int D>
void find(std::size_t size, bool weighted, bool want_square, const double* HWY_RESTRICT vertices,
          OrthosphereBlock& found) {
  constexpr std::size_t n = static_cast<std::size_t>(N), block = orthosphere_block;
  constexpr std::size_t most = D > 0 ? static_cast<std::size_t>(D) : most_orthosphere_dimension;
  const std::size_t dimension = D > 0 ? static_cast<std::size_t>(D) : size;
  const hn::CappedTag<double, block> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  using V = hn::Vec<decltype(d)>;
  constexpr double u = kernel::unit_roundoff;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0), little = hn::Set(d, 1e-290);
  const double dn = n, dd = static_cast<double>(dimension);
  const auto times = [&](double factor, V x) { return hn::Mul(hn::Set(d, factor), x); };
  for (std::size_t lane = 0; lane < block; lane += hn::Lanes(d)) {
    const auto vertex = [&](std::size_t i, std::size_t j) {
      return hn::LoadU(d, vertices + (i * (dimension + 1) + j) * block + lane);
    };
    V high[n * most], low[n * most], gram[n * n], inverse[n * n], lambda[n], weight[n], weight_low[n];
    V largest = zero, heaviest = zero, first_weight = zero;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < dimension; ++j) {
        const Pair<V> edge = two_sum(vertex(i + 1, j), hn::Neg(vertex(0, j)));
        high[i * dimension + j] = edge.high;
        low[i * dimension + j] = edge.low;
        largest = hn::Max(largest, hn::Abs(edge.high));
      }
    if (weighted) first_weight = vertex(0, dimension);
    for (std::size_t i = 0; i < n; ++i) {
      const Pair<V> difference =
          weighted ? two_sum(vertex(i + 1, dimension), hn::Neg(first_weight)) : Pair<V>{zero, zero};
      weight[i] = difference.high;
      weight_low[i] = difference.low;
      heaviest = hn::Max(heaviest, hn::Abs(weight[i]));
    }
    auto ok = hn::And(hn::Gt(largest, hn::Set(d, 0x1p-150)), hn::Lt(largest, hn::Set(d, 0x1p150)));
    ok = hn::And(ok, hn::Lt(hn::Max(heaviest, hn::Abs(first_weight)), hn::Set(d, 0x1p300)));
    V square = zero, largest_right = zero;  // g and B
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t m = 0; m <= i; ++m) {
        V dot = hn::Mul(high[i * dimension], high[m * dimension]);
        for (std::size_t j = 1; j < dimension; ++j)
          dot = hn::Add(dot, hn::Mul(high[i * dimension + j], high[m * dimension + j]));
        gram[i * n + m] = gram[m * n + i] = dot;
      }
    for (std::size_t i = 0; i < n; ++i) {
      square = hn::Max(square, gram[i * n + i]);
      largest_right = hn::Max(largest_right, hn::Add(gram[i * n + i], hn::Abs(weight[i])));
    }
    if constexpr (N == 1)
      inverse[0] = hn::Div(one, gram[0]);
    else
      invert<N>(d, gram, inverse);
    V norm = zero;
    for (std::size_t i = 0; i < n; ++i) {
      V row = zero;
      for (std::size_t j = 0; j < n; ++j) row = hn::Add(row, hn::Abs(inverse[i * n + j]));
      norm = hn::Max(norm, row);
    }
    const V alpha = hn::Add(inverse_defect<N>(d, gram, inverse),
                            times(1.1 * dn * (dn + dd + 6) * u, hn::MulAdd(norm, square, one)));
    ok = hn::And(ok, hn::Le(alpha, hn::Set(d, 0.5)));
    V largest_lambda = zero, first = one;
    for (std::size_t i = 0; i < n; ++i) {
      V sum = zero;
      for (std::size_t m = 0; m < n; ++m)
        sum = hn::Add(sum, hn::Mul(inverse[i * n + m], hn::Sub(gram[m * n + m], weight[m])));
      lambda[i] = times(0.5, sum);
      largest_lambda = hn::Max(largest_lambda, hn::Abs(lambda[i]));
      first = hn::Sub(first, lambda[i]);
    }
    const V e = hn::Add(times(0.52 * (dn + dd + 6) * u, hn::Mul(norm, largest_right)), little);
    const V error = times(1.01, hn::Add(e, hn::Mul(times(2, alpha), hn::Add(largest_lambda, e))));
    ok = hn::And(ok, hn::Lt(error, hn::Set(d, 1e300)));

    const V error_of_first =
        times(1.01, hn::Add(times(dn, error), times(dn * u, hn::Add(one, times(dn, largest_lambda)))));
    auto beyond = hn::IfThenElseZero(hn::RebindMask(du, hn::Lt(first, hn::Neg(error_of_first))),
                                     hn::Set(du, std::uint64_t{1}));
    auto is_certain = hn::And(ok, hn::Gt(hn::Abs(first), error_of_first));
    for (std::size_t i = 0; i < n; ++i) {
      beyond = hn::Or(beyond, hn::IfThenElseZero(hn::RebindMask(du, hn::Lt(lambda[i], hn::Neg(error))),
                                                 hn::Set(du, std::uint64_t{2} << i)));
      is_certain = hn::And(is_certain, hn::Gt(hn::Abs(lambda[i]), error));
    }
    hn::StoreU(beyond, du, found.beyond + lane);
    hn::StoreU(hn::IfThenElseZero(is_certain, one), d, found.beyond_is_certain + lane);

    const V length = times(1.01, hn::Sqrt(square));
    const V rounding_of_x = times(1.1 * dn * (dn + 1) * u, hn::Mul(largest_lambda, length));
    const V error_of_x = hn::Add(times(1.01 * dn, hn::Mul(error, length)), rounding_of_x);
    V x[most], sum = zero;
    for (std::size_t j = 0; j < dimension; ++j) {
      x[j] = hn::Mul(lambda[0], high[j]);
      for (std::size_t i = 1; i < n; ++i) x[j] = hn::Add(x[j], hn::Mul(lambda[i], high[i * dimension + j]));
      sum = hn::Add(sum, hn::Mul(x[j], x[j]));
    }
    const V length_of_x = times(1.01, hn::Sqrt(sum));
    const V approximate = hn::Sub(sum, first_weight);
    V range = hn::Add(times(dd * u, sum), hn::Mul(error_of_x, hn::Add(times(2, length_of_x), error_of_x)));
    range = hn::Add(times(1.01, hn::Add(range, times(3 * u, hn::Abs(approximate)))), little);
    hn::StoreU(hn::Sub(approximate, range), d, found.least + lane);
    hn::StoreU(hn::Add(approximate, range), d, found.most + lane);
    hn::StoreU(hn::IfThenElseZero(ok, one), d, found.range_is_certain + lane);
    if (!want_square) continue;

    // The squared length of x and two more terms, with all low parts in one sum: these are at most 2(d + 2)u
    // of the magnitude together, and so are roundings of 2(d + 2) sums u of that: 4(d + 2)²u² in all.
    Pair<V> result{zero, zero};
    V magnitude = hn::Add(hn::Abs(first_weight), sum);
    for (std::size_t j = 0; j < dimension; ++j) {
      const Pair<V> product = two_product(d, x[j], x[j]), next = two_sum(result.high, product.high);
      result = {next.high, hn::Add(result.low, hn::Add(next.low, product.low))};
    }
    V correction = zero, rest_error = zero, largest_residual = zero;
    const double second_order = 5.1 * (dd + 3) * (dd + 3) * u * u;
    for (std::size_t i = 0; i < n; ++i) {
      V part = hn::Neg(weight[i]), rest = hn::Neg(weight_low[i]);
      for (std::size_t j = 0; j < dimension; ++j) {
        const V a = high[i * dimension + j], a_low = low[i * dimension + j];
        const Pair<V> factor = two_sum(a, times(-2, x[j]));
        const V factor_low = hn::Add(factor.low, a_low);
        const Pair<V> product = two_product(d, a, factor.high), next = two_sum(part, product.high);
        part = next.high;
        rest = hn::Add(rest, hn::Add(hn::Add(next.low, product.low),
                                     hn::Add(hn::Mul(a, factor_low), hn::Mul(a_low, factor.high))));
      }
      const V residual = hn::Add(part, rest);
      const V m =
          times(1.01, hn::Add(hn::Add(square, times(2, hn::Mul(length, length_of_x))), hn::Abs(weight[i])));
      correction = hn::Add(correction, hn::Mul(lambda[i], residual));
      const V of_residual = hn::Add(hn::Add(times(u, hn::Abs(residual)), times(second_order, m)), little);
      largest_residual = hn::Max(largest_residual, hn::Add(hn::Abs(residual), of_residual));
      rest_error = hn::Add(rest_error, hn::Mul(hn::Abs(lambda[i]),
                                               hn::Add(of_residual, times((dn + 1) * u, hn::Abs(residual)))));
    }
    const V span = hn::Mul(hn::Sqrt(times(0.5 * dn, norm)), largest_residual);
    const V sharper = hn::Min(error_of_x, hn::Add(times(1.01, span), rounding_of_x));
    magnitude = hn::Add(magnitude, hn::Abs(correction));
    for (const V term : {correction, hn::Neg(first_weight)}) {
      const Pair<V> next = two_sum(result.high, term);
      result = {next.high, hn::Add(result.low, next.low)};
    }
    result = two_sum(result.high, result.low);
    V bound = hn::Add(hn::Mul(sharper, hn::Add(sharper, times(2, rounding_of_x))), rest_error);
    bound = hn::Add(bound, times(16 * (dd + 3) * (dd + 3) * u * u, magnitude));
    bound = hn::Add(times(1.01, bound), little);
    // The doubles beside result.high, which is normal and not 0.
    const auto bits = hn::BitCast(du, result.high), unit = hn::Set(du, std::uint64_t{1});
    const V larger = hn::BitCast(d, hn::Add(bits, unit)), smaller = hn::BitCast(d, hn::Sub(bits, unit));
    const auto is_positive = hn::Gt(result.high, zero);
    const V next = hn::IfThenElse(is_positive, larger, smaller),
            previous = hn::IfThenElse(is_positive, smaller, larger);
    const V top = hn::Add(result.low, bound), bottom = hn::Sub(result.low, bound);
    const auto is_below = hn::Le(top, zero);
    const auto settled = hn::Or(hn::And(is_below, hn::Gt(bottom, hn::Sub(previous, result.high))),
                                hn::And(hn::Gt(bottom, zero), hn::Le(top, hn::Sub(next, result.high))));
    ok = hn::And(ok, hn::And(settled, hn::Gt(hn::Abs(result.high), hn::Set(d, 1e-280))));
    hn::StoreU(hn::IfThenElse(is_below, result.high, next), d, found.square + lane);
    hn::StoreU(hn::IfThenElseZero(ok, one), d, found.square_is_certain + lane);
  }
}

void find_orthospheres_here(std::size_t n, std::size_t d, bool weighted, bool want_square,
                            const double* vertices, OrthosphereBlock& found) {
  const auto choose = [&]() {
    if (d == 3) {
      if (n == 1) return &find<1, 3>;
      if (n == 2) return &find<2, 3>;
      if (n == 3) return &find<3, 3>;
    }
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
