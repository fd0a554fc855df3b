"""Joint errors, raw and after subtraction of each marker's constant displacement."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from regkit.body import Body
from regkit.config.model import did_you_mean
from regkit.observation import Truth
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError
from regkit.tracking import Track


@dataclass(frozen=True)
class JointErrors:
    """Distances between the body's markers and the reference joints, in T frames for J joints.

    Attributes:
        joints: Names of the joints in the data, (J,).
        raw: Distances, (T, J) [m]; NaN where the reference is missing.
        adjusted: Distances after subtraction of each marker's constant displacement in its segment
            frame, (T, J) [m]. The displacement of even frames is estimated on odd ones and vice
            versa.
    """

    joints: tuple[str, ...]
    raw: Array
    adjusted: Array


def joint_errors(track: Track, body: Body, truth: Truth, joints: Mapping[str, str]) -> JointErrors:
    """Computes the joint errors of a track.

    Args:
        track: The track.
        body: The tracked body.
        truth: Reference joints.
        joints: Marker of the body for each reference joint whose name differs.

    Raises:
        ConfigError: If ``joints`` names an unknown joint or marker, or no joint matches a marker.
    """
    columns, markers = matched(body, truth, joints)
    frames = min(len(track.markers), len(truth.positions))
    error = truth.positions[:frames, columns] - track.markers[:frames, markers]
    placements = [body.place(track.pose(index)) for index in range(frames)]
    rotations = np.array([p.transforms[body.markers.segments[markers], :3, :3] for p in placements])
    local = np.einsum("tjba,tjb->tja", rotations, error)
    return JointErrors(
        joints=tuple(truth.joints[column] for column in columns),
        raw=np.linalg.norm(error, axis=2),
        adjusted=np.linalg.norm(_without_displacement(local), axis=2),
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


def matched(body: Body, truth: Truth, joints: Mapping[str, str]) -> tuple[list[int], list[int]]:
    """Matches reference joints with markers of the body.

    Args:
        body: The body.
        truth: Reference joints.
        joints: Marker of the body for each reference joint whose name differs.

    Returns:
        Indices of the matched reference joints, and indices of their markers.

    Raises:
        ConfigError: If ``joints`` names an unknown joint or marker, or no joint matches a marker.
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
                f"the template '{body.name}' has no marker '{marker}' (there are: "
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
            f"({', '.join(body.markers.names)}); map their names (dataset.joints), or disable the "
            "comparison (dataset.compared=false)",
            place="dataset.joints",
        )
    return [column for column, _ in pairs], [marker for _, marker in pairs]
