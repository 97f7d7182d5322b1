# SPDX-License-Identifier: GPL-3.0-or-later
"""Downloads the sources of OpenMesh and Eigen, with pip on any system, into a folder for CMake's MRC_DEPENDENCIES."""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# The Python bindings of OpenMesh, whose source archive contains OpenMesh itself, and a wheel with the headers of Eigen.
# Both are compiled into published packages, so their hashes are pinned.
REQUIREMENTS = """
openmesh==1.2.1 --hash=sha256:6fd3fa41a68148e4a7523f562426aa9758bf65ccc6642abcf79c37bae9c6af3c
cmeel-eigen==3.4.1 --hash=sha256:0ccd7b73fe8a72e2729784253c982e75d1790e0a8c71f302eb5a1fb1dd3a8a90
"""
PIP = [sys.executable, "-m", "pip", "download", "--no-deps", "--no-binary", "openmesh", "--only-binary", "cmeel-eigen"]


def fetch(folder):
    """Downloads the two archives, whose hashes pip checks, and unpacks them."""
    requirements, archives = folder / "requirements.txt", folder / "archives"
    requirements.write_text(REQUIREMENTS, encoding="utf-8")
    subprocess.run([*PIP, "--require-hashes", "--requirement", requirements, "--dest", archives], check=True)
    for archive in archives.iterdir():
        shutil.unpack_archive(archive, folder, "zip" if archive.suffix == ".whl" else None)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    target = parser.parse_args().folder
    unfinished = target.with_name(target.name + ".new")  # so that the folder is there only when it is complete
    shutil.rmtree(target, ignore_errors=True)
    shutil.rmtree(unfinished, ignore_errors=True)
    with tempfile.TemporaryDirectory() as scratch:
        fetch(Path(scratch))
        shutil.copytree(next(Path(scratch).glob("openmesh-*/OpenMesh")), unfinished / "openmesh")
        shutil.copytree(Path(scratch) / "cmeel.prefix", unfinished / "eigen")
    unfinished.rename(target)


if __name__ == "__main__":
    main()
