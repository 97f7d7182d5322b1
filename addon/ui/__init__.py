# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user meets: operators, panels, menus, overlays and preferences. Imports mesh/ and core/."""
