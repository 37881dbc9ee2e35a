// SPDX-License-Identifier: BSD-3-Clause
// Prefetching, if the compiler offers it: GCC, Clang and compatible ones.
#pragma once

#include <delone/config.hpp>

// The intrinsic of MSVC is declared in <xmmintrin.h>, which declares thousands of names; public headers do
// without.

namespace delone::internal {

/// Asks the processor to load the cache line of an address, which will be read soon. Any address may be
/// given. No effect on results.
#if !DELONE_PORTABLE && defined(__GNUC__)
[[gnu::always_inline]] inline void prefetch(const void* address) { __builtin_prefetch(address); }
#else
// Nothing is prefetched.

inline void prefetch(const void*) {}
#endif

}  // namespace delone::internal
