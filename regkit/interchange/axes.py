"""Axis conventions of files: which axis is up, and which is the front."""

from __future__ import annotations

import numpy as np

from regkit.system.arrays import Array
from regkit.system.errors import ConfigError

_DIRECTIONS = {
    sign + letter: float(f"{sign}1") * axis
    for sign in ("", "-")
    for letter, axis in zip("xyz", np.eye(3), strict=True)
}


def body_axes(up: str, front: str) -> Array:
    """Returns ``R_body_file`` (3, 3), where a body has y up, z to the front and x to its left.

    Args:
        up: The up axis of the file: x, y, z, -x, -y or -z.
        front: The front axis of the file.

    Raises:
        ConfigError: If one is not an axis, or they are parallel.
    """
    for argument, axis in (("up", up), ("front", front)):
        if axis not in _DIRECTIONS:
            known = ", ".join(_DIRECTIONS)
            raise ConfigError(f"'{axis}' is not an axis (there are: {known})", place=argument)
    y, z = _DIRECTIONS[up], _DIRECTIONS[front]
    if y @ z != 0.0:
        raise ConfigError(f"up is {up}; the front cannot be {front}", place="front")
    return np.stack([np.cross(y, z), y, z])
