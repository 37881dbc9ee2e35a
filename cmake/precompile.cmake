# SPDX-License-Identifier: BSD-3-Clause
# delone_precompile(<target> <header>...): headers of other libraries that most files of the target include, compiled once.
# Nothing of this project is precompiled. CMAKE_DISABLE_PRECOMPILE_HEADERS (the preset dev has it) shows whether each file
# still includes what it uses.
function(delone_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    # Otherwise ccache refuses whatever uses a precompiled header. None of these headers depends on the time.
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime;${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
endfunction()
