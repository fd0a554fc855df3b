"""A scene for the laws of segmenters: a body that moves before a wall."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body, BodyDescription
from regkit.body.depth import depth_image
from regkit.body.reading import description_in
from regkit.geometry.rigid import rigid
from regkit.interfaces import Recording, Template
from regkit.observation import Frame
from regkit.skeleton import Pose
from regkit.system.arrays import Array
from regkit.testing.samples import CAMERA, LINKAGE

WALL = 3.0
"""Depth of the wall [m]."""

SIZE = 1.2
"""Size of the body [m]."""

UPRIGHT = np.diag([1.0, -1.0, -1.0])
"""R_camera_body of a body that faces the camera."""


class SceneTemplate(Template):
    """The linkage of the samples, at the size of the scene."""

    kind: Literal["scene"] = "scene"

    def description(self) -> BodyDescription:
        """Returns the description of the linkage."""
        return description_in(LINKAGE)

    def given_size(self) -> float:
        """Returns the size of the body in the scene [m]."""
        return SIZE


@dataclass(frozen=True)
class WallScene(Recording):
    """Depth images, or clouds, of a body that moves to the right before a wall.

    Attributes:
        images: Whether the frames are images.
    """

    images: bool = True

    @cached_property
    def body(self) -> Body:
        """The body."""
        return SceneTemplate().body(SIZE)

    def pose(self, index: int) -> Pose:
        """Returns the pose in a frame."""
        return self.body.skeleton.rest(rigid(UPRIGHT, np.array([0.1 * index - 0.4, 0.1, 2.0])))

    def shown(self, index: int) -> NDArray[np.bool_]:
        """Returns the pixels of the body in a frame, (H, W)."""
        return np.asarray(self._depth(index) < WALL - 0.1)

    def frames(self) -> Iterator[Frame]:
        """Yields all frames."""
        yield from self.shots

    @cached_property
    def shots(self) -> tuple[Frame, ...]:
        """The frames."""
        depths = [self._depth(index) for index in range(self.length)]
        points = [CAMERA.back_projected(depth) for depth in depths]
        if not self.images:
            return tuple(Frame(some[::5], place="a cloud") for some in points)
        return tuple(
            Frame(some, CAMERA, depth, "an image")
            for some, depth in zip(points, depths, strict=True)
        )

    def truth(self) -> None:
        """Returns None: the laws need no joints."""

    def _depth(self, index: int) -> Array:
        """Returns the depth image of a frame, (H, W) [m]: spheres on the body's axes."""
        return np.minimum(depth_image(self.body, self.pose(index), CAMERA), WALL)
