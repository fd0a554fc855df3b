"""How far the joints are from their references, as they are and less what is constant."""

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
    """Distances of the body's markers to the reference joints, in T frames and J joints.

    Attributes:
        joints: The joints' names in the data, (J,).
        raw: As they are, (T, J) [m]; NaN where the reference is missing.
        adjusted: After each marker's constant displacement in its segment is subtracted, (T, J)
            [m]; the displacement of even frames is fitted on odd ones and the other way round.
    """

    joints: tuple[str, ...]
    raw: Array
    adjusted: Array


def joint_errors(track: Track, body: Body, truth: Truth, joints: Mapping[str, str]) -> JointErrors:
    """The errors of a track.

    Args:
        track: What was found.
        body: Whose poses they are.
        truth: Reference joints.
        joints: Names of reference joints to the body's markers, where they differ.

    Raises:
        ConfigError: If ``joints`` names what is not there, or no joint is known by the body.
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
