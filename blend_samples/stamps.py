# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures are drawn again only where something in them has changed: a stamp beside each says what it was made of."""

import hashlib
import json
from pathlib import Path

import numpy as np

redraw = False  # True: whether something has changed or not
HERE = Path(__file__).resolve().parent
DRAWN_BY = [HERE / f"{name}.py" for name in ("pictures", "views", "gallery_pictures", "captions", "images", "curves")]


def stamp(arrays, words):
    """Of the arrays and words in a picture, and of the code that draws it."""
    digest = hashlib.sha256()
    for array in arrays:
        digest.update(np.ascontiguousarray(array).tobytes())
    digest.update(json.dumps([*words, *(file.read_text() for file in DRAWN_BY)]).encode())
    return digest.hexdigest()


def draw_if_changed(path, made_of, draw):
    """Calls `draw` unless the picture is there and was made of the same."""
    beside = path.with_suffix(".sha256")
    if not redraw and path.exists() and beside.exists() and beside.read_text() == made_of:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    draw()
    beside.write_text(made_of)
