# SPDX-License-Identifier: BSD-3-Clause
# delone_manual(<target>): man pages of a command, and completions for bash, zsh and fish, made from its --help and installed in the
# usual places. Needs a Python, and a command that this machine can run; without, they are left out.
find_package(Python3 COMPONENTS Interpreter QUIET)
include(GNUInstallDirs)

function(delone_manual target)
  if(NOT Python3_Interpreter_FOUND OR (CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR))
    message(STATUS "delone: man pages and completions of ${target} are left out")
    return()
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/manual)
  set(script ${PROJECT_SOURCE_DIR}/tools/command_manual.py)
  add_custom_command(OUTPUT ${folder}/made
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${folder}
    COMMAND Python3::Interpreter ${script} ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:${target}> --man ${folder}/man1 --completions ${folder}
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}/made
    DEPENDS ${target} ${script} VERBATIM)
  add_custom_target(${target}_manual ALL DEPENDS ${folder}/made)
  if(DELONE_INSTALL)
    install(DIRECTORY ${folder}/man1/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(DIRECTORY ${folder}/bash/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(DIRECTORY ${folder}/zsh/ DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
    install(DIRECTORY ${folder}/fish/ DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  endif()
endfunction()
