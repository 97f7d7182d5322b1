# SPDX-License-Identifier: GPL-3.0-or-later
# MRC_DEPENDENCIES: for systems that package neither Eigen nor OpenMesh, and for libraries that stand on their own: a folder that
# native/dependencies.py filled. Of OpenMesh it has the part of the core that meshes without files need, compiled in.
cmake_path(ABSOLUTE_PATH MRC_DEPENDENCIES BASE_DIRECTORY ${PROJECT_SOURCE_DIR} NORMALIZE)
set(Eigen3_ROOT ${MRC_DEPENDENCIES}/eigen)

# Windows: the C++ runtime is compiled in too, since Blender preloads an old one, and Python alone brings none.
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
