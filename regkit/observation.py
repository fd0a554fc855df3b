"""What is measured: frames as they come, and observations as a kernel wants them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from regkit.arrays import Array
from regkit.camera import Camera
from regkit.silhouette import Silhouette


@dataclass(frozen=True)
class Frame:
    """One measurement of a sequence.

    Attributes:
        points: Measured points in the camera's frame (x right, y down, z forward), (N, 3) [m].
        camera: The camera, if the points are those of a depth image.
        depth: The depth image (H, W) [m], zero where nothing was measured, if there is one.
        place: Where it came from, for error messages.
    """

    points: Array
    camera: Camera | None = None
    depth: Array | None = None
    place: str | None = None


@dataclass(frozen=True)
class Observation:
    """Data as a sum of N isotropic Gaussians, eq. 2.

    Attributes:
        points: Means, (N, 3) [m].
        weights: (N,).
        variances: sigma^2 of each, (N,) [m^2]. A kernel's time grows with the number of different
            values, so an observer that has many rounds them.
        camera: The camera, if it is known; it looks along z from the origin.
        depth: The depth image (H, W) [m] that the points come from, zero where nothing was
            measured, if there is one.
        normals: Unit normals of the surface at the points, (N, 3), of either sign, if they are
            known.
    """

    points: Array
    weights: Array
    variances: Array
    camera: Camera | None = None
    depth: Array | None = None
    normals: Array | None = None

    @cached_property
    def silhouette(self) -> Silhouette | None:
        """What the depth image says of free space, if there is one."""
        if self.camera is None or self.depth is None:
            return None
        return Silhouette(self.camera, self.depth)


@dataclass(frozen=True)
class Truth:
    """Reference positions of named joints.

    Attributes:
        joints: (J,) names.
        positions: (T, J, 3) [m] in the frame of the points; NaN where a joint was not seen.
    """

    joints: tuple[str, ...]
    positions: Array
