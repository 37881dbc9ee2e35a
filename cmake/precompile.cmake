# SPDX-License-Identifier: BSD-3-Clause
# delone_precompile(<target> <header>...): headers of other libraries that most files of the target include, compiled once.
# No header of this project is precompiled. With CMAKE_DISABLE_PRECOMPILE_HEADERS (in the preset dev) a file that does not include
# what it uses fails to compile.
function(delone_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    # Without this, ccache does not cache files that use a precompiled header. None of these headers depends on the time.
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime;${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
endfunction()
