"""Several cameras as arrays of the file of a scene."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.observation import PlacedCamera
from regkit.system.arrays import real_numbers

LENS = 6
"""Numbers of a camera's lens."""


def camera_arrays(cameras: Sequence[PlacedCamera]) -> dict[str, NDArray[Any]]:
    """Returns cameras as named arrays; an unknown lens is NaN."""
    lenses = [
        [np.nan] * LENS if one.camera is None else [float(v) for v in vars(one.camera).values()]
        for one in cameras
    ]
    return {
        "camera_names": np.array([one.name for one in cameras], dtype=np.str_),
        "camera_poses": np.array([one.T_world_camera for one in cameras]),
        "camera_lenses": np.array(lenses),
    }


def cameras_of(named: Mapping[str, NDArray[Any]]) -> tuple[PlacedCamera, ...]:
    """Returns the cameras of ``camera_arrays``.

    Raises:
        ValueError: If the arrays contradict each other, or a pose is not finite.
    """
    names = tuple(map(str, named["camera_names"]))
    poses, lenses = (real_numbers(named[name], name) for name in ("camera_poses", "camera_lenses"))
    if poses.shape != (len(names), 4, 4) or lenses.shape != (len(names), LENS):
        raise ValueError("the arrays of the cameras differ in length")
    if not np.isfinite(poses).all():
        raise ValueError("'camera_poses' has numbers that are not finite")
    return tuple(
        PlacedCamera(name, pose, lens_of(lens) if np.isfinite(lens).all() else None)
        for name, pose, lens in zip(names, poses, lenses, strict=True)
    )


def lens_of(values: NDArray[Any]) -> Camera:
    """Returns the camera whose fields are six numbers."""
    width, height, *lens = values.tolist()
    return Camera(int(width), int(height), *lens)
