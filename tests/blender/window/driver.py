# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives a Blender window as a user does: with mouse and keys, reading the screen."""

import subprocess

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

PAUSE = 0.02  # seconds between the steps of a scenario
_DRAWN = 3  # steps until the screen shows the effect of an event
_ROW = 14  # pixels, less than a row of buttons
_OPENED = 12  # steps until a popup or the redo panel is open
_DIGITS = ("ZERO", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE")


class Window:
    def __init__(self, pictures):
        self.pictures = pictures
        self.window = bpy.context.window_manager.windows[0]
        self.area = max(self.window.screen.areas, key=lambda area: area.width * area.height * (area.type == "VIEW_3D"))
        self.region = next(region for region in self.area.regions if region.type == "WINDOW")
        self.view = self.area.spaces.active.region_3d
        self.mouse = self.region.x + 20, self.region.y + 20

    def fresh(self):
        """Open an empty scene with Blender's default settings, seen from the front and slightly above."""
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.batch_remove([*bpy.data.objects, *bpy.data.meshes])
        bpy.context.scene.tool_settings.mesh_select_mode = (False, True, False)
        last = bpy.context.window_manager.operator_properties_last("mesh.optimize_contour")
        names = list(last.keys())
        for name in names:
            last.property_unset(name)
        self.area.spaces.active.show_region_ui = False
        self.view.view_perspective = "PERSP"
        self.view.view_rotation = Vector((0.0, 0.9, -0.45)).to_track_quat("-Z", "Y")
        self.view.view_location, self.view.view_distance = (0.0, 0.0, 2.0), 9.0
        yield from self.move(20, 20)

    def context(self):
        return bpy.context.temp_override(window=self.window, area=self.area, region=self.region)

    def operator(self, name, **settings):
        """Start a mesh operator as a menu does."""
        with self.context():
            return getattr(bpy.ops.mesh, name)("INVOKE_DEFAULT", True, **settings)

    def wait(self):
        for _ in range(_DRAWN):
            yield

    def move(self, x, y):
        """Move the mouse to a position in the viewport, in pixels."""
        self.mouse = self.region.x + int(x), self.region.y + int(y)
        self._event("MOUSEMOVE", "NOTHING")
        yield from self.wait()

    def press(self, key, times=1, **modifiers):
        for _ in range(times):
            self._event(key, "PRESS", **modifiers)
            if not key.startswith("WHEEL"):
                self._event(key, "RELEASE", **modifiers)
            yield from self.wait()

    def turn(self, key, times):
        """Send many events at once, as they queue up while Blender is busy."""
        for _ in range(times):
            self._event(key, "PRESS")
        yield from self.wait()

    def move_over(self, x, y):
        """Move the mouse to a position in the window, in pixels."""
        self.mouse = int(x), int(y)
        self._event("MOUSEMOVE", "NOTHING")
        yield
        yield

    def type(self, text):
        for letter in text:
            key = _DIGITS[int(letter)] if letter.isdigit() else letter.upper()
            self._event(key, "PRESS", unicode=letter)
            self._event(key, "RELEASE")
            yield
        yield from self.wait()

    def copied(self):
        """Return what Blender copies from the button under the mouse: an operator's command, or a value."""
        manager = bpy.context.window_manager
        manager.clipboard = ""
        self._event("C", "PRESS", ctrl=True)
        self._event("C", "RELEASE", ctrl=True)
        yield
        return manager.clipboard

    def region_of(self, kind):
        return next(region for region in self.area.regions if region.type == kind)

    def find(self, kind, text, share=0.7):
        """Move the mouse down a region until it is over a button with this command or value; return its height."""
        region = self.region_of(kind)
        for y in range(region.y + region.height - _ROW, region.y, -_ROW):
            self.mouse = int(region.x + share * region.width), y
            self._event("MOUSEMOVE", "NOTHING")
            yield
            if text in (yield from self.copied()):
                return y
        raise AssertionError(f"no button with {text} in the region {kind}")

    def push(self, kind, text, share=0.7):
        """Click the button with this command."""
        yield from self.find(kind, text, share)
        yield from self.press("LEFTMOUSE")
        yield from self.rest()

    def rest(self):
        """Wait until a popup or panel has opened."""
        for _ in range(_OPENED):
            yield

    def choose(self, text, among=12):
        """Pick the entry with this command from the open menu, searching from its end."""
        yield from self.rest()
        yield from self.press("END")
        for _ in range(among):
            if text in (yield from self.copied()):
                yield from self.press("RET")
                yield from self.rest()
                return
            yield from self.press("UP_ARROW")
        raise AssertionError(f"no entry with {text} at the end of the menu")

    def open_sidebar(self):
        """Open the sidebar at the add-on's tab, which is the last one."""
        self.area.spaces.active.show_region_ui = True
        yield from self.rest()
        region = self.region_of("UI")
        yield from self.move_over(region.x + region.width // 2, region.y + region.height - 40)
        yield from self.press("WHEELDOWNMOUSE", times=4, ctrl=True)

    def drag(self, button, x, y):
        self._event(button, "PRESS")
        for _ in range(2):
            self.mouse = self.mouse[0] + x // 2, self.mouse[1] + y // 2
            self._event("MOUSEMOVE", "NOTHING")
            yield
        self._event(button, "RELEASE")
        yield from self.wait()

    def click(self, obj, vertex):
        """Click on a vertex."""
        place = obj.matrix_world @ obj.data.vertices[vertex].co
        yield from self.move(*location_3d_to_region_2d(self.region, self.view, place))
        yield from self.press("LEFTMOUSE")

    def picture(self, name):
        """Return the pixels of the screen, and save them as a picture. In Mesa 25, those by Blender are black."""
        path = str(self.pictures / f"{name}.png")
        with self.context():
            bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)
        subprocess.run(["scrot", "--overwrite", path], check=True)
        image = bpy.data.images.load(path)
        pixels = np.empty(len(image.pixels), dtype=np.float32)
        image.pixels.foreach_get(pixels)
        shape = image.size[1], image.size[0], 4
        bpy.data.images.remove(image)
        return pixels.reshape(shape)

    def upper(self, pixels):
        """Return the pixels of the upper part of the viewport, which Blender's messages do not cover."""
        bottom = self.region.y + 2 * self.region.height // 5
        return pixels[bottom : self.region.y + self.region.height, self.region.x : self.region.x + self.region.width]

    def _event(self, key, value, **modifiers):
        self.window.event_simulate(key, value, x=self.mouse[0], y=self.mouse[1], **modifiers)
