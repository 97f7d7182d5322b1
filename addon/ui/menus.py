# SPDX-License-Identifier: GPL-3.0-or-later
"""The entries in Blender's own menus, whose texts the menu search (F3) finds."""

import bpy

OPERATOR = "mesh.optimize_contour"
_INVOKED = "INVOKE_REGION_WIN"


class VIEW3D_MT_minimum_ratio_contours(bpy.types.Menu):
    """Optimize the selected contours and choose their output in one step"""

    bl_idname = "VIEW3D_MT_minimum_ratio_contours"
    bl_label = "Optimize Contour and"

    def draw(self, context):
        self.layout.operator_context = _INVOKED
        for output, text in (
            ("SEAM", "Mark Seam"),
            ("SHARP", "Mark Sharp"),
            ("CUT", "Cut into Faces"),
            ("RIP", "Rip Open"),
            ("SEPARATE", "Separate Part"),
        ):
            self.layout.operator(OPERATOR, text=text).output = output


def _separate(layout):
    """Start a group whose operators are invoked: menus opened with a key would execute them, without progress."""
    layout.separator()
    layout.operator_context = _INVOKED


def _draw_contour(layout, **text):
    """Draw the entry that selects the contour, whatever the last run did.

    Shortcuts that users give to an entry have its properties, so they select, too.
    """
    layout.operator(OPERATOR, **text).output = "SELECT"


def _draw_edge(self, context):
    _separate(self.layout)
    _draw_contour(self.layout)
    self.layout.operator("mesh.adjust_contour")
    self.layout.menu(VIEW3D_MT_minimum_ratio_contours.bl_idname)


def _draw_face(self, context):
    _separate(self.layout)
    _draw_contour(self.layout, text="Optimize Contour of Faces")
    self.layout.operator("mesh.optimize_segmentation")
    self.layout.menu(VIEW3D_MT_minimum_ratio_contours.bl_idname)


def _draw_uv(self, context):
    _separate(self.layout)
    self.layout.operator(OPERATOR, text="Optimize Contour to Seam").output = "SEAM"
    self.layout.operator("mesh.optimize_seams")


def _draw_mesh(self, context):
    _separate(self.layout)
    self.layout.operator("mesh.show_curvature")
    self.layout.operator("mesh.show_curvature_directions")


_ENTRIES = (
    ("VIEW3D_MT_edit_mesh", _draw_mesh),
    ("VIEW3D_MT_edit_mesh_context_menu", _draw_edge),
    ("VIEW3D_MT_edit_mesh_edges", _draw_edge),
    ("VIEW3D_MT_edit_mesh_faces", _draw_face),
    ("VIEW3D_MT_uv_map", _draw_uv),
)


def register():
    bpy.utils.register_class(VIEW3D_MT_minimum_ratio_contours)
    for menu, draw in _ENTRIES:
        getattr(bpy.types, menu).append(draw)


def unregister():
    for menu, draw in _ENTRIES:
        getattr(bpy.types, menu).remove(draw)
    bpy.utils.unregister_class(VIEW3D_MT_minimum_ratio_contours)
