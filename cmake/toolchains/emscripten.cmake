# SPDX-License-Identifier: BSD-3-Clause
# WebAssembly by emscripten, of Debian or of its own SDK. Programs that the build runs, and tests, run in Node. Other libraries come from
# build/emscripten-packages (tools/build_cross_packages.sh).
find_program(DELONE_EMCC emcc REQUIRED)
file(REAL_PATH ${DELONE_EMCC} DELONE_EMCC)
cmake_path(GET DELONE_EMCC PARENT_PATH delone_emscripten)
if(NOT EXISTS ${delone_emscripten}/cmake)  # Debian's programs call those in here
  set(delone_emscripten /usr/share/emscripten)
endif()
get_filename_component(delone_emscripten_packages ${CMAKE_CURRENT_LIST_DIR}/../../build/emscripten-packages ABSOLUTE)
# Exceptions of WebAssembly instead of those that emscripten makes of JavaScript's; vectors of 128 bits.
set(CMAKE_C_FLAGS_INIT "-fwasm-exceptions -msimd128")
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -msimd128 -isystem ${CMAKE_CURRENT_LIST_DIR}/emscripten")
set(CMAKE_FIND_ROOT_PATH ${delone_emscripten_packages}/installed)
include(${delone_emscripten}/cmake/Modules/Platform/Emscripten.cmake)
