# SPDX-License-Identifier: BSD-3-Clause
# The libraries that delone is made of: those that are installed, or built from pinned sources into the library itself.
# DELONE_FETCH_DEPENDENCIES says which (cmake/options.cmake). To build without a network, unpack the sources and name their folders:
# FETCHCONTENT_SOURCE_DIR_DELONE_HIGHWAY, …_FMT, …_TBB, …_JSON, …_FAST_FLOAT, …_CLI11, …_MULTIPRECISION, …_BOOST_CONFIG.
# Offers hwy::hwy, DELONE_FMT, nlohmann_json::nlohmann_json, CLI11::CLI11, Boost_INCLUDE_DIRS and DELONE_FAST_FLOAT_INCLUDE;
# with DELONE_HAVE_TBB 1, TBB::tbb, and with DELONE_HAVE_ZLIB 1, ZLIB::ZLIB.
include(FetchContent)

set(delone_fetched_libraries "")  # those that a static library of delone needs beside it: installed with it

# delone_needs_fetching(<variable> <found>): whether a dependency is to be fetched.
function(delone_needs_fetching variable found)
  set(${variable} OFF PARENT_SCOPE)
  if(DELONE_FETCH_DEPENDENCIES STREQUAL "ALL" OR (DELONE_FETCH_DEPENDENCIES STREQUAL "MISSING" AND NOT found))
    set(${variable} ON PARENT_SCOPE)
  endif()
endfunction()

# delone_fetch(<name> <url> <sha256>): sets <name>_SOURCE_DIR, and <name>_FETCHED to the version in the URL; the project in there is not
# configured.
macro(delone_fetch name url sha256)
  string(REGEX MATCH "[0-9]+[._][0-9]+[._][0-9]+" ${name}_FETCHED ${url})
  string(REPLACE "_" "." ${name}_FETCHED ${${name}_FETCHED})
  string(TOUPPER "FETCHCONTENT_SOURCE_DIR_${name}" delone_folder_of_sources)
  if(NOT ${delone_folder_of_sources})
    message(STATUS "delone: fetching ${url}")
  endif()
  set(delone_download)
  if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.24)
    set(delone_download DOWNLOAD_EXTRACT_TIMESTAMP OFF)
  endif()
  FetchContent_Declare(${name} URL ${url} URL_HASH SHA256=${sha256} ${delone_download} SOURCE_SUBDIR not_configured)
  FetchContent_MakeAvailable(${name})
endmacro()

# delone_headers(<target> <alias> <folder>): an interface library of headers.
function(delone_headers target alias folder)
  add_library(${target} INTERFACE)
  add_library(${alias} ALIAS ${target})
  target_include_directories(${target} SYSTEM INTERFACE ${folder})
endfunction()

