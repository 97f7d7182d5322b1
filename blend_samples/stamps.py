# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws pictures again only if something in them has changed, which is detected by a hash stored next to each."""

import hashlib
import json
from pathlib import Path

import numpy as np

redraw = False  # True: draw pictures even if nothing has changed
HERE = Path(__file__).resolve().parent
DRAWN_BY = [HERE / f"{name}.py" for name in ("pictures", "views", "gallery_pictures", "captions", "images", "curves")]


def stamp(arrays, words):
    """Return a hash of the arrays and words in a picture, and of the code that draws it."""
    digest = hashlib.sha256()
    for array in arrays:
        digest.update(np.ascontiguousarray(array).tobytes())
    digest.update(json.dumps([*words, *(file.read_text() for file in DRAWN_BY)]).encode())
    return digest.hexdigest()


def draw_if_changed(path, made_of, draw):
    """Call `draw` unless the picture exists and has the same stamp."""
    stamp_path = path.with_suffix(".sha256")
    if not redraw and path.exists() and stamp_path.exists() and stamp_path.read_text() == made_of:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    draw()
    stamp_path.write_text(made_of)
