"""The poses of several cameras, with their verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.body import BodyFit
from regkit.body.verdict import Verdict, frame_verdict
from regkit.calibration.extrinsics.refinement import Refinement
from regkit.system.arrays import Array

POOR = 0.6
"""Cameras are doubtful if the body is surely found in a smaller fraction of the frames."""


@dataclass(frozen=True)
class FoundCameras:
    """The poses of several cameras, with what supports them.

    Attributes:
        poses: T_world_camera (4, 4) [m] by the cameras' names.
        offsets: What is added to the times of each camera's frames [s], by its name.
        rough: Distance of the markers between each camera alone and the first one [m], by its name.
        frames: Number of frames in which all were refined.
        distance: Median distance of the points of these frames to the body [m].
        verdict: Whether the cameras are found.
        reason: Why they are not surely found; empty if they are.
    """

    poses: Mapping[str, Array]
    offsets: Mapping[str, float]
    rough: Mapping[str, float]
    frames: int
    distance: float
    verdict: Verdict
    reason: str = ""


def judged(refinement: Refinement) -> tuple[Verdict, str, float]:
    """Returns the verdict of the refined cameras, the reason, and the points' distance [m]."""
    body, verdicts, distances = refinement.registrar.body, [], []
    for frame, pose in zip(refinement.frames, refinement.poses, strict=True):
        fit = BodyFit.of(body, pose, frame.points, frame.sight)
        count = len(frame.points)
        verdicts.append(
            frame_verdict(count, fit.inlier_share, fit.coverage, fit.misfit, fit.relief)
        )
        distances.append(fit.distance)
    surely = float(np.mean([one is Verdict.FOUND for one in verdicts]))
    reasons = []
    if surely < POOR:
        reasons.append(f"the body is surely found in {100.0 * surely:.0f} % of the frames only")
    if not refinement.rested:
        reasons.append(f"the cameras still move after {refinement.rounds} rounds")
    verdict = Verdict.DOUBTFUL if reasons else Verdict.FOUND
    return verdict, "; ".join(reasons), float(np.median(distances))
