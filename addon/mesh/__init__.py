# SPDX-License-Identifier: GPL-3.0-or-later
"""What reads and writes Blender's meshes, by bpy and bmesh. Imports core/, and nothing of ui/."""
