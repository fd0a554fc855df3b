"""Cameras with lens distortion, and the rectification of their depth images."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from regkit.geometry.camera import Camera, camera_content, tell_unread
from regkit.geometry.distortion import Distortion, distortion_of
from regkit.system.arrays import Array, Indices
from regkit.system.guard import reading


@dataclass(frozen=True)
class Lens:
    """A camera as it is, with the distortion of its lens.

    Attributes:
        camera: The pinhole camera of the rectified images; size and intrinsics are those of the
            images as they are measured.
        distortion: The distortion of measured images; None if there is none.
    """

    camera: Camera
    distortion: Distortion | None = None

    def rectified(self, depth: Array, *, place: str | None = None) -> Array:
        """Returns the depth image of the pinhole camera, (H, W) [m]; zero where nothing is known.

        Each pixel takes the depth of the nearest measured pixel: depths are never interpolated, as
        there is nothing between a body and what is behind it. The depth along the optical axis does
        not change.

        Args:
            depth: The measured image, (H, W) [m].
            place: Where the image comes from, for messages.

        Raises:
            DataError: If the image size differs from the camera's.
        """
        self.camera.check_size(depth, place=place)
        if self.distortion is None or self.distortion.is_none:
            return depth
        return np.asarray(np.where(self.sources < 0, 0.0, depth.ravel()[self.sources]))

    @cached_property
    def sources(self) -> Indices:
        """Flat index of the measured pixel of each rectified pixel, (H, W); -1 if it is outside."""
        camera = self.camera
        directions = camera.rays()[..., :2].reshape(-1, 2)
        shown = directions if self.distortion is None else self.distortion.distorted(directions)
        columns, rows = (shown * [camera.fx, camera.fy] + [camera.cx, camera.cy]).T
        inside = (columns > -0.5) & (columns < camera.width - 0.5)
        inside &= (rows > -0.5) & (rows < camera.height - 0.5)
        sources = np.full(len(shown), -1, dtype=np.intp)
        sources[inside] = np.rint(rows[inside]) * camera.width + np.rint(columns[inside])
        return sources.reshape(camera.height, camera.width)

    @classmethod
    def read(cls, path: Path) -> Lens:
        """Reads a camera's file, with the optional field ``distortion``.

        Raises:
            DataError: If the file is missing, or does not describe such a camera.
        """
        return cls.described_by(camera_content(path), path)

    @classmethod
    def described_by(cls, content: dict[str, Any], path: Path) -> Lens:
        """Returns the camera of a file's content, with the optional field ``distortion``.

        Raises:
            DataError: If it does not describe such a camera.
        """
        with reading(path, "a camera file"):
            lens = cls(Camera.described_by(content), distortion_of(content.get("distortion")))
        tell_unread(content, path, besides=("distortion",))
        return lens
