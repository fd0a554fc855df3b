"""Motion through keyframes."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy
from pydantic import Field, field_validator, model_validator

from regkit.config.model import Model
from regkit.config.quantities import Coordinate, Duration
from regkit.geometry.rotation import vector_to_matrix
from regkit.system.arrays import Array
from regkit_synthesis.figure.figure import FIGURE, check_joints
from regkit_synthesis.figure.standing import STANDING
from regkit_synthesis.motion.motion import Motion, Rig, SourcePose

_ANKLE = 0.09
"""Height of the ankles of a standing figure [m]."""

Triple = tuple[Coordinate, Coordinate, Coordinate]


class Keyframe(Model):
    """A pose at a time. Joints that it does not name are interpolated between other keyframes."""

    time: Duration
    """Time [s]."""

    joints: dict[str, Triple] = Field(default_factory=dict)
    """Angles [deg] of the figure's joints about the parent's x (left), y (backward) and z (up); all
    are zero when it stands with hanging arms. The rotation about z (along the limb) is applied
    first, then y (sideways), then x (forward and backward). A bent knee has a positive x, a raised
    thigh and a bent elbow a negative x. A left arm is lifted sideways by a negative y, a right arm
    by a positive y."""

    feet: Triple | None = None
    """Position of the midpoint between the ankles, and height of the lower foot above the ground
    [m]; by default the figure stays in place."""

    @field_validator("joints")
    @classmethod
    def _of_a_figure(cls, joints: dict[str, Triple]) -> dict[str, Triple]:
        check_joints(joints)
        return joints


class Keyframes(Model):
    """Keyframes with smooth motion in between, at rest in the first and the last one."""

    title: str = ""
    """What it does."""

    loops: bool = False
    """Whether the motion repeats; the first and the last keyframe must then be the same."""

    frames: tuple[Keyframe, ...] = Field(min_length=2)
    """The poses, in the order of their times."""

    @model_validator(mode="after")
    def _in_order(self) -> Keyframes:
        times = [frame.time for frame in self.frames]
        if any(later <= earlier for earlier, later in itertools.pairwise(times)):
            raise ValueError(f"the times of the frames must increase; they are {times}")
        if times[0] != 0.0:
            raise ValueError(f"the first frame must have the time 0; it has {times[0]}")
        if self.loops:
            self._check_loop()
        return self

    def _check_loop(self) -> None:
        """Refuse a loop that jumps; whole turns and steps along the ground are none."""
        motion = self.motion()
        for joint, curve in motion.curves.items():
            gap = (curve(motion.length) - curve(0.0) + 180.0) % 360.0 - 180.0
            if np.abs(gap).max() > 1e-6:
                raise ValueError(
                    f"a motion that loops must end as it begins; {joint} goes from "
                    f"{[*map(float, curve(0.0))]} to {[*map(float, curve(motion.length))]}"
                )
        if abs(motion.feet(motion.length)[2] - motion.feet(0.0)[2]) > 1e-6:
            raise ValueError("a motion that loops must end at the height at which it begins")

    def motion(self) -> KeyframedMotion:
        """Returns the motion through the keyframes."""
        joints = dict.fromkeys(joint for frame in self.frames for joint in frame.joints)
        curves = {
            joint: _curve([(f.time, f.joints[joint]) for f in self.frames if joint in f.joints])
            for joint in joints
        }
        feet = [(f.time, f.feet) for f in self.frames if f.feet is not None]
        return KeyframedMotion(
            RIG, self.loops, self.frames[-1].time, curves, _curve(feet or [(0.0, (0.0, 0.0, 0.0))])
        )


RIG = Rig(FIGURE, STANDING, {joint: joint for joint in FIGURE})
"""The figure that keyframes are written for."""


@dataclass(frozen=True)
class KeyframedMotion(Motion):
    """A motion through keyframes.

    Each angle is interpolated separately by monotone cubics, which do not overshoot, so angles may
    exceed a full turn. The lower foot stays on the ground. It may slide, because the midpoint
    between the ankles is fixed.

    Source: Fritsch, Carlson, Monotone Piecewise Cubic Interpolation, SIAM J. Numer. Anal. 17, 1980.

    Attributes:
        length: Time of the last keyframe [s].
        curves: Functions from a time [s] to angles (3,) [deg], by joint; other joints are at rest.
        feet: Function from a time [s] to the position of the feet (3,) [m].
    """

    length: float
    curves: Mapping[str, scipy.interpolate.PchipInterpolator]
    feet: scipy.interpolate.PchipInterpolator

    @property
    def duration(self) -> float:
        """Time of the last keyframe [s]."""
        return self.length

    def at(self, time: float) -> SourcePose:
        """Returns the pose at ``time`` [s]."""
        cycle = np.floor(time / self.length) if self.loops else 0.0
        within = float(np.clip(time - cycle * self.length, 0.0, self.length))
        rotations: dict[str, Array] = {}
        for joint, parent in FIGURE.items():
            before = rotations[parent] if parent else np.eye(3)
            curve = self.curves.get(joint)
            rotations[joint] = before if curve is None else before @ _turned(curve(within))
        way = cycle * (self.feet(self.length) - self.feet(0.0)) * [1.0, 1.0, 0.0]
        return SourcePose(self.feet(within) + way - _below(rotations), rotations)


def _curve(keys: list[tuple[float, Triple]]) -> scipy.interpolate.PchipInterpolator:
    """Returns the interpolation of keyframe values, at rest in the first and the last one."""
    times = [time for time, _ in keys]
    values = [value for _, value in keys]
    # The value is the same before the first key and after the last one, where it comes to rest.
    times = [times[0] - 1.0, *times, times[-1] + 1.0]
    return scipy.interpolate.PchipInterpolator(
        times, [values[0], *values, values[-1]], axis=0, extrapolate=True
    )


def _turned(angles: Array) -> Array:
    """Returns the rotation (3, 3) by angles (3,) [deg] about z, then y, then x."""
    x, y, z = vector_to_matrix(np.diag(np.radians(angles)))
    return np.asarray(x @ y @ z)


def _below(rotations: Mapping[str, Array]) -> Array:
    """Returns the vector (3,) [m] from the hips to the ground below the midpoint of the ankles."""
    ankles = []
    for side in ("left", "right"):
        hip, knee, ankle = (STANDING[f"{side}_{joint}"] for joint in ("hip", "knee", "ankle"))
        ankles.append(
            rotations["pelvis"] @ hip
            + rotations[f"{side}_hip"] @ (knee - hip)
            + rotations[f"{side}_knee"] @ (ankle - knee)
        )
    middle = np.mean(ankles, axis=0)
    return np.array([middle[0], middle[1], min(ankle[2] for ankle in ankles) - _ANKLE])
