"""The pose in one frame of a stream."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Self

from regkit.observation import Observation
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.tracking import Verdict
from regkit.tracking.live import LiveFrame


@dataclass(frozen=True)
class LivePose(Brief):
    """The body in one frame of a stream.

    Attributes:
        number: Number of the frame in the stream, from 0; dropped frames count too.
        time: Its time on the stream's clock [s].
        pose: The pose.
        segments: T_camera_segment of each of S segments, (S, 4, 4) [m].
        markers: The markers in the camera's frame, (M, 3) [m].
        supports: How well data support each segment, (S,), from 0 to 1; NaN for one without
            capsules.
        verdict: Whether the body was found.
        inlier_share: Fraction of the points that lie on the body; NaN without data.
        observation: The data of the frame; None if it has none.
        latency: Time from the frame's arrival to its pose [s].
        seconds: Time to preprocess and register [s].
        deviations: Standard deviations of the markers along the camera's axes, (M, 3) [m]; None if
            the method does not know them, or without data.
        bodies: Whether each of several bodies was found, by name; empty for one body.
    """

    number: int
    time: float
    pose: Pose
    segments: Array
    markers: Array
    supports: Array
    verdict: Verdict
    inlier_share: float
    observation: Observation | None
    latency: float
    seconds: float
    deviations: Array | None = None
    bodies: Mapping[str, Verdict] = field(default_factory=dict)

    @classmethod
    def of(cls, frame: LiveFrame) -> Self:
        """Returns the pose of a tracked frame."""
        tracked, recorded = frame.tracked, frame.recorded
        return cls(
            number=frame.number,
            time=frame.time,
            pose=tracked.registered.pose,
            segments=recorded.placement.transforms,
            markers=recorded.markers,
            supports=recorded.supports,
            verdict=recorded.verdict,
            inlier_share=recorded.fit.inlier_share,
            observation=tracked.observation,
            latency=frame.latency,
            seconds=tracked.seconds,
            deviations=recorded.deviations(),
            bodies=recorded.bodies,
        )
