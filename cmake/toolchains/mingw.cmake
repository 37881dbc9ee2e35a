# SPDX-License-Identifier: BSD-3-Clause
# 64-bit Windows from Debian, by mingw-w64 with its POSIX threads, which std::thread needs. Programs that the build runs, and tests,
# run under Wine. Other libraries come from build/mingw-packages (tools/build_cross_packages.sh).
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
get_filename_component(delone_mingw_packages ${CMAKE_CURRENT_LIST_DIR}/../../build/mingw-packages ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32 ${delone_mingw_packages}/installed)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# Programs need no file of the compiler.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-static")
find_program(DELONE_WINE NAMES wine64 wine PATHS /usr/lib/wine)
if(DELONE_WINE)
  set(CMAKE_CROSSCOMPILING_EMULATOR
    ${CMAKE_COMMAND} -E env WINEDEBUG=-all WINEPREFIX=${delone_mingw_packages}/wine ${DELONE_WINE})
endif()
