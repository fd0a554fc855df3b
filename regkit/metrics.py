"""How well a sequence was tracked, as the literature measures it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields

import numpy as np

from regkit.arrays import Array
from regkit.body import Body
from regkit.errors import ConfigError
from regkit.model import did_you_mean
from regkit.observation import Truth
from regkit.tracking import Track

TEN_CM = 0.10
"""The threshold of the literature on people [m]."""

NEAR = 0.06
"""A joint is near its reference within this part of the body's size: 10 cm on a tall person."""


@dataclass(frozen=True)
class Measure:
    """Figures of one tracked sequence; None where a figure cannot be had.

    Attributes:
        joint_error_raw_cm: Mean distance of the markers to the reference joints.
        joint_error_adjusted_cm: The same after each marker's constant displacement in its segment
            is subtracted; the displacement of even frames is fitted on odd ones and vice versa.
        within_10cm_percent: How many raw distances are below 10 cm.
        within_10cm_adjusted_percent: How many adjusted distances are below 10 cm.
        near_percent: How many raw distances are below 6 % of the body's size.
        frames: Number of frames.
        lost_frames: Frames in which less than half of the joints are that near.
        unconverged_frames: Frames in which the solver met no tolerance.
        surface_distance_mm: Median over frames of the median distance of the data to the surface.
        limit_violation_deg: Mean over frames of the largest violation of a joint limit.
        evaluations_per_frame: Mean number of energy evaluations.
        fps: Frames per second of observing and registering.
    """

    joint_error_raw_cm: float | None
    joint_error_adjusted_cm: float | None
    within_10cm_percent: float | None
    within_10cm_adjusted_percent: float | None
    near_percent: float | None
    frames: float | None
    lost_frames: float | None
    unconverged_frames: float | None
    surface_distance_mm: float | None
    limit_violation_deg: float | None
    evaluations_per_frame: float | None
    fps: float | None

    def to_dict(self) -> dict[str, float | None]:
        """The figures by name."""
        return asdict(self)


def measured(track: Track, body: Body, truth: Truth | None, joints: Mapping[str, str]) -> Measure:
    """The figures of a track.

    Args:
        track: What was found.
        body: Whose poses they are.
        truth: Reference joints, if there are any.
        joints: Names of reference joints to the body's markers, where they differ.

    Raises:
        ConfigError: If ``joints`` names what is not there, or no joint is known by the body.
    """
    raw, adjusted = (None, None) if truth is None else _distances(track, body, truth, joints)
    frames = len(track.seconds)
    limits = body.skeleton.limits
    violations = [limits.violation(track.pose(index)).max(initial=0.0) for index in range(frames)]
    near = NEAR * body.size
    found = None if raw is None else _fraction_below(raw, near, axis=1)
    lost = None if found is None else int((found < 0.5).sum())
    return Measure(
        joint_error_raw_cm=_mean(raw, 100.0),
        joint_error_adjusted_cm=_mean(adjusted, 100.0),
        within_10cm_percent=_percent_below(raw, TEN_CM),
        within_10cm_adjusted_percent=_percent_below(adjusted, TEN_CM),
        near_percent=_percent_below(raw, near),
        frames=frames,
        lost_frames=lost,
        unconverged_frames=float((track.converged == 0.0).sum()),
        surface_distance_mm=_finite(1000.0 * np.median(track.surface_distances)),
        limit_violation_deg=_finite(np.degrees(np.mean(violations))),
        evaluations_per_frame=float(track.evaluations.mean()),
        fps=float(frames / track.seconds.sum()),
    )


def mean_of(measures: list[Measure]) -> Measure:
    """The mean of each figure over sequences; None where any sequence lacks it or there is none."""
    means: dict[str, float | None] = {}
    for field in fields(Measure):
        values = [getattr(measure, field.name) for measure in measures]
        complete = values and all(value is not None for value in values)
        means[field.name] = float(np.mean(values)) if complete else None
    return Measure(**means)


