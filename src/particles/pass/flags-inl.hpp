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
#include <type_traits>

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
/// Divides by b.
template <class T>
class Divisor {
 public:
  HWY_INLINE explicit Divisor(const T& b) : inverse_(number<T>(1) / b) {}
  HWY_INLINE T operator()(const T& a) const { return a * inverse_; }
  HWY_INLINE T inverse() const { return inverse_; }

 private:
  T inverse_;
};
/// Off by less than 2⁻¹⁰⁰ of the quotient: the second digit makes up for what the first leaves.
template <>
class Divisor<kernel::DoubleDouble> {
 public:
  HWY_INLINE explicit Divisor(const kernel::DoubleDouble& b) : b_(b) {}
  HWY_INLINE kernel::DoubleDouble operator()(const kernel::DoubleDouble& a) const {
    const double first = a.high / b_.high;
    const kernel::DoubleDouble rest = a - b_ * kernel::DoubleDouble{first, 0};
    return kernel::two_sum(first, rest.high / b_.high);
  }
  HWY_INLINE double inverse() const { return 1 / b_.high; }

 private:
  kernel::DoubleDouble b_;
};
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
  kernel::Buffer<T, num_sets * N> steps;           // d per set: its center less that without its last vertex
  T box = number<T>(1), box_error = number<T>(0);  // D, and its relative error
  T worst = number<T>(0);                          // the largest η

  HWY_INLINE Flags(std::size_t num_edges, std::size_t dimension)
      : k(num_edges),
        d(dimension),
        alpha((std::size_t{1} << k) * k),
        tau((std::size_t{1} << k) * k),
        steps((std::size_t{1} << k) * d) {}
};

/// The r_w and α_w of a set, and their errors.
template <class T, class Number, int K, int N>
struct Remainders {
  kernel::Buffer<Number, K * N> r;
  kernel::Buffer<Number, K> alpha;
  kernel::Buffer<T, K> epsilon, tau;
  HWY_INLINE Remainders(std::size_t k, std::size_t d) : r(k * d), alpha(k), epsilon(k), tau(k) {}
};

/// A number that is known at compile time, or any other.
template <std::size_t I>
using Constant = std::integral_constant<std::size_t, I>;
template <class I>
inline constexpr bool is_constant = !std::is_same_v<I, std::size_t>;

/// Loops begin with this: with a constant for the dimension that is worth so much code.
template <int K>
using Zero = std::conditional_t<K == 4, Constant<0>, std::size_t>;

/// Calls body(i) for i = first … size − 1; for constants up to Size − 1, with constants.
template <int Size, class First, class Body>
HWY_INLINE void for_numbers(First first, std::size_t size, const Body& body) {
  if constexpr (!is_constant<First>) {
    for (std::size_t i = first; i < size; ++i) body(i);
  } else if constexpr (First::value < static_cast<std::size_t>(Size)) {
    body(first);
    for_numbers<Size>(Constant<First::value + 1>(), size, body);
  }
}
template <class Set, class V>
HWY_INLINE auto joined(Set set, V v) {
  if constexpr (is_constant<Set>)
    return Constant<(Set::value | std::size_t{1} << V::value)>();
  else
    return set | std::size_t{1} << v;
}
template <class V>
HWY_INLINE auto after(V v) {
  if constexpr (is_constant<V>)
    return Constant<V::value + 1>();
  else
    return v + 1;
}

/// Finds what flags has for `set` and for all sets made from it by vertices from `first` on, which come after
/// its own. `unit`: the roundoff of Number. Constants for both make one long piece of code of it.
template <class T, class Number, int K, int N, class Set, class First>
void eliminate(Flags<T, K, N>& flags, const T* lambda, double unit, Set set, First first,
               const Remainders<T, Number, K, N>& from) {
  const std::size_t k = K > 0 ? static_cast<std::size_t>(K) : flags.k,
                    d = N > 0 ? static_cast<std::size_t>(N) : flags.d;
  const std::size_t all = (std::size_t{1} << k) - 1;
  for (std::size_t w = 0; w < k; ++w) {
    if ((set >> w & 1) != 0) continue;
    const T alpha = leading(from.alpha[w]);
    flags.alpha[set * k + w] = alpha;
    flags.tau[set * k + w] = from.tau[w];
    if constexpr (!std::is_same_v<T, Number>)  // α is rounded
      flags.tau[set * k + w] = from.tau[w] + kernel::unit_roundoff * abs(alpha);
  }
  for_numbers<K>(first, k, [&](auto v) {
    const auto with = joined(set, v);
    const Number* const along = from.r.data() + v * d;
    const Number square = dot(along, along, d);
    const Divisor<Number> divided(square);
    const T length = root(leading(square)), inverse_length = length * divided.inverse(),
            eta = from.epsilon[v] * inverse_length;
    const T alpha = leading(from.alpha[v]), step = alpha * divided.inverse();
    for (std::size_t j = 0; j < d; ++j) flags.steps[with * d + j] = step * leading(along[j]);
    flags.worst = max(flags.worst, eta);
    if (set + 1 == std::size_t{1} << v) {  // the order 0, 1, …
      flags.box = flags.box * length;
      flags.box_error = flags.box_error + (eta + static_cast<double>(d + 2) * kernel::unit_roundoff);
    }
    if (with == all) return;
    const T spread = eta + static_cast<double>(2 * d + 5) * unit;
    const T alpha_per_length = abs(alpha) * inverse_length, own = from.tau[v] + (2.0 * unit) * abs(alpha);
    Remainders<T, Number, K, N> next(k, d);
    for (std::size_t w = 0; w < k; ++w) {
      if ((with >> w & 1) != 0) continue;
      const Number* const r = from.r.data() + w * d;
      const Number f = divided(dot(r, along, d));
      for (std::size_t j = 0; j < d; ++j) next.r[w * d + j] = r[j] - f * along[j];
      next.alpha[w] = from.alpha[w] - f * from.alpha[v];
      next.epsilon[w] = from.epsilon[w] + lambda[w] * spread;
      next.tau[w] = from.tau[w] + abs(leading(f)) * own + alpha_per_length * next.epsilon[w] +
                    unit * abs(leading(next.alpha[w]));
    }
    eliminate<T, Number, K, N>(flags, lambda, unit, with, after(v), next);
  });
}

