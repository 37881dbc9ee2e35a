# SPDX-License-Identifier: BSD-3-Clause
# delone_embed_page(<page> <source>): makes a C++ source that holds a page as literals, short enough for every compiler, in two lists:
# what comes before the mark <!--delone:data-->, and what comes after it. Done when CMake runs; it runs again when the page changes.
function(delone_embed_page page source)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
  if(EXISTS ${source} AND NOT ${page} IS_NEWER_THAN ${source} AND NOT ${CMAKE_CURRENT_FUNCTION_LIST_FILE} IS_NEWER_THAN ${source})
    return()
  endif()
  set(mark "<!--delone:data-->\n")
  set(part 12000)
  file(READ ${page} text)
  string(FIND "${text}" "${mark}" end_of_before)
  string(LENGTH "${mark}" length_of_mark)
  math(EXPR start_of_after "${end_of_before} + ${length_of_mark}")
  string(SUBSTRING "${text}" 0 ${end_of_before} before)
  string(SUBSTRING "${text}" ${start_of_after} -1 after)

  file(WRITE ${source} "// Made by CMake of ${page}.\n#include \"view/viewer_page.hpp\"\n\nnamespace delone::view {\nnamespace {\n\nusing namespace std::string_view_literals;\n\n")
  foreach(name IN ITEMS before after)
    string(LENGTH "${${name}}" length)
    file(APPEND ${source} "constexpr std::string_view parts_${name}[] = {\n")
    foreach(start RANGE 0 ${length} ${part})
      string(SUBSTRING "${${name}}" ${start} ${part} literal)
      file(APPEND ${source} "R\"delone_page(" "${literal}" ")delone_page\"sv,\n")
    endforeach()
    file(APPEND ${source} "};\n\n")
  endforeach()
  file(APPEND ${source} "}  // namespace\n\n"
    "std::span<const std::string_view> page_before_data() { return parts_before; }\n"
    "std::span<const std::string_view> page_after_data() { return parts_after; }\n\n}  // namespace delone::view\n")
endfunction()