# delone_static(<target> <alias> <folder of headers> <source>...): a static library whose symbols a module does not export.
function(delone_static target alias folder)
  add_library(${target} STATIC ${ARGN})
  add_library(${alias} ALIAS ${target})
  target_include_directories(${target} SYSTEM PUBLIC $<BUILD_INTERFACE:${folder}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# With the option OFF, a library that is not found is an error that names it.
set(delone_required)
if(DELONE_FETCH_DEPENDENCIES STREQUAL "OFF")
  set(delone_required REQUIRED)
endif()

if(NOT DELONE_FETCH_DEPENDENCIES STREQUAL "ALL")
  find_package(Boost 1.70 CONFIG QUIET)  # CMake 3.30 warns of its own module
  if(NOT Boost_FOUND)
    find_package(Boost 1.70 ${delone_required})
  endif()
  find_package(hwy ${delone_required})
  find_package(fmt ${delone_required})
  find_package(nlohmann_json ${delone_required})
  find_path(DELONE_FAST_FLOAT_INCLUDE fast_float/fast_float.h ${delone_required})
  if(DELONE_BUILD_CLI)
    find_package(CLI11 ${delone_required})
  endif()
  if(DELONE_WITH_TBB STREQUAL "AUTO")
    find_package(TBB 2021 QUIET)
  elseif(DELONE_WITH_TBB)
    find_package(TBB 2021 ${delone_required})
  endif()
endif()

delone_needs_fetching(fetch "${Boost_FOUND}")
if(fetch)  # of Boost only what there is of it in use, which stands by itself
  delone_fetch(delone_multiprecision https://github.com/boostorg/multiprecision/archive/refs/tags/Boost_1_89_0.tar.gz
    d6000cc58594fead142eee4bf3a1aec39bf144dcb6accd8f4b8e6d780d258482)
  delone_fetch(delone_boost_config https://github.com/boostorg/config/archive/refs/tags/boost-1.89.0.tar.gz
    a16a53f8f0dde2a9ff485fb134a069e54aca738009d825837dac9a35cd4afe0a)
  set(Boost_INCLUDE_DIRS ${delone_multiprecision_SOURCE_DIR}/include ${delone_boost_config_SOURCE_DIR}/include)
  add_compile_definitions(BOOST_MP_STANDALONE)
endif()

delone_needs_fetching(fetch "${hwy_FOUND}")
if(fetch)
  delone_fetch(delone_highway https://github.com/google/highway/archive/refs/tags/1.0.3.tar.gz
    566fc77315878473d9a6bd815f7de78c73734acdcb745c3dde8579560ac5440e)
  set(folder ${delone_highway_SOURCE_DIR}/hwy)
  delone_static(delone_highway hwy::hwy ${delone_highway_SOURCE_DIR}
    ${folder}/aligned_allocator.cc ${folder}/per_target.cc ${folder}/print.cc ${folder}/targets.cc)
  target_compile_definitions(delone_highway PUBLIC HWY_STATIC_DEFINE)
  list(APPEND delone_fetched_libraries delone_highway)
endif()

delone_needs_fetching(fetch "${fmt_FOUND}")
if(fetch)
  delone_fetch(delone_fmt https://github.com/fmtlib/fmt/archive/refs/tags/9.1.0.tar.gz
    5dea48d1fcddc3ec571ce2058e13910a0d4a6bab4cc09a809d8b1dd1c88ae6f2)
  delone_static(delone_fmt fmt::fmt ${delone_fmt_SOURCE_DIR}/include ${delone_fmt_SOURCE_DIR}/src/format.cc)
  list(APPEND delone_fetched_libraries delone_fmt)
endif()

# As headers fmt takes half of the compile time of every file that formats one message.
set(DELONE_FMT fmt::fmt)
if(DELONE_HEADER_ONLY_FMT)
  set(DELONE_FMT fmt::fmt-header-only)
endif()

delone_needs_fetching(fetch "${nlohmann_json_FOUND}")
if(fetch)
  delone_fetch(delone_json https://github.com/nlohmann/json/archive/refs/tags/v3.11.2.tar.gz
    d69f9deb6a75e2580465c6c4c5111b89c4dc2fa94e3a85fcd2ffcd9a143d9273)
  delone_headers(delone_json nlohmann_json::nlohmann_json ${delone_json_SOURCE_DIR}/include)
endif()

delone_needs_fetching(fetch "${DELONE_FAST_FLOAT_INCLUDE}")
if(fetch)
  delone_fetch(delone_fast_float https://github.com/fastfloat/fast_float/archive/refs/tags/v3.9.0.tar.gz
    a10443e13748291709b422b2da49fc6753a1a43bf24205d4600595dfe3d811bb)
  set(DELONE_FAST_FLOAT_INCLUDE ${delone_fast_float_SOURCE_DIR}/include)
endif()

if(DELONE_BUILD_CLI)
  delone_needs_fetching(fetch "${CLI11_FOUND}")
  if(fetch)
    delone_fetch(delone_cli11 https://github.com/CLIUtils/CLI11/archive/refs/tags/v2.1.2.tar.gz
      26291377e892ba0e5b4972cdfd4a2ab3bf53af8dac1f4ea8fe0d1376b625c8cb)
    delone_headers(delone_cli11 CLI11::CLI11 ${delone_cli11_SOURCE_DIR}/include)
  endif()
endif()

set(DELONE_HAVE_TBB 0)
if(DELONE_WITH_TBB)
  delone_needs_fetching(fetch "${TBB_FOUND}")
  if(fetch)
    # By its own CMake files, in a scope of their own: it needs options of the compiler that they know.
    delone_fetch(delone_tbb https://github.com/oneapi-src/oneTBB/archive/refs/tags/v2021.8.0.tar.gz
      eee380323bb7ce864355ed9431f85c43955faaae9e9bce35c62b372d7ffd9f8b)
    function(delone_add_tbb)
      set(CMAKE_POLICY_DEFAULT_CMP0077 NEW)  # these variables stand for its options
      set(CMAKE_POLICY_VERSION_MINIMUM 3.5)  # CMake 4 refuses its older minimum otherwise
      set(BUILD_SHARED_LIBS OFF)
      set(CMAKE_POSITION_INDEPENDENT_CODE ON)
      foreach(option TBB_TEST TBB_STRICT TBB_EXAMPLES TBBMALLOC_BUILD TBBMALLOC_PROXY_BUILD TBB_ENABLE_IPO)
        set(${option} OFF)
      endforeach()
      add_subdirectory(${delone_tbb_SOURCE_DIR} ${delone_tbb_BINARY_DIR} EXCLUDE_FROM_ALL)
    endfunction()
    delone_add_tbb()
    list(APPEND delone_fetched_libraries tbb)
    set(DELONE_HAVE_TBB 1)
  elseif(TBB_FOUND)
    set(DELONE_HAVE_TBB 1)
  endif()
endif()

# zlib is never fetched: every system has it.
set(DELONE_HAVE_ZLIB 0)
if(DELONE_WITH_ZLIB)
  if(NOT DELONE_WITH_ZLIB STREQUAL "AUTO")
    find_package(ZLIB REQUIRED)
  else()
    find_package(ZLIB QUIET)
  endif()
  if(ZLIB_FOUND)
    set(DELONE_HAVE_ZLIB 1)
  endif()
endif()
