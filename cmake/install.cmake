# SPDX-License-Identifier: BSD-3-Clause
# Install rules: the library with its public headers, the command, and a CMake package that offers delone::delone, delone::c if it was built; and delone::mpi
# with its header and command, if it was built.
# The library's dependencies are private; users of a static library need what it links: Highway, fmt, oneTBB and zlib. Those that were
# built from sources are installed with it.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(delone_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/delone)

install(TARGETS delone ${delone_fetched_libraries} EXPORT delone-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/delone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp" PATTERN mpi EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/include/delone/config.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/delone)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY_LICENSES DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(DELONE_BUILD_CLI)
  install(TARGETS delone_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET delone_c)
  install(TARGETS delone_c EXPORT delone-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(FILES ${PROJECT_SOURCE_DIR}/include/delone/delone.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/delone)
endif()
if(TARGET delone_mpi)
  set(delone_mpi_targets delone_mpi)
  if(TARGET delone_internals)
    list(APPEND delone_mpi_targets delone_internals)
  endif()
  install(TARGETS ${delone_mpi_targets} EXPORT delone-mpi-targets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/delone/mpi DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/delone FILES_MATCHING PATTERN "*.hpp")
  if(TARGET delone_mpi_cli)
    install(TARGETS delone_mpi_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
  install(EXPORT delone-mpi-targets NAMESPACE delone:: DESTINATION ${delone_package_dir})
endif()

include(${PROJECT_SOURCE_DIR}/cmake/pkgconfig.cmake)
install(EXPORT delone-targets NAMESPACE delone:: DESTINATION ${delone_package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/delone-config.cmake.in ${PROJECT_BINARY_DIR}/delone-config.cmake
  INSTALL_DESTINATION ${delone_package_dir})
# Before 1.0 a minor version may change the API, so the minor version must match the one requested.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/delone-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/delone-config.cmake ${PROJECT_BINARY_DIR}/delone-config-version.cmake
  DESTINATION ${delone_package_dir})
