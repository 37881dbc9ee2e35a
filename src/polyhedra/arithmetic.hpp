// SPDX-License-Identifier: BSD-3-Clause
// The three kinds of integers that rays are computed with: of 64 bits, of 128 bits, and of any size. Every
// operation is exact or says that the numbers are too large for it; the caller repeats its step with the next
// kind then. What may overflow is known from bounds beforehand, so sums need no check of their own.
#pragma once

#include "kernel/fractions.hpp"
#include "kernel/int128.hpp"
#include "polyhedra/common_divisor.hpp"
#include "polyhedra/exact_quotients.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::polyhedra {

inline int bit_length(const Int128& x) {
  const internal::TwoWords size = kernel::magnitude(x);
  return size.high != 0 ? 64 + std::bit_width(size.high) : std::bit_width(size.low);
}
inline int bit_length(const Integer& x) {
  return x == 0 ? 0 : static_cast<int>(boost::multiprecision::msb(boost::multiprecision::abs(x))) + 1;
}

/// Σ a[i]·x[i]. REQUIRES that neither products nor partial sums overflow a Sum.
template <class Sum, class T>
Sum sum_of_products(const T* a, const T* x, std::size_t d) {
  Sum sum = 0;
  for (std::size_t i = 0; i < d; ++i) sum += static_cast<Sum>(a[i]) * static_cast<Sum>(x[i]);
  return sum;
}

template <class T>
int sign_of(const T& x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// What rays and rows of entries of type T need. `Product`: a scalar product of a row and a ray.
///   most_bits_of_rows, most_bits     of the entries of rows and of rays
///   set_rows(bits, d)                says how many bits the entries of rows have at most, and the dimension
///   try_convert(integer, x)          x = integer, if it is small enough for a ray
///   sign_of_open(row, ray, d)        the sign of the scalar product, which find_signs() has left open
///   try_product(row, ray, d, sum)    sum = the scalar product, if it fits
///   try_combine(p, n, at_p, at_n, divisor, d, out)   out = (at_p·n + at_n·p)/c, where at_p and at_n are
///                                    positive, for some c > 0 that divides all entries: `divisor` if it
///                                    does, or their greatest common divisor. A divisor of 0 is not tried.
///                                    `out` is unspecified if it says no.
///   make_primitive(x, d)             divides by the greatest common divisor
template <class T>
class Arithmetic;

/// Entries below 2^58. The sum of 2^10 products is below 2^126.
template <>
class Arithmetic<std::int64_t> {
 public:
  using Product = Int128;
  static constexpr int most_bits = 58, most_bits_of_rows = most_bits;
  static constexpr std::size_t largest_dimension = 1024;

  void set_rows(int, std::size_t) {}
  static bool try_convert(const Integer& integer, std::int64_t& x) {
    if (bit_length(integer) > most_bits) return false;
    x = static_cast<std::int64_t>(integer);
    return true;
  }
  static int sign_of_open(const std::int64_t* a, const std::int64_t* x, std::size_t d) {
    return sign_of(sum_of_products<Int128>(a, x, d));
  }
  static bool try_product(const std::int64_t* a, const std::int64_t* x, std::size_t d, Int128& sum) {
    sum = sum_of_products<Int128>(a, x, d);
    return true;
  }
  bool try_combine(const std::int64_t* p, const std::int64_t* n, Int128 at_p, Int128 at_n,
                   const Int128& divisor, std::size_t d, std::int64_t* out) {
    const auto try_divisor = [&] {
      return divisor > 1 && try_exact_quotients(p, n, at_p, at_n, divisor, d, most_bits, out);
    };
    if (std::max(bit_length(at_p), bit_length(at_n)) > 63 && try_divisor()) return true;
    const Int128 common = common_divisor(at_p, at_n), factor_of_n = at_p / common,
                 factor_of_p = at_n / common;
    if (bit_length(factor_of_n) > 63 || bit_length(factor_of_p) > 63) return false;
    sums_.resize(d);
    std::uint64_t high = 0, low = 0;
    for (std::size_t i = 0; i < d; ++i) {  // below 2^(63 + 58 + 1)
      sums_[i] = factor_of_n * n[i] + factor_of_p * p[i];
      const internal::TwoWords size = kernel::magnitude(sums_[i]);
      high |= size.high;
      low |= size.low;
    }
    if (high == 0 && std::bit_width(low) < 64) return try_divide_small(out);
    return try_divisor() || try_divide(out);
  }
  static void make_primitive(std::int64_t* x, std::size_t d) {
    std::uint64_t content = 0;
    for (std::size_t i = 0; i < d && content != 1; ++i)
      content = std::gcd(content, kernel::magnitude(x[i]).low);
    if (content > 1)
      for (std::size_t i = 0; i < d; ++i) x[i] /= static_cast<std::int64_t>(content);
  }

 private:
  bool try_divide_small(std::int64_t* out) const {
    std::uint64_t content = 0;
    for (std::size_t i = 0; i < sums_.size() && content != 1; ++i)
      content = std::gcd(content, kernel::magnitude(sums_[i]).low);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      out[i] = static_cast<std::int64_t>(sums_[i]);
      if (content > 1) out[i] /= static_cast<std::int64_t>(content);
      if (std::bit_width(kernel::magnitude(out[i]).low) > most_bits) return false;
    }
    return true;
  }
  bool try_divide(std::int64_t* out) const {
    Int128 content = 0;
    for (std::size_t i = 0; i < sums_.size() && content != 1; ++i)
      content = common_divisor(content, sums_[i] < 0 ? Int128(-sums_[i]) : sums_[i]);
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const Int128 quotient = sums_[i] / content;
      if (bit_length(quotient) > most_bits) return false;
      out[i] = static_cast<std::int64_t>(quotient);
    }
    return true;
  }

  std::vector<Int128> sums_;
};

