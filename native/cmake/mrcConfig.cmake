# SPDX-License-Identifier: GPL-3.0-or-later
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(OpenMesh CONFIG)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/mrcTargets.cmake)
