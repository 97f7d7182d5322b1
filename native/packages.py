# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the packages for Blender from self-contained wheels, all for one platform.

One extension has all wheels for the Pythons of Blender 4.2 and later, as extensions.blender.org wants it: one file for
each platform. One legacy add-on has the modules of all wheels, for older releases.
"""

import argparse
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
EXTENSION_PYTHONS = ("cp311", "cp313")  # of Blender 4.2 and later; before 4.2 there are no extensions
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


def name_inside(wheel):
    """The name of a wheel inside an extension.

    The first releases of Blender 4.2, which has Python 3.11, look at no Python: of wheels of the same version they take
    that whose name comes last. A build tag puts the others before it.
    """
    python = read_name(wheel)[1]
    return wheel.name if python == "cp311" else wheel.name.replace(f"-{python}-", f"-1-{python}-", 1)


def manifest(wheels):
    """The manifest in the source, completed with what is known only in a package.

    Blender takes the wheel for its Python, and refuses the extension if there is none.
    """
    version, _, platform = read_name(wheels[0])
    text = (ADDON / "blender_manifest.toml").read_text(encoding="utf-8")
    text = text.replace('\nversion = "0.0.0"', f'\nversion = "{version}"')
    if address := homepage():
        text += f'website = "{address}"\n'
    paths = ", ".join(f'"./wheels/{name_inside(wheel)}"' for wheel in wheels)
    return text + f'platforms = ["{platform}"]\nwheels = [{paths}]\n'


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


def build_extension(wheels, output, tool):
    """Builds and validates the extension with Blender's own tool, from a folder that contains nothing else."""
    package = output / package_name(wheels, "extension")
    with tempfile.TemporaryDirectory() as folder:
        source, built = Path(folder) / "source", Path(folder) / "built.zip"
        for name, content in sources(wheels).items():
            (source / name).parent.mkdir(parents=True, exist_ok=True)
            (source / name).write_bytes(content)
        (source / "blender_manifest.toml").write_text(manifest(wheels), encoding="utf-8")
        (source / "wheels").mkdir()
        for wheel in wheels:
            shutil.copyfile(wheel, source / "wheels" / name_inside(wheel))
        run = [sys.executable, tool]
        subprocess.run([*run, "build", "--source-dir", source, "--output-filepath", built], check=True)
        with ZipFile(built) as content:
            write_zip(package, {name: content.read(name) for name in content.namelist() if not name.endswith("/")})
        subprocess.run([*run, "validate", package], check=True)
    return package


def build_legacy(wheels, output):
    """Builds one folder with the add-on, the modules for all Python versions, the libraries they need, and the
    licenses."""
    package = output / package_name(wheels, "legacy")
    # Without an entry for the folder, an upgrade would overwrite the library that Blender has loaded.
    files = {"": b""} | sources(wheels)
    for wheel in wheels:
        files |= _library_files(wheel)
    write_zip(package, {f"{ID}/{name}": content for name, content in files.items()})
    return package


def write_zip(package, files):
    """The same files give the same bytes: the order of a folder, the time zone and the user's mask have no effect."""
    with ZipFile(package, "w", ZIP_DEFLATED) as content:
        for name in sorted(files):
            entry = ZipInfo(name)  # dated 1980
            entry.compress_type, entry.external_attr = ZIP_DEFLATED, (0o40755 if name.endswith("/") else 0o644) << 16
            content.writestr(entry, files[name])


def _library_files(wheel):
    """The files of a wheel that belong next to the Python files of the add-on: module, bundled libraries and
    licenses."""
    with ZipFile(wheel) as content:
        names = [name for name in content.namelist() if not name.endswith("/")]
        module_files = {name: name for name in names if name.startswith(("mrcontour.", ".dylibs/"))}
        licenses = {name.rpartition("/")[2]: name for name in names if "/licenses/" in name}
        return {target: content.read(name) for target, name in (module_files | licenses).items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("wheels", type=Path, nargs="+")
    parser.add_argument("--extension-tool", type=Path, required=True, help="blender_ext.py of a Blender or a bpy wheel")
    parser.add_argument("--output", type=Path, required=True, help="the folder for the packages")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    wheels = sorted(arguments.wheels)
    platforms = sorted({read_name(wheel)[2] for wheel in wheels})
    if len(platforms) > 1:
        parser.error(f"these wheels are for several platforms: {', '.join(platforms)}")
    extension = [wheel for wheel in wheels if read_name(wheel)[1] in EXTENSION_PYTHONS]
    if extension:
        print(build_extension(extension, arguments.output, arguments.extension_tool))
    legacy = [wheel for wheel in wheels if read_name(wheel)[1] in LEGACY_PYTHONS]
    if legacy:
        print(build_legacy(legacy, arguments.output))


if __name__ == "__main__":
    main()
