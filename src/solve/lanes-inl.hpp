// SPDX-License-Identifier: BSD-3-Clause
// The numbers of the solver: a double, or a SIMD vector of Highway with one problem per lane. A template on
// the number type T is one text for both. A double in an expression with vectors stands for a vector of it.
// The order of operations is the same for both, and none is fused, so each lane has the bits of the double.
// Included once for each instruction set, after hwy/highway.h.
#if defined(DELONE_SOLVE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef DELONE_SOLVE_LANES_INL
#undef DELONE_SOLVE_LANES_INL
#else
#define DELONE_SOLVE_LANES_INL
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace delone::solve {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class T>
inline constexpr bool is_one_lane = std::is_same_v<T, double>;

template <class V>
concept Vector = requires {
  typename hn::DFromV<V>;
};

template <class T>
HWY_INLINE T number(double x) {
  if constexpr (is_one_lane<T>)
    return x;
  else
    return hn::Set(hn::DFromV<T>(), x);
}

/// What a comparison gives: bool, or one for each lane.
template <class T>
using Mask = decltype(std::declval<T>() < std::declval<T>());

/// Keeps the operators below from being considered for two built-in numbers. A concept would be checked too
/// late: clang 14 forms the operator first, and refuses one of two built-in numbers.
template <class V>
using IfVector = std::enable_if_t<!std::is_arithmetic_v<V>, hn::DFromV<V>>;

template <class V, class = IfVector<V>>
HWY_INLINE V operator*(double a, V b) {
  return number<V>(a) * b;
}
template <class V, class = IfVector<V>>
HWY_INLINE V operator+(V a, double b) {
  return a + number<V>(b);
}
template <class V, class = IfVector<V>>
HWY_INLINE auto operator<(V a, double b) {
  return a < number<V>(b);
}
template <class V, class = IfVector<V>>
HWY_INLINE auto operator<=(V a, double b) {
  return a <= number<V>(b);
}
template <class V, class = IfVector<V>>
HWY_INLINE auto operator>(V a, double b) {
  return a > number<V>(b);
}
template <class V, class = IfVector<V>>
HWY_INLINE auto operator>=(V a, double b) {
  return a >= number<V>(b);
}
template <class V, class = IfVector<V>>
HWY_INLINE auto operator==(V a, double b) {
  return a == number<V>(b);
}

HWY_INLINE double minus(double x) { return -x; }
HWY_INLINE double abs(double x) { return std::fabs(x); }
HWY_INLINE double root(double x) { return std::sqrt(x); }
HWY_INLINE double max(double a, double b) { return std::max(a, b); }
HWY_INLINE double min(double a, double b) { return std::min(a, b); }
HWY_INLINE double select(bool first, double a, double b) { return first ? a : b; }
HWY_INLINE bool both(bool a, bool b) { return a && b; }
HWY_INLINE bool either(bool a, bool b) { return a || b; }

HWY_INLINE auto minus(Vector auto x) { return hn::Neg(x); }
HWY_INLINE auto abs(Vector auto x) { return hn::Abs(x); }
HWY_INLINE auto root(Vector auto x) { return hn::Sqrt(x); }
template <Vector V>
HWY_INLINE V max(V a, V b) {
  return hn::Max(a, b);
}
template <Vector V>
HWY_INLINE V min(V a, V b) {
  return hn::Min(a, b);
}
template <Vector V>
HWY_INLINE V select(Mask<V> first, V a, V b) {
  return hn::IfThenElse(first, a, b);
}
template <class M>
HWY_INLINE M both(M a, M b) {
  return hn::And(a, b);
}
template <class M>
HWY_INLINE M either(M a, M b) {
  return hn::Or(a, b);
}

template <class T>
HWY_INLINE bool all(Mask<T> mask) {
  if constexpr (is_one_lane<T>)
    return mask;
  else
    return hn::AllTrue(hn::DFromV<T>(), mask);
}

/// The bits of a number, or the same bits in each lane.
template <class T>
HWY_INLINE auto bits_of(T x) {
  if constexpr (is_one_lane<T>)
    return std::bit_cast<std::uint64_t>(x);
  else
    return hn::BitCast(hn::RebindToUnsigned<hn::DFromV<T>>(), x);
}
template <class T>
HWY_INLINE auto bits(std::uint64_t x) {
  if constexpr (is_one_lane<T>)
    return x;
  else
    return hn::Set(hn::RebindToUnsigned<hn::DFromV<T>>(), x);
}
template <class T>
using Bits = decltype(bits<T>(0));
template <class T>
HWY_INLINE T number_of(Bits<T> x) {
  if constexpr (is_one_lane<T>)
    return std::bit_cast<double>(x);
  else
    return hn::BitCast(hn::DFromV<T>(), x);
}
/// These bits where the mask says so, and zeros elsewhere.
template <class T>
HWY_INLINE Bits<T> bits_where(Mask<T> mask, std::uint64_t x) {
  if constexpr (is_one_lane<T>)
    return mask ? x : 0;
  else
    return hn::IfThenElseZero(hn::RebindMask(hn::RebindToUnsigned<hn::DFromV<T>>(), mask), bits<T>(x));
}

/// The bits of both: ±0 if and only if both are.
template <class T>
HWY_INLINE T either_bits(T a, T b) {
  return number_of<T>(bits_of(a) | bits_of(b));
}

/// 2^e and 2^(−e−1) for 2^e ≤ x < 2^(e+1). REQUIRES 2^−1000 ≤ x ≤ 2^1000.
template <class T>
struct Powers {
  T power, scale;
};
template <class T>
HWY_INLINE Powers<T> powers_of_two(T x) {
  const Bits<T> power = bits_of(x) & bits<T>(std::uint64_t{0x7ff} << 52);  // by biased exponents
  return {number_of<T>(power), number_of<T>(bits<T>(std::uint64_t{2045} << 52) - power)};
}

/// high + low.
template <class T>
struct Pair {
  T high, low;
};

/// a + b exactly, barring overflow (Knuth, The Art of Computer Programming 2, section 4.2.2).
template <class T>
HWY_INLINE Pair<T> two_sum(T a, T b) {
  const T sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a·b exactly, barring underflow and factors beyond 2^990 (Dekker 1971, doi:10.1007/BF01397083). FMA, where
/// the processor has it, gives the same pair.
template <class T>
HWY_INLINE Pair<T> two_product(T a, T b) {
  const T product = a * b;
#if HWY_NATIVE_FMA
  if constexpr (!is_one_lane<T>) return {product, hn::MulSub(a, b, product)};
#endif
  const auto split = [](T x) {
    const T scaled = (0x1p27 + 1) * x, high = scaled - (scaled - x);
    return Pair<T>{high, x - high};
  };
  const Pair<T> x = split(a), y = split(b);
  return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::solve
HWY_AFTER_NAMESPACE();

#endif
