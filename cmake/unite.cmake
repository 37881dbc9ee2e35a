# SPDX-License-Identifier: BSD-3-Clause
# delone_unite(<target> <files>): in builds with tests, compiles the sources of a folder together, up to so many at a time. What they
# include is then parsed once, and templates that they share are compiled once: a fifth of the time less. A source with
# compile options of its own, and one that Highway compiles for several instruction sets, stays alone.
# In the preset dev, and without tests, each source is compiled by itself, so that it includes what it uses.
function(delone_unite target files)
  if(NOT DELONE_DEVELOPER_MODE OR CMAKE_DISABLE_PRECOMPILE_HEADERS)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    cmake_path(GET source PARENT_PATH folder)
    if(NOT source MATCHES "\\.cpp$" OR folder STREQUAL CMAKE_CURRENT_BINARY_DIR)
      continue()
    endif()
    file(STRINGS ${source} several_targets REGEX "hwy/foreach_target" LIMIT_COUNT 1)
    if(several_targets)
      continue()
    endif()
    string(MAKE_C_IDENTIFIER "${folder}" key)
    math(EXPR count_${key} "0${count_${key}} + 1")
    math(EXPR part "(${count_${key}} - 1) / ${files}")
    file(RELATIVE_PATH name ${CMAKE_CURRENT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER "${name}_${part}" group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
