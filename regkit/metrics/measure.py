"""The metrics of one tracked recording."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from typing import Annotated, Any

import numpy as np
from pydantic import Field, Strict

from regkit.body import Body
from regkit.interfaces import Start
from regkit.metrics.joints import JointErrors
from regkit.metrics.losses import Losses
from regkit.metrics.thresholds import auc, fraction_within
from regkit.system.arrays import Array
from regkit.tracking import Track, TrackVerdict, Verdict

TEN_CM = 0.10
"""The usual threshold in the literature on people [m]."""

PCK_FRACTION = 0.06
"""The PCK threshold as a fraction of the body's size: 10 cm for a tall person."""

AUC_FRACTION = 2.0 * PCK_FRACTION
"""The largest threshold of the AUC as a fraction of the body's size: 20 cm for a tall person."""


Positive = Annotated[float, Field(gt=0.0)]
Amount = Annotated[float, Field(ge=0.0)]
Percent = Annotated[float, Field(ge=0.0, le=100.0)]
Fraction = Annotated[float, Field(ge=0.0, le=1.0)]


@dataclass(frozen=True)
class Measure:
    """Metrics of one tracked recording; a metric that is not defined is None.

    The bounds of the fields are those of ``checked_measure``.

    Attributes:
        joint_error_raw_cm: Mean distance between markers and reference joints.
        joint_error_adjusted_cm: The same after subtraction of each marker's constant displacement
            in its segment frame, estimated for even frames on odd ones and vice versa.
        within_10cm_percent: Percentage of raw distances below 10 cm.
        within_10cm_adjusted_percent: Percentage of adjusted distances below 10 cm.
        pck_percent: Percentage of raw distances below 6 % of the body's size (PCK).
        auc_percent: Area under the curve of the percentage of raw distances within a threshold,
            from 0 to 12 % of the body's size; 100 if all distances are zero.
        auc_adjusted_percent: The same for adjusted distances.
        frames: Number of frames.
        lost_frames: Number of frames with less than half of the joints within the PCK threshold.
        recovery_s: Mean time until a lost body is recovered; None if it was never lost.
        lost_at_end: 1 if the body is lost in the last frame, else 0.
        unconverged_frames: Number of frames in which the solver did not converge.
        found_percent: Percentage of the frames with data in which the body was found, judged by
            the data alone.
        inlier_percent: Mean percentage of the points that lie on the body's surface.
        coverage_percent: Mean percentage of the body that has data nearby.
        frames_without_data: Number of frames without data, which keep the last pose.
        surface_distance_mm: Median over frames of the median distance of the data to the surface.
        limit_violation_deg: Mean over frames of the largest joint limit violation.
        evaluations_per_frame: Mean number of energy evaluations per frame.
        preprocessing_ms: Mean preprocessing time per frame.
        registering_ms: Mean registration time per frame.
        fps: Frames per second of preprocessing and registration, over the frames with data.
        marker_deviation_cm: Mean over markers and frames of the standard deviation along an axis
            that the method gives a marker; None if it gives none.
        interval_coverage_percent: Percentage of the joints' coordinates whose adjusted error is
            within the 90 % interval of the marker.
        exchanged_percent: Percentage of the frames in which two parts of like joints, such as two
            hands, would be nearer to the reference if they were exchanged; None without such parts.
        verdict: Whether the body was found in the recording: found, doubtful or lost.
        reason: Why it is doubtful or lost, or how many frames have no data; None if neither.
    """

    joint_error_raw_cm: Amount | None
    joint_error_adjusted_cm: Amount | None
    within_10cm_percent: Percent | None
    within_10cm_adjusted_percent: Percent | None
    pck_percent: Percent | None
    auc_percent: Percent | None
    auc_adjusted_percent: Percent | None
    frames: Positive | None
    lost_frames: Amount | None
    recovery_s: Positive | None
    lost_at_end: Fraction | None
    unconverged_frames: Amount | None
    found_percent: Percent | None
    inlier_percent: Percent | None
    coverage_percent: Percent | None
    frames_without_data: Amount | None
    surface_distance_mm: Amount | None
    limit_violation_deg: Amount | None
    evaluations_per_frame: Amount | None
    preprocessing_ms: Amount | None
    registering_ms: Amount | None
    fps: Positive | None
    marker_deviation_cm: Amount | None
    interval_coverage_percent: Percent | None
    exchanged_percent: Percent | None
    # JSON holds the verdict as text.
    verdict: Annotated[Verdict, Strict(strict=False)] | None = None
    reason: str | None = None

    def to_dict(self) -> dict[str, Any]:
        """Returns the metrics, the verdict and its reason by name."""
        return asdict(self)

    def numbers(self) -> dict[str, float | None]:
        """Returns the metrics by name, without the verdict."""
        return {name: getattr(self, name) for name in METRICS}


