"""Organised clouds as what they are: depth images of a camera."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from regkit.clouds import OrganisedCloud, read_organised
from regkit.geometry.camera import Camera
from regkit.geometry.pinhole import measured, pinhole_of
from regkit.geometry.rigid import inverse, transformed
from regkit.observation.frame import Frame
from regkit.system.arrays import Array, measured_points
from regkit.system.notes import note


def organised_frame(path: Path, *, tell: bool = True) -> Frame | None:
    """Returns the frame of a file with an organised cloud, in the frame of the camera that saw it.

    The camera is fitted to the grid: in the coordinates of the file, or else in those of the
    viewpoint that the file gives.

    Args:
        path: The file.
        tell: Whether to tell of the camera.

    Returns:
        The frame with its camera and depth image; None if the cloud is not organised, or not seen
        by a pinhole camera.

    Raises:
        DataError: If an organised file is damaged, or a coordinate is absurdly large.
    """
    cloud = read_organised(path)
    if cloud is None:
        return None
    for points, frame in _coordinates(cloud):
        camera = pinhole_of(points)
        if camera is not None:
            if tell:
                note(_told(camera, frame), place=path)
            shown = measured(points)
            depth = np.where(shown, points[..., 2], 0.0)
            seen = measured_points(points[shown], place=str(path))
            return Frame(seen, camera, depth, place=str(path))
    return None


def _coordinates(cloud: OrganisedCloud) -> list[tuple[Array, str]]:
    """Returns the points (H, W, 3) in each frame that may be the camera's, and its name."""
    found = [(cloud.points, "")]
    if not np.array_equal(cloud.T_cloud_sensor, np.eye(4)):
        shown, T_sensor_cloud = measured(cloud.points), inverse(cloud.T_cloud_sensor)
        moved = np.full(cloud.points.shape, np.nan)
        moved[shown] = transformed(T_sensor_cloud, cloud.points[shown])
        found.append((moved, ", in the frame of its VIEWPOINT"))
    return found


def _told(camera: Camera, frame: str) -> str:
    focal = f"{camera.fx:.5g}"
    if f"{camera.fy:.5g}" != focal:
        focal += f" and {camera.fy:.5g}"
    return (
        f"read as the depth image of a camera with f = {focal} px and c = ({camera.cx:.5g}, "
        f"{camera.cy:.5g}), {camera.width}x{camera.height}{frame}"
    )
