"""Recording of a track frame by frame, with memory that does not grow with the images."""

from __future__ import annotations

from array import array
from dataclasses import dataclass, fields
from sys import intern

import numpy as np

from regkit.body import BodyFit
from regkit.body.support import segment_supports
from regkit.interfaces import Expected, Registrar
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.tracking.loop import TrackedFrame
from regkit.tracking.sample import FrameSample
from regkit.tracking.session import Session
from regkit.tracking.track import Track


@dataclass(frozen=True)
class Snapshot(Brief):
    """A frame for pictures.

    Attributes:
        frame: Index of the frame in the recording.
        points: The frame's data, (N, 3) [m].
        pose: The registered pose.
    """

    frame: int
    points: Array
    pose: Pose


class TrackRecorder:
    """Records the tracked frames of a session one by one.

    It stores the values of a ``Track`` for every frame, and the points of only three frames with
    data: the first, the last, and the one whose points are farthest from the surface. Other frames
    are read again on request. A ``FrameSample`` has thinned points for a replay.

    Args:
        session: The session.
        registrar: Method bound to the session's body.
    """

    def __init__(self, session: Session, registrar: Registrar) -> None:
        self._session = session
        self.registrar = registrar
        self.sample = FrameSample()
        self._values = {field.name: array("d") for field in fields(Track)}
        self._messages: list[str] = []
        self._snapshots: dict[str, Snapshot] = {}
        self._worst = -np.inf

    def __len__(self) -> int:
        """Number of recorded frames."""
        return len(self._messages)

    def add(self, frame: TrackedFrame) -> None:
        """Records the next frame."""
        body, found = self.registrar.body, frame.registered
        transforms = body.place(found.pose).transforms
        points, fit = None, BodyFit.unknown()
        supports = np.zeros(len(transforms))
        if frame.observation is not None:
            points = frame.observation.points
            supports = segment_supports(body, transforms, points)
            self.sample.add(len(self), frame.observation)
            fit = BodyFit.of(body, found.pose, points, frame.observation.silhouette)
        values = {
            "root": found.pose.root,
            "balls": found.pose.balls,
            "hinges": found.pose.hinges,
            "markers": body.markers.place(transforms),
            "surface_distances": fit.distance,
            "inlier_shares": fit.inlier_share,
            "coverages": fit.coverage,
            "misfits": fit.misfit,
            "reliefs": fit.relief,
            "supports": supports,
            "points": 0 if points is None else len(points),
            "energies": found.energy,
            "evaluations": found.evaluations,
            "converged": found.converged,
            "seconds": frame.seconds,
            "preprocessing": frame.preprocessing,
        }
        for name, value in values.items():
            self._values[name].frombytes(np.asarray(value, dtype=np.float64).tobytes())
        if points is not None:
            self._keep(Snapshot(len(self), points, found.pose), fit.distance)
        self._messages.append(intern(found.message))

    def _keep(self, snapshot: Snapshot, distance: float) -> None:
        self._snapshots.setdefault("first", snapshot)
        self._snapshots["last"] = snapshot
        if distance > self._worst:
            self._worst = distance
            self._snapshots["worst"] = snapshot

    def track(self) -> Track:
        """Returns all recorded frames as arrays."""
        rest, markers = self.registrar.body.skeleton.rest(), self.registrar.body.markers
        shapes = {
            "root": rest.root.shape,
            "balls": rest.balls.shape,
            "hinges": rest.hinges.shape,
            "markers": (len(markers.names), 3),
            "supports": (len(self.registrar.body.skeleton.names),),
        }
        return Track(
            **{
                name: np.array(values).reshape(len(self), *shapes.get(name, ()))
                for name, values in self._values.items()
            }
        )

    def message(self, index: int) -> str:
        """Returns the reason why the registration of a frame ended."""
        return self._messages[index]

    def snapshot(self, index: int) -> Snapshot:
        """Returns a frame for pictures, read again unless it is stored.

        Raises:
            RegkitError: If it cannot be read again, or has no data.
        """
        for kept in self._snapshots.values():
            if kept.frame == index:
                return kept
        track, body = self.track(), self.registrar.body
        # A segmenter follows the body, from the start on.
        expected = Expected(body, track.pose(max(index - 1, 0)))
        points = self._session.observation(index, expected).points
        return Snapshot(index, points, track.pose(index))
