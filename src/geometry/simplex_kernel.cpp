// SPDX-License-Identifier: BSD-3-Clause
// Inverts the matrix of edges by elimination with row exchanges, and derives certificates from the residuals.
// Proofs: docs/predicates.md, "Many simplices at once".
#include "geometry/simplex_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "geometry/pair.hpp"

#include <algorithm>
#include <cmath>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "geometry/simplex_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef DELONE_SIMPLEX_KERNEL
#define DELONE_SIMPLEX_KERNEL
namespace delone::geometry {

/// The arrays of the scratch memory. Sizes count entries of simplex_lanes doubles.
struct SimplexArrays {
  explicit SimplexArrays(const SimplexTask& task)
      : k(static_cast<std::size_t>(task.k)),
        width(k + 1),
        functions(task.scratch),
        images(functions + (k + 2) * width * simplex_lanes),
        edges(images + width * width * simplex_lanes),
        inverse(edges + k * k * simplex_lanes),
        column_sums(inverse + k * k * simplex_lanes),
        determinant(column_sums + k * simplex_lanes),
        growth(determinant + simplex_lanes),
        proved(growth + simplex_lanes) {}
  static std::size_t entries(std::size_t k) {
    return (k + 2) * (k + 1) + (k + 1) * (k + 1) + 2 * k * k + k + 2 + 3;
  }

