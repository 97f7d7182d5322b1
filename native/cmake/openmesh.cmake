# SPDX-License-Identifier: GPL-3.0-or-later
# For systems that package no OpenMesh: the part of its core that meshes without files need, as a static library.
set(openmesh_core ${MRC_OPENMESH_SOURCE}/src/OpenMesh/Core)
add_library(OpenMeshCore STATIC
    ${openmesh_core}/Mesh/ArrayKernel.cc
    ${openmesh_core}/Mesh/BaseKernel.cc
    ${openmesh_core}/Mesh/PolyConnectivity.cc
    ${openmesh_core}/Mesh/TriConnectivity.cc
    ${openmesh_core}/System/omstream.cc
    ${openmesh_core}/Utils/BaseProperty.cc
    ${openmesh_core}/Utils/Endian.cc)
target_include_directories(OpenMeshCore SYSTEM PUBLIC ${MRC_OPENMESH_SOURCE}/src)
target_compile_definitions(OpenMeshCore PUBLIC OM_STATIC_BUILD _USE_MATH_DEFINES)
