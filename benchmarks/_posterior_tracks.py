"""Tracks of the synthetic suites by the method of each frame alone, by the filter, and smoothed."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from _suite import own_template
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from regkit.body import Body
from regkit.body.support import WEAK
from regkit.cli.choices import method_named, template_named
from regkit.config.document import Document
from regkit.interfaces import Preprocessor, Recording
from regkit.metrics import JointErrors, joint_errors
from regkit.metrics.matching import matched
from regkit.observation import Truth
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.tracking import Session, Track, TrackRecorder, smoothed
from regkit_plugins.datasets.synthetic import Synthetic
from regkit_plugins.presets import HANDS, PEOPLE, SMMC_LIKE

SUITES: dict[str, tuple[str, Path]] = {
    "people": ("human", PEOPLE),
    "smmc_like": ("human", SMMC_LIKE),
    "hands": ("hand", HANDS),
}
"""Type of body and dataset of each suite."""

FEWEST, NEARBY = 3, 0.06
"""A joint is measured if so many points are within this part of the body's size, 10 cm of a person.
"""

POINTS = {
    "human": {"kind": "points", "voxel": 0.03, "sigma": 0.01},
    "hand": {"kind": "points", "voxel": 0.008, "sigma": 0.003},
}
TALL = "{kind: human, build: tall, height: 1.88}"


@dataclass(frozen=True)
class Tracked:
    """A recording, tracked in one way.

    Attributes:
        errors: Joint errors, and how the method's intervals cover them.
        hidden: Whether a joint's segment has little data of its own, (T, J).
        unmeasured: Whether the true joint has no measurements nearby, (T, J): fewer than
            ``FEWEST`` points within ``NEARBY`` of the body's size.
        jitter: Root mean square difference of the joints' accelerations to the true ones, in
            [m] per frame squared.
        seconds: Usual time of a frame from the depth image on, or of smoothing it [s].
    """

    errors: JointErrors
    hidden: NDArray[np.bool_]
    unmeasured: NDArray[np.bool_]
    jitter: float
    seconds: float

    @classmethod
    def of(
        cls,
        track: Track,
        body: Body,
        truth: Truth,
        unmeasured: NDArray[np.bool_],
        seconds: float,
    ) -> Tracked:
        """Returns how a track compares with the true joints."""
        columns, markers = matched(body, truth, {})
        hidden = track.supports[:, body.markers.segments[markers]] < WEAK
        off = track.markers[:, markers] - truth.positions[: len(track), columns]
        acceleration = np.diff(off, n=2, axis=0)
        jitter = float(np.sqrt((acceleration**2).sum(axis=2).mean()))
        return cls(joint_errors(track, body, truth, {}), hidden, unmeasured, jitter, seconds)

    @property
    def raw(self) -> float:
        """Mean joint error [cm]."""
        return 100.0 * float(self.errors.raw.mean())

    def last(self, *joints: str) -> float:
        """Returns the mean error of some joints in the last frame [cm]."""
        own = [self.errors.joints.index(joint) for joint in joints]
        return 100.0 * float(self.errors.raw[-1, own].mean())


@dataclass(frozen=True)
class Compared:
    """A recording, tracked in three ways from one start."""

    suite: str
    name: str
    best: Tracked
    filtered: Tracked
    smoothed: Tracked


def compared(suite: str) -> Iterator[Compared]:
    """Yields the recordings of a suite, tracked in three ways."""
    kind, preset = SUITES[suite]
    preprocessor = Preprocessor.parse(POINTS[kind], place=suite, field="preprocessor")
    for recording in Document.read(preset).validated(Synthetic).chosen():
        subject = f"{kind}_{recording.subject}"
        text = TALL if subject == "human_tall" else own_template(subject)
        session = Session(recording, template_named(text), preprocessor)
        yield _compared(suite, recording, session)


def _compared(suite: str, recording: Recording, session: Session) -> Compared:
    recording.prepare()
    truth = recording.truth()
    assert truth is not None
    start = session.begin()
    tracks, seconds = {}, {}
    columns, _ = matched(start.body, truth, {})
    places = truth.positions[:, columns]
    for name in ("best", "filtered"):
        tracks[name], seconds[name], unmeasured = _track(
            session, name, start.body, start.pose, places
        )
    begun = time.process_time()
    smooth = smoothed(tracks["filtered"], start.body)
    seconds["smoothed"] = (time.process_time() - begun) / len(smooth)
    tracks["smoothed"] = smooth
    kinds = {
        name: Tracked.of(track, start.body, truth, unmeasured, seconds[name])
        for name, track in tracks.items()
    }
    return Compared(suite, recording.name, **kinds)


def _track(
    session: Session, name: str, body: Body, pose: Pose, places: Array
) -> tuple[Track, float, NDArray[np.bool_]]:
    """Returns a track by a preset, the usual time of a frame [s], and unmeasured joints."""
    method = method_named(name)
    registrar = method.bind(body)
    assert method.tracker is not None
    recorder = TrackRecorder(registrar, session.recording.fps)
    unmeasured = []
    for frame, joints in zip(
        session.tracked(registrar, method.tracker, pose), places, strict=False
    ):
        recorder.add(frame)
        assert frame.observation is not None
        near = cKDTree(frame.observation.points).query_ball_point(joints, NEARBY * body.size)
        unmeasured.append([len(found) < FEWEST for found in near])
    track = recorder.track()
    # The median is that of a frame in which no limb is sought.
    return track, float(np.median(track.seconds)), np.array(unmeasured)
