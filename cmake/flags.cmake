# SPDX-License-Identifier: BSD-3-Clause
# The arithmetic contract and the warnings, as one target that every target of this project links privately.
# Filters are proved for IEEE binary64 with round to nearest, each operation rounded by itself: no contraction, no fast-math.
add_library(delone_flags INTERFACE)
target_compile_features(delone_flags INTERFACE cxx_std_20)
target_compile_options(delone_flags INTERFACE -ffp-contract=off -fno-fast-math -Wall -Wextra -Wpedantic -Wshadow)
if(DELONE_WERROR)
  target_compile_options(delone_flags INTERFACE -Werror)
endif()
if(DELONE_SANITIZE)
  target_compile_options(delone_flags INTERFACE -fsanitize=${DELONE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(delone_flags INTERFACE -fsanitize=${DELONE_SANITIZE})
endif()
if(DELONE_FUZZ)  # libFuzzer sees which branches of the library an input takes
  target_compile_options(delone_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
# A parent project that chose no build type gets a library that is optimised none the less, unless its flags say how.
if(NOT PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )-O")
  target_compile_options(delone_flags INTERFACE -O3)
  target_compile_definitions(delone_flags INTERFACE NDEBUG)
endif()
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  message(STATUS "No build type was chosen: using Release")
  set(CMAKE_BUILD_TYPE Release)
endif()
