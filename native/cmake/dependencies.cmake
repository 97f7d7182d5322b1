# SPDX-License-Identifier: GPL-3.0-or-later
# MRC_DEPENDENCIES is a folder filled by native/dependencies.py, for systems without packages of Eigen and OpenMesh and for
# self-contained libraries. Only the part of the OpenMesh core that does not deal with files is compiled in.
cmake_path(ABSOLUTE_PATH MRC_DEPENDENCIES BASE_DIRECTORY ${PROJECT_SOURCE_DIR} NORMALIZE)
set(Eigen3_ROOT ${MRC_DEPENDENCIES}/eigen)

# On Windows the C++ runtime is linked statically too: Blender preloads an old one, and Python alone provides none.
set(CMAKE_MSVC_RUNTIME_LIBRARY MultiThreaded$<$<CONFIG:Debug>:Debug>)

set(openmesh_core ${MRC_DEPENDENCIES}/openmesh/src/OpenMesh/Core)
add_library(OpenMeshCore STATIC
    ${openmesh_core}/Mesh/ArrayKernel.cc
    ${openmesh_core}/Mesh/BaseKernel.cc
    ${openmesh_core}/Mesh/PolyConnectivity.cc
    ${openmesh_core}/Mesh/TriConnectivity.cc
    ${openmesh_core}/System/omstream.cc
    ${openmesh_core}/Utils/BaseProperty.cc
    ${openmesh_core}/Utils/Endian.cc)
set_target_properties(OpenMeshCore PROPERTIES UNITY_BUILD OFF)
target_include_directories(OpenMeshCore SYSTEM PUBLIC ${MRC_DEPENDENCIES}/openmesh/src)
target_compile_definitions(OpenMeshCore PUBLIC OM_STATIC_BUILD _USE_MATH_DEFINES)
