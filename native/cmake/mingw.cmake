# SPDX-License-Identifier: GPL-3.0-or-later
# Windows x86-64 with Debian's g++-mingw-w64-x86-64-posix. Everything is linked statically, so that nothing but Windows and Python
# is needed, and no time stamp is written, so that builds are reproducible.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CXX_FLAGS_INIT "-Wa,-mbig-obj -Wno-restrict")  # GCC 12 gives that warning wrongly where strings are joined (PR 105651)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -s -Wl,--no-insert-timestamp")
set(CMAKE_MODULE_LINKER_FLAGS_INIT "-static -s -Wl,--no-insert-timestamp")
