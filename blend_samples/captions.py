# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a strip of text with Blender's own font."""

import bpy
from images import link, material, render, workbench

LINE, SMALL_LINE, PAD = 30, 23, 8  # pixels


def strip(width, words, spacing=LINE):
    """Draw words, given as (line from the top, pixels from the left, text, color). Return rows of pixels, bottom first.

    `spacing` is the distance between lines in pixels; the size of the letters is proportional to it. Words that are too
    long for the space up to the next word on their line, or to the border, are made smaller.
    """
    height = spacing * (1 + max(line for line, *_ in words)) + 12
    scene = bpy.data.scenes.new("words")
    workbench(scene, width, height)
    scene.display.shading.light = "FLAT"
    camera = link(scene, "camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", width
    camera.location = (width / 2, height / 2, 10)
    scene.camera = camera
    for line, left, text, color in words:
        data = bpy.data.curves.new("words", "FONT")
        data.body, data.size = text, 0.95 * spacing
        data.materials.append(material("words", color))
        placed = link(scene, "words", data)
        placed.location = (left, height - spacing * (line + 0.95), 0)
        scene.view_layers[0].update()  # computes the dimensions
        room = min([other for at, other, *_ in words if at == line and other > left], default=width) - left - PAD
        placed.scale *= min(1.0, room / placed.dimensions.x)
    return render(scene)
