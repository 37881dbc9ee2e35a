# SPDX-License-Identifier: BSD-3-Clause
# A build from nothing compiles many sources together: what they include is then parsed once, and templates that they share are compiled
# once. That takes half of the time. Names in anonymous namespaces differ among sources that are compiled together.
# In the preset dev each source is compiled by itself, so that it includes what it uses.

# delone_unite(<target> <files> [ACROSS_FOLDERS]): compiles the sources of a folder together, in parts of equal size of at most so many
# files; with ACROSS_FOLDERS those of all folders, in the order of their names. A source with compile options of its own, and one that
# Highway compiles for several instruction sets, stays alone.
function(delone_unite target files)
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
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
    if("ACROSS_FOLDERS" IN_LIST ARGN)
      set(folder ${CMAKE_CURRENT_SOURCE_DIR}/all)
    endif()
    list(APPEND folders ${folder})
    string(MAKE_C_IDENTIFIER "${folder}" key)
    list(APPEND sources_${key} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder ${folders})
    string(MAKE_C_IDENTIFIER "${folder}" key)
    list(LENGTH sources_${key} number)
    math(EXPR parts "(${number} + ${files} - 1) / ${files}")
    file(RELATIVE_PATH name ${CMAKE_CURRENT_SOURCE_DIR} ${folder})
    set(index 0)
    foreach(source ${sources_${key}})
      math(EXPR part "${index} * ${parts} / ${number}")
      math(EXPR index "${index} + 1")
      string(MAKE_C_IDENTIFIER "${name}_${part}" group)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# delone_unite_made(<target> <name> <source>...): adds sources to the target, joined in the file <name>.cpp, which CMake makes. They may be
# for several instruction sets.
function(delone_unite_made target name)
  set(sources ${ARGN})
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    set(joined ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    list(TRANSFORM sources REPLACE "(.+)" "#include \"\\1\"\n")
    string(JOIN "" content "#define HWY_TARGET_INCLUDE \"${joined}\"\n" ${sources})
    set(sources ${joined})
    file(CONFIGURE OUTPUT ${sources} CONTENT "${content}" @ONLY)
  endif()
  target_sources(${target} PRIVATE ${sources})
endfunction()
