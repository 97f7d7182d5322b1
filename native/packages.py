# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the packages for Blender from self-contained wheels, all for one platform.

Each wheel for a Python of Blender 4.2 or later becomes an extension. All share one legacy add-on, for older
releases and for Blenders that a distribution builds with another Python than their release's own.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from packaging.utils import parse_wheel_filename

ROOT = Path(__file__).resolve().parents[1]
ADDON = ROOT / "addon"
ID = "minimum_ratio_contours"
# The Blender releases with each Python: from the first up to, but not including, the second. Before 4.2 there are no
# extensions.
EXTENSION_RELEASES = {"cp311": ("4.2.0", "5.1.0"), "cp313": ("5.1.0", None)}
LEGACY_PYTHONS = ("cp310", "cp311", "cp313")  # with the last of them, Debian 13 builds its Blender 4.3
PLATFORMS = {"linux": "linux", "manylinux": "linux", "musllinux": "linux", "win": "windows", "macosx": "macos"}
MACHINES = {"x86_64": "x64", "amd64": "x64", "arm64": "arm64", "aarch64": "arm64"}


def read_name(wheel):
    """The version of a wheel, its Python tag, and its platform as Blender names it."""
    _, version, _, tags = parse_wheel_filename(wheel.name)
    tag = next(iter(tags))
    system = next(name for prefix, name in PLATFORMS.items() if tag.platform.startswith(prefix))
    machine = next(name for suffix, name in MACHINES.items() if tag.platform.endswith(suffix))
    return str(version), tag.interpreter, f"{system}-{machine}"


def package_name(wheels, kind):
    return f"{ID}-{read_name(wheels[0])[0]}-{kind}-{package_target(wheels)}.zip"


def package_target(wheels):
    """What a package with these wheels is for: platform and Pythons, such as linux-x64-cp310-cp311."""
    names = [read_name(wheel) for wheel in wheels]
    return "-".join([names[0][2], *(python for _, python, _ in names)])


def homepage():
    """The public address of the project, from CMakeLists.txt; empty if there is none."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r'^project\(.* HOMEPAGE_URL "(.*?)"', text, re.MULTILINE)[1]


def manifest(wheel):
    """The manifest in the source, completed with what is known only in a package."""
    version, python, platform = read_name(wheel)
    first, end = EXTENSION_RELEASES[python]
    text = (ADDON / "blender_manifest.toml").read_text(encoding="utf-8")
    text = text.replace('\nversion = "0.0.0"', f'\nversion = "{version}"')
    text = text.replace('blender_version_min = "4.2.0"', f'blender_version_min = "{first}"')
    if address := homepage():
        text += f'website = "{address}"\n'
    if end:
        text += f'blender_version_max = "{end}"\n'
    return text + f'platforms = ["{platform}"]\nwheels = ["./wheels/{wheel.name}"]\n'


def sources(wheels):
    """The Python files of the add-on, by their names in the package. `__init__.py` learns what only a package knows."""
    files = {path.relative_to(ADDON).as_posix(): path.read_bytes() for path in sorted(ADDON.rglob("*.py"))}
    numbers = ", ".join(read_name(wheels[0])[0].split("."))
    text = files["__init__.py"].decode()
    text = text.replace('"version": (0, 0, 0)', f'"version": ({numbers})')
    if address := homepage():
        text = text.replace('"doc_url": ""', f'"doc_url": "{address}"')
        text = text.replace('"tracker_url": ""', f'"tracker_url": "{address}/issues"')
    text = text.replace('\nTARGET = ""', f'\nTARGET = "{package_target(wheels)}"')
    return files | {"__init__.py": text.encode()}


def build_extension(wheel, output, tool):
    """Builds and validates the extension with Blender's own tool, from a folder that contains nothing else."""
    package = output / package_name([wheel], "extension")
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for name, content in sources([wheel]).items():
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)
        (folder / "blender_manifest.toml").write_text(manifest(wheel), encoding="utf-8")
        (folder / "wheels").mkdir()
        shutil.copyfile(wheel, folder / "wheels" / wheel.name)
        for path in folder.rglob("*"):
            os.utime(path, (_epoch(), _epoch()))
        run = [sys.executable, tool]
        subprocess.run([*run, "build", "--source-dir", folder, "--output-filepath", package], check=True)
        subprocess.run([*run, "validate", package], check=True)
    return package


def build_legacy(wheels, output):
    """Builds one folder with the add-on, the modules for all Python versions, the libraries they need, and the
    licenses."""
    package = output / package_name(wheels, "legacy")
    files = {"": b""} | sources(wheels)
    for wheel in wheels:
        files |= _library_files(wheel)
    with ZipFile(package, "w", ZIP_DEFLATED) as content:
        for name in sorted(files):
            # Without an entry for the folder, an upgrade would overwrite the library that Blender has loaded.
            entry = ZipInfo(f"{ID}/{name}")  # dated 1980
            entry.compress_type, entry.external_attr = ZIP_DEFLATED, (0o644 if name else 0o40755) << 16
            content.writestr(entry, files[name])
    return package


def _library_files(wheel):
    """The files of a wheel that belong next to the Python files of the add-on: module, bundled libraries and
    licenses."""
    with ZipFile(wheel) as content:
        names = [name for name in content.namelist() if not name.endswith("/")]
        module_files = {name: name for name in names if name.startswith(("mrcontour.", ".dylibs/"))}
        licenses = {name.rpartition("/")[2]: name for name in names if "/licenses/" in name}
        return {target: content.read(name) for target, name in (module_files | licenses).items()}


def _epoch():
    return int(os.environ.get("SOURCE_DATE_EPOCH", "315532800"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("wheels", type=Path, nargs="+")
    parser.add_argument("--extension-tool", type=Path, required=True, help="blender_ext.py of a Blender or a bpy wheel")
    parser.add_argument("--output", type=Path, required=True, help="the folder for the packages")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    wheels = sorted(arguments.wheels)
    extensions = [wheel for wheel in wheels if read_name(wheel)[1] in EXTENSION_RELEASES]
    packages = [build_extension(wheel, arguments.output, arguments.extension_tool) for wheel in extensions]
    legacy = [wheel for wheel in wheels if read_name(wheel)[1] in LEGACY_PYTHONS]
    if legacy:
        packages.append(build_legacy(legacy, arguments.output))
    print(*packages, sep="\n")


if __name__ == "__main__":
    main()
