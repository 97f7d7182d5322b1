# SPDX-License-Identifier: GPL-3.0-or-later
"""The modules in the wheels need nothing but Python, NumPy and what each system has, and export nothing else."""

import re
import subprocess
import sys
from zipfile import ZipFile

import lief
import packages as maker
from conftest import only
from packaging.utils import parse_wheel_filename

LINUX_LIBRARIES = {"libc.so.6", "libdl.so.2", "libm.so.6", "libpthread.so.0"}
LOADER = re.compile(r"ld-linux-(x86-64\.so\.2|aarch64\.so\.1)")
MACHINES = {
    "linux-x64": lief.ELF.ARCH.X86_64,
    "linux-arm64": lief.ELF.ARCH.AARCH64,
    "macos-x64": lief.MachO.Header.CPU_TYPE.X86_64,
    "macos-arm64": lief.MachO.Header.CPU_TYPE.ARM64,
}
SUFFIXES = {
    "linux-x64": "-x86_64-linux-gnu.so",
    "linux-arm64": "-aarch64-linux-gnu.so",
    "macos-x64": "-darwin.so",
    "macos-arm64": "-darwin.so",
}


def pytest_generate_tests(metafunc):
    for system in ("linux", "macos"):
        if f"{system}_wheel" in metafunc.fixturenames:
            found = sorted(metafunc.config.getoption("packages").resolve().glob("*.whl"))
            chosen = [wheel for wheel in found if maker.read_name(wheel)[2].startswith(system)]
            ids = ["-".join(maker.read_name(wheel)[1:]) for wheel in chosen]
            metafunc.parametrize(f"{system}_wheel", chosen, ids=ids)


def module(wheel):
    """The compiled module of a wheel, after its name is checked."""
    _, python, platform = maker.read_name(wheel)
    with ZipFile(wheel) as content:
        name = only(name for name in content.namelist() if name.startswith("mrcontour."))
        assert name == f"mrcontour.cpython-{python.removeprefix('cp')}{SUFFIXES[platform]}"
        return content.read(name)


def exported(binary):
    return {symbol.name.removeprefix("_") for symbol in binary.exported_symbols}


def test_linux_module_needs_only_the_c_library(linux_wheel):
    binary = lief.ELF.parse(list(module(linux_wheel)))
    assert binary.header.machine_type == MACHINES[maker.read_name(linux_wheel)[2]]
    others = set(binary.libraries) - LINUX_LIBRARIES
    assert all(LOADER.fullmatch(name) for name in others)
    assert {symbol.name for symbol in binary.exported_symbols} == {"PyInit_mrcontour"}


def test_linux_wheel_works_with_the_c_library_that_its_tags_name(linux_wheel):
    """As auditwheel judges by the versions of the symbols."""
    command = [sys.executable, "-m", "auditwheel", "show", linux_wheel]
    shown = " ".join(subprocess.run(command, check=True, capture_output=True, text=True).stdout.split())
    consistent = re.search(r'consistent with the following platform tag: "(\w+)"', shown)[1]
    oldest = tuple(map(int, re.match(r"manylinux_(\d+)_(\d+)", consistent).groups()))
    (platform,) = {tag.platform for tag in parse_wheel_filename(linux_wheel.name)[3]}
    assert oldest <= (2, 28)
    assert platform.startswith("manylinux_2_28_")


def test_macos_module_needs_only_the_system_library(macos_wheel):
    binary = only(lief.MachO.parse(list(module(macos_wheel))))
    assert binary.header.cpu_type == MACHINES[maker.read_name(macos_wheel)[2]]
    assert [library.name for library in binary.libraries] == ["/usr/lib/libSystem.B.dylib"]
    assert "PyInit_mrcontour" in exported(binary)


def test_macos_module_is_signed_and_for_macos_11(macos_wheel):
    """macOS on arm64 loads nothing without a signature; one without an identity is enough."""
    binary = only(lief.MachO.parse(list(module(macos_wheel))))
    assert binary.has_code_signature
    assert tuple(binary.build_version.minos)[:2] == (11, 0)
    (platform,) = {tag.platform for tag in parse_wheel_filename(macos_wheel.name)[3]}
    assert platform.startswith("macosx_11_0_")
