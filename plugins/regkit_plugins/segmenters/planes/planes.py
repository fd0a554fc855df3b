"""The plane segmenter: removes floor and walls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
import scipy
from numpy.typing import NDArray
from pydantic import Field

from regkit.interfaces import BoundSegmenter, Expected, Recording, Segmenter, Template
from regkit.observation import Frame
from regkit.system.arrays import Array
from regkit_plugins.segmenters.planes.plane import Plane
from regkit_plugins.segmenters.planes.search import bounding_planes
from regkit_plugins.segmenters.sampling import sampled

FRAMES = 3
"""Number of frames, spread over the recording, in which the planes are sought."""

SURE = 0.5
"""Points within this part of a plane's thickness are the plane's, even beside a foot."""

BESIDE, MANY = 5, 0.4
"""Width of the neighbourhood of a pixel [px], and the share of it that has to be kept, for a point
in the outer part of a plane to be taken as a foot's. The noise of a floor is nowhere as dense."""

CONTACT = 0.06
"""Points of a plane within this depth of others beside them may be a sole's, in body sizes."""

LEVEL = np.cos(np.radians(45.0))
"""A plane is taken as the floor if its normal is within this cosine of the image's upright."""


class Planes(Segmenter):
    """Removes the large planes that bound the scene: floor, walls and ceiling.

    They are found in any orientation of the camera, as planes that are larger than the body's flat
    parts and have hardly anything behind them. Feet on the floor keep what is above its noise.
    """

    kind: Literal["planes"] = "planes"

    least: Annotated[float, Field(ge=0.01, le=1e4)] = 0.3
    """Least area of a plane, in squares of the body's size; a body shows about 0.2 at most."""
    most: Annotated[int, Field(ge=1, le=100)] = 6
    """Largest number of planes."""
    moving_camera: bool = False
    """Whether the camera moves, so that the planes are sought in every frame."""

    def bind(self, recording: Recording, template: Template) -> BoundPlanes:
        """Finds the planes in a few frames, unless the camera moves."""
        size = float(np.median(template.candidate_sizes()))
        bound = BoundPlanes(self, size, ())
        if self.moving_camera:
            return bound
        points = [frame.points for frame in sampled(recording, FRAMES)]
        return BoundPlanes(self, size, bound.found(np.concatenate(points) if points else None))


@dataclass(frozen=True)
class BoundPlanes(BoundSegmenter):
    """``Planes`` bound to a recording.

    Attributes:
        settings: The segmenter.
        size: Usual size of the body [m].
        planes: The planes of a camera that does not move, the largest first.
    """

    settings: Planes
    size: float
    planes: tuple[Plane, ...]

    def found(self, points: Array | None) -> tuple[Plane, ...]:
        """Returns the planes that bound points (N, 3)."""
        if points is None:
            return ()
        return tuple(bounding_planes(points, self.size, self.settings.least, self.settings.most))

    @property
    def floor(self) -> Plane | None:
        """The plane whose normal is nearest to the image's upright, within 45 degrees, or None.

        Its normal is a hint where gravity is; for a camera that is rolled further, a wall may be
        taken for the floor.
        """
        upright = [plane for plane in self.planes if -plane.normal[1] >= LEVEL]
        return min(upright, key=lambda plane: float(plane.normal[1]), default=None)

    def segmented(self, frame: Frame, expected: Expected | None) -> Frame:
        """Returns the frame without the points of the planes, which are free space."""
        planes = self.planes
        if self.settings.moving_camera and len(frame.points):
            planes = self.found(frame.points)
        removed, sure = np.zeros((2, len(frame.points)), dtype=bool)
        for plane in planes:
            removed |= plane.holds(frame.points)
            sure |= plane.holds(frame.points, SURE)
        kept = ~removed | (_beside(frame, ~removed) & ~sure)
        return frame.only(kept, free=removed & ~_touching(frame, kept, CONTACT * self.size))


def _beside(frame: Frame, kept: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Returns a mask (N,) of the points of an image that are beside many that are kept.

    Args:
        frame: The frame.
        kept: Mask (N,) of the points that are kept.
    """
    pixels = frame.pixels
    if pixels is None or frame.depth is None:
        return np.zeros_like(kept)
    image = np.zeros(frame.depth.shape)
    image.flat[pixels[kept]] = 1.0
    return np.asarray(scipy.ndimage.uniform_filter(image, BESIDE).flat[pixels] >= MANY)


def _touching(frame: Frame, kept: NDArray[np.bool_], distance: float) -> NDArray[np.bool_]:
    """Returns a mask (N,) of the points of an image that are close to some that are kept.

    A sole within the noise of the floor is removed with it, and is not free space.

    Args:
        frame: The frame.
        kept: Mask (N,) of the points that are kept.
        distance: Largest difference of depths [m].
    """
    pixels = frame.pixels
    if pixels is None or frame.depth is None:
        return np.zeros_like(kept)
    image = np.full(frame.depth.shape, np.inf)
    image.flat[pixels[kept]] = frame.points[kept, 2]
    near = scipy.ndimage.minimum_filter(image, BESIDE).flat[pixels]
    return np.asarray(np.abs(near - frame.points[:, 2]) <= distance)
