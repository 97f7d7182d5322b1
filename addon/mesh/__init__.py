# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that reads and writes Blender's meshes with bpy and bmesh. Imports core/ and nothing of ui/."""
