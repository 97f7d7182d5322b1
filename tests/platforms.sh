# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Sourced by tests/run: runs what is built for Linux where it is oldest, in a root of Debian 11, and for arm64 in an emulator, and
# looks into all wheels, also those for macOS, which cannot run here.
roots=$build/roots
oldest=$roots/oldest  # Debian 11, with glibc 2.31: the oldest release that Debian's servers still have
oldest_packages=(gcc libc6-dev make zlib1g-dev liblzma-dev libffi-dev)  # what compiles Python
arm64=$roots/arm64
emulator=(qemu-aarch64-static -L "$arm64")
platforms_python=3.11
# Under the emulator: the same bytes, exceptions, threads, and what is passed between C++ and Python.
few_module_tests=("$root"/tests/python/test_{bad_input,cancellation,errors,optimize,optimize_all,pickling,same_bytes,two_copies}.py)

# The wheel, and what its tests import, for a Python that pip does not run in.
make_site() {  # FOLDER PACKAGES PLATFORM...
    local requirements platform tags=()
    mapfile -t requirements < <(printf '%s\n' "${python_requirements[@]}" | grep -E '^(numpy|scipy|pytest|hypothesis)>')
    for platform in "${@:3}"; do tags+=(--platform "$platform"); done
    say "installing with pip into ${1#"$root"/}: mrcontour ${requirements[*]}"
    rm -rf "$1"
    logged "pip-$(basename "$1")" "$venv/bin/python" -m pip install --disable-pip-version-check --find-links "$2" --target "$1" "${tags[@]}" \
        --python-version "$platforms_python" --only-binary :all: mrcontour "${requirements[@]}"
}

# CPython is compiled in Debian 11, whose own is older than what the module is for.
make_oldest() {
    if [ -d "$oldest" ]; then return 0; fi
    install_packages mmdebstrap
    get_python_source "$platforms_python"
    say "making: a root of Debian 11, and Python $platforms_python there"
    as_root rm -rf "$oldest.new"
    mkdir -p "$roots"
    logged apt-bullseye apt_update bullseye &&
        logged oldest-root as_root mmdebstrap --variant=minbase --include="${oldest_packages[*]}" bullseye "$oldest.new" \
            "$build"/apt/bullseye/sources/* &&
        as_root cp -r "$build/python/$platforms_python/source" "$oldest.new/python" &&
        logged oldest-python as_root chroot "$oldest.new" sh -c "cd /python && ./configure -q && make -s -j$(nproc)" &&
        as_root mv "$oldest.new" "$oldest"
}

# A copy, so that nothing that runs there can write into the project.
fill_oldest() {
    as_root rm -rf "$oldest"/{project,site,results}
    as_root mkdir "$oldest"/{project,results}
    as_root cp -r "$root"/{CMakeLists.txt,README.md,.github,addon,blend_samples,native,tests} "$oldest/project"
    as_root cp -r "$roots/site-x64" "$oldest/site"
    as_root cp "$build/platforms/linux-x64/tests/native/mrc_tests" "$oldest/project"
}

oldest_suite() {  # NAME COMMAND...
    suite "$1" "$root/tests/in_root" "$oldest" "$results/$1.xml" "${@:2}"
}

# All tests of the module, two cases of each, but not those of the add-on and of documents.
run_in_oldest() {
    if ! { make_oldest && make_site "$roots/site-x64" "$build/packages" manylinux_2_28_x86_64 manylinux_2_17_x86_64 &&
        build_native_tests linux-x64 && fill_oldest; }; then
        record oldest-linux 0 1 0
        return 0
    fi
    oldest_suite oldest-native /project/mrc_tests --gtest_brief=1 --gtest_output=xml:/results/oldest-native.xml
    oldest_suite oldest-python /python/python -m pytest -q --tb=short -p no:cacheprovider -m "not long and not slow" --few=2 \
        --ignore-glob="*/test_addon_*" --ignore-glob="*/test_doc*" --ignore-glob="*/test_clang_tidy.py" \
        --junitxml=/results/oldest-python.xml /project/tests/python
}

# Debian's Python for arm64 with all libraries that it needs, unpacked but not installed.
make_arm64() {
    local apt=(apt_get "${suites[$platforms_python]}" -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o Dir::State::status=/dev/null)
    if [ -d "$arm64" ]; then return 0; fi
    say "unpacking: Python $platforms_python for arm64"
    rm -rf "$arm64.new"
    mkdir -p "$arm64.new"
    logged apt-arm64 apt_update "${suites[$platforms_python]}" &&
        logged apt-arm64-lists "${apt[@]}" update &&
        logged apt-arm64-packages "${apt[@]}" install -y --no-install-recommends --download-only "python$platforms_python" libstdc++6 &&
        logged unpack-arm64 find "$build/apt/${suites[$platforms_python]}/cache/archives" -name '*.deb' -exec dpkg-deb -x {} "$arm64.new" \; &&
        mv "$arm64.new" "$arm64"
}

# Every tenth search gives the same bytes as on this machine.
same_bytes_arm64() {
    { [ -f "$results/searches.json.xz" ] || fingerprints wheel --write "$results/searches.json.xz"; } &&
        fingerprints wheel "$results/searches.json.xz" --every 10 >"$results/fingerprints-x64.txt" &&
        PYTHONPATH=$roots/site-arm64 "${emulator[@]}" "$arm64/usr/bin/python$platforms_python" "$root/tests/python/fingerprints.py" \
            "$results/searches.json.xz" --every 10 >"$results/fingerprints-arm64.txt" &&
        cmp "$results"/fingerprints-{x64,arm64}.txt
}

run_emulated() {
    install_packages qemu-user-static
    if ! { make_arm64 && make_site "$roots/site-arm64" "$build/platform-packages" manylinux_2_28_aarch64 manylinux_2_17_aarch64 &&
        build_native_tests linux-arm64; }; then
        record arm64 0 1 0
        return 0
    fi
    suite arm64-native "${emulator[@]}" "$build/platforms/linux-arm64/tests/native/mrc_tests" --gtest_brief=1 --gtest_filter=-*Slow* \
        --gtest_output="xml:$results/arm64-native.xml"
    suite arm64-python env PYTHONPATH="$roots/site-arm64" "${emulator[@]}" "$arm64/usr/bin/python$platforms_python" -m pytest -q --tb=short \
        -p no:cacheprovider -m "not long and not slow" --few=2 --junitxml="$results/arm64-python.xml" "${few_module_tests[@]}"
    check arm64-same-bytes same_bytes_arm64
}

part_platforms() {
    ensure_packages || return 0
    "$root/native/package" --output "$build/platform-packages" linux-arm64 macos-arm64 macos-x64 || { record platforms-build 0 1 0; return 0; }
    suite platform-packages "$venv/bin/python" -m pytest -q --tb=short --junitxml="$results/platform-packages.xml" \
        --packages "$build/platform-packages" "$root/tests/packages/test_platforms.py"
    run_in_oldest
    run_emulated
}
