// SPDX-License-Identifier: BSD-3-Clause
// Integers of 128 bits for the exact stages: of the compiler, or of Boost.Multiprecision where it has none.
#pragma once

#include "base/compiler.hpp"

#include <cstdint>

#if !DELONE_HAS_INT128
#include <boost/multiprecision/cpp_int.hpp>
#endif

namespace delone::kernel {

#if DELONE_HAS_INT128

using internal::BuiltInUInt128;
using Int128 = internal::BuiltInInt128;

/// |x|
inline internal::TwoWords magnitude(Int128 x) {
  const BuiltInUInt128 size = x < 0 ? -static_cast<BuiltInUInt128>(x) : static_cast<BuiltInUInt128>(x);
  return {static_cast<std::uint64_t>(size), static_cast<std::uint64_t>(size >> 64)};
}

#else

/// Holds what has fewer than 128 bits, and a sign.
using Int128 = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<128, 128, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

/// |x|
inline internal::TwoWords magnitude(const Int128& x) {
  const Int128 size = x < 0 ? Int128(-x) : x;
  return {static_cast<std::uint64_t>(size & ~std::uint64_t{0}), static_cast<std::uint64_t>(size >> 64)};
}

#endif

}  // namespace delone::kernel
