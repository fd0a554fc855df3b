"""Guesses of the first pose: every likely stance, facing the camera, at the cloud's centre."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from regkit.body import Body, Stance
from regkit.geometry.rigid import rigid
from regkit.geometry.rotation import vector_to_matrix
from regkit.skeleton import Pose
from regkit.start import Candidate, Scan
from regkit.start.scan import SPACING
from regkit.system.arrays import Array

FACING_CAMERA = np.diag([1.0, -1.0, -1.0])
"""R_camera_body of a body that faces the camera: its left on the image's right, its y up."""


def guesses(scan: Scan, body: Body, cutoff: float) -> Iterator[Candidate]:
    """Yields the best position of every stance in every rotation.

    Args:
        scan: The cloud.
        body: The body.
        cutoff: Upper bound of each distance [m]; rough guesses require a large one.
    """
    places = scan.centres(body.size)
    for stance in body.stances:
        for turn in _turns(body):
            poses = [_placed(body, stance, FACING_CAMERA @ turn, place) for place in places]
            misfits = [scan.misfit(body, body.place(pose), cutoff) for pose in poses]
            best = int(np.argmin(misfits))
            yield Candidate(body, poses[best], misfits[best])


def _turns(body: Body) -> list[Array]:
    """Returns rotations (3, 3) of the body before it faces the camera."""
    if body.upright:
        return [vector_to_matrix(np.array([0.0, turn, 0.0])) for turn in np.radians([-30, 0, 30])]
    rolls = [vector_to_matrix(np.array([0.0, 0.0, turn])) for turn in np.radians(range(0, 360, 30))]
    sides = [np.eye(3), np.diag([-1.0, 1.0, -1.0])]
    return [roll @ side for roll in rolls for side in sides]


def _placed(body: Body, stance: Stance, rotation: Array, place: Array) -> Pose:
    """Returns the rotated stance with the centre of its visible side at a place (3,) [m]."""
    root = rotation @ stance.pose.root[:3, :3]
    pose = Pose(rigid(root, np.zeros(3)), stance.pose.balls, stance.pose.hinges)
    placed = body.capsules.place(body.place(pose).transforms)
    axes = placed.axis_points(SPACING * body.size)
    # The camera sees the surface in front of the axes.
    visible = axes.points - axes.radii[:, None] * np.array([0.0, 0.0, 1.0])
    centre = np.average(visible, axis=0, weights=axes.radii)
    return Pose(rigid(root, place - centre), pose.balls, pose.hinges)
