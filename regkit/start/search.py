"""Searching for the start: many coarse guesses, the best of them fitted, the best fit kept."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from regkit.arrays import Array
from regkit.body import Body, Stance
from regkit.errors import ConfigError
from regkit.interfaces import Template
from regkit.observation import Observation
from regkit.rigid import rigid
from regkit.rotation import vector_to_matrix
from regkit.skeleton import Pose, PoseDescription
from regkit.start.fit import fitted
from regkit.start.scan import SPACING, Scan

FACING_CAMERA = np.diag([1.0, -1.0, -1.0])
"""R_camera_body of a body that faces the camera: its left on the image's right, its y up."""

REACH = 0.06
"""Gaps beyond this part of the body's size count no more: an arm's width on a person."""

FINALISTS = 3
"""How many stances are fitted in every candidate size."""


@dataclass(frozen=True)
class Start:
    """Where a sequence begins.

    Attributes:
        body: The body at its size.
        pose: Its pose in the first frame.
        misfit: How badly it fits, from 0 to 2, and by how much it violates a joint limit [rad];
            None if the pose was given.
    """

    body: Body
    pose: Pose
    misfit: float | None = None


def found_start(template: Template, observation: Observation) -> Start:
    """The start that fits the first frame best.

    Every likely stance is placed at the cloud's centre, facing the camera, in every candidate size
    and turn; the best guess of each stance is fitted to the cloud. The stances that then fit best
    are fitted again in every size, annealed from far to near, and the best fit is kept. Shape
    models, kernels and solvers play no part, so that all methods begin alike.

    Args:
        template: What is seen, perhaps of unknown size.
        observation: The first frame.
    """
    scan = Scan(observation.points)
    bodies = [template.body(size) for size in template.candidate_sizes()]
    likely = [
        min((guess for body in bodies for guess in _guesses(scan, body, index)), key=_misfit)
        for index in range(len(bodies[0].stances))
    ]
    coarse = sorted((_fit(scan, guess.body, guess.pose, (1.0,)) for guess in likely), key=_misfit)
    fine = [
        _fit(scan, body, start.pose, (1.0, 0.4)) for start in coarse[:FINALISTS] for body in bodies
    ]
    return min(fine, key=_misfit)


def given_start(template: Template, description: PoseDescription) -> Start:
    """The start that a user wrote down.

    Raises:
        ConfigError: If it turns a joint that the body does not have, or the size is not known.
    """
    size = template.given_size()
    if size is None:
        raise ConfigError("a given start needs a template of given size", place="start")
    body = template.body(size)
    return Start(body, body.skeleton.pose(description))


def _misfit(start: Start) -> float:
    return np.inf if start.misfit is None else start.misfit


def _fit(scan: Scan, body: Body, pose: Pose, reaches: tuple[float, ...]) -> Start:
    """The start fitted from a pose, with ``reaches`` as parts of the usual one."""
    reach = REACH * body.size
    found = fitted(scan, body, pose, [part * reach for part in reaches])
    # A body of the wrong size fits as well as the right one if its joints may bend as they cannot.
    strain = float(body.skeleton.limits.violation(found).max(initial=0.0))
    return Start(body, found, scan.misfit(body, body.place(found), reach) + strain)


def _guesses(scan: Scan, body: Body, stance: int) -> Iterator[Start]:
    for turn in _turns(body):
        pose = _at_centre(body, body.stances[stance], FACING_CAMERA @ turn, scan)
        yield Start(body, pose, scan.misfit(body, body.place(pose), REACH * body.size))


def _turns(body: Body) -> list[Array]:
    """Rotations of the body before it faces the camera, (3, 3)."""
    if body.upright:
        return [vector_to_matrix(np.array([0.0, turn, 0.0])) for turn in np.radians([-30, 0, 30])]
    rolls = [vector_to_matrix(np.array([0.0, 0.0, turn])) for turn in np.radians(range(0, 360, 30))]
    sides = [np.eye(3), np.diag([-1.0, 1.0, -1.0])]
    return [roll @ side for roll in rolls for side in sides]


def _at_centre(body: Body, stance: Stance, rotation: Array, scan: Scan) -> Pose:
    """The stance, turned, with its visible side at the centre of the cloud."""
    root = rotation @ stance.pose.root[:3, :3]
    pose = Pose(rigid(root, np.zeros(3)), stance.pose.balls, stance.pose.hinges)
    placed = body.capsules.place(body.place(pose).transforms)
    axes = placed.axis_points(SPACING * body.size)
    # The camera sees the surface in front of the axes.
    visible = axes.points - axes.radii[:, None] * np.array([0.0, 0.0, 1.0])
    centre = np.average(visible, axis=0, weights=axes.radii)
    return Pose(rigid(root, scan.centre - centre), pose.balls, pose.hinges)
