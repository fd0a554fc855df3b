"""Scenes in memory for tests of segmenters."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import Image

from regkit.geometry.camera import Camera
from regkit.interfaces import Recording
from regkit.observation import Frame
from regkit.testing.samples import CAMERA


def frame_of(depth: np.ndarray, camera: Camera = CAMERA) -> Frame:
    """Returns the frame of a depth image."""
    return Frame(camera.back_projected(depth), camera, depth, "an image")


@dataclass(frozen=True)
class Frames(Recording):
    """A recording of frames in memory."""

    given: tuple[Frame, ...] = ()

    def frames(self) -> Iterator[Frame]:
        yield from self.given

    def truth(self) -> None:
        return None


def recording(*frames: Frame | np.ndarray) -> Frames:
    """Returns a recording of frames or depth images."""
    given = tuple(one if isinstance(one, Frame) else frame_of(one) for one in frames)
    return Frames("frames", 30.0, len(given), given=given)


def write_recording(folder: Path, depths: Sequence[np.ndarray]) -> Path:
    """Writes depth images as the folder of a recording, and returns it."""
    (folder / "depth").mkdir(parents=True)
    for index, depth in enumerate(depths):
        image = Image.fromarray(np.rint(1000.0 * depth).astype(np.uint16))
        image.save(folder / "depth" / f"{index:06d}.png")
    (folder / "camera.json").write_text(CAMERA.to_json())
    sequence = {"name": folder.name, "fps": 30, "depth_scale": 1000, "source": "a test"}
    (folder / "sequence.yaml").write_text(json.dumps({**sequence, "licence": "none"}))
    return folder


def of_planes(normals_offsets: Sequence[tuple[Sequence[float], float]], roll: float = 0.0):
    """Returns the depth image of planes ``normal . x + offset = 0``, the nearest at each pixel.

    Args:
        normals_offsets: The planes; the camera is on their positive side.
        roll: Angle by which the camera is rolled [rad].
    """
    rays = CAMERA.rays()
    turn = np.array(
        [[np.cos(roll), -np.sin(roll), 0.0], [np.sin(roll), np.cos(roll), 0.0], [0.0, 0.0, 1.0]]
    )
    nearest = np.full(rays.shape[:2], np.inf)
    for normal, offset in normals_offsets:
        slope = rays @ (turn @ np.asarray(normal, dtype=float))
        depth = np.where(slope < -1e-6, -offset / np.where(slope < -1e-6, slope, 1.0), np.inf)
        nearest = np.minimum(nearest, depth)
    return np.where(np.isfinite(nearest) & (nearest < 8.0), nearest, 0.0)
