# SPDX-License-Identifier: BSD-3-Clause
# Cross compilers of Debian, for CMAKE_SYSTEM_PROCESSOR: libraries are those that tools/make_sysroot.sh unpacked, and programs of the
# build are run by QEMU.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_LIBRARY_ARCHITECTURE ${CMAKE_SYSTEM_PROCESSOR}-linux-gnu)
set(CMAKE_C_COMPILER ${CMAKE_LIBRARY_ARCHITECTURE}-gcc)
set(CMAKE_CXX_COMPILER ${CMAKE_LIBRARY_ARCHITECTURE}-g++)
get_filename_component(delone_sysroots ${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH ${delone_sysroots}/${CMAKE_SYSTEM_PROCESSOR} /usr/${CMAKE_LIBRARY_ARCHITECTURE})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# The C and C++ libraries of the cross compiler.
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${CMAKE_SYSTEM_PROCESSOR}-static -L /usr/${CMAKE_LIBRARY_ARCHITECTURE})
