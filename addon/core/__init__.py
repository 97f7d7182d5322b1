# SPDX-License-Identifier: GPL-3.0-or-later
"""Everything that does not need Blender: settings, networks, messages and the search. Imports no mesh/, ui/ or bpy."""
