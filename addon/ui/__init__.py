# SPDX-License-Identifier: GPL-3.0-or-later
"""The user interface: operators, panels, menus, overlays and preferences. Imports mesh/ and core/."""
