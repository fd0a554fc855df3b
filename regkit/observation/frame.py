"""Frames: raw measurements."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.geometry.lens import Lens
from regkit.geometry.rigid import transformed
from regkit.observation.compiled_removal import kept_points, remaining_depth
from regkit.observation.landmarks import Landmarks, surest
from regkit.observation.view import View, only_view
from regkit.system.arrays import Array, Indices, loop_input
from regkit.system.brief import Brief

FARTHEST = 98.0
"""Percentile of the kept depths that counts as the body's farthest: a few points are stray."""


@dataclass(frozen=True)
class Frame(Brief):
    """One measurement of a recording.

    Several cameras, or one that is not at the world's origin, are its ``views``: then the points
    are those of all views in the world, and ``camera`` and ``depth`` are None.

    Attributes:
        points: Points in the camera frame (x right, y down, z forward), (N, 3) [m].
        camera: Intrinsics, if the points come from a depth image.
        depth: Depth image, (H, W) [m]; None if there is none. Zero marks a pixel without a
            measurement, which counts as free space. NaN marks an unknown pixel: something
            else may hide the body there, or a camera in a room measures nothing.
        place: Source of the frame, for error messages.
        landmarks: Measured positions of points of the body; None without any.
        views: What each of several cameras measured; empty for one camera at the origin.
    """

    points: Array
    camera: Camera | None = None
    depth: Array | None = None
    place: str | None = None
    landmarks: Landmarks | None = None
    views: tuple[View[Frame], ...] = ()

    @classmethod
    def of_views(
        cls,
        views: Sequence[View[Frame]],
        *,
        place: str | None = None,
        landmarks: Landmarks | None = None,
    ) -> Frame:
        """Returns the frame of several cameras.

        Args:
            views: What each camera measured.
            place: Source of the frame, for error messages.
            landmarks: Landmarks in the world; by default those of the views.

        Raises:
            DataError: If a view has landmarks in the picture alone.
        """
        points = [transformed(view.T_world_camera, view.data.points) for view in views]
        return cls(
            np.concatenate([np.zeros((0, 3)), *points]),
            place=place,
            landmarks=landmarks or _in_world(views),
            views=tuple(views),
        )

    @classmethod
    def of_image(cls, depth: Array, lens: Lens, *, place: str | None = None) -> Frame:
        """Returns the frame of a depth image as a camera measures it, rectified.

        Args:
            depth: Distance along the optical axis, (H, W) [m]; zero marks an invalid pixel.
            lens: The camera with its distortion.
            place: Source of the frame, for error messages.

        Raises:
            DataError: If the image size differs from the camera's, or a depth is beyond any camera.
        """
        rectified = lens.rectified(depth, place=place)
        points = lens.camera.back_projected(rectified, place=place)
        return cls(points, lens.camera, rectified, place)

    @property
    def each_view(self) -> tuple[View[Frame], ...]:
        """The views; of one camera at the origin, this frame as its view."""
        return self.views or (only_view(self),)

    @cached_property
    def pixels(self) -> Indices | None:
        """Flat indices of the points' pixels, (N,); None if the points are not an image's."""
        if self.depth is None:
            return None
        # Points are the pixels with depth in row-major order.
        pixels = np.flatnonzero(self.depth > 0.0)
        return pixels if len(pixels) == len(self.points) else None

    def only(self, kept: NDArray[np.bool_], *, free: NDArray[np.bool_] | None = None) -> Frame:
        """Returns the frame with some of its points.

        Removed pixels are unknown if they are nearer than the farthest point that is kept, since
        the body may be behind what they show. Others are free space.

        Args:
            kept: Mask of the points to keep, (N,).
            free: Mask of removed points, (N,), that cannot hide the body, such as the floor.
        """
        if kept.all():
            return self
        if self.views:
            return self._only_in_views(kept, free)
        left = kept_points(loop_input(self.points), kept)
        if self.depth is None:
            return replace(self, points=left)
        # Nothing hides a body of which nothing is kept.
        farthest = float(np.percentile(left[:, 2], FARTHEST)) if len(left) else -np.inf
        free = np.zeros_like(kept) if free is None else free
        depth, of_image = remaining_depth(loop_input(self.depth), kept, free, farthest)
        return replace(self, points=left, depth=depth if of_image else self.depth)

    def _only_in_views(self, kept: NDArray[np.bool_], free: NDArray[np.bool_] | None) -> Frame:
        ends = np.cumsum([len(view.data.points) for view in self.views])[:-1]
        masks = np.split(kept, ends)
        frees = [None] * len(masks) if free is None else np.split(free, ends)
        return Frame.of_views(
            [
                replace(view, data=view.data.only(mask, free=unhidden))
                for view, mask, unhidden in zip(self.views, masks, frees, strict=True)
            ],
            place=self.place,
            landmarks=self.landmarks,
        )


def _in_world(views: Sequence[View[Frame]]) -> Landmarks | None:
    """Returns the landmarks of all views in the world; None without any.

    Raises:
        DataError: If a view has landmarks in the picture alone.
    """
    known = [
        view.data.landmarks.moved(view.T_world_camera)
        for view in views
        if view.data.landmarks is not None
    ]
    return surest(known) if known else None
