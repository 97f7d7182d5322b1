# SPDX-License-Identifier: GPL-3.0-or-later
"""Real scans and models from the installed Debian package libcgal-demo, and the planes of their rough loops.

The points of the planes are fractions of the mesh's bounding box, so that they can be read off a picture.
"""

import subprocess
import tarfile
from pathlib import Path

import numpy as np
from rough_loops import Cut, Polygons

ARCHIVE = "usr/share/doc/libcgal-dev/data.tar.gz"

CUTS = {
    "armadillo.off": [
        Cut("tail", (0.48, 0.36, 0.83), (0.25, -0.3, 0.9), end=(0.49, 0.43, 0.70)),
        Cut("arm", (0.25, 0.71, 0.48), (1.0, -0.3, 0.25)),
        Cut("knee", (0.25, 0.26, 0.45), (0.15, 1.0, 0.35)),
        Cut("ear", (0.35, 0.96, 0.27), (-0.4, 0.85, 0.3), end=(0.43, 0.89, 0.32)),
    ],
    "camel.off": [
        Cut("neck", (0.5, 0.70, 0.76), (0.1, 0.75, 0.65)),
        Cut("front_leg", (0.3, 0.45, 0.55), (0.2, 1.0, -0.25)),
    ],
    "cow.off": [
        Cut("head", (0.79, 0.75, 0.5), (1.0, 0.25, 0.2)),
        Cut("front_leg", (0.6, 0.35, 0.2), (0.25, 1.0, 0.2)),
    ],
    "man.off": [
        Cut("neck", (0.43, 0.47, 0.865), (0.15, -0.1, 1.0)),
        Cut("thigh", (0.27, 0.5, 0.43), (0.15, 0.2, 1.0), end=(0.34, 0.48, 0.51)),
        Cut("wrist", (0.08, 0.2, 0.54), (0.1, 0.2, 1.0)),
    ],
    "bear.off": [
        Cut("ear", (0.75, 0.85, 0.5), (0.9, 0.3, 0.2)),
        Cut("arm", (0.80, 0.57, 0.5), (1.0, 0.3, 0.25)),
        Cut("neck", (0.48, 0.63, 0.5), (0.05, 1.0, 0.2)),
    ],
    "bunny00.off": [
        Cut("ear", (0.4, 0.85, 0.2), (0.6, 0.7, -0.3), end=(0.26, 0.76, 0.56)),
    ],
    "diplodocus.off": [
        Cut("tail", (0.2, 0.35, 0.5), (-0.8, -0.4, 0.3)),
        Cut("neck", (0.75, 0.62, 0.6), (0.2, 1.0, 0.2)),
        Cut("front_leg", (0.66, 0.25, 0.7), (0.2, 1.0, 0.2), end=(0.66, 0.4, 0.7)),
    ],
    "hand.off": [
        Cut("thumb", (0.85, 0.2, 0.55), (0.3, -0.9, 0.3)),
        Cut("wrist", (0.5, 0.5, 0.17), (0.15, 0.2, 1.0)),
    ],
    "homer.off": [
        Cut("arm", (0.24, 0.58, 0.5), (1.0, -0.2, 0.3)),
    ],
}

STANDING_IN_Z = {"man.off", "hand.off"}  # the others stand in y


def open_archive(folder):
    """Open the package's archive; on a system without /usr/share/doc, from the package downloaded into `folder`."""
    for root in (Path("/"), folder):
        if (root / ARCHIVE).exists():
            return tarfile.open(root / ARCHIVE)
    folder.mkdir(parents=True, exist_ok=True)
    print("Downloading Debian's libcgal-demo, as its files are not in /usr/share/doc.", flush=True)
    subprocess.run(["apt-get", "download", "-q", "libcgal-demo"], cwd=folder, check=True)
    package = max(folder.glob("libcgal-demo*.deb"))
    subprocess.run(["dpkg-deb", "-x", package, folder], check=True)
    return tarfile.open(folder / ARCHIVE)


def read_off(archive, name):
    """Read a triangle mesh in OFF: the counts, the positions, then '3 a b c' for each face."""
    numbers = np.array(archive.extractfile(f"data/meshes/{name}").read().split()[1:], float)
    vertices, faces = int(numbers[0]), int(numbers[1])
    positions = numbers[3 : 3 + 3 * vertices].reshape(-1, 3)
    corners = numbers[3 + 3 * vertices :][: 4 * faces].reshape(-1, 4).astype(np.int32)
    if np.any(corners[:, 0] != 3):
        raise ValueError(f"{name} has faces that are not triangles.")
    return Polygons(positions, 3 * np.arange(faces + 1, dtype=np.int32), corners[:, 1:].ravel())


def cuts(name, mesh):
    """Return the table's planes in the mesh's own coordinates."""
    low, high = mesh.positions.min(axis=0), mesh.positions.max(axis=0)

    def place(fractions):
        return fractions and tuple(low + np.array(fractions) * (high - low))

    return [Cut(cut.name, place(cut.point), cut.normal, place(cut.end)) for cut in CUTS[name]]


def up(name):
    """Return the axis that points up in the mesh, for the pictures."""
    return (0, 0, 1) if name in STANDING_IN_Z else (0, 1, 0)
