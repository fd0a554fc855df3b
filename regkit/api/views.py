"""One frame of several cameras, from the arrays of a program."""

from __future__ import annotations

from collections.abc import Mapping

from numpy.typing import ArrayLike

from regkit.api.frame import Intrinsics, Measured, frame_of
from regkit.config.model import did_you_mean
from regkit.geometry.rigid import checked_rigid
from regkit.observation import Frame, View
from regkit.system.errors import ConfigError, RegkitError


def frame_of_views(
    measured: Mapping[str, Measured],
    poses: Mapping[str, ArrayLike],
    cameras: Mapping[str, Intrinsics] | None = None,
) -> Frame:
    """Returns one instant of several cameras as a frame, for ``register`` or ``track``.

    A camera without a measurement at this instant is left out of ``measured``.

    Args:
        measured: Depth image (H, W) [m] or cloud (N, 3) [m] of each camera by its name, in the
            camera's own frame (x right, y down, z forward).
        poses: T_world_camera (4, 4) [m] of each camera by its name.
        cameras: Camera of each depth image by its name: a ``Camera``, a ``camera.json``, or its
            matrix K (3, 3) [px].

    Raises:
        RegkitError: If a pose is missing or not rigid, or a measurement is invalid.
    """
    if not measured:
        raise ConfigError("no camera has a measurement", place="measured")
    for name in cameras or {}:
        if name not in measured and name not in poses:
            hint = did_you_mean(name, list(measured))
            raise ConfigError(
                f"'{name}' has neither a measurement nor a pose{hint}", place="cameras"
            )
    views = []
    for name, one in measured.items():
        if name not in poses:
            raise ConfigError(
                f"camera '{name}' has no pose (there are: {', '.join(poses)})"
                + did_you_mean(name, list(poses)),
                place="poses",
            )
        pose = checked_rigid(poses[name], place=f"poses['{name}']")
        try:
            frame = frame_of(one, (cameras or {}).get(name), place=f"measured['{name}']")
        except RegkitError as error:
            raise error.at(f"measured['{name}']") from None
        if frame.views:
            raise ConfigError("this has several cameras itself", place=f"measured['{name}']")
        views.append(View(name, pose, frame))
    return Frame.of_views(views)