/// Rays with entries below 2^124, rows with entries below 2^110. Sums of up to 2^20 products, below 2^254,
/// are of 256 bits where bounds do not show that 128 are enough; what is kept fits 128 bits.
template <>
class Arithmetic<Int128> {
 public:
  using Product = Int128;
  static constexpr int most_bits = 124;
  static constexpr int most_bits_of_rows = 110;
  static constexpr std::size_t largest_dimension = std::size_t{1} << 20;

  /// What binary64 leaves open is at most (d + 8)·2^−50 times the sum of a row's magnitudes times the largest
  /// entry of the ray (sign_kernel.cpp).
  void set_rows(int bits_of_rows, std::size_t d) {
    bits_of_rows_ = bits_of_rows;
    const int bits_of_dimension = std::bit_width(d + 8);
    are_open_sums_small_ = bits_of_rows + most_bits + 2 * bits_of_dimension - 50 <= most_bits_of_sum;
  }
  static bool try_convert(const Integer& integer, Int128& x) {
    if (bit_length(integer) > most_bits) return false;
    x = static_cast<Int128>(integer);
    return true;
  }
  int sign_of_open(const Int128* a, const Int128* x, std::size_t d) const {
    return are_open_sums_small_ ? sign_of(sum_modulo(a, x, d)) : sign_of(sum_of_products<Wide>(a, x, d));
  }
  bool try_product(const Int128* a, const Int128* x, std::size_t d, Int128& sum) const {
    if (bits_of_rows_ + most_bits_of(x, d) + std::bit_width(d) > most_bits_of_sum && !is_sum_small(a, x, d))
      return false;
    sum = sum_modulo(a, x, d);
    return true;
  }
  bool try_combine(const Int128* p, const Int128* n, Int128 at_p, Int128 at_n, const Int128& divisor,
                   std::size_t d, Int128* out) {
    if (divisor > 1 && try_exact_quotients(p, n, at_p, at_n, divisor, d, most_bits, out)) return true;
    const Int128 common = common_divisor(at_p, at_n);
    at_p /= common;
    at_n /= common;
    const int bits = std::max(bit_length(at_p) + most_bits_of(n, d), bit_length(at_n) + most_bits_of(p, d));
    return bits < most_bits_of_sum ? try_combine_as(p, n, at_p, at_n, d, out, sums_)
                                   : try_combine_as(p, n, Wide(at_p), Wide(at_n), d, out, wide_sums_);
  }
  static void make_primitive(Int128* x, std::size_t d) {
    Int128 content = 0;
    for (std::size_t i = 0; i < d && content != 1; ++i)
      content = common_divisor(content, x[i] < 0 ? Int128(-x[i]) : x[i]);
    if (content > 1)
      for (std::size_t i = 0; i < d; ++i) x[i] /= content;
  }

 private:
  using Wide = boost::multiprecision::number<
      boost::multiprecision::cpp_int_backend<256, 256, boost::multiprecision::signed_magnitude,
                                             boost::multiprecision::unchecked, void>,
      boost::multiprecision::et_off>;
  static constexpr int most_bits_of_sum = 126;

  static int most_bits_of(const Int128* x, std::size_t d) {
    std::uint64_t high = 0, low = 0;
    for (std::size_t i = 0; i < d; ++i) {
      const internal::TwoWords size = kernel::magnitude(x[i]);
      high |= size.high;
      low |= size.low;
    }
    return high != 0 ? 64 + std::bit_width(high) : std::bit_width(low);
  }
  static int bits_of(const Int128& x) { return bit_length(x); }
  static int bits_of(const Wide& x) {
    return x == 0 ? 0 : static_cast<int>(boost::multiprecision::msb(Wide(boost::multiprecision::abs(x)))) + 1;
  }

