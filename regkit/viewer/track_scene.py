"""All that is shown of one track."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body, Markers
from regkit.body.bones import bones_of
from regkit.geometry.camera import Camera
from regkit.interfaces import Registrar
from regkit.observation import PlacedCamera, Truth
from regkit.system.arrays import Array, Indices, Singles
from regkit.tracking import Track
from regkit.viewer.model_shapes import shapes_of, transforms_of
from regkit.viewer.points import FramePoints
from regkit.viewer.reference import reference_of
from regkit.viewer.shapes import Shape, moved
from regkit.viewer.uncertainty import ellipsoids_of

CHUNK = 256
"""Number of frames that are placed together."""


@dataclass(frozen=True)
class Curve:
    """A number of each frame.

    Attributes:
        name: What it is.
        unit: Its unit.
        values: Its values, (T,); NaN where unknown.
    """

    name: str
    unit: str
    values: Array


@dataclass(frozen=True)
class TrackScene:
    """A track of T frames as it is shown, with the points of F of them.

    Attributes:
        fps: Frames per second.
        segments: Names of the S segments.
        bones: Ends of the bones, (B, 2): indices of the segments' origins, then of the markers.
        markers: The markers.
        transforms: Quaternion (x, y, z, w) and origin [m] of T_camera_segment, (T, S, 7).
        supports: How well data support each segment, (T, S), from 0 to 1; NaN where unknown.
        verdicts: Whether the body was found in each frame, (T,), as text.
        curves: Numbers of each frame.
        shapes: The shape model, and the body's mesh.
        points: The points of F frames.
        joints: Names of the J reference joints.
        reference: Their positions in these frames, (F, J, 3) [m]; NaN where unknown.
        marked: Why frames are marked, by their numbers.
        camera: The camera, if it is known.
        cameras: Several cameras in the world; none if there is one at the origin.
        ellipsoids: Where the markers are with a probability of 90 %, (T, M, 7), as
            ``ellipsoids_of``; None if it is unknown.
    """

    fps: float
    segments: tuple[str, ...]
    bones: Indices
    markers: Markers
    transforms: Singles
    supports: Array
    verdicts: NDArray[Any]
    curves: tuple[Curve, ...]
    shapes: tuple[Shape, ...]
    points: FramePoints
    joints: tuple[str, ...]
    reference: Array
    marked: Mapping[int, str]
    camera: Camera | None
    ellipsoids: Singles | None = None
    cameras: tuple[PlacedCamera, ...] = ()

    @classmethod
    def of(
        cls,
        track: Track,
        registrar: Registrar,
        points: Mapping[int, NDArray[Any]],
        *,
        fps: float,
        camera: Camera | None = None,
        cameras: Iterable[PlacedCamera] = (),
        truth: Truth | None = None,
        errors: Array | None = None,
        marked: Mapping[int, str] | None = None,
    ) -> Self:
        """Returns the scene of a tracked recording.

        Args:
            track: The tracked recording.
            registrar: The registrar of its frames.
            points: Points (N, 3) [m] of some frames by their numbers.
            fps: Frames per second.
            camera: The camera, if it is known.
            cameras: Several cameras in the world.
            truth: Reference joints, if there are any.
            errors: Mean joint error of each frame, (T,) [m], if known.
            marked: Why frames are marked, by their numbers.
        """
        body = registrar.body
        known = FramePoints.of(points)
        joints, reference = reference_of(truth, known.frames)
        curves = [
            Curve("inlier share", "%", 100.0 * track.inlier_shares),
            Curve("surface distance", "mm", 1000.0 * track.surface_distances),
        ]
        if errors is not None:
            curves.append(Curve("joint error", "cm", 100.0 * errors))
        return cls(
            fps=fps,
            segments=body.skeleton.names,
            bones=bones_of(body),
            markers=body.markers,
            transforms=_transforms(track, body),
            supports=track.supports,
            verdicts=np.array(track.verdicts, dtype=np.str_),
            curves=tuple(curves),
            shapes=shapes_of(registrar),
            points=known,
            joints=joints,
            reference=reference,
            marked=dict(marked or {}),
            camera=camera,
            ellipsoids=ellipsoids_of(track, body),
            cameras=tuple(cameras),
        )

    @classmethod
    def empty(cls, registrar: Registrar, fps: float, curves: Mapping[str, str]) -> Self:
        """Returns the scene of a track before its first frame.

        Args:
            registrar: The registrar of its frames.
            fps: Frames per second.
            curves: Units of the curves by their names.
        """
        body = registrar.body
        count = len(body.skeleton.names)
        return cls(
            fps=fps,
            segments=body.skeleton.names,
            bones=bones_of(body),
            markers=body.markers,
            transforms=np.zeros((0, count, 7), dtype=np.float32),
            supports=np.zeros((0, count)),
            verdicts=np.zeros(0, dtype=np.str_),
            curves=tuple(Curve(name, unit, np.zeros(0)) for name, unit in curves.items()),
            shapes=shapes_of(registrar),
            points=FramePoints.of({}),
            joints=(),
            reference=np.zeros((0, 0, 3)),
            marked={},
            camera=None,
        )

    def __len__(self) -> int:
        """Number T of frames."""
        return len(self.transforms)

    def marker_positions(self, frames: Iterable[int]) -> Array:
        """Returns the markers in some frames, (F, M, 3) [m]."""
        carriers = self.transforms[list(frames)][:, self.markers.segments].astype(np.float64)
        return moved(carriers, np.broadcast_to(self.markers.points, (*carriers.shape[:2], 3)))


def _transforms(track: Track, body: Body) -> Singles:
    """Returns the quaternions and origins of all segments in all frames, (T, S, 7)."""
    frames = range(len(track))
    transforms = np.empty((len(track), len(body.skeleton.names), 7), dtype=np.float32)
    # Matrices of an hour of frames at once would take many times the memory of the result.
    for first in frames[::CHUNK]:
        chunk = frames[first : first + CHUNK]
        placed = [body.place(track.pose(frame)).transforms for frame in chunk]
        transforms[first : first + CHUNK] = transforms_of(np.array(placed))
    return transforms
