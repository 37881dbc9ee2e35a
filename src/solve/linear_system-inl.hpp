// SPDX-License-Identifier: BSD-3-Clause
// Solutions of small linear systems with certified bounds, for centers of spheres, smallest orthospheres and
// common points of hyperplanes. With an approximate inverse R of A, α ≥ ‖I − R·A‖∞ and the residual ρ = b −
// A·x⁰ of x⁰ = R·b, known as ρ̃ up to e,
//
//     |x − x⁰ − R·ρ̃|_j ≤ α·ζ + t_j,   t_j = Σ_i |R_ji|·(e_i + (n+2)u·|ρ̃_i|),   ζ = max_j(|R·ρ̃|_j + t_j)/(1 − α).
//
// If both ends of this interval round to one double, that double is the result. The proof is in
// docs/predicates.md, "Small linear systems". T: double, or a SIMD vector with one system per lane. Included
// once for each instruction set, after hwy/highway.h.
#if defined(DELONE_SOLVE_LINEAR_SYSTEM_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DELONE_SOLVE_LINEAR_SYSTEM_INL
#undef DELONE_SOLVE_LINEAR_SYSTEM_INL
#else
#define DELONE_SOLVE_LINEAR_SYSTEM_INL
#endif

#include "kernel/buffer.hpp"
#include "kernel/linear_bound.hpp"
#include "solve/lanes-inl.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace delone::solve {
namespace HWY_NAMESPACE {

/// An approximate inverse of a, for N = 0 of n×n entries: by cofactors for N = 2, 3, otherwise by
/// elimination, which exchanges rows of a double alone. False where the matrix was found to be singular;
/// entries may be infinite or NaN, which no bound accepts.
template <int N, class T>
HWY_INLINE bool invert(const T* a, T* inverse, [[maybe_unused]] std::size_t n) {
  if constexpr (N == 1) {
    inverse[0] = number<T>(1) / a[0];
  } else if constexpr (is_one_lane<T>) {
    kernel::Buffer<double, N * N> work(n * n);
    std::copy_n(a, n * n, work.data());
    return kernel::approximate_inverse<N>(work.data(), inverse, n);
  } else if constexpr (N == 2) {
    const T scale = number<T>(1) / (a[0] * a[3] - a[1] * a[2]);
    inverse[0] = a[3] * scale;
    inverse[1] = minus(a[1]) * scale;
    inverse[2] = minus(a[2]) * scale;
    inverse[3] = a[0] * scale;
  } else if constexpr (N == 3) {
    const auto minor = [](T p, T q, T r, T s) { return p * q - r * s; };
    const T c0 = minor(a[4], a[8], a[5], a[7]), c1 = minor(a[5], a[6], a[3], a[8]),
            c2 = minor(a[3], a[7], a[4], a[6]);
    const T scale = number<T>(1) / (a[0] * c0 + a[1] * c1 + a[2] * c2);
    inverse[0] = c0 * scale;
    inverse[1] = minor(a[2], a[7], a[1], a[8]) * scale;
    inverse[2] = minor(a[1], a[5], a[2], a[4]) * scale;
    inverse[3] = c1 * scale;
    inverse[4] = minor(a[0], a[8], a[2], a[6]) * scale;
    inverse[5] = minor(a[2], a[3], a[0], a[5]) * scale;
    inverse[6] = c2 * scale;
    inverse[7] = minor(a[1], a[6], a[0], a[7]) * scale;
    inverse[8] = minor(a[0], a[4], a[1], a[3]) * scale;
  } else {
    // Gauss–Jordan in place: after step s, columns 0 … s are those of the inverse.
    std::copy_n(a, N * N, inverse);
    for (int s = 0; s < N; ++s) {
      const T scale = number<T>(1) / inverse[s * N + s];
      inverse[s * N + s] = number<T>(1);
      for (int c = 0; c < N; ++c) inverse[s * N + c] = inverse[s * N + c] * scale;
      for (int r = 0; r < N; ++r) {
        if (r == s) continue;
        const T factor = inverse[r * N + s];
        inverse[r * N + s] = number<T>(0);
        for (int c = 0; c < N; ++c) inverse[r * N + c] = inverse[r * N + c] - factor * inverse[s * N + c];
      }
    }
  }
  return true;
}

/// As kernel::inverse_defect(), infinite if it is not below 1.
template <int N, class T>
HWY_INLINE T inverse_defect(const T* a, const T* inverse, std::size_t n) {
  if constexpr (is_one_lane<T>) {
    return kernel::inverse_defect<N>(a, inverse, n);
  } else {
    constexpr double relative = 1.01 * static_cast<double>(2 * N + 4) * kernel::unit_roundoff;
    T largest = number<T>(0);
    for (int i = 0; i < N; ++i) {
      T row = number<T>(1e-290), magnitudes = number<T>(1);
      for (int j = 0; j < N; ++j) {
        T entry = number<T>(i == j ? 1 : 0);
        for (int m = 0; m < N; ++m) {
          const T product = inverse[i * N + m] * a[m * N + j];
          entry = entry - product;
          magnitudes = magnitudes + abs(product);
        }
        row = row + abs(entry);
      }
      row = row + relative * magnitudes;
      largest = select(row < 1, max(largest, row), number<T>(std::numeric_limits<double>::infinity()));
    }
    return largest;
  }
}

/// N equations A·x = b, or a number of them chosen at run time: N = 0, for doubles only.
template <class T, int N>
class LinearSystem {
 public:
  explicit LinearSystem(std::size_t size)
      : a(size * size),
        inverse(size * size),
        b(size),
        x(size),
        residual(size),
        error(size),
        correction(size),
        radius(size),
        size_(size) {}

