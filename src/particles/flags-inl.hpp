// SPDX-License-Identifier: BSD-3-Clause
// The pieces of a cell in any dimension: each face of the cell is visited once, not each order of its
// vertices.
//
// Elimination. Vectors r_w and numbers α_w, w ∉ F, start as e_w and α_w for F = ∅. When v joins F, each of
// the others loses its part along v: with f = r_w·r_v/|r_v|²,
//     r_w −= f·r_v,    α_w −= f·α_v.
//
// Errors, up to terms of second order, which the factor `slack` covers; |·| is the Euclidean norm, u the unit
// roundoff. Let r_w be off by ε_w, α_w by τ_w, and λ_w = |e_w|, which bounds |r_w|; η_v = ε_v/|r_v|.
// Projections along two directions at an angle φ differ by sin φ, and a computed product of two vectors is
// off by d·u times the product of their norms. So with κ = 2d + 5 the new r_w is off by
//     ε'_w = ε_w + λ_w·(η_v + κ·u).
// The same sum divided by |r_v| bounds what f is off by, and |f| ≤ λ_w/|r_v|: so
//     τ'_w = τ_w + |f|·τ_v + (|α_v|/|r_v|)·ε'_w + u·(2|f·α_v| + |α'_w|).
// At the beginning a rounded difference of coordinates gives ε_w = u·λ_w, and |e_w|² + w_0 − w is off by (d +
// 3)·u times s_w·λ_w, the sum of its magnitudes. D = Π|r| along one order has the relative error Σ(η + (d +
// 2)·u).
//
// Sums. With v(all) = 1, v(F) = Σ_w α^F_w·v(F ∪ {w})/(k − |F|), W_i = |e_i|²·v({i})/D. The sums of absolute
// values, p(F), bound their errors: e(F) = Σ_w (|α^F_w|·e(F ∪ {w}) + τ^F_w·(p + e)(F ∪ {w}))/(k − |F|).
//
// T is double, or a vector with one cell per lane; Number is T, or for doubles a pair. Included once for each
// instruction set, after hwy/highway.h.
#if defined(DELONE_PARTICLES_FLAGS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DELONE_PARTICLES_FLAGS_INL
#undef DELONE_PARTICLES_FLAGS_INL
#else
#define DELONE_PARTICLES_FLAGS_INL
#endif

#include "kernel/buffer.hpp"
#include "kernel/determinant.hpp"
#include "kernel/double_double.hpp"
#include "solve/lanes-inl.hpp"

#include <bit>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace delone::particles {
namespace HWY_NAMESPACE {

using namespace solve::HWY_NAMESPACE;
using solve::HWY_NAMESPACE::select;  // not that of base

/// Covers terms of second order, where relative errors are below `most_relative`.
inline constexpr double slack = 1.01, most_relative = 1e-3;
/// Products of k numbers α, and D, are far from underflow in cells whose D is at least this.
inline constexpr double least_box = 1e-150;

template <class T>
HWY_INLINE T leading(const T& x) {
  return x;
}
HWY_INLINE double leading(const kernel::DoubleDouble& x) { return x.high; }
template <class T>
HWY_INLINE T quotient(const T& a, const T& b) {
  return a / b;
}
/// Off by less than 2⁻¹⁰⁰ of the quotient: the second digit makes up for what the first leaves.
HWY_INLINE kernel::DoubleDouble quotient(const kernel::DoubleDouble& a, const kernel::DoubleDouble& b) {
  const double first = a.high / b.high;
  const kernel::DoubleDouble rest = a - b * kernel::DoubleDouble{first, 0};
  return kernel::two_sum(first, rest.high / b.high);
}
template <class Number>
HWY_INLINE Number dot(const Number* a, const Number* b, std::size_t d) {
  Number sum = a[0] * b[0];
  for (std::size_t j = 1; j < d; ++j) sum = sum + a[j] * b[j];
  return sum;
}

/// What elimination finds, by set of vertices: bit i is vertex i. K and N, the dimension of the space, are 0
/// if they are known at run time.
template <class T, int K, int N>
struct Flags {
  static constexpr int num_sets = K > 0 ? 1 << K : 0;
  std::size_t k, d;
  kernel::Buffer<T, num_sets * K> alpha, tau;      // k per set; those of its own vertices are unused
  kernel::Buffer<T, num_sets * N> centers;         // d per set
  T box = number<T>(1), box_error = number<T>(0);  // D, and its relative error
  T worst = number<T>(0);                          // the largest η

