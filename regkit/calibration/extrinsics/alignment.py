"""How the motions of one body in two cameras lie to each other, in space and in time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.calibration.extrinsics.motions import Motion
from regkit.geometry.rigid import rigid, transformed
from regkit.system.arrays import Array

LONGEST_OFFSET = 0.25
"""Clocks are compared up to this difference [s]."""

STEP = 0.5
"""Step of the differences that are tried, in frames."""

SCALES = (0.3, 0.15, 0.08, 0.05, 0.05, 0.05)
"""Scales of the robust distance of markers in successive fits [m]; a person's limb is as thick."""

CLEARER = 0.9
"""A difference of the clocks is believed if it lowers the distance to this fraction."""

FEWEST = 5
"""Least number of common frames."""

GAP = 2.5
"""A motion is interpolated over at most so many frames."""


@dataclass(frozen=True)
class MotionAlignment:
    """A fit of two motions.

    Attributes:
        transform: T_reference_camera, (4, 4) [m].
        offset: What is added to the camera's times [s].
        distance: Root of the robust mean squared distance of the markers [m].
        frames: Number of common frames.
    """

    transform: Array
    offset: float
    distance: float
    frames: int


def aligned(reference: Motion, camera: Motion, fps: float) -> MotionAlignment | None:
    """Returns the best rigid motion and difference of the clocks; None without common frames.

    Args:
        reference: The motion in the reference camera.
        camera: The motion in the other camera.
        fps: Frame rate [1/s].
    """
    step = STEP / fps
    count = int(LONGEST_OFFSET / step)
    offsets = step * np.arange(-count, count + 1)
    fits = [_at_offset(reference, camera, float(offset), fps) for offset in offsets]
    known = [one for one in fits if one is not None]
    if not known:
        return None
    none = fits[count]
    best = min(known, key=lambda one: one.distance)
    if none is not None and best.distance > CLEARER * none.distance:
        return none
    around = [one for one in known if abs(one.offset - best.offset) < 1.5 * step]
    if len(around) == 3:
        # The squared distance is a parabola near its minimum.
        squares = [one.distance**2 for one in around]
        bend = squares[0] - 2.0 * squares[1] + squares[2]
        if bend > 0.0:
            refined = best.offset + 0.5 * step * (squares[0] - squares[2]) / bend
            return _at_offset(reference, camera, refined, fps) or best
    return best


def _at_offset(
    reference: Motion, camera: Motion, offset: float, fps: float
) -> MotionAlignment | None:
    """Returns the best rigid motion at a difference of the clocks [s]."""
    places, weights = camera.at(reference.times - offset, GAP / fps)
    weights = weights * reference.weights
    common = int((weights.max(axis=1, initial=0.0) > 0.0).sum())
    if common < FEWEST:
        return None
    used = weights.ravel() > 0.0
    source, target = places.reshape(-1, 3)[used], reference.markers.reshape(-1, 3)[used]
    weights = weights.ravel()[used]
    transform, gains = np.eye(4), np.ones(len(weights))
    for scale in (None, *SCALES):
        if scale is not None:
            squares = ((transformed(transform, source) - target) ** 2).sum(axis=1)
            gains = 1.0 / (1.0 + squares / scale**2) ** 2
        transform = _rigid_fit(source, target, weights * gains)
    squares = ((transformed(transform, source) - target) ** 2).sum(axis=1)
    robust = squares / (1.0 + squares / SCALES[-1] ** 2)
    distance = float(np.sqrt(np.average(robust, weights=weights)))
    return MotionAlignment(transform, offset, distance, common)


def _rigid_fit(source: Array, target: Array, weights: Array) -> Array:
    """Returns the weighted least-squares motion (4, 4) between pairs (N, 3) (Kabsch, 1976)."""
    middle, aim = (np.average(one, axis=0, weights=weights) for one in (source, target))
    left, _, right = np.linalg.svd((target - aim).T @ (weights[:, None] * (source - middle)))
    upright = np.diag([1.0, 1.0, np.sign(np.linalg.det(left @ right))])
    rotation = left @ upright @ right
    return rigid(rotation, aim - rotation @ middle)
