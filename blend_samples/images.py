# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders scenes to arrays of pixels with Workbench, which is fast and needs no display and no lights."""

import tempfile
from pathlib import Path

import bpy
import numpy as np

PAPER = (0.94, 0.94, 0.93)


def link(scene, name, data):
    ob = bpy.data.objects.new(name, data)
    scene.collection.objects.link(ob)
    return ob


def material(name, color):
    made = bpy.data.materials.new(name)
    made.diffuse_color = (*color, 1.0)
    made.roughness = 0.6
    return made


def workbench(scene, width, height):
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.display.render_aa = "8"
    scene.display.shading.light, scene.display.shading.color_type = "STUDIO", "MATERIAL"
    scene.view_settings.view_transform = "Standard"
    scene.render.film_transparent = True
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.image_settings.file_format = "PNG"


def render(scene):
    """Render a scene on a paper background. Return rows of pixels, bottom first."""
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "half.png")
        bpy.ops.render.render(write_still=True, scene=scene.name)
        pixels = load(scene.render.filepath)
    return pixels[:, :, :3] * pixels[:, :, 3:] + (1.0 - pixels[:, :, 3:]) * np.float32(PAPER)


def load(path):
    """Return rows of pixels with alpha, bottom first."""
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(4 * width * height, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(height, width, 4)


def save(pixels, path):
    height, width = pixels.shape[:2]
    image = bpy.data.images.new(path.stem, width, height)
    image.pixels.foreach_set(np.concatenate([pixels, np.ones_like(pixels[:, :, :1])], axis=2).ravel())
    scene = bpy.data.scenes.new("save")
    workbench(scene, width, height)
    scene.render.image_settings.color_mode, scene.render.image_settings.compression = "RGB", 100
    image.save_render(str(path), scene=scene)
