# SPDX-License-Identifier: GPL-3.0-or-later
"""The networks of meshes in Edit Mode, with the data that their search and output need."""

from dataclasses import dataclass

import bpy

from ..core.networks import NetworkSearch
from .contour_tasks import warnings_of


@dataclass
class NetworkTask(NetworkSearch):
    """The network of one object."""

    obj: bpy.types.Object = None
    details: object = None  # for writing: its Labeling, or whether the selection moves with the seams
    asymmetric: bool = False  # whether X Mirror is on but mirror images are missing


def warnings(tasks):
    """Return what the user should know about the objects with results; call it before any output is made."""
    return [warning for task in tasks if task.plan and task.plan.taken_results() for warning in warnings_of(task)]
