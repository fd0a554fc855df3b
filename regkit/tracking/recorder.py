"""Recording of a track frame by frame, with memory that does not grow with the images."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from sys import intern

import numpy as np

from regkit.body import Body, BodyFit
from regkit.body.each import fits_of_each, shares_of_each, verdicts_of_each
from regkit.body.marker_fit import fit_to_data
from regkit.body.verdict import Verdict, frame_verdict, worst
from regkit.interfaces import Expected, Registrar
from regkit.observation import Observation
from regkit.skeleton import Placement, Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import DataError
from regkit.tracking.loop import TrackedFrame
from regkit.tracking.rows import Rows, RowsInMemory
from regkit.tracking.sample import FrameSample
from regkit.tracking.track import Track


@dataclass(frozen=True)
class Snapshot(Brief):
    """A frame for pictures.

    Attributes:
        frame: Index of the frame among the recorded ones.
        points: The frame's data, (N, 3) [m].
        pose: The registered pose.
    """

    frame: int
    points: Array
    pose: Pose


@dataclass(frozen=True)
class RecordedFrame(Brief):
    """What is recorded of a frame besides its pose.

    Attributes:
        number: Number of the frame in the recording.
        time: Its time [s].
        body: The body.
        placement: T_camera_segment of all segments.
        covariance: Covariance of the pose, (n, n); None if it is unknown.
        markers: The markers in the camera's frame, (M, 3) [m].
        supports: How well data support each segment, (S,), from 0 to 1.
        fit: Agreement of the body with the data.
        verdict: Whether the body was found; of several bodies, each of them.
        bodies: Whether each of several bodies was found, by name; empty for one body.
    """

    number: int
    time: float
    body: Body
    placement: Placement
    covariance: Array | None
    markers: Array
    supports: Array
    fit: BodyFit
    verdict: Verdict
    bodies: Mapping[str, Verdict] = field(default_factory=dict)

    def deviations(self) -> Array | None:
        """Returns the standard deviations of the markers along the camera's axes, (M, 3) [m].

        None if they are unknown.
        """
        if self.covariance is None:
            return None
        jacobian = self.body.markers.jacobian(self.placement)
        variances = np.einsum("mij,mij->mi", jacobian @ self.covariance, jacobian)
        return np.asarray(np.sqrt(np.maximum(variances, 0.0)))


class TrackRecorder:
    """Records tracked frames one by one.

    It stores the values of a ``Track`` for every frame, and the points of only three frames with
    data: the first, the last, and the one whose points are farthest from the surface. Other frames
    are read again on request. A ``FrameSample`` has thinned points for a replay.

    Args:
        registrar: Method bound to the body.
        fps: Frame rate of the recording [1/s], from which times follow that are not given.
        read: Returns the data of a frame by its number and what is known of the body before it;
            None if the frames cannot be read again.
        rows: Where the values are kept, in the layout of the body; in memory by default.
    """

    def __init__(
        self,
        registrar: Registrar,
        fps: float,
        read: Callable[[int, Expected], Observation] | None = None,
        rows: Rows | None = None,
    ) -> None:
        self.registrar = registrar
        self.sample = FrameSample()
        self._fps = fps
        self._read = read
        self._rows = RowsInMemory(Track.layout(registrar.body)) if rows is None else rows
        self._messages: list[str] = []
        self._snapshots: dict[str, Snapshot] = {}
        self._worst = -np.inf

    def __len__(self) -> int:
        """Number of recorded frames."""
        return len(self._messages)

    def add(
        self, frame: TrackedFrame, number: int | None = None, time: float | None = None
    ) -> RecordedFrame:
        """Records the next frame, and returns what is recorded of it.

        Args:
            frame: The frame.
            number: Its number in the recording; by default the number of frames before it.
            time: Its time [s]; by default that of its number at the recording's rate.

        Raises:
            DataError: If the file of the values cannot be written.
        """
        body, found = self.registrar.body, frame.registered
        number = len(self) if number is None else number
        time = number / self._fps if time is None else time
        placement = body.place(found.pose)
        transforms = placement.transforms
        points, fit = None, BodyFit.unknown()
        supports = np.zeros(len(transforms))
        shares = np.full((len(body.free_bodies), 4), np.nan)
        if frame.observation is not None:
            points = frame.observation.points
            self.sample.add(len(self), frame.observation)
            fit, supports = fit_to_data(body, found.pose, frame.observation)
            sight = frame.observation.sight
            shares = shares_of_each(fits_of_each(body, found.pose, points, sight))
        markers = body.markers.place(transforms)
        count = 0 if points is None else len(points)
        self._rows.append(
            {
                "numbers": number,
                "times": time,
                "root": found.pose.root,
                "balls": found.pose.balls,
                "hinges": found.pose.hinges,
                "markers": markers,
                "surface_distances": fit.distance,
                "inlier_shares": fit.inlier_share,
                "coverages": fit.coverage,
                "misfits": fit.misfit,
                "reliefs": fit.relief,
                "supports": supports,
                "points": count,
                "energies": found.energy,
                "evaluations": found.evaluations,
                "converged": found.converged,
                "seconds": frame.seconds,
                "preprocessing": frame.preprocessing,
                "effective_points": found.effective_points,
                "covariances": np.nan if found.covariance is None else found.covariance,
                "pulls": np.nan if found.pull is None else found.pull,
                "information": np.nan if found.information is None else found.information,
                "body_shares": shares,
            }
        )
        if points is not None:
            self._keep(Snapshot(len(self), points, found.pose), fit.distance)
        self._messages.append(intern(found.message))
        verdict = frame_verdict(count, fit.inlier_share, fit.coverage, fit.misfit, fit.relief)
        names = [one.name for one in body.free_bodies]
        bodies = dict(zip(names, verdicts_of_each(shares), strict=True))
        return RecordedFrame(
            number, time, body, placement, found.covariance, markers, supports, fit,
            worst((verdict, *bodies.values())), bodies,
        )  # fmt: skip

    def _keep(self, snapshot: Snapshot, distance: float) -> None:
        self._snapshots.setdefault("first", snapshot)
        self._snapshots["last"] = snapshot
        if distance > self._worst:
            self._worst = distance
            self._snapshots["worst"] = snapshot

    def track(self) -> Track:
        """Returns all recorded frames as arrays."""
        return Track.of(self._rows.arrays())

    def message(self, index: int) -> str:
        """Returns the reason why the registration of a frame ended."""
        return self._messages[index]

    def has(self, index: int) -> bool:
        """Returns whether the points of a frame are stored, or can be read again."""
        kept = any(one.frame == index for one in self._snapshots.values())
        return kept or self._read is not None

    def snapshot(self, index: int) -> Snapshot:
        """Returns a frame for pictures, read again unless it is stored.

        Raises:
            RegkitError: If it cannot be read again, or has no data.
        """
        for kept in self._snapshots.values():
            if kept.frame == index:
                return kept
        track, body = self.track(), self.registrar.body
        number = int(track.numbers[index])
        if self._read is None:
            raise DataError("the points of this frame were not kept", place=f"frame {number}")
        # A segmenter follows the body, from the start on.
        expected = Expected(body, track.pose(max(index - 1, 0)))
        return Snapshot(index, self._read(number, expected).points, track.pose(index))
