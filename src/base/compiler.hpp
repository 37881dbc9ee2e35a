// SPDX-License-Identifier: BSD-3-Clause
// All that depends on the compiler: what GCC, Clang and those that follow them have beyond the standard, each
// with a fallback in standard C++. DELONE_PORTABLE selects the fallbacks everywhere. Attributes and pragmas
// that a compiler does not know it ignores; they stay where they are.
#pragma once

#include <delone/config.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if !DELONE_PORTABLE && defined(__GNUC__)
#define DELONE_GNU_COMPILER 1
#else
#define DELONE_GNU_COMPILER 0
#endif
#if DELONE_GNU_COMPILER && defined(__SIZEOF_INT128__)
#define DELONE_HAS_INT128 1
#else
#define DELONE_HAS_INT128 0
#endif

namespace delone::internal {

/// Asks the processor to load the cache line of an address, which will be read or written soon. Any address
/// may be given. No effect on results.
#if DELONE_GNU_COMPILER
[[gnu::always_inline]] inline void prefetch(const void* address) { __builtin_prefetch(address); }
[[gnu::always_inline]] inline void prefetch_for_writing(const void* address) {
  __builtin_prefetch(address, 1);
}
#else
inline void prefetch(const void*) {}
inline void prefetch_for_writing(const void*) {}
#endif

/// The bytes of a word in reverse order.
constexpr std::uint64_t byte_swap(std::uint64_t x) {
#if DELONE_GNU_COMPILER
  return __builtin_bswap64(x);
#else
  x = (x & 0x00ff00ff00ff00ff) << 8 | (x >> 8 & 0x00ff00ff00ff00ff);
  x = (x & 0x0000ffff0000ffff) << 16 | (x >> 16 & 0x0000ffff0000ffff);
  return x << 32 | x >> 32;
#endif
}

/// A number of 128 bits without a sign, as two words.
struct TwoWords {
  std::uint64_t low, high;
};

#if DELONE_HAS_INT128
__extension__ typedef __int128 BuiltInInt128;  // NOLINT(modernize-use-using): the extension mark needs it
__extension__ typedef unsigned __int128 BuiltInUInt128;  // NOLINT(modernize-use-using)
#endif

/// a·b + c + d. It never overflows.
constexpr TwoWords multiply_add(std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d = 0) {
#if DELONE_HAS_INT128
  const BuiltInUInt128 sum = static_cast<BuiltInUInt128>(a) * b + c + d;
  return {static_cast<std::uint64_t>(sum), static_cast<std::uint64_t>(sum >> 64)};
#else
  constexpr std::uint64_t half = 0xffffffff;
  const std::uint64_t a0 = a & half, a1 = a >> 32, b0 = b & half, b1 = b >> 32;
  // Each sum is at most (2^32 − 1)² + 2·(2^32 − 1) = 2^64 − 1.
  const std::uint64_t bottom = a0 * b0 + (c & half) + (d & half);
  const std::uint64_t one = a1 * b0 + (c >> 32) + (bottom >> 32);
  const std::uint64_t other = a0 * b1 + (d >> 32) + (one & half);
  return {other << 32 | (bottom & half), a1 * b1 + (one >> 32) + (other >> 32)};
#endif
}

/// a + b + carry, and a − b − carry modulo 2^64 with what was borrowed. REQUIRES carry 0 or 1.
constexpr TwoWords add(std::uint64_t a, std::uint64_t b, std::uint64_t carry) {
#if DELONE_HAS_INT128
  const BuiltInUInt128 sum = static_cast<BuiltInUInt128>(a) + b + carry;
  return {static_cast<std::uint64_t>(sum), static_cast<std::uint64_t>(sum >> 64) & 1};
#else
  const std::uint64_t first = a + b, sum = first + carry;
  return {sum, static_cast<std::uint64_t>(first < a) | static_cast<std::uint64_t>(sum < first)};
#endif
}
constexpr TwoWords subtract(std::uint64_t a, std::uint64_t b, std::uint64_t carry) {
#if DELONE_HAS_INT128
  const BuiltInUInt128 sum = static_cast<BuiltInUInt128>(a) - b - carry;
  return {static_cast<std::uint64_t>(sum), static_cast<std::uint64_t>(sum >> 64) & 1};
#else
  const std::uint64_t first = a - b;
  return {first - carry, static_cast<std::uint64_t>(a < b) | static_cast<std::uint64_t>(first < carry)};
#endif
}

/// N numbers that are loaded, stored and computed with together. With the vectors of GNU compilers these
/// are the operations of the processor; the fallback has those of them that are used, one number at a time.
/// Comparisons give one answer per number, for select().
#if DELONE_GNU_COMPILER

namespace detail {
template <class T, std::size_t N>
struct LanesOf {
  typedef T Type __attribute__((vector_size(N * sizeof(T))));  // NOLINT(modernize-use-using)
};
}  // namespace detail
template <class T, std::size_t N>
using Lanes = typename detail::LanesOf<T, N>::Type;

#else

template <class T, std::size_t N>
struct Lanes {
  std::array<T, N> values;

  constexpr T operator[](std::size_t i) const { return values[i]; }

#define DELONE_LANES_OPERATOR(op)                                   \
  friend constexpr Lanes operator op(Lanes a, const Lanes& b) {     \
    for (std::size_t i = 0; i < N; ++i) a.values[i] = a[i] op b[i]; \
    return a;                                                       \
  }                                                                 \
  friend constexpr Lanes operator op(Lanes a, T b) {                \
    for (std::size_t i = 0; i < N; ++i) a.values[i] = a[i] op b;    \
    return a;                                                       \
  }                                                                 \
  friend constexpr Lanes& operator op##=(Lanes& a, const Lanes& b) { return a = a op b; }
  DELONE_LANES_OPERATOR(+)
  DELONE_LANES_OPERATOR(-)
  DELONE_LANES_OPERATOR(*)
  DELONE_LANES_OPERATOR(|)
  DELONE_LANES_OPERATOR(<<)
#undef DELONE_LANES_OPERATOR

  friend constexpr Lanes operator-(Lanes a) {
    for (T& value : a.values) value = -value;
    return a;
  }

#define DELONE_LANES_COMPARISON(op)                                                  \
  friend constexpr std::array<bool, N> operator op(const Lanes& a, const Lanes& b) { \
    std::array<bool, N> holds{};                                                     \
    for (std::size_t i = 0; i < N; ++i) holds[i] = a[i] op b[i];                     \
    return holds;                                                                    \
  }                                                                                  \
  friend constexpr std::array<bool, N> operator op(const Lanes& a, T b) {            \
    std::array<bool, N> holds{};                                                     \
    for (std::size_t i = 0; i < N; ++i) holds[i] = a[i] op b;                        \
    return holds;                                                                    \
  }
  DELONE_LANES_COMPARISON(==)
  DELONE_LANES_COMPARISON(<)
  DELONE_LANES_COMPARISON(>)
  DELONE_LANES_COMPARISON(<=)
  DELONE_LANES_COMPARISON(>=)
#undef DELONE_LANES_COMPARISON
};

template <class T, std::size_t N>
constexpr Lanes<T, N> select(const std::array<bool, N>& condition, Lanes<T, N> a, const Lanes<T, N>& b) {
  for (std::size_t i = 0; i < N; ++i) a.values[i] = condition[i] ? a[i] : b[i];
  return a;
}

#endif

/// condition ? a : b, for each number.
template <class Condition, class T>
constexpr T select(Condition condition, T a, T b) {
  return condition ? a : b;
}

}  // namespace delone::internal
