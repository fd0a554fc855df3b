"""Observations: preprocessed frames, the data that kernels compare with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.geometry.rigid import transformed
from regkit.observation.arrays import ObservationArrays
from regkit.observation.landmarks import Landmarks
from regkit.observation.removed_pixels import depth_of_kept
from regkit.observation.sight import SharedSight, Sight
from regkit.observation.silhouette import Silhouette
from regkit.observation.view import View, only_view
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import DataError


@dataclass(frozen=True)
class Observation(Brief):
    """Data as a sum of N isotropic Gaussians, eq. 2.

    Data of several cameras have ``views``; their points, weights, variances and normals are those
    of all views in the world, and ``camera`` and ``depth`` are None: no single camera sees them.

    Attributes:
        points: Means in the camera frame, (N, 3) [m].
        weights: Weights, (N,).
        variances: Variances sigma^2, (N,) [m^2]. The run time of a kernel grows with the number of
            distinct values, so a preprocessor should round them.
        camera: Intrinsics, or None if unknown; the camera is at the origin and looks along z.
        depth: Depth image of the points, (H, W) [m]; None if there is none. As in a ``Frame``, zero
            marks free space and NaN an unknown pixel.
        normals: Unit normals of arbitrary sign at the points, (N, 3); None if unknown.
        landmarks: Measured positions of points of the body; None without any.
        views: What each of several cameras measured; empty for one camera at the origin.

    Raises:
        DataError: If there is no point, or the arrays differ in length.
    """

    points: Array
    weights: Array
    variances: Array
    camera: Camera | None = None
    depth: Array | None = None
    normals: Array | None = None
    landmarks: Landmarks | None = None
    views: tuple[View[Observation], ...] = ()

    @classmethod
    def of_views(
        cls, views: Sequence[View[Observation]], landmarks: Landmarks | None = None
    ) -> Observation:
        """Returns the data of several cameras in the world.

        Those of one camera at the origin are these data themselves.

        Args:
            views: What each camera measured, at least one.
            landmarks: Landmarks in the world, if there are some.

        Raises:
            DataError: If there is no view.
        """
        if not views:
            raise DataError("no camera has data; a registration needs some")
        if len(views) == 1 and np.array_equal(views[0].T_world_camera, np.eye(4)):
            alone = views[0].data
            return alone if landmarks is None else replace(alone, landmarks=landmarks)
        data = [view.data for view in views]
        known = [one.normals for one in data if one.normals is not None]
        turned = [
            normals @ view.T_world_camera[:3, :3].T
            for view, normals in zip(views, known, strict=False)
        ]
        return cls(
            np.concatenate([transformed(one.T_world_camera, one.data.points) for one in views]),
            np.concatenate([one.weights for one in data]),
            np.concatenate([one.variances for one in data]),
            normals=np.concatenate(turned) if len(known) == len(views) else None,
            landmarks=landmarks,
            views=tuple(views),
        )

    @property
    def each_view(self) -> tuple[View[Observation], ...]:
        """The views; of one camera at the origin, these data as its view."""
        return self.views or (only_view(self),)

    def seen_from(self, view: View[Observation]) -> Observation:
        """Returns the data with the camera of one of the views as the world's origin."""
        if not self.views:
            return self
        landmarks = None if self.landmarks is None else self.landmarks.moved(view.to_camera)
        return Observation.of_views([one.moved(view.to_camera) for one in self.views], landmarks)

    def only(self, kept: NDArray[np.bool_]) -> Observation:
        """Returns the data with some of the points; the pixels of others are free or unknown.

        Args:
            kept: Mask of the points to keep, (N,).

        Raises:
            DataError: If no point is kept.
        """
        if self.views:
            ends = np.cumsum([len(view.data.points) for view in self.views])[:-1]
            left = [
                replace(view, data=view.data.only(mask))
                for view, mask in zip(self.views, np.split(kept, ends), strict=True)
                if mask.any()
            ]
            return Observation.of_views(left, self.landmarks)
        depth = self.depth
        if depth is not None and self.camera is not None and not kept.all():
            depth = depth_of_kept(depth, self.camera, self.points, kept)
        return replace(
            self,
            points=self.points[kept],
            weights=self.weights[kept],
            variances=self.variances[kept],
            depth=depth,
            normals=None if self.normals is None else self.normals[kept],
        )

    def __post_init__(self) -> None:
        """Validates the arrays.

        Raises:
            DataError: If there is no point, or the arrays differ in length.
        """
        count = len(self.points)
        if not count:
            raise DataError("the observation has no points; a registration needs some")
        for name in ("weights", "variances"):
            if getattr(self, name).shape != (count,):
                raise DataError(
                    f"the observation has {count} points, but {name} of the shape "
                    f"{getattr(self, name).shape}; it must be ({count},)"
                )

    @cached_property
    def silhouette(self) -> Silhouette | None:
        """The free space of the depth image; None without a depth image."""
        if self.camera is None or self.depth is None:
            return None
        return Silhouette(self.camera, self.depth)

    @cached_property
    def sight(self) -> Sight | None:
        """What the cameras would show; None if everything is seen, as without a depth image."""
        if not self.views:
            return self.silhouette
        known = [(one.to_camera, one.data.silhouette) for one in self.views]
        shown = [(camera, silhouette) for camera, silhouette in known if silhouette is not None]
        return SharedSight(shown) if len(shown) == len(known) else None

    @cached_property
    def arrays(self) -> ObservationArrays | None:
        """The data as compiled functions take them; None if the variances differ."""
        return ObservationArrays.of(self)
