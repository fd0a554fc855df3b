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

ROUGH = 3.0
"""By how much the reach is larger for guesses."""

LIKELY = 12
"""How many guesses are fitted in a middle size."""

FINALISTS = 3
"""How many stances are fitted in every candidate size."""


@dataclass(frozen=True)
class Start:
    """Where a sequence begins.

    Attributes:
        body: The body at its size.
        pose: Its pose in the first frame.
        misfit: How badly it fits, from 0 to 2, plus the largest violation of a joint limit [rad];
            None if the pose was given.
    """

    body: Body
    pose: Pose
    misfit: float | None = None


def found_start(template: Template, observation: Observation) -> Start:
    """The start that fits the first frame best.

    Every likely stance is placed at the cloud's centre, facing the camera, in every turn. The best
    of these guesses are fitted to the cloud; those that then fit best are fitted in every candidate
    size, annealed from far to near, and the best fit is kept. Shape models, kernels and solvers play
    no part, so that all methods begin alike.

    Args:
        template: What is seen, perhaps of unknown size.
        observation: The first frame.
    """
    scan = Scan(observation.points)
    bodies = [template.body(size) for size in template.candidate_sizes()]
    likely = sorted(_guesses(scan, bodies[len(bodies) // 2]), key=_misfit)[:LIKELY]
    coarse = sorted((_fit(scan, s.body, s.pose, (ROUGH, 1.0)) for s in likely), key=_misfit)
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
    return Start(body, found, scan.misfit(body, body.place(found), reaches[-1] * reach) + strain)


def _guesses(scan: Scan, body: Body) -> Iterator[Start]:
    """The best place for every stance and turn; these are rough, and looked at from farther off."""
    reach = ROUGH * REACH * body.size
    for stance in body.stances:
        for turn in _turns(body):
            poses = [
                _placed(body, stance, FACING_CAMERA @ turn, centre)
                for centre in scan.centres(body.size)
            ]
            starts = [Start(body, pose, scan.misfit(body, body.place(pose), reach)) for pose in poses]
            yield min(starts, key=_misfit)


def _turns(body: Body) -> list[Array]:
    """Rotations of the body before it faces the camera, (3, 3)."""
    if body.upright:
        return [vector_to_matrix(np.array([0.0, turn, 0.0])) for turn in np.radians([-30, 0, 30])]
    rolls = [vector_to_matrix(np.array([0.0, 0.0, turn])) for turn in np.radians(range(0, 360, 30))]
    sides = [np.eye(3), np.diag([-1.0, 1.0, -1.0])]
    return [roll @ side for roll in rolls for side in sides]


def _placed(body: Body, stance: Stance, rotation: Array, place: Array) -> Pose:
    """The stance, turned, with the centre of its visible side at a place (3,)."""
    root = rotation @ stance.pose.root[:3, :3]
    pose = Pose(rigid(root, np.zeros(3)), stance.pose.balls, stance.pose.hinges)
    placed = body.capsules.place(body.place(pose).transforms)
    axes = placed.axis_points(SPACING * body.size)
    # The camera sees the surface in front of the axes.
    visible = axes.points - axes.radii[:, None] * np.array([0.0, 0.0, 1.0])
    centre = np.average(visible, axis=0, weights=axes.radii)
    return Pose(rigid(root, place - centre), pose.balls, pose.hinges)
