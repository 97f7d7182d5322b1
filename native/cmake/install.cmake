# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install BUILD [--prefix PREFIX] installs the core library, its headers and license, and the files for find_package(mrc),
# but nothing for Python.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(mrc_package_directory ${CMAKE_INSTALL_LIBDIR}/cmake/mrc)
install(TARGETS mrc EXPORT mrc)
install(DIRECTORY native/include/mrc DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.h)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/mrc)
install(EXPORT mrc NAMESPACE mrc:: FILE mrcTargets.cmake DESTINATION ${mrc_package_directory})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mrcConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES native/cmake/mrcConfig.cmake ${PROJECT_BINARY_DIR}/mrcConfigVersion.cmake DESTINATION ${mrc_package_directory})
