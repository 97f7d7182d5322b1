# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Sourced by tests/run: builds for Windows, and runs Windows' own Python and Blender under Wine.
windows=$build/windows
in_windows_python=("$root/tests/under_wine" "$windows/python/python.exe" -X utf8)
windows_release=4.5  # of Blender

# Windows' Python with what the tests import, and Blender as its module, which decides about the version of NumPy.
make_windows_python() {
    local requirements contents
    mapfile -t requirements < <(printf '%s\n' "${python_requirements[@]}" | grep -E '^(numpy|scipy|matplotlib|pytest|hypothesis)>')
    requirements+=("bpy==$windows_release.*" colorama)  # pytest needs the last on Windows, but pip goes by the system it runs on
    contents=$(printf '%s\n' "$windows" "${embedded_pythons[3.11]}" "${requirements[@]}")
    if [ "$(cat "$windows/contents" 2>/dev/null)" = "$contents" ]; then return 0; fi
    rm -rf "$windows/python" "$windows/contents"
    mkdir -p "$windows"
    get_embedded_python 3.11 && cp -r "$build/python/3.11/windows" "$windows/python" || return 1
    rm "$windows"/python/*._pth  # it would keep PYTHONPATH from having an effect
    say "installing with pip into build/windows/python: ${requirements[*]}"
    logged pip-windows "$venv/bin/python" -m pip install --disable-pip-version-check --target "$windows/python/Lib/site-packages" \
        --platform win_amd64 --python-version 3.11 --only-binary :all: "${requirements[@]}" && echo "$contents" >"$windows/contents"
}

# Builds the packages, and installs the wheels in build/windows/module-PYTHON as pip does on Windows.
make_windows_packages() {
    local version
    "$root/native/package" --output "$windows/packages" windows-x64 || return 1
    for version in "${module_pythons[@]}"; do
        rm -rf "$windows/module-$version"
        logged "windows-wheel-$version" "$venv/bin/python" -m pip install --disable-pip-version-check --no-deps --no-index \
            --find-links "$windows/packages" --target "$windows/module-$version" --platform win_amd64 --python-version "$version" \
            --only-binary :all: mrcontour || return 1
    done
}

# Installs and builds what is needed for tests under Wine, once; if that fails, the part ends.
ensure_windows() {
    if [ "${windows_built:-}" ]; then return 0; fi
    if [ "$(dpkg --print-architecture)" != amd64 ]; then
        say "left out: what runs under Wine, which needs an x86-64 machine"
        record windows 0 0 1
        return 1
    fi
    if ! { install_packages wine wine64 && make_windows_packages && make_windows_python &&
        logged wineboot "$root/tests/under_wine" wineboot; }; then
        record windows-build 0 1 0
        return 1
    fi
    windows_built=yes
}

run_windows_native() {  # SHARD
    local name=windows-native-$1  # GoogleTest takes a path for absolute only with its drive
    suite "$name" env GTEST_TOTAL_SHARDS=2 GTEST_SHARD_INDEX="$1" "$root/tests/under_wine" \
        "$build/platforms/windows-x64/tests/native/mrc_tests.exe" --gtest_brief=1 --gtest_output="xml:Z:$results/$name.xml"
}

# Compiling them takes as long as all else of the part: the usual run tests the same code through the module.
windows_native() {
    local shard
    build_native_tests windows-x64 || { record windows-build 0 1 0; return 0; }
    for shard in 0 1; do background run_windows_native "$shard"; done
    wait
}

windows_module() {
    suite windows-python env PYTHONPATH="$windows/module-3.11" "${in_windows_python[@]}" -m pytest -q --tb=short -p no:cacheprovider \
        -m "$markers" "${few[@]}" --junitxml="$results/windows-python.xml" "$root/tests/python"
}

# The modules need nothing but Windows and their Python. Python 3.13 itself does not start under Wine 8.
windows_libraries() {
    local version needed
    for version in "${module_pythons[@]}"; do
        needed=$(x86_64-w64-mingw32-objdump -p "$windows/module-$version"/mrcontour.*.pyd | sed -n 's/.*DLL Name: //p')
        grep -qx "python${version/./}.dll" <<<"$needed" &&
            ! grep -vixE "python${version/./}\.dll|kernel32\.dll|msvcrt\.dll|ucrtbase\.dll|api-ms-win-crt-.*\.dll" <<<"$needed" || return 1
    done
}

# Installing, upgrading and removing in Windows' Blender: the usual run tests what differs most, files in use.
windows_packages() {
    local selection=(-k "upgrade or restarts")
    if [ "$full" ]; then selection=(); fi
    suite windows-packages "$venv/bin/python" -m pytest -q --tb=short --junitxml="$results/windows-packages.xml" \
        --packages "$windows/packages" --wine "$windows/python" "${selection[@]}" "$root/tests/packages/test_lifecycle.py"
}

# Every tenth of the searches of part `same`, or all, give the same bytes as on Linux.
same_bytes_windows() {
    local every=10 found=$results/fingerprints-windows.txt
    if [ "$full" ]; then every=1; fi
    PYTHONPATH=$windows/module-3.11 "${in_windows_python[@]}" "$root/tests/python/fingerprints.py" "$results/searches.json.xz" \
        --every "$every" >"$found" && [ -s "$found" ] && ! grep -vxFf "$results/fingerprints-dev.txt" "$found"
}

part_windows() {
    ensure_windows || return 0
    local few=(--few=1) addon_selection="-k 'not fuzz and not gallery and not networks'"  # what takes long
    if [ "$full" ]; then few=() addon_selection=; fi
    background blender_suite windows-bpy "$windows"/packages/*-extension-*.zip "${in_windows_python[@]}"
    background windows_module
    background windows_packages
    check windows-libraries windows_libraries
    wait
    if [ "$full" ]; then windows_native; fi
}
