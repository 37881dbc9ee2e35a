# SPDX-License-Identifier: BSD-3-Clause
# With BUILD_SHARED_LIBS delone is a shared library: it exports what the public headers mark with DELONE_EXPORT, and its name has
# the version that its API belongs to. Before 1.0 that is the minor version.
set(DELONE_API_VERSION ${PROJECT_VERSION_MAJOR})
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(DELONE_API_VERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endif()

# delone_exports(<target> <map>): the target exports what the linker's version script lists, made from <map>. Instances of the
# standard library's templates are not hidden by the compiler, nor are the archives that are linked in.
function(delone_exports target map)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${DELONE_API_VERSION})
  if(UNIX AND NOT APPLE AND NOT EMSCRIPTEN AND NOT DELONE_SANITIZE)
    get_filename_component(name ${map} NAME_WLE)
    configure_file(${map} ${CMAKE_CURRENT_BINARY_DIR}/${name} @ONLY)
    target_link_options(${target} PRIVATE -Wl,--version-script=${CMAKE_CURRENT_BINARY_DIR}/${name})
    set_target_properties(${target} PROPERTIES LINK_DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/${name})
  endif()
endfunction()

# delone_from_objects(<target> <type>): a library of that type of the objects of delone.
function(delone_from_objects target type)
  if(NOT EXISTS ${CMAKE_CURRENT_BINARY_DIR}/none.cpp)  # some generators want a source
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/none.cpp "")
  endif()
  add_library(${target} ${type} ${CMAKE_CURRENT_BINARY_DIR}/none.cpp $<TARGET_OBJECTS:delone>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  get_target_property(libraries delone LINK_LIBRARIES)
  get_target_property(folders delone INTERFACE_INCLUDE_DIRECTORIES)
  target_link_libraries(${target} PRIVATE ${libraries})
  target_include_directories(${target} INTERFACE ${folders})
endfunction()

# delone_set_exports(): the visibility of delone, and the target delone::internals for what includes headers of src/: the static
# library, or the objects of the shared one as a static library. What links it does not link delone::delone. For the tests of a static
# library there is a shared one, delone_shared.
function(delone_set_exports)
  set_target_properties(delone PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON DEFINE_SYMBOL DELONE_BUILD)
  if(DELONE_64BIT_IDS)  # names of functions do not tell the width of ids: that of the library does
    set_target_properties(delone PROPERTIES OUTPUT_NAME delone64)
  endif()
  if(DELONE_SHARED)
    delone_exports(delone ${CMAKE_CURRENT_SOURCE_DIR}/exports.map.in)
    delone_from_objects(delone_internals STATIC)
    add_library(delone::internals ALIAS delone_internals)
    set_target_properties(delone_internals PROPERTIES EXPORT_NAME internals EXCLUDE_FROM_ALL ON)
    target_compile_definitions(delone_internals INTERFACE DELONE_INTERNALS)
  else()
    add_library(delone::internals ALIAS delone)
    if(DELONE_DEVELOPER_MODE AND UNIX AND NOT APPLE AND NOT DELONE_SANITIZE)
      delone_from_objects(delone_shared SHARED)
      delone_exports(delone_shared ${CMAKE_CURRENT_SOURCE_DIR}/exports.map.in)
      set_target_properties(delone_shared PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
  endif()
endfunction()
