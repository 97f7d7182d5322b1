# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a wheel for another platform or Python: the wheel of this machine with another module inside and other tags."""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

WHEEL = [sys.executable, "-m", "wheel"]


def exchange_module(wheel, module, folder):
    """A copy of the wheel with another module. Its tags are still those of the old one."""
    subprocess.run([*WHEEL, "unpack", "--dest", folder, wheel], check=True)
    (unpacked,) = folder.iterdir()
    for old in unpacked.glob("mrcontour.*"):
        old.unlink()
    shutil.copyfile(module, unpacked / module.name)
    subprocess.run([*WHEEL, "pack", "--dest-dir", folder, unpacked], check=True)
    return folder / wheel.name


def build_wheel(wheel, module, python, platform, output):
    with tempfile.TemporaryDirectory() as folder:
        exchanged = exchange_module(wheel, module, Path(folder))
        tags = ["--python-tag", python, "--abi-tag", python, "--platform-tag", platform]
        subprocess.run([*WHEEL, "tags", "--remove", *tags, exchanged], check=True)
        output.mkdir(parents=True, exist_ok=True)
        (made,) = Path(folder).glob("*.whl")
        return shutil.copy(made, output)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("wheel", type=Path, help="as pip builds it, without bundled libraries")
    parser.add_argument("module", type=Path, help="the compiled module, with the file name that its Python expects")
    parser.add_argument("--python", required=True, help="the tag of the Python, such as cp311")
    parser.add_argument("--platform", required=True, help="the tag of the platform, such as win_amd64")
    parser.add_argument("--output", type=Path, required=True, help="the folder for the wheel")
    arguments = parser.parse_args()
    print(build_wheel(arguments.wheel, arguments.module, arguments.python, arguments.platform, arguments.output))


if __name__ == "__main__":
    main()
