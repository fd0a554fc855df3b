"""Keypoints: what a detector found in the pictures of a recording."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from regkit.geometry.camera import Camera
from regkit.observation.frame import Frame
from regkit.observation.landmarks import Landmarks
from regkit.system.arrays import Array, Indices
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError


@dataclass(frozen=True)
class Keypoints(Brief):
    """Landmarks of F frames of a recording, with the same L names in all of them.

    Attributes:
        names: Names of the template's markers, (L,).
        numbers: Numbers of the frames in the recording, ascending, (F,).
        positions: Positions in the camera frame, (F, L, 3) [m]; NaN where unknown.
        pixels: Columns and rows in the rectified depth image, (F, L, 2) [pixels]; NaN where
            unknown.
        confidences: Confidences from 0 (ignored) to 1, (F, L).
        relative: Whether ``pixels`` are fractions of the image's width and height.
        files: The files that they were read from.
    """

    names: tuple[str, ...]
    numbers: Indices
    positions: Array
    pixels: Array
    confidences: Array
    relative: bool = False
    files: tuple[Path, ...] = ()

    @classmethod
    def in_space(cls, names: tuple[str, ...], positions: Array) -> Keypoints:
        """Returns sure keypoints of known positions (F, L, 3) [m] in the frames from 0 on."""
        frames, count = positions.shape[:2]
        pixels = np.full((frames, count, 2), np.nan)
        return cls(names, np.arange(frames), positions, pixels, np.ones((frames, count)))

    @classmethod
    def in_picture(cls, names: tuple[str, ...], pixels: Array) -> Keypoints:
        """Returns sure keypoints of known pixels (F, L, 2) in the frames from 0 on."""
        frames, count = pixels.shape[:2]
        positions = np.full((frames, count, 3), np.nan)
        return cls(names, np.arange(frames), positions, pixels, np.ones((frames, count)))

    def landmarks(self, number: int, camera: Camera | None = None) -> Landmarks | None:
        """Returns the landmarks of a frame; None if the detector found none in it.

        Args:
            number: Number of the frame in the recording.
            camera: Camera of the frame, whose image the fractions are of.

        Raises:
            ConfigError: If the keypoints are in the picture, and there is no camera.
        """
        row = self._rows.get(number)
        if row is None:
            return None
        pixels = self.pixels[row]
        if np.isfinite(pixels).any():
            if camera is None:
                raise ConfigError(
                    "keypoints in the picture belong to the depth images of one camera, and this "
                    "recording has none, or has several; give keypoints in space "
                    "(frame,name,x,y,z,confidence)"
                )
            if self.relative:
                # The middle of the first pixel is half a pixel from the border.
                pixels = pixels * [camera.width, camera.height] - 0.5
        return Landmarks(self.names, self.positions[row], pixels, self.confidences[row])

    def beside(self, frame: Frame, number: int) -> Frame:
        """Returns a frame with its landmarks.

        Args:
            frame: The frame.
            number: Its number in the recording.

        Raises:
            ConfigError: If the keypoints are in the picture, and the frame has no camera.
        """
        try:
            return replace(frame, landmarks=self.landmarks(number, frame.camera))
        except ConfigError as error:
            raise error.at(str(self.files[0]) if self.files else "keypoints") from None

    def renamed(self, markers: Mapping[str, str]) -> Keypoints:
        """Returns the keypoints with some names replaced by those of markers.

        Args:
            markers: Marker of the template for each keypoint whose name differs.

        Raises:
            ConfigError: If there is no keypoint of a name, or two get the same.
        """
        for name in markers:
            if name not in self.names:
                raise ConfigError(
                    f"there is no keypoint '{name}' (there are: {', '.join(self.names)})"
                )
        names = tuple(markers.get(name, name) for name in self.names)
        if len(set(names)) < len(names):
            twice = next(name for name in names if names.count(name) > 1)
            raise ConfigError(f"two keypoints are the marker '{twice}'")
        return replace(self, names=names)

    @cached_property
    def _rows(self) -> dict[int, int]:
        return {int(number): row for row, number in enumerate(self.numbers)}