  HWY_INLINE Flags(std::size_t num_edges, std::size_t dimension)
      : k(num_edges),
        d(dimension),
        alpha((std::size_t{1} << k) * k),
        tau((std::size_t{1} << k) * k),
        centers((std::size_t{1} << k) * d) {
    for (std::size_t j = 0; j < d; ++j) centers[j] = number<T>(0);
  }
};

/// The r_w and α_w of a set, and their errors.
template <class T, class Number, int K, int N>
struct Remainders {
  kernel::Buffer<Number, K * N> r;
  kernel::Buffer<Number, K> alpha;
  kernel::Buffer<T, K> epsilon, tau;
  HWY_INLINE Remainders(std::size_t k, std::size_t d) : r(k * d), alpha(k), epsilon(k), tau(k) {}
};

/// Finds what flags has for `set` and for all sets made from it by vertices from `first` on, which come after
/// its own. `unit`: the roundoff of Number.
template <class T, class Number, int K, int N>
void eliminate(Flags<T, K, N>& flags, const T* lambda, double unit, std::size_t set, std::size_t first,
               const Remainders<T, Number, K, N>& from) {
  const std::size_t k = K > 0 ? static_cast<std::size_t>(K) : flags.k,
                    d = N > 0 ? static_cast<std::size_t>(N) : flags.d;
  const std::size_t all = (std::size_t{1} << k) - 1;
  for (std::size_t w = 0; w < k; ++w) {
    if ((set >> w & 1) != 0) continue;
    const T alpha = leading(from.alpha[w]);
    flags.alpha[set * k + w] = alpha;
    flags.tau[set * k + w] = from.tau[w] + kernel::unit_roundoff * abs(alpha);
  }
  for (std::size_t v = first; v < k; ++v) {
    const std::size_t with = set | std::size_t{1} << v;
    const Number* const along = from.r.data() + v * d;
    const Number square = dot(along, along, d);
    const T length = root(leading(square)), eta = from.epsilon[v] / length;
    const T step = leading(from.alpha[v]) / leading(square);
    for (std::size_t j = 0; j < d; ++j)
      flags.centers[with * d + j] = flags.centers[set * d + j] + step * leading(along[j]);
    flags.worst = max(flags.worst, eta);
    if (set + 1 == std::size_t{1} << v) {  // the order 0, 1, …
      flags.box = flags.box * length;
      flags.box_error = flags.box_error + (eta + static_cast<double>(d + 2) * kernel::unit_roundoff);
    }
    if (with == all) continue;
    const T spread = eta + static_cast<double>(2 * d + 5) * unit;
    const T alpha = abs(leading(from.alpha[v])), alpha_per_length = alpha / length;
    Remainders<T, Number, K, N> next(k, d);
    for (std::size_t w = 0; w < k; ++w) {
      if ((with >> w & 1) != 0) continue;
      const Number* const r = from.r.data() + w * d;
      const Number f = quotient(dot(r, along, d), square);
      for (std::size_t j = 0; j < d; ++j) next.r[w * d + j] = r[j] - f * along[j];
      next.alpha[w] = from.alpha[w] - f * from.alpha[v];
      next.epsilon[w] = from.epsilon[w] + lambda[w] * spread;
      const T factor = abs(leading(f));
      next.tau[w] = from.tau[w] + factor * from.tau[v] + alpha_per_length * next.epsilon[w] +
                    unit * (2.0 * (factor * alpha) + abs(leading(next.alpha[w])));
    }
    eliminate<T, Number, K, N>(flags, lambda, unit, with, v + 1, next);
  }
}

/// Sums up all pieces, and calls write(i, number) for what is computed of a cell. `squares`: |e_i|².
template <class T, int K, int N, class Write>
void sum_flags(const Flags<T, K, N>& flags, const T* squares, Write write) {
  const std::size_t k = K > 0 ? static_cast<std::size_t>(K) : flags.k,
                    d = N > 0 ? static_cast<std::size_t>(N) : flags.d;
  const std::size_t all = (std::size_t{1} << k) - 1;
  constexpr int num_sets = Flags<T, K, N>::num_sets;
  kernel::Buffer<T, num_sets> values(all + 1), sizes(all + 1), errors(all + 1);
  kernel::Buffer<T, num_sets * N> moments((all + 1) * d);
  values[all] = sizes[all] = number<T>(1);
  errors[all] = number<T>(0);
  for (std::size_t j = 0; j < d; ++j)  // the center of an edge has its share elsewhere
    moments[all * d + j] = k > 1 ? flags.centers[all * d + j] : number<T>(0);
  for (std::size_t set = all; set-- > 0;) {
    T value = number<T>(0), size = value, error = value;
    T* const moment = moments.data() + set * d;
    for (std::size_t j = 0; j < d; ++j) moment[j] = number<T>(0);
    for (std::size_t w = 0; w < k; ++w) {
      if ((set >> w & 1) != 0) continue;
      const std::size_t with = set | std::size_t{1} << w;
      const T alpha = flags.alpha[set * k + w], magnitude = abs(alpha);
      value = value + alpha * values[with];
      size = size + magnitude * sizes[with];
      error = error + (magnitude * errors[with] + flags.tau[set * k + w] * (sizes[with] + errors[with]));
      for (std::size_t j = 0; j < d; ++j) moment[j] = moment[j] + alpha * moments[with * d + j];
    }
    const int num_in = std::popcount(set);
    const double share = 1 / static_cast<double>(static_cast<int>(k) - num_in);
    values[set] = share * value;
    sizes[set] = share * size;
    errors[set] = share * error;
    for (std::size_t j = 0; j < d; ++j) {
      moment[j] = share * moment[j];
      if (num_in > 1) moment[j] = moment[j] + values[set] * flags.centers[set * d + j];
    }
  }
  const T inverse = number<T>(1) / flags.box;
  for (std::size_t i = 0; i < k; ++i) write(i, squares[i] * values[std::size_t{1} << i] * inverse);
  const T per_simplex = 1 / static_cast<double>(k + 1) * inverse;
  for (std::size_t j = 0; j < d; ++j) write(k + j, moments[j] * per_simplex);
  const T size = sizes[0] * inverse;
  write(k + d, size);
  const double roundings = static_cast<double>(k * (k + 3) + 8) * kernel::unit_roundoff;
  const T error = slack * (errors[0] * inverse + size * (flags.box_error + roundings));
  const Mask<T> is_valid =
      both(flags.box > least_box, both(flags.worst < most_relative, flags.box_error < most_relative));
  write(k + d + 1, select(is_valid, error, number<T>(std::numeric_limits<double>::infinity())));
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::particles
HWY_AFTER_NAMESPACE();

#endif