METRICS = tuple(field.name for field in fields(Measure) if field.name not in ("verdict", "reason"))
"""Names of the metrics, which are numbers."""


ONLY_WHERE_LOST = ("recovery_s",)
"""Metrics that are defined only for recordings in which the body was lost."""


def measured(
    track: Track,
    body: Body,
    errors: JointErrors | None,
    fps: float,
    start: Start | None = None,
) -> Measure:
    """Computes the metrics of a track.

    Args:
        track: The track.
        body: The tracked body.
        errors: Joint errors, if there are reference joints.
        fps: Frames per second of the recording.
        start: The start, whose doubts are those of the track.
    """
    raw, adjusted = (None, None) if errors is None else (errors.raw, errors.adjusted)
    frames = len(track.seconds)
    limits = body.skeleton.limits
    violations = [limits.violation(track.pose(index)).max(initial=0.0) for index in range(frames)]
    threshold, largest = PCK_FRACTION * body.size, AUC_FRACTION * body.size
    losses = None if raw is None else Losses.of(raw, threshold)
    judged, seen = TrackVerdict.of(track, start=start), track.seen
    found = np.array(track.verdicts)[seen] == Verdict.FOUND
    return Measure(
        joint_error_raw_cm=_mean(raw, 100.0),
        joint_error_adjusted_cm=_mean(adjusted, 100.0),
        within_10cm_percent=_percent_within(raw, TEN_CM),
        within_10cm_adjusted_percent=_percent_within(adjusted, TEN_CM),
        pck_percent=_percent_within(raw, threshold),
        auc_percent=_auc_percent(raw, largest),
        auc_adjusted_percent=_auc_percent(adjusted, largest),
        frames=frames,
        lost_frames=None if losses is None else int(losses.lost.sum()),
        recovery_s=None if losses is None else losses.recovery(fps),
        lost_at_end=None if losses is None else int(losses.at_end),
        unconverged_frames=float((track.converged[seen] == 0.0).sum()),
        found_percent=100.0 * float(found.mean()) if seen.any() else None,
        inlier_percent=_mean(track.inlier_shares, 100.0),
        coverage_percent=_mean(track.coverages, 100.0),
        frames_without_data=int((~seen).sum()),
        surface_distance_mm=_median(1000.0 * track.surface_distances),
        limit_violation_deg=_finite(np.degrees(np.mean(violations))),
        evaluations_per_frame=_mean(track.evaluations[seen], 1.0),
        preprocessing_ms=_mean(track.preprocessing[seen], 1000.0),
        registering_ms=_mean((track.seconds - track.preprocessing)[seen], 1000.0),
        fps=float(seen.sum() / track.seconds[seen].sum()) if seen.any() else None,
        marker_deviation_cm=_mean(_deviations(track, body), 100.0),
        interval_coverage_percent=_mean(None if errors is None else errors.covered, 100.0),
        exchanged_percent=_mean(None if errors is None else errors.exchanged, 100.0),
        verdict=judged.verdict,
        reason=judged.reason or None,
    )


def mean_of(measures: Sequence[Measure]) -> Measure:
    """Returns the mean of each metric over recordings; None where a recording lacks it.

    The recovery time is averaged over the recordings in which the body was lost.
    """
    means: dict[str, Any] = {}
    for name in METRICS:
        values = [getattr(measure, name) for measure in measures]
        if name in ONLY_WHERE_LOST:
            values = [value for value in values if value is not None]
        complete = values and all(value is not None for value in values)
        means[name] = float(np.mean(values)) if complete else None
    return Measure(**means)


def in_words(fps: float | None) -> str:
    """Returns a speed [1/s] with three digits or more, never as a power of ten; a dash for None."""
    if fps is None:
        return "-"
    return f"{fps:.0f} frames per second" if fps >= 100.0 else f"{fps:.3g} frames per second"


def _deviations(track: Track, body: Body) -> Array | None:
    """Returns the standard deviations of all markers, (T, M) [m]; None if they are unknown."""
    sides = track.marker_deviations(body)
    return None if sides is None else np.asarray(np.sqrt((sides**2).mean(axis=2)))


def _percent_within(distances: Array | None, threshold: float) -> float | None:
    if distances is None:
        return None
    return _finite(100.0 * float(fraction_within(distances, threshold)))


def _auc_percent(distances: Array | None, largest: float) -> float | None:
    area = None if distances is None else auc(distances, largest)
    return None if area is None else 100.0 * area


def _mean(distances: Array | None, factor: float) -> float | None:
    if distances is None or not np.isfinite(distances).any():
        return None
    return factor * float(np.nanmean(distances))


def _median(values: Array) -> float | None:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else None


def _finite(value: float | np.floating) -> float | None:
    return float(value) if np.isfinite(value) else None
