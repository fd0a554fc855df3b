"""Joint errors, raw and after subtraction of each marker's constant displacement."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from regkit.body import Body
from regkit.metrics.matching import check_reference_unit, matched
from regkit.metrics.parts import exchanged_frames, parts_of_markers
from regkit.observation import Truth
from regkit.system.arrays import Array
from regkit.tracking import Track

HALF_WIDTH = 1.6448536269514722
"""Half the width of a normal distribution's central 90 % interval, in standard deviations."""


RADIUS = 2.5002777108094148
"""Radius of the ball that holds 90 % of an isotropic normal distribution in space, in standard
deviations along an axis."""


@dataclass(frozen=True)
class JointErrors:
    """Distances between the body's markers and the reference joints, in T frames for J joints.

    Attributes:
        joints: Names of the joints in the data, (J,).
        raw: Distances, (T, J) [m]; NaN where the reference is missing.
        adjusted: Distances after subtraction of each marker's constant displacement in its segment
            frame, (T, J) [m]. The displacement of even frames is estimated on odd ones and vice
            versa.
        deviations: Standard deviation that the method gives each marker, the root of the mean over
            the camera's axes, (T, J) [m]; None if it gives none.
        covered: Share of the three coordinates whose adjusted error is within the 90 % interval of
            the marker, (T, J). A constant displacement is a matter of where a marker is defined,
            and no error of the pose.
        parts: Name of the part of each joint, (J,), which is empty for joints of no part; empty if
            the body has no parts.
        exchanged: 1 where two parts of like joints, exchanged, would be nearer to the reference,
            else 0, (T,); None without such parts.
    """

    joints: tuple[str, ...]
    raw: Array
    adjusted: Array
    deviations: Array | None = None
    covered: Array | None = None
    parts: tuple[str, ...] = ()
    exchanged: Array | None = None

    def of_part(self, part: str) -> JointErrors:
        """Returns the errors of the joints of one part."""
        own = np.array([name == part for name in self.parts], dtype=bool)
        return replace(
            self,
            joints=tuple(joint for joint, kept in zip(self.joints, own, strict=True) if kept),
            raw=self.raw[:, own],
            adjusted=self.adjusted[:, own],
            deviations=None if self.deviations is None else self.deviations[:, own],
            covered=None if self.covered is None else self.covered[:, own],
            parts=(part,) * int(own.sum()),
            exchanged=None,
        )

    def expected(self) -> Array | None:
        """Returns the distance within which a joint is expected in 9 of 10 cases, (T,) [m].

        The mean over the joints in each frame; None if the method does not know how sure it is.
        """
        if self.deviations is None:
            return None
        known = np.isfinite(self.deviations)
        sums = np.where(known, self.deviations, 0.0).sum(axis=1)
        counts = known.sum(axis=1)
        return np.where(counts > 0, RADIUS * sums / np.maximum(counts, 1), np.nan)

    def of_frames(self) -> Array:
        """Returns the mean raw distance in each frame, (T,) [m]; NaN where no joint is known."""
        known = np.isfinite(self.raw)
        sums = np.where(known, self.raw, 0.0).sum(axis=1)
        counts = known.sum(axis=1)
        return np.where(counts > 0, sums / np.maximum(counts, 1), np.nan)


def joint_errors(track: Track, body: Body, truth: Truth, joints: Mapping[str, str]) -> JointErrors:
    """Computes the joint errors of a track.

    Args:
        track: The track.
        body: The tracked body.
        truth: Reference joints.
        joints: Marker of the body for each reference joint whose name differs.

    Raises:
        ConfigError: If ``joints`` names an unknown joint or marker, or no joint matches a marker.
        DataError: If the reference is in another unit than the body.
    """
    columns, markers = matched(body, truth, joints)
    check_reference_unit(body, truth, joints)
    frames = min(len(track.markers), len(truth.positions))
    error = truth.positions[:frames, columns] - track.markers[:frames, markers]
    placements = [body.place(track.pose(index)) for index in range(frames)]
    rotations = np.array([p.transforms[body.markers.segments[markers], :3, :3] for p in placements])
    local = np.einsum("tjba,tjb->tja", rotations, error)
    adjusted = _without_displacement(local)
    deviations = covered = None
    known = track[:frames].marker_deviations(body)
    if known is not None:
        sides = known[:, markers]
        deviations = np.sqrt((sides**2).mean(axis=2))
        beyond = np.abs(np.einsum("tjab,tjb->tja", rotations, adjusted)) > HALF_WIDTH * sides
        certain = np.isfinite(adjusted).all(axis=2) & np.isfinite(deviations)
        covered = np.where(certain, 1.0 - beyond.mean(axis=2), np.nan)
    parts = parts_of_markers(body, markers) if body.parts else ()
    exchanged = None
    if parts:
        exchanged = exchanged_frames(
            [body.markers.names[marker] for marker in markers],
            parts,
            track.markers[:frames, markers],
            truth.positions[:frames, columns],
        )
    return JointErrors(
        joints=tuple(truth.joints[column] for column in columns),
        raw=np.linalg.norm(error, axis=2),
        adjusted=np.linalg.norm(adjusted, axis=2),
        deviations=deviations,
        covered=covered,
        parts=parts,
        exchanged=exchanged,
    )


def _without_displacement(local: Array) -> Array:
    """Subtracts from errors (T, J, 3) in segment frames their mean over the other frames."""
    adjusted = np.full_like(local, np.nan)
    for parity in (0, 1):
        others = local[1 - parity :: 2] if len(local) > 1 else local[:0]
        seen = np.asarray(np.isfinite(others).all(axis=2))
        counts = seen.sum(axis=0)
        sums = np.where(seen[:, :, None], others, 0.0).sum(axis=0)
        displacement = np.where(counts[:, None] > 0, sums / np.maximum(counts, 1)[:, None], np.nan)
        adjusted[parity::2] = local[parity::2] - displacement
    return adjusted
