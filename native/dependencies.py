# SPDX-License-Identifier: GPL-3.0-or-later
"""Fetches the sources of OpenMesh and Eigen into a folder for CMake's MRC_DEPENDENCIES, with pip, on any system."""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

OPENMESH = "openmesh==1.2.1"  # Python bindings, whose source archive holds OpenMesh's own
EIGEN = "cmeel-eigen==3.4.1"  # Eigen's headers as a wheel


def fetch(requirement, kind, folder):
    """Downloads one archive, of the source or a wheel, and unpacks it."""
    pip = [sys.executable, "-m", "pip", "download", "--no-deps", kind, ":all:", "--dest", folder, requirement]
    subprocess.run(pip, check=True)
    (archive,) = folder.iterdir()
    shutil.unpack_archive(archive, folder / "content", "zip" if archive.suffix == ".whl" else None)
    return folder / "content"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    target = parser.parse_args().folder
    shutil.rmtree(target, ignore_errors=True)
    with tempfile.TemporaryDirectory() as scratch:
        (Path(scratch) / "openmesh").mkdir()
        (Path(scratch) / "eigen").mkdir()
        openmesh = fetch(OPENMESH, "--no-binary", Path(scratch) / "openmesh")
        eigen = fetch(EIGEN, "--only-binary", Path(scratch) / "eigen")
        shutil.copytree(next(openmesh.glob("*/OpenMesh")), target / "openmesh")
        shutil.copytree(eigen / "cmeel.prefix", target / "eigen")


if __name__ == "__main__":
    main()