/// Sums up all pieces, and calls write(i, number) for what is computed of a cell. `squares`: |e_i|².
///
/// Let u(F) be the sum of Π α/(k − |·|) over all ways from ∅ to F. The moment is the sum of u(F)·v(F)·c_F
/// over |F| ≥ 2; and c_F is a sum of steps, over the sets that F begins with.
template <class T, int K, int N, class Write>
void sum_flags(const Flags<T, K, N>& flags, const T* squares, Write write) {
  const std::size_t k = K > 0 ? static_cast<std::size_t>(K) : flags.k,
                    d = N > 0 ? static_cast<std::size_t>(N) : flags.d;
  const std::size_t all = (std::size_t{1} << k) - 1;
  constexpr int num_sets = Flags<T, K, N>::num_sets;
  kernel::Buffer<T, num_sets> values(all + 1), sizes(all + 1), errors(all + 1), both_of(all + 1);
  const auto share_of = [&](std::size_t set) {
    return 1 / static_cast<double>(static_cast<int>(k) - std::popcount(set));
  };
  values[all] = sizes[all] = both_of[all] = number<T>(1);
  errors[all] = number<T>(0);
  for_numbers<num_sets - 1>(Zero<K>(), all, [&](auto place) {
    const std::size_t set = all - 1 - place;
    T value = number<T>(0), size = value, error = value;
    for_numbers<K>(Zero<K>(), k, [&](auto w) {
      if ((set >> w & 1) != 0) return;
      const std::size_t with = set | std::size_t{1} << w;
      const T alpha = flags.alpha[set * k + w], magnitude = abs(alpha);
      value = value + alpha * values[with];
      size = size + magnitude * sizes[with];
      error = error + (magnitude * errors[with] + flags.tau[set * k + w] * both_of[with]);
    });
    const double share = share_of(set);
    values[set] = share * value;
    sizes[set] = share * size;
    errors[set] = share * error;
    both_of[set] = sizes[set] + errors[set];
  });
  kernel::Buffer<T, num_sets> ways(all + 1), weights(all + 1);
  ways[0] = number<T>(1);
  for_numbers<num_sets - 1>(Zero<K>(), all, [&](auto place) {
    const std::size_t set = place + 1;
    T sum = number<T>(0);
    for_numbers<K>(Zero<K>(), k, [&](auto w) {
      if ((set >> w & 1) == 0) return;
      const std::size_t without = set & ~(std::size_t{1} << w);
      sum = sum + ways[without] * flags.alpha[without * k + w];
    });
    ways[set] = share_of(set & (set - 1)) * sum;
  });
  kernel::Buffer<T, N> moment(d);
  for (std::size_t j = 0; j < d; ++j) moment[j] = number<T>(0);
  for_numbers<num_sets - 1>(Zero<K>(), all, [&](auto place) {
    const std::size_t set = all - place;
    T weight = std::popcount(set) > 1 ? ways[set] * values[set] : number<T>(0);
    for_numbers<K>(Zero<K>(), k, [&](auto w) {
      if (set < std::size_t{1} << w) weight = weight + weights[set | std::size_t{1} << w];
    });
    weights[set] = weight;
    for (std::size_t j = 0; j < d; ++j) moment[j] = moment[j] + weight * flags.steps[set * d + j];
  });
  const T inverse = number<T>(1) / flags.box;
  for (std::size_t i = 0; i < k; ++i) write(i, squares[i] * values[std::size_t{1} << i] * inverse);
  const T per_simplex = 1 / static_cast<double>(k + 1) * inverse;
  for (std::size_t j = 0; j < d; ++j) write(k + j, moment[j] * per_simplex);
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
