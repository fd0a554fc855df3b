"""Depth cameras with their noise: what they store of what they see."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.sensors.cameras import CameraChoice, camera_of
from regkit.sensors.noise import NOISES, DepthNoise, NoiseChoice, noise_of
from regkit.sensors.raycast import View, stored


@dataclass(frozen=True)
class Sensor:
    """A depth camera.

    Attributes:
        camera: Intrinsics.
        noise: Noise model, or the standard deviation of constant Gaussian noise [m].
        depth_scale: Stored units per metre.
    """

    camera: Camera
    noise: DepthNoise | float
    depth_scale: float

    @classmethod
    def of(cls, camera: CameraChoice, noise: NoiseChoice | None = None) -> Self:
        """Returns a camera by its name, file or numbers.

        Args:
            camera: The camera.
            noise: Its noise; by default that of a known camera, and none of any other.

        Raises:
            DataError: If the camera's file is missing or invalid.
        """
        given = camera_of(camera)
        if noise is None:
            noise = NOISES[camera if isinstance(camera, str) else "none"]
        return cls(given.camera(), noise_of(noise), given.depth_scale)

    def image(self, view: View, random: np.random.Generator) -> NDArray[np.uint16]:
        """Returns the image (H, W) that it stores of a view; 0 for invalid pixels."""
        return stored(noise_of(self.noise).applied(view, random), self.depth_scale)