  std::size_t k, width;
  double* functions;    ///< (k + 2)·(k + 1)
  double* images;       ///< (k + 1)², with lifts, of the vertices
  double* edges;        ///< k²: row i is vertex i + 1 less vertex 0; eliminated in place
  double* inverse;      ///< k²: in the end the inverse of the matrix of edges
  double* column_sums;  ///< k: the sum of the magnitudes of a column of U
  double* determinant;  ///< the product of the pivots, with the sign of the exchanges
  double* growth;       ///< the largest ratio of an entry to the pivot above it, at least 1
  double* proved;       ///< 3: the defect of the inverse, the spread without it, the residual
};

}  // namespace delone::geometry
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::geometry {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Gathers the images of the vertices, one simplex per lane, two simplices at a time.
template <int K>
void gather(const SimplexTask& task, const SimplexArrays& arrays) {
  const std::size_t width = K > 0 ? K + 1 : arrays.width, last = task.simplices.size() - 1;
  double* HWY_RESTRICT images = arrays.images;
  static_assert(simplex_lanes % 2 == 0);
  for (std::size_t lane = 0; lane < simplex_lanes; lane += 2) {
    const Index* const one = task.simplices[std::min(lane, last)];
    const Index* const two = task.simplices[std::min(lane + 1, last)];
    for (std::size_t i = 0; i < width; ++i) {
      const double* const of_one = task.rows + one[i] * width;
      const double* const of_two = task.rows + two[i] * width;
      const auto put = [&](std::size_t r, double from_one, double from_two) {
        store_pair(&lane_entry(images, i * width + r, lane), Pair{from_one, from_two});
      };
      for (std::size_t r = 0; r + 1 < width; r += 2) {
        const Pair a = load_pair(of_one + r), b = load_pair(of_two + r);
        put(r, a[0], b[0]);
        put(r + 1, a[1], b[1]);
      }
      if (width % 2 == 1) put(width - 1, of_one[width - 1], of_two[width - 1]);
    }
  }
}

/// Writes the matrices of edges.
template <int K>
void write_edges(const SimplexArrays& arrays, double* edges) {
  const hn::CappedTag<double, simplex_lanes> d;
  const std::size_t k = K > 0 ? K : arrays.k, width = k + 1;
  for (std::size_t lane = 0; lane < simplex_lanes; lane += hn::Lanes(d))
    for (std::size_t r = 0; r < k; ++r) {
      const auto base = hn::Load(d, arrays.images + r * simplex_lanes + lane);
      for (std::size_t i = 0; i < k; ++i) {
        const auto image = hn::Load(d, arrays.images + ((i + 1) * width + r) * simplex_lanes + lane);
        hn::Store(hn::Sub(image, base), d, edges + (i * k + r) * simplex_lanes + lane);
      }
    }
}

/// Inverts the matrices of edges in place, without row exchanges. All loops have constant lengths and are
/// unrolled.
template <int K>
void invert_in_place(const SimplexArrays& arrays) {
  const hn::CappedTag<double, simplex_lanes> d;
  using V = hn::Vec<decltype(d)>;
  write_edges<K>(arrays, arrays.inverse);
  for (std::size_t lane = 0; lane < simplex_lanes; lane += hn::Lanes(d)) {
    double* HWY_RESTRICT matrix = arrays.inverse + lane;
    const auto entry = [&](std::size_t i, std::size_t r) { return matrix + (i * K + r) * simplex_lanes; };
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
    V determinant = one, growth = one, column_sums[K];
    for (V& sum : column_sums) sum = zero;
#pragma GCC unroll 8
    for (std::size_t s = 0; s < K; ++s) {
      const V pivot = hn::Load(d, entry(s, s)), factor = hn::Div(one, pivot), per_pivot = hn::Abs(factor);
      determinant = hn::Mul(determinant, pivot);
      V pivot_row[K];  // divided by the pivot
#pragma GCC unroll 8
      for (std::size_t r = 0; r < K; ++r) {
        const V u = hn::Load(d, entry(s, r));
        if (r >= s) column_sums[r] = hn::Add(column_sums[r], hn::Abs(u));
        pivot_row[r] = r == s ? factor : hn::Mul(u, factor);
        hn::Store(pivot_row[r], d, entry(s, r));
      }
#pragma GCC unroll 8
      for (std::size_t i = 0; i < K; ++i) {
        if (i == s) continue;
        const V times = hn::Load(d, entry(i, s));
        if (i > s) growth = hn::Max(growth, hn::Mul(hn::Abs(times), per_pivot));
#pragma GCC unroll 8
        for (std::size_t r = 0; r < K; ++r)
          hn::Store(hn::NegMulAdd(times, pivot_row[r], r == s ? zero : hn::Load(d, entry(i, r))), d,
                    entry(i, r));
      }
    }
    for (std::size_t r = 0; r < K; ++r)
      hn::Store(column_sums[r], d, arrays.column_sums + r * simplex_lanes + lane);
    hn::Store(determinant, d, arrays.determinant + lane);
    hn::Store(growth, d, arrays.growth + lane);
  }
}

/// Inverts the matrices of edges with row exchanges, which keep entries from growing.
void invert_with_exchanges(const SimplexArrays& arrays) {
  const hn::CappedTag<double, simplex_lanes> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t k = arrays.k;
  write_edges<0>(arrays, arrays.edges);
  for (std::size_t lane = 0; lane < simplex_lanes; lane += hn::Lanes(d)) {
    const auto edge = [&](std::size_t i, std::size_t r) {
      return arrays.edges + (i * k + r) * simplex_lanes + lane;
    };
    const auto entry = [&](std::size_t i, std::size_t r) {
      return arrays.inverse + (i * k + r) * simplex_lanes + lane;
    };
    const auto column_sum = [&](std::size_t r) { return arrays.column_sums + r * simplex_lanes + lane; };
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
    for (std::size_t r = 0; r < k; ++r) {
      for (std::size_t i = 0; i < k; ++i) hn::Store(i == r ? one : zero, d, entry(i, r));
      hn::Store(zero, d, column_sum(r));
    }
    V determinant = one;
    for (std::size_t s = 0; s < k; ++s) {
      for (std::size_t i = s + 1; i < k; ++i) {  // the largest of the column becomes the pivot
        const auto larger = hn::Gt(hn::Abs(hn::Load(d, edge(i, s))), hn::Abs(hn::Load(d, edge(s, s))));
        determinant = hn::IfThenElse(larger, hn::Neg(determinant), determinant);
        const auto exchange = [&](double* a, double* b) {
          const V of_a = hn::Load(d, a), of_b = hn::Load(d, b);
          hn::Store(hn::IfThenElse(larger, of_b, of_a), d, a);
          hn::Store(hn::IfThenElse(larger, of_a, of_b), d, b);
        };
        for (std::size_t r = s; r < k; ++r) exchange(edge(s, r), edge(i, r));
        for (std::size_t r = 0; r < k; ++r) exchange(entry(s, r), entry(i, r));
      }
      const V pivot = hn::Load(d, edge(s, s)), factor = hn::Div(one, pivot);
      determinant = hn::Mul(determinant, pivot);
      for (std::size_t r = s; r < k; ++r) {
        const V u = hn::Load(d, edge(s, r));
        hn::Store(hn::Add(hn::Load(d, column_sum(r)), hn::Abs(u)), d, column_sum(r));
        hn::Store(hn::Mul(u, factor), d, edge(s, r));
      }
      for (std::size_t r = 0; r < k; ++r)
        hn::Store(hn::Mul(hn::Load(d, entry(s, r)), factor), d, entry(s, r));
      for (std::size_t i = 0; i < k; ++i) {
        if (i == s) continue;
        const V times = hn::Load(d, edge(i, s));
        for (std::size_t r = s + 1; r < k; ++r)
          hn::Store(hn::NegMulAdd(times, hn::Load(d, edge(s, r)), hn::Load(d, edge(i, r))), d, edge(i, r));
        for (std::size_t r = 0; r < k; ++r)
          hn::Store(hn::NegMulAdd(times, hn::Load(d, entry(s, r)), hn::Load(d, entry(i, r))), d, entry(i, r));
      }
    }
    hn::Store(determinant, d, arrays.determinant + lane);
    hn::Store(one, d, arrays.growth + lane);
  }
}

/// Writes the affine functions, given the inverses. K is k, or 0 for any k.
template <int K>
void write_functions(const SimplexArrays& arrays) {
  const hn::CappedTag<double, simplex_lanes> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t k = K > 0 ? K : arrays.k, width = k + 1;
  for (std::size_t lane = 0; lane < simplex_lanes; lane += hn::Lanes(d)) {
    const auto at = [&](double* array, std::size_t i) { return array + i * simplex_lanes + lane; };
    const auto image = [&](std::size_t i, std::size_t r) {
      return hn::Load(d, at(arrays.images, i * width + r));
    };
    const auto function = [&](std::size_t f, std::size_t r) { return at(arrays.functions, f * width + r); };
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
    // Column i of the inverse is the gradient of coordinate i + 1. The gradients of all coordinates add up to
    // 0, and the constants to 1.
    V constant_of_first = one, constant_of_last = zero;
    for (std::size_t i = 1; i <= k; ++i) {
      V constant = zero;
      for (std::size_t r = 0; r < k; ++r)
        constant = hn::NegMulAdd(hn::Load(d, at(arrays.inverse, r * k + i - 1)), image(0, r), constant);
      hn::Store(constant, d, function(i, k));
      constant_of_first = hn::Sub(constant_of_first, constant);
      constant_of_last = hn::NegMulAdd(image(i, k), constant, constant_of_last);
    }
    hn::Store(constant_of_first, d, function(0, k));
    hn::Store(hn::NegMulAdd(image(0, k), constant_of_first, constant_of_last), d, function(width, k));
    for (std::size_t r = 0; r < k; ++r) {
      V first = zero, last = zero;
      for (std::size_t i = 1; i <= k; ++i) {
        const V gradient = hn::Load(d, at(arrays.inverse, r * k + i - 1));
        hn::Store(gradient, d, function(i, r));
        first = hn::Sub(first, gradient);
        last = hn::NegMulAdd(image(i, k), gradient, last);
      }
      hn::Store(first, d, function(0, r));
      hn::Store(hn::NegMulAdd(image(0, k), first, last), d, function(width, r));
    }
  }
}

template <int K>
void solve(const SimplexTask& task) {
  const SimplexArrays arrays(task);
  gather<K>(task, arrays);
  // Row exchanges are half of the work and seldom needed.
  bool is_tame = K > 0;
  if constexpr (K > 0) {
    invert_in_place<K>(arrays);
    constexpr double largest_growth = 1e4;
    for (std::size_t lane = 0; lane < simplex_lanes; ++lane)
      is_tame = is_tame && arrays.growth[lane] <= largest_growth;
  }
  if (!is_tame) invert_with_exchanges(arrays);
  write_functions<K>(arrays);
}

void solve_here(const SimplexTask& task) {
  internal::with_compiled_dimension<2, 8>(static_cast<std::size_t>(task.k),
                                          [&](auto k) { solve<k()>(task); });
}

/// K is k, or 0 for any.
template <int K>
void certify(const SimplexTask& task) {
  const hn::CappedTag<double, simplex_lanes> d;
  using V = hn::Vec<decltype(d)>;
  const SimplexArrays arrays(task);
  const std::size_t k = K > 0 ? K : arrays.k, width = k + 1;
  for (std::size_t lane = 0; lane < simplex_lanes; lane += hn::Lanes(d)) {
    const auto at = [&](double* array, std::size_t i) { return array + i * simplex_lanes + lane; };
    const auto image = [&](std::size_t i, std::size_t r) {
      return hn::Load(d, at(arrays.images, i * width + r));
    };
    const auto function = [&](std::size_t f, std::size_t r) { return at(arrays.functions, f * width + r); };
    const V one = hn::Set(d, 1.0);
    const auto value_at = [&](std::size_t f, std::size_t j) {
      V value = hn::Load(d, function(f, k));
      for (std::size_t r = 0; r < k; ++r) value = hn::MulAdd(hn::Load(d, function(f, r)), image(j, r), value);
      return value;
    };
    V farthest = hn::Zero(d), spread = hn::Zero(d);
    for (std::size_t j = 0; j <= k; ++j) {
      V sum = hn::Zero(d);
      for (std::size_t i = 0; i <= k; ++i) {
        const V value = value_at(i, j);
        sum = hn::Add(sum, hn::Abs(i == j ? hn::Sub(value, one) : value));
      }
      farthest = hn::Max(farthest, sum);
    }
    for (std::size_t i = 0; i <= k; ++i)
      for (std::size_t r = 0; r <= k; ++r) spread = hn::Add(spread, hn::Abs(hn::Load(d, function(i, r))));
    // The values of the functional at the vertices are subtracted from it, once.
    for (std::size_t i = 0; i <= k; ++i) {
      const V value = hn::Add(value_at(width, i), image(i, k));
      for (std::size_t r = 0; r <= k; ++r)
        hn::Store(hn::NegMulAdd(value, hn::Load(d, function(i, r)), hn::Load(d, function(width, r))), d,
                  function(width, r));
    }
    V residual = hn::Zero(d);
    for (std::size_t i = 0; i <= k; ++i)
      residual = hn::Max(residual, hn::Abs(hn::Add(value_at(width, i), image(i, k))));
    hn::Store(farthest, d, at(arrays.proved, 0));
    hn::Store(spread, d, at(arrays.proved, 1));
    hn::Store(residual, d, at(arrays.proved, 2));
  }
}

void certify_here(const SimplexTask& task) {
  internal::with_compiled_dimension<2, 8>(static_cast<std::size_t>(task.k),
                                          [&](auto k) { certify<k()>(task); });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(solve_here);
HWY_EXPORT(certify_here);

std::size_t simplex_scratch(int k) {
  return SimplexArrays::entries(static_cast<std::size_t>(k)) * simplex_lanes;
}

void solve_simplices(const SimplexTask& task) { HWY_DYNAMIC_DISPATCH(solve_here)(task); }

void certify_simplices(const SimplexTask& task, SimplexCertificate* certificates) {
  HWY_DYNAMIC_DISPATCH(certify_here)(task);
  const SimplexArrays arrays(task);
  const auto k = static_cast<double>(task.k);
  constexpr double u = 0x1p-53, slack = 1 + 0x1p-40;
  for (std::size_t lane = 0; lane < task.simplices.size(); ++lane) {
    const double spread = lane_entry(arrays.proved, 1, lane);
    const double farthest = slack * (lane_entry(arrays.proved, 0, lane) + 1.01 * (k + 8) * u * spread);
    double column_sum = 0;
    for (std::size_t r = 0; r < arrays.k; ++r)
      column_sum = std::max(column_sum, lane_entry(arrays.column_sums, r, lane));
    const double growth = lane_entry(arrays.growth, 0, lane);
    const double change = slack * 2 * spread * (1.01 * (k + 4) * u * growth * column_sum + 4.1 * u);
    const double determinant = lane_entry(arrays.determinant, 0, lane);
    // False for NaN, and where pivots underflow.
    const bool is_proved = farthest < 1.0 / 64 && change < 1.0 / 64 && std::fabs(determinant) > 1e-240;
    certificates[lane] = {!is_proved        ? Sign::zero
                          : determinant > 0 ? Sign::positive
                                            : Sign::negative,
                          slack * spread / (1 - farthest), lane_entry(arrays.proved, 2, lane),
                          std::fabs(determinant) * (1 - k * change - 2 * k * u) / slack};
  }
}

}  // namespace delone::geometry
#endif
