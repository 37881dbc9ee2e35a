// SPDX-License-Identifier: BSD-3-Clause
// Prefetching, where the compiler offers it: GCC, Clang and those that follow them.
#pragma once

#include <delone/config.hpp>

// The intrinsic of MSVC is declared in <xmmintrin.h>, which declares thousands of names; public headers do
// without.

namespace delone::internal {

/// Lets the processor fetch the cache line of an address, to be read soon. Any address may be given. No
/// effect on results.
#if !DELONE_PORTABLE && defined(__GNUC__)
[[gnu::always_inline]] inline void prefetch(const void* address) { __builtin_prefetch(address); }
#else
// Nothing is prefetched.

inline void prefetch(const void*) {}
#endif

}  // namespace delone::internal
