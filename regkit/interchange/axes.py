"""Which way is up in a file, and which is the front."""

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
    """``R_body_file`` (3, 3): a body has y up, z to the front and x to its left.

    Args:
        up: The file's axis that points up: x, y, z, -x, -y or -z.
        front: The one that points to the front.

    Raises:
        ConfigError: If they are no axes, or along one line.
    """
    for argument, axis in (("up", up), ("front", front)):
        if axis not in _DIRECTIONS:
            known = ", ".join(_DIRECTIONS)
            raise ConfigError(f"'{axis}' is no axis (there are: {known})", place=argument)
    y, z = _DIRECTIONS[up], _DIRECTIONS[front]
    if y @ z != 0.0:
        raise ConfigError(f"up is {up}; the front cannot be {front}", place="front")
    return np.stack([np.cross(y, z), y, z])
