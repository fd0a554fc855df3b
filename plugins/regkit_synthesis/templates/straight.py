"""Straight limbs: directions, and how a mesh is turned into the rest pose."""

from __future__ import annotations

import numpy as np

from regkit.geometry.rigid import rigid
from regkit.system.arrays import Array

LEFT = np.array([1.0, 0.0, 0.0])
DOWN = np.array([0.0, -1.0, 0.0])
FORWARD = np.array([0.0, 0.0, 1.0])


def mesh_axes(columns: Array, origin: Array) -> Array:
    """``T_template_mesh`` (4, 4) of a template's axes (3, 3), as columns, and origin in a mesh."""
    return rigid(columns.T, -columns.T @ origin)


def unit(vector: Array) -> Array:
    """A vector (3,) of the length one."""
    return np.asarray(vector / np.linalg.norm(vector))


def aligned(bone: Array, axis: Array, goal_bone: Array, goal_axis: Array) -> Array:
    """The rotation (3, 3) that turns a bone and an axis at right angles to it into two others."""
    start = np.column_stack([bone, axis, np.cross(bone, axis)])
    goal = np.column_stack([goal_bone, goal_axis, np.cross(goal_bone, goal_axis)])
    return np.asarray(goal @ start.T)