  /// Whether the sum is below 2^126, as binary64 shows: its error is at most (d + 8)·2^−52 times the sum of
  /// the magnitudes (as in sign_kernel.cpp).
  static bool is_sum_small(const Int128* a, const Int128* x, std::size_t d) {
    double sum = 0, magnitudes = 0;
    for (std::size_t i = 0; i < d; ++i) {
      const double product = static_cast<double>(a[i]) * static_cast<double>(x[i]);
      sum += product;
      magnitudes += std::abs(product);
    }
    return std::abs(sum) + (static_cast<double>(d) + 8) * 0x1p-51 * magnitudes < 0x1p125;
  }
  /// The sum, which REQUIRES that it is below 2^126. Partial sums may be larger: they are right modulo 2^128.
  static Int128 sum_modulo(const Int128* a, const Int128* x, std::size_t d) {
#if DELONE_HAS_INT128
    internal::BuiltInUInt128 sum = 0;
    for (std::size_t i = 0; i < d; ++i)
      sum += static_cast<internal::BuiltInUInt128>(a[i]) * static_cast<internal::BuiltInUInt128>(x[i]);
    return static_cast<Int128>(sum);
#else
    return static_cast<Int128>(sum_of_products<Wide>(a, x, d));
#endif
  }

  /// The content is that of the first entries nearly always: the others are tested for that, which is quick.
  template <class Sum>
  static Sum content_of(const std::vector<Sum>& sums) {
    Sum content = 0;
    for (const Sum& sum : sums) {
      if (sum == 0) continue;
      const Sum rest = content == 0 ? sum : Sum(sum % content);
      if (rest != 0) content = divisor(content, rest < 0 ? Sum(-rest) : rest);
      if (content == 1) break;
    }
    return content;
  }
  static Int128 divisor(const Int128& a, const Int128& b) { return common_divisor(a, b); }
  static Wide divisor(const Wide& a, const Wide& b) { return boost::multiprecision::gcd(a, b); }

  template <class Sum>
  static bool try_combine_as(const Int128* p, const Int128* n, const Sum& at_p, const Sum& at_n,
                             std::size_t d, Int128* out, std::vector<Sum>& sums) {
    sums.resize(d);
    for (std::size_t i = 0; i < d; ++i)
      sums[i] = at_p * static_cast<Sum>(n[i]) + at_n * static_cast<Sum>(p[i]);
    const Sum content = content_of(sums);
    for (std::size_t i = 0; i < d; ++i) {
      if (content != 1) sums[i] /= content;
      if (bits_of(sums[i]) > most_bits) return false;
      out[i] = static_cast<Int128>(sums[i]);
    }
    return true;
  }

  int bits_of_rows_ = 0;
  bool are_open_sums_small_ = false;
  std::vector<Int128> sums_;
  std::vector<Wide> wide_sums_;
};

/// Entries of any size.
template <>
class Arithmetic<Integer> {
 public:
  using Product = Integer;
  static constexpr std::size_t largest_dimension = static_cast<std::size_t>(-1);

  static constexpr int most_bits_of_rows = std::numeric_limits<int>::max();

  void set_rows(int, std::size_t) {}
  static bool try_convert(const Integer& integer, Integer& x) {
    x = integer;
    return true;
  }
  static int sign_of_open(const Integer* a, const Integer* x, std::size_t d) {
    return product(a, x, d).sign();
  }
  static bool try_product(const Integer* a, const Integer* x, std::size_t d, Integer& sum) {
    sum = product(a, x, d);
    return true;
  }
  static bool try_combine(const Integer* p, const Integer* n, const Integer& at_p, const Integer& at_n,
                          const Integer& divisor, std::size_t d, Integer* out) {
    if (divisor > 1 && try_exact_quotients(p, n, at_p, at_n, divisor, d, out)) return true;
    const Integer common = common_divisor(at_p, at_n), factor_of_n = at_p / common,
                  factor_of_p = at_n / common;
    Integer content = 0;
    for (std::size_t i = 0; i < d; ++i) {
      out[i] = factor_of_n * n[i] + factor_of_p * p[i];
      if (content != 1 && out[i] != 0) content = common_divisor(content, out[i]);
    }
    if (content != 1)
      for (std::size_t i = 0; i < d; ++i) out[i] /= content;
    return true;
  }
  static void make_primitive(Integer* x, std::size_t d) {
    Integer content = 0;
    for (std::size_t i = 0; i < d && content != 1; ++i) content = common_divisor(content, x[i]);
    if (content > 1)
      for (std::size_t i = 0; i < d; ++i) x[i] /= content;
  }

 private:
  static bool try_exact_quotients(const Integer* p, const Integer* n, const Integer& at_p,
                                  const Integer& at_n, const Integer& divisor, std::size_t d, Integer* out) {
    Integer rest;
    for (std::size_t i = 0; i < d; ++i) {
      const Integer sum = at_p * n[i] + at_n * p[i];
      boost::multiprecision::divide_qr(sum, divisor, out[i], rest);
      if (rest != 0) return false;
    }
    return true;
  }
  static Integer product(const Integer* a, const Integer* x, std::size_t d) {
    Integer sum = 0;
    for (std::size_t i = 0; i < d; ++i)
      if (a[i] != 0 && x[i] != 0) sum += a[i] * x[i];
    return sum;
  }
};

}  // namespace delone::polyhedra
