# SPDX-License-Identifier: BSD-3-Clause
# Options of the build. A parent project that adds this one by add_subdirectory gets the library only.
option(DELONE_64BIT_IDS "Use 64-bit ids for vertices and cells" OFF)
option(DELONE_BUILD_CLI "Build the command `delone`" ${PROJECT_IS_TOP_LEVEL})
option(DELONE_BUILD_PYTHON "Build the Python module `delone` (needs pybind11, and a Python with NumPy)" OFF)
option(DELONE_INSTALL "Install rules and the CMake package" ${PROJECT_IS_TOP_LEVEL})
option(DELONE_DEVELOPER_MODE "Build the tests and the examples" OFF)
option(DELONE_BUILD_BENCHMARKS "Build the programs of benchmarks/internal, and of benchmarks/rivals, one for each peer that is installed (some of those are GPL)" OFF)
option(DELONE_OPTIMIZE_TESTS "Compile the tests of a release build with its full optimisation, which takes twice as long" OFF)
option(DELONE_FUZZ "Build the fuzz targets with libFuzzer (needs clang)" OFF)
option(DELONE_WERROR "Treat warnings as errors" ${DELONE_DEVELOPER_MODE})
set(DELONE_LARGEST_COMPILED_DIMENSION 8 CACHE STRING
  "Engines are compiled for 1 … this dimension (8 at most); larger ones use the engine whose dimension is a variable")
set(DELONE_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, for example address,undefined")

if(NOT DELONE_LARGEST_COMPILED_DIMENSION MATCHES "^[1-8]$")
  message(FATAL_ERROR "DELONE_LARGEST_COMPILED_DIMENSION is 1 to 8")
endif()
if(DELONE_64BIT_IDS)
  set(DELONE_64BIT_IDS_VALUE 1)
else()
  set(DELONE_64BIT_IDS_VALUE 0)
endif()
