// SPDX-License-Identifier: BSD-3-Clause
// Prefetching, where the compiler offers it: GCC, Clang and those that follow them, and MSVC on x86-64.
#pragma once

#include <delone/config.hpp>

#if !DELONE_PORTABLE && !defined(__GNUC__) && defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace delone::internal {

/// Lets the processor fetch the cache line of an address, to be read soon. Any address may be given. No
/// effect on results.
#if !DELONE_PORTABLE && defined(__GNUC__)
[[gnu::always_inline]] inline void prefetch(const void* address) { __builtin_prefetch(address); }
#elif !DELONE_PORTABLE && defined(_M_X64)
inline void prefetch(const void* address) { _mm_prefetch(static_cast<const char*>(address), _MM_HINT_T0); }
#else
inline void prefetch(const void*) {}
#endif

}  // namespace delone::internal