def joint_errors(track: Track, body: Body, truth: Truth, joints: Mapping[str, str]) -> Array:
    """Raw distances of the matched joints, (T, J) [m]; NaN where the reference is missing."""
    return _distances(track, body, truth, joints)[0]


def _distances(
    track: Track, body: Body, truth: Truth, joints: Mapping[str, str]
) -> tuple[Array, Array]:
    """Raw and adjusted distances (T, J) [m] of the matched joints."""
    columns, markers = matched(body, truth, joints)
    frames = min(len(track.markers), len(truth.positions))
    error = truth.positions[:frames, columns] - track.markers[:frames, markers]
    placements = [body.place(track.pose(index)) for index in range(frames)]
    rotations = np.array([p.transforms[body.markers.segments[markers], :3, :3] for p in placements])
    local = np.einsum("tjba,tjb->tja", rotations, error)
    return np.linalg.norm(error, axis=2), np.linalg.norm(_without_displacement(local), axis=2)


def _without_displacement(local: Array) -> Array:
    """Errors (T, J, 3) in the segments' frames less their constant part, fitted on other frames."""
    adjusted = np.full_like(local, np.nan)
    for parity in (0, 1):
        others = local[1 - parity :: 2] if len(local) > 1 else local[:0]
        seen = np.asarray(np.isfinite(others).all(axis=2))
        counts = seen.sum(axis=0)
        sums = np.where(seen[:, :, None], others, 0.0).sum(axis=0)
        displacement = np.where(counts[:, None] > 0, sums / np.maximum(counts, 1)[:, None], np.nan)
        adjusted[parity::2] = local[parity::2] - displacement
    return adjusted


def matched(body: Body, truth: Truth, joints: Mapping[str, str]) -> tuple[list[int], list[int]]:
    """Columns of the truth, and the body's markers that they are compared with.

    Raises:
        ConfigError: If ``joints`` names what is not there, or no joint is known by the body.
    """
    for name, marker in joints.items():
        if name not in truth.joints:
            raise ConfigError(
                f"the data have no joint '{name}' (there are: {', '.join(truth.joints)})"
                + did_you_mean(name, list(truth.joints)),
                place="dataset.joints",
            )
        if marker not in body.markers.names:
            raise ConfigError(
                f"'{body.name}' has no marker '{marker}' (there are: "
                f"{', '.join(body.markers.names)})"
                + did_you_mean(marker, list(body.markers.names)),
                place=f"dataset.joints.{name}",
            )
    names = [joints.get(name, name) for name in truth.joints]
    pairs = [
        (column, body.markers.names.index(name))
        for column, name in enumerate(names)
        if name in body.markers.names
    ]
    if not pairs:
        raise ConfigError(
            f"no joint of the data ({', '.join(truth.joints)}) is a marker of '{body.name}' "
            f"({', '.join(body.markers.names)}); map them by name (dataset.joints), or leave them "
            "out (dataset.compared=false)",
            place="dataset.joints",
        )
    return [column for column, _ in pairs], [marker for _, marker in pairs]


def _fraction_below(distances: Array, threshold: float, axis: int | None = None) -> Array:
    """How many of the known distances are below a threshold; NaN where none is known."""
    known = np.isfinite(distances).sum(axis=axis)
    below = (distances < threshold).sum(axis=axis)
    return np.asarray(np.where(known > 0, below / np.maximum(known, 1), np.nan))


def _percent_below(distances: Array | None, threshold: float) -> float | None:
    if distances is None:
        return None
    return _finite(100.0 * float(_fraction_below(distances, threshold)))


def _mean(distances: Array | None, factor: float) -> float | None:
    if distances is None or not np.isfinite(distances).any():
        return None
    return factor * float(np.nanmean(distances))


def _finite(value: float | np.floating) -> float | None:
    return float(value) if np.isfinite(value) else None
