"""The result of tracking, for notebooks: arrays, metrics, a table and a picture."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, overload

import numpy as np

from regkit.api.reference import Reference, truth_of
from regkit.api.registration import Registration
from regkit.api.tables import Summary
from regkit.body import Body
from regkit.interfaces import Registrar, Start
from regkit.metrics import JointErrors, Measure, in_words, joint_errors, measured
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, DataError, RegkitError
from regkit.system.files import write_arrays
from regkit.tracking import (
    Smoothing,
    Snapshot,
    Track,
    TrackRecorder,
    TrackVerdict,
    Verdict,
    smoothed,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from regkit.viewer.embedded import SceneView


class TrackingError(RegkitError):
    """A recording could not be tracked to its end.

    Args:
        message: What is wrong with the frame.
        place: The frame.
        tracked: The frames before it.
    """

    def __init__(
        self, message: str, *, place: str | None = None, tracked: Tracking | None = None
    ) -> None:
        super().__init__(message, place=place)
        self.tracked = tracked


@dataclass(frozen=True, repr=False)
class Tracking(Summary):
    """A tracked recording of T frames.

    ``len`` is T; an index gives the ``Registration`` of a frame, a slice a ``Tracking``.

    Attributes:
        name: Name of the recording.
        method: Name of the method.
        fps: Frame rate of the recording [1/s].
        start: The pose and size in the first frame, with their verdict.
        registrar: The registrar of the frames.
        recorder: Frames recorded during tracking.
        indices: Positions of the frames among those that were recorded.
        track: The frames as arrays: numbers (T,), times (T,) [s], root (T, 4, 4) [m], balls
            (T, n_ball, 4), hinges (T, n_hinge) [rad], markers, seconds and more.
        is_smoothed: Whether the poses are those of ``smoothed``.
    """

    name: str
    method: str
    fps: float
    start: Start
    registrar: Registrar
    recorder: TrackRecorder
    indices: range
    track: Track
    is_smoothed: bool = False

    @classmethod
    def of(
        cls, name: str, method: str, fps: float, start: Start, recorder: TrackRecorder
    ) -> Tracking:
        """Returns everything that was recorded.

        Args:
            name: Name of the recording.
            method: Name of the method.
            fps: Frame rate of the recording [1/s].
            start: The pose and size in the first frame.
            recorder: The recorded frames.
        """
        rows, track = range(len(recorder)), recorder.track()
        return cls(name, method, fps, start, recorder.registrar, recorder, rows, track)

    @property
    def body(self) -> Body:
        """The body at its given or estimated size."""
        return self.registrar.body

    @property
    def size(self) -> float:
        """Size of the body [m]: its height, length, or another size that the template defines."""
        return self.body.size

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Names of the M markers, which match reference joints to markers."""
        return self.body.markers.names

    @property
    def markers(self) -> Array:
        """Positions of the markers in the camera's frame, (T, M, 3) [m]."""
        return self.track.markers

    @cached_property
    def deviations(self) -> Array | None:
        """Standard deviations of the markers along the camera's axes, (T, M, 3) [m].

        NaN for a frame without data; None if the method does not know how sure it is.
        """
        return self.track.marker_deviations(self.body)

    @property
    def covariances(self) -> Array | None:
        """Covariances of the degrees of freedom, (T, n, n), on the tangent space; None if unknown.

        They are those of the step of ``Skeleton.retract`` from each pose, in [m] and [rad].
        """
        return self.track.covariances

    @property
    def numbers(self) -> tuple[int, ...]:
        """Numbers of the frames in the recording, (T,); a camera's dropped frames are missing."""
        return tuple(map(int, self.track.numbers))

    @property
    def poses(self) -> tuple[Pose, ...]:
        """The pose in each frame."""
        return tuple(map(self.track.pose, range(len(self))))

    @cached_property
    def segments(self) -> Array:
        """T_camera_segment of each of S segments, (T, S, 4, 4) [m], in the order of ``body``."""
        return np.array([self.body.place(pose).transforms for pose in self.poses])

    @cached_property
    def judged(self) -> TrackVerdict:
        """Whether the body was found in these frames, and the reason if not."""
        return TrackVerdict.of(self.track, self.start)

    @property
    def verdict(self) -> Verdict:
        """Whether the body was found in these frames: found, doubtful or lost."""
        return self.judged.verdict

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """Whether the body was found in each frame, (T,): found, doubtful, lost or no data."""
        return self.track.verdicts

    @property
    def body_verdicts(self) -> dict[str, tuple[Verdict, ...]]:
        """Whether each of several bodies was found in each frame, (T,), by name; hidden: no data.

        Empty for one body.
        """
        each = zip(*self.track.body_verdicts, strict=True)
        return dict(zip([one.name for one in self.body.free_bodies], each, strict=False))

    @property
    def inlier_shares(self) -> Array:
        """Fraction of each frame's points that lie on the body, (T,); NaN without data."""
        return self.track.inlier_shares

    @property
    def coverages(self) -> Array:
        """Fraction of the body that has data nearby in each frame, (T,); NaN without data."""
        return self.track.coverages

    def measure(self, truth: Reference | None = None) -> Measure:
        """Returns the metrics of an experiment's report.

        Args:
            truth: Reference joints; without them there are no joint errors.

        Raises:
            RegkitError: If they do not match the frames or the markers.
        """
        return measured(self.track, self.body, self._errors(truth), self.fps, self.start)

    def error(self, truth: Reference) -> float:
        """Returns the mean distance [m] of the markers to the visible reference joints.

        Raises:
            RegkitError: If they do not match the frames or the markers, or none is visible.
        """
        known = truth_of(truth, self.body, self.numbers)
        distances = joint_errors(self.track, self.body, known, {}).raw
        if not np.isfinite(distances).any():
            raise DataError("no joint is visible in any frame", place="truth")
        return float(np.nanmean(distances))

    def smoothed(self, settings: Smoothing | None = None) -> Tracking:
        """Returns the same frames with the poses that are most likely, given all of them.

        Hidden limbs and frames without data are interpolated, and there is less noise; the verdicts
        of the frames stay.

        Args:
            settings: How the body moves; by default as people and hands do.

        Raises:
            ConfigError: If the method does not know how sure its poses are.
        """
        track = smoothed(self.track, self.body, settings)
        return replace(self, track=track, is_smoothed=True)

    def plot(self, truth: Reference | None = None) -> Figure:
        """Returns a figure of the first, the worst and the last frame, from the front and the side.

        Args:
            truth: Reference joints, drawn as crosses.
        """
        from regkit.report.overlay import overlay
        from regkit.report.record import Record
        from regkit.report.style import PALETTE

        known = None if truth is None else truth_of(truth, self.body, self.numbers)
        errors = self._errors(truth)
        record = Record.of(self.track, self.snapshot, self.registrar, errors, known, self.fps)
        return overlay(f"{self.method} on {self.name}", record, PALETTE[0])

    def view(self, truth: Reference | None = None, *, height: int = 560) -> SceneView:
        """Returns a view of points, body and verdicts over time: a notebook shows it inline.

        Its ``save`` writes it as a page that opens without a network, its ``open`` opens it in a
        browser. Of a long track some 60 frames are shown.

        Args:
            truth: Reference joints, shown beside the markers.
            height: Height in a notebook [px].

        Raises:
            RegkitError: If the reference does not match, or a frame can no longer be read.
        """
        from regkit.api.viewing import view_of

        return view_of(self, truth, height)

    def save(self, path: str | Path) -> None:
        """Writes the motion as an ``.npz`` file, with the arrays of a run's ``poses.npz``.

        Raises:
            ConfigError: If the suffix is not ``.npz``.
            DataError: If the file cannot be written.
        """
        if Path(path).suffix != ".npz":
            raise ConfigError(f"'{path}' must end with .npz", place="path")
        write_arrays(Path(path), self.track.named_arrays(self.body))

    def _errors(self, truth: Reference | None) -> JointErrors | None:
        if truth is None:
            return None
        return joint_errors(self.track, self.body, truth_of(truth, self.body, self.numbers), {})

    def __len__(self) -> int:
        """Number of frames."""
        return len(self.track)

    @overload
    def __getitem__(self, index: int) -> Registration: ...

    @overload
    def __getitem__(self, index: slice) -> Tracking: ...

    def __getitem__(self, index: int | slice) -> Registration | Tracking:
        """Returns the result of one frame, or of a slice of frames.

        Raises:
            IndexError: If the frame does not exist, or the slice is empty.
        """
        if not isinstance(index, slice):
            at = range(len(self))[index]
            return Registration(self._part(slice(at, at + 1), str(self.numbers[at])))
        start, stop, step = index.indices(len(self))
        if not len(range(start, stop, step)):
            raise IndexError(f"no frame of {len(self)} is in [{start}:{stop}:{step}]")
        label = f"{start}:{stop}" + (f":{step}" if step != 1 else "")
        return self._part(index, label)

    def _part(self, part: slice, label: str) -> Tracking:
        return replace(
            self,
            name=f"{self.name}[{label}]" if len(self) > 1 else self.name,
            fps=self.fps / abs(part.step or 1),
            indices=self.indices[part],
            track=self.track[part],
        )

    def snapshot(self, index: int) -> Snapshot:
        """Returns points and pose of a frame; points that were not kept are read again.

        Raises:
            RegkitError: If the frame can no longer be read.
        """
        kept = self.recorder.snapshot(self.indices[index])
        return replace(kept, frame=index, pose=self.track.pose(index))

    def message(self, index: int) -> str:
        """Returns why the registration of a frame ended."""
        return self.recorder.message(self.indices[index])

    def rows(self) -> dict[str, str]:
        """Returns the rows of a table: recording, method, body, surface distance and speed."""
        measure = self.measure()
        return {
            "recording": f"{self.name}, {len(self)} frames",
            **self.summary(measure),
            "converged": f"{int(self.track.converged.sum())} of {len(self)}",
            "speed": in_words(measure.fps),
            **self.warning(),
        }

    def summary(self, measure: Measure) -> dict[str, str]:
        """Returns the rows that a frame and a recording share: method, body, distance, verdict."""
        surface, inliers = measure.surface_distance_mm, measure.inlier_percent
        return {
            "method": self.method,
            "body": f"{self.body.name}, {self.size:.3g} m",
            "surface": "-" if surface is None else f"half of the data within {surface:.3g} mm",
            "inliers": "-" if inliers is None else f"{inliers:.0f} % of the points",
            "verdict": str(self.verdict),
        }

    def warning(self) -> dict[str, str]:
        """Returns the row that says why the result is doubtful, or none."""
        return {"warning": self.judged.reason} if self.judged.reason else {}