  std::size_t size() const { return N > 0 ? static_cast<std::size_t>(N) : size_; }

  /// Sets `inverse`, alpha and x⁰. Certain are lanes with α < 1/2, entries of the inverse below
  /// `most_of_inverse` and of x⁰ below `most`.
  HWY_INLINE Mask<T> solve(double most_of_inverse, double most) {
    const std::size_t n = size();
    [[maybe_unused]] const bool is_regular = invert<N>(a.data(), inverse.data(), n);
    alpha = inverse_defect<N>(a.data(), inverse.data(), n);
    Mask<T> certain = alpha < 0.5;
    if constexpr (is_one_lane<T>)
      if (!is_regular || !certain) return false;
    for (std::size_t j = 0; j < n; ++j) {
      x[j] = number<T>(0);
      for (std::size_t i = 0; i < n; ++i) {
        x[j] = x[j] + inverse[j * n + i] * b[i];
        certain = both(certain, abs(inverse[j * n + i]) < most_of_inverse);
      }
      certain = both(certain, abs(x[j]) < most);
    }
    return certain;
  }

  /// Sets `correction` and `radius`: the solution is x⁰ + correction, up to the radius. REQUIRES `residual`,
  /// and `error`, which bounds its errors. `underflow` is more than what is lost to underflow.
  HWY_INLINE void correct(double underflow) {
    const std::size_t n = size();
    T zeta = number<T>(0);
    for (std::size_t j = 0; j < n; ++j) {
      correction[j] = radius[j] = number<T>(0);
      for (std::size_t i = 0; i < n; ++i) {
        const T part = error[i] + (static_cast<double>(n + 2) * u) * abs(residual[i]);
        correction[j] = correction[j] + inverse[j * n + i] * residual[i];
        radius[j] = radius[j] + abs(inverse[j * n + i]) * part;
      }
      radius[j] = 1.01 * radius[j] + underflow;
      zeta = max(zeta, abs(correction[j]) + radius[j]);
    }
    zeta = zeta * (number<T>(1.01) / (number<T>(1) - alpha));
    for (std::size_t j = 0; j < n; ++j) radius[j] = 1.01 * (alpha * zeta + radius[j]);
  }

  kernel::Buffer<T, N * N> a, inverse;  ///< row by row; no entry of A is above 1 in magnitude
  kernel::Buffer<T, N> b, x, residual, error, correction, radius;
  T alpha;

 private:
  static constexpr double u = kernel::unit_roundoff;
  std::size_t size_;
};

/// Σ_j a_j·(a_j − z_j) − w for a_j = high_j + low_j, and a bound on its error.
template <class T>
struct Residual {
  T value, error;
};
template <class T>
HWY_INLINE Residual<T> sphere_residual(std::size_t d, const T* high, const T* low, const T* z,
                                       const Pair<T>& weight) {
  constexpr double u = kernel::unit_roundoff;
  const double second_order = 1.01 * 5 * static_cast<double>((d + 3) * (d + 3)) * u * u;
  T sum = minus(weight.high), rest = minus(weight.low), magnitude = abs(weight.high);
  for (std::size_t j = 0; j < d; ++j) {
    const T a = high[j], a_low = low[j];
    const Pair<T> factor = two_sum(a, minus(z[j]));
    const T factor_low = factor.low + a_low;
    const Pair<T> product = two_product(a, factor.high), next = two_sum(sum, product.high);
    sum = next.high;
    rest = rest + ((next.low + product.low) + (a * factor_low + a_low * factor.high));
    magnitude = magnitude + abs(a) * (abs(a) + abs(z[j]));
  }
  const T value = sum + rest;
  return {value, (1.01 * u * abs(value) + second_order * magnitude) + 1e-280};
}

/// The double nearest to a number within `radius` of start + correction, where that is settled: both ends of
/// the interval `radius` around it round to this value.
template <class T>
struct Nearest {
  T value, radius;
  Mask<T> is_settled;
};
template <class T>
HWY_INLINE Nearest<T> nearest_double(const Pair<T>& start, T correction, T radius) {
  constexpr double u = kernel::unit_roundoff;
  const T middle = start.low + correction;
  const Pair<T> sum = two_sum(start.high, middle);
  // `middle` is a rounded sum, and so are the ends of the interval.
  radius = (radius + 2 * u * abs(middle)) + 4 * u * abs(sum.low);
  return {sum.high, radius, sum.high + (sum.low - radius) == sum.high + (sum.low + radius)};
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::solve
HWY_AFTER_NAMESPACE();

#endif
