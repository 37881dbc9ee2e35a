// SPDX-License-Identifier: BSD-3-Clause
// What a shared library of delone exports. The rest of the library is compiled with hidden visibility.
#pragma once

#include <delone/config.hpp>

/// Before a function, or between `class` and the name: what is defined in the library and called from outside
/// of it. DELONE_EXPORT_TYPE is for types without such functions, which are the same type on both sides: they
/// can be caught, and be arguments of templates that are exported.
#if defined(_WIN32)
#if defined(DELONE_BUILD)  // set by CMake for the sources of a shared library
#define DELONE_EXPORT __declspec(dllexport)
#elif DELONE_SHARED && \
    !defined(DELONE_INTERNALS)  // the same headers, used with the static library of the tests
#define DELONE_EXPORT __declspec(dllimport)
#else
#define DELONE_EXPORT
#endif
#define DELONE_EXPORT_TYPE
#define DELONE_HIDDEN
#elif defined(__GNUC__)
#define DELONE_EXPORT __attribute__((visibility("default")))
#define DELONE_EXPORT_TYPE __attribute__((visibility("default")))
#define DELONE_HIDDEN __attribute__((visibility("hidden")))
#else
#define DELONE_EXPORT
#define DELONE_EXPORT_TYPE
#define DELONE_HIDDEN
#endif
