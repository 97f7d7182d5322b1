# SPDX-License-Identifier: GPL-3.0-or-later
"""The networks of meshes in Edit Mode, with what their search and their output need."""

from dataclasses import dataclass

import bpy

from ..core.networks import NetworkSearch
from .contour_tasks import warnings_of


@dataclass
class NetworkTask(NetworkSearch):
    """The network of one object."""

    obj: bpy.types.Object = None
    details: object = None  # what is needed to write it: its Labeling, or whether the selection moves with the seams
    asymmetric: bool = False  # whether mirror images were asked for and are not there


def warnings(tasks):
    """What the user should know about how the objects are measured in which something was found; before any output."""
    return [warning for task in tasks if task.plan and task.plan.taken_results() for warning in warnings_of(task)]
