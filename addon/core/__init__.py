# SPDX-License-Identifier: GPL-3.0-or-later
"""What needs no Blender: settings, networks, messages and the search. Imports nothing of mesh/, ui/ or bpy."""
