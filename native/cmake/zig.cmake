# SPDX-License-Identifier: GPL-3.0-or-later
# Linux with glibc 2.28 or later and macOS 11 or later, with the clang, the C++ library and the glibc of Zig. MRC_ZIG is its
# program; MRC_PLATFORM is linux-x64, linux-arm64, macos-x64 or macos-arm64.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MRC_ZIG MRC_PLATFORM)
if(MRC_PLATFORM MATCHES "^linux-")
    set(CMAKE_SYSTEM_NAME Linux)
    set(zig_system linux-gnu.2.28)
    # Operators new and delete of the C++ library are not hidden by default; those of Blender must not come between them.
    set(CMAKE_MODULE_LINKER_FLAGS_INIT "-Wl,--version-script=${CMAKE_CURRENT_LIST_DIR}/exports.map")
else()
    set(CMAKE_SYSTEM_NAME Darwin)
    set(zig_system macos.11.0)
    set(CMAKE_INSTALL_NAME_TOOL :)  # Darwin has it, but nothing is installed
endif()
if(MRC_PLATFORM MATCHES "-arm64$")
    set(CMAKE_SYSTEM_PROCESSOR aarch64)
else()
    set(CMAKE_SYSTEM_PROCESSOR x86_64)
endif()

# ccache cannot tell from the name of the program that this is a clang.
find_program(CCACHE ccache)
if(CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_COMPILERTYPE=clang ${CCACHE})
endif()

# Zig builds its C++ library at first use, once for each level of optimization and for each choice about debug information:
# always with these flags, also where CMake tries the compiler.
set(CMAKE_CXX_COMPILER ${MRC_ZIG} c++ -target ${CMAKE_SYSTEM_PROCESSOR}-${zig_system} -O3 -s)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_AR ${MRC_ZIG})
set(CMAKE_RANLIB ${MRC_ZIG})
set(CMAKE_CXX_ARCHIVE_CREATE "<CMAKE_AR> ar qc <TARGET> <LINK_FLAGS> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_APPEND "<CMAKE_AR> ar q <TARGET> <LINK_FLAGS> <OBJECTS>")
set(CMAKE_CXX_ARCHIVE_FINISH "<CMAKE_RANLIB> ranlib <TARGET>")
