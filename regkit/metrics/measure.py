"""The figures of one tracked recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields

import numpy as np

from regkit.body import Body
from regkit.metrics.joints import JointErrors
from regkit.metrics.losses import Losses
from regkit.metrics.thresholds import auc, share_within
from regkit.system.arrays import Array
from regkit.tracking import Track

TEN_CM = 0.10
"""The threshold of the literature on people [m]."""

PCK_PART = 0.06
"""A joint is near its reference within this part of the body's size: 10 cm on a tall person."""

AUC_PART = 2.0 * PCK_PART
"""The threshold curve ends at this part of the body's size: 20 cm on a tall person."""


@dataclass(frozen=True)
class Measure:
    """Figures of one tracked recording; None where a figure cannot be had.

    Attributes:
        joint_error_raw_cm: Mean distance of the markers to the reference joints.
        joint_error_adjusted_cm: The same after each marker's constant displacement in its segment
            is subtracted; the displacement of even frames is fitted on odd ones and vice versa.
        within_10cm_percent: How many raw distances are below 10 cm.
        within_10cm_adjusted_percent: How many adjusted distances are below 10 cm.
        pck_percent: How many raw distances are below 6 % of the body's size.
        auc_percent: Area under the curve of how many raw distances are within a threshold, which
            goes from 0 to 12 % of the body's size; 100 if all of them are zero.
        auc_adjusted_percent: The same of the adjusted distances.
        frames: Number of frames.
        lost_frames: Frames in which less than half of the joints are near.
        recovery_s: Mean time from losing the body to having it again; None if it was never lost.
        lost_at_end: 1 if the last frame is lost, else 0.
        unconverged_frames: Frames in which the solver met no tolerance.
        surface_distance_mm: Median over frames of the median distance of the data to the surface.
        limit_violation_deg: Mean over frames of the largest violation of a joint limit.
        evaluations_per_frame: Mean number of energy evaluations.
        preprocessing_ms: Mean time to make data of a frame.
        registering_ms: Mean time to register it.
        fps: Frames per second of preprocessing and registering.
    """

    joint_error_raw_cm: float | None
    joint_error_adjusted_cm: float | None
    within_10cm_percent: float | None
    within_10cm_adjusted_percent: float | None
    pck_percent: float | None
    auc_percent: float | None
    auc_adjusted_percent: float | None
    frames: float | None
    lost_frames: float | None
    recovery_s: float | None
    lost_at_end: float | None
    unconverged_frames: float | None
    surface_distance_mm: float | None
    limit_violation_deg: float | None
    evaluations_per_frame: float | None
    preprocessing_ms: float | None
    registering_ms: float | None
    fps: float | None

    def to_dict(self) -> dict[str, float | None]:
        """The figures by name."""
        return asdict(self)


ONLY_WHERE_LOST = ("recovery_s",)
"""Figures that a recording lacks because nothing was wrong with it."""


def measured(track: Track, body: Body, errors: JointErrors | None, fps: float) -> Measure:
    """The figures of a track.

    Args:
        track: What was found.
        body: Whose poses they are.
        errors: How far its joints are from their references, if there are any.
        fps: Frames per second at which the recording was recorded.
    """
    raw, adjusted = (None, None) if errors is None else (errors.raw, errors.adjusted)
    frames = len(track.seconds)
    limits = body.skeleton.limits
    violations = [limits.violation(track.pose(index)).max(initial=0.0) for index in range(frames)]
    near, widest = PCK_PART * body.size, AUC_PART * body.size
    losses = None if raw is None else Losses.of(raw, near)
    return Measure(
        joint_error_raw_cm=_mean(raw, 100.0),
        joint_error_adjusted_cm=_mean(adjusted, 100.0),
        within_10cm_percent=_percent_within(raw, TEN_CM),
        within_10cm_adjusted_percent=_percent_within(adjusted, TEN_CM),
        pck_percent=_percent_within(raw, near),
        auc_percent=_percent_area(raw, widest),
        auc_adjusted_percent=_percent_area(adjusted, widest),
        frames=frames,
        lost_frames=None if losses is None else int(losses.lost.sum()),
        recovery_s=None if losses is None else losses.recovery(fps),
        lost_at_end=None if losses is None else int(losses.at_end),
        unconverged_frames=float((track.converged == 0.0).sum()),
        surface_distance_mm=_finite(1000.0 * np.median(track.surface_distances)),
        limit_violation_deg=_finite(np.degrees(np.mean(violations))),
        evaluations_per_frame=float(track.evaluations.mean()),
        preprocessing_ms=1000.0 * float(track.preprocessing.mean()),
        registering_ms=1000.0 * float((track.seconds - track.preprocessing).mean()),
        fps=float(frames / track.seconds.sum()),
    )


def mean_of(measures: Sequence[Measure]) -> Measure:
    """The mean of each figure over recordings; None where any recording lacks it or there is none.

    The time to recover is the mean over the recordings in which the body was lost.
    """
    means: dict[str, float | None] = {}
    for field in fields(Measure):
        values = [getattr(measure, field.name) for measure in measures]
        if field.name in ONLY_WHERE_LOST:
            values = [value for value in values if value is not None]
        complete = values and all(value is not None for value in values)
        means[field.name] = float(np.mean(values)) if complete else None
    return Measure(**means)


def _percent_within(distances: Array | None, threshold: float) -> float | None:
    if distances is None:
        return None
    return _finite(100.0 * float(share_within(distances, threshold)))


def _percent_area(distances: Array | None, widest: float) -> float | None:
    area = None if distances is None else auc(distances, widest)
    return None if area is None else 100.0 * area


def _mean(distances: Array | None, factor: float) -> float | None:
    if distances is None or not np.isfinite(distances).any():
        return None
    return factor * float(np.nanmean(distances))


def _finite(value: float | np.floating) -> float | None:
    return float(value) if np.isfinite(value) else None
