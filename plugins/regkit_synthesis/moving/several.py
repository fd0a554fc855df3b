"""Several moving bodies in one scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from regkit.geometry.rigid import inverse
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError, RegkitError
from regkit_synthesis.moving.moved import Moved
from regkit_synthesis.moving.moving import Moving


class MovingPart(Moving):
    """One of several bodies that move."""

    carrier: str | None = None
    """Name of the body that carries this one, such as the hand that holds an object: the course is
    then relative to that body's first bone, as it is in the first frame."""


def joined_bodies(parts: Mapping[str, MovingPart]) -> Moved:
    """Returns several moving bodies as one.

    Args:
        parts: The bodies by name.

    Raises:
        RegkitError: If one of them cannot move, or its carrier is unknown or carried itself.
    """
    moved = {name: _located(part.moved, name) for name, part in parts.items()}
    whole = {}
    for name, part in parts.items():
        whole[name] = moved[name]
        if part.carrier is None:
            continue
        if part.carrier not in parts or parts[part.carrier].carrier is not None:
            free = [other for other, one in parts.items() if one.carrier is None]
            raise ConfigError(
                f"'{part.carrier}' carries nothing; the bodies that can are {', '.join(free)}",
                place=f"bodies.{name}.carrier",
            )
        whole[name] = moved[name].along(_carriage(moved[part.carrier]))
    return Moved.joined(whole)


def _carriage(carrier: Moved) -> Callable[[float], Array]:
    """Returns the function from a time [s] to the motion (4, 4) of a carrier since its start."""
    back = inverse(carrier.bone_poses(0.0)[0])
    return lambda time: np.asarray(carrier.bone_poses(time)[0] @ back)


def _located(moved: Callable[[], Moved], name: str) -> Moved:
    try:
        return moved()
    except RegkitError as error:
        raise type(error)(f"{error}", place=f"bodies.{name}") from None
