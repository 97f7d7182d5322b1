# SPDX-License-Identifier: GPL-3.0-or-later
"""Text of several lines, since Blender's labels do not wrap."""

import textwrap


def draw_text(layout, context, text, icon):
    """Draw wrapped text. Margins, icon and tabs take about 70 points, a character 6.5."""
    points = context.region.width / context.preferences.system.ui_scale
    column = layout.column(align=True)
    for index, line in enumerate(textwrap.wrap(text, max(16, int((points - 70) / 6.5)))):
        column.label(text=line, icon=icon if index == 0 else "BLANK1")
