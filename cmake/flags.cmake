# SPDX-License-Identifier: BSD-3-Clause
# The arithmetic contract and the warnings, as one target that every target of this project links privately.
# Filters are proved for IEEE binary64 with round to nearest, each operation rounded by itself: no contraction, no fast-math.
add_library(delone_flags INTERFACE)
target_compile_features(delone_flags INTERFACE cxx_std_20)
if(MSVC)
  # /fp:precise is that contract, if nothing contracts: without /arch:AVX2 or later it does not. Pragmas and attributes of other
  # compilers (4068, 5030) are meant to be ignored.
  target_compile_options(delone_flags INTERFACE /fp:precise /W4 /utf-8 /bigobj /EHsc /Zc:__cplusplus /Zc:preprocessor /wd4068 /wd5030)
  target_compile_definitions(delone_flags INTERFACE NOMINMAX _CRT_SECURE_NO_WARNINGS)
else()
  # Without -ffp-contract=off, GCC and Clang merge a product and a sum into one operation with one rounding where the processor has it.
  target_compile_options(delone_flags INTERFACE -ffp-contract=off -fno-fast-math -Wall -Wextra -Wpedantic
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow>)  # not of names of another file (unite.cmake)
endif()
if(MINGW)
  # GCC does not align AVX registers that it saves on the stack of Windows (https://gcc.gnu.org/bugzilla/show_bug.cgi?id=54412): the
  # assembler replaces moves that need it. The format of object files has too few sections for templates without -mbig-obj.
  target_compile_options(delone_flags INTERFACE -Wa,-muse-unaligned-vector-move -Wa,-mbig-obj)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC looks for memory that it can use again only beyond half a gigabyte: it compiles in a twelfth less time, with up to 150 MB more.
  target_compile_options(delone_flags INTERFACE --param=ggc-min-heapsize=500000)
endif()
if(DELONE_WERROR)
  target_compile_options(delone_flags INTERFACE $<IF:$<CXX_COMPILER_ID:MSVC>,/WX,-Werror>)
endif()
if(DELONE_SANITIZE)
  target_compile_options(delone_flags INTERFACE -fsanitize=${DELONE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(delone_flags INTERFACE -fsanitize=${DELONE_SANITIZE})
endif()
if(DELONE_FUZZ)  # libFuzzer sees which branches of the library an input takes
  target_compile_options(delone_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
# -O2 makes smaller files than -O3, in four fifths of the time. Kernels and engines are compiled with -O3 (src/CMakeLists.txt), which
# unrolls their loops over the dimension: at -O2 a construction executes a fifth more instructions.
if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_FLAGS_RELEASE STREQUAL "-O3 -DNDEBUG")
  set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
  set(DELONE_RELEASE_IS_O2 ON)
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
