"""UTD-MHAD in its published layout: Kinect depth of one person, and the Kinect's skeleton."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.config.model import InputPath
from regkit.geometry.camera import Camera
from regkit.interfaces import Dataset, Recording
from regkit.observation import Frame, Truth
from regkit.system.arrays import Array
from regkit.system.errors import DataError
from regkit_plugins.datasets.formats.matlab import array_shape, read_array, read_frames
from regkit_plugins.datasets.formats.subjects import subject_of

CAMERA = Camera(width=320, height=240, fx=285.63, fy=285.63, cx=159.0, cy=120.0)
"""The Kinect's depth camera at half resolution, for flipped images."""

_SIDES = [
    f"{side}_{joint}"
    for limb in (("shoulder", "elbow", "wrist", "hand"), ("hip", "knee", "ankle", "foot"))
    for side in ("left", "right")
    for joint in limb
]
JOINTS = ("head", "neck", "spine", "pelvis", *_SIDES)
"""The 20 joints of the Kinect's skeleton in order, by regkit's names."""


class UtdMhad(Dataset):
    """UTD-MHAD (Chen, Jafari and Kehtarnavaz, ICIP 2015).

    Images and joints are stored mirrored; both are flipped, since the left hand would otherwise
    appear as the right one. The reference joints are estimates of the Kinect SDK, not markers, with
    an accuracy of about 10 cm.
    """

    kind: Literal["utd_mhad"] = "utd_mhad"

    root: InputPath
    """Folder that contains ``Depth/`` and ``Skeleton/``."""
    skeleton_lead: Annotated[float, Field(ge=0.0, le=1e6)] = 1.5
    """Number of frames by which the skeletons are ahead of the images. Compared with the images
    alone, the joints of moving arms match images one to two frames later, in every recording
    examined, for every person."""

    def found(self) -> list[Recording]:
        """Returns a recording for each file in ``Depth/``."""
        files = sorted((self.root / "Depth").glob("*_depth.mat"), key=_by_numbers)
        if not files:
            raise DataError(
                "no recording here: Depth/ must hold files like a1_s1_t1_depth.mat",
                place=str(self.root),
            )
        names = {path: path.stem.removesuffix("_depth") for path in files}
        wanted = [path for path, name in names.items() if self.wanted(name)]
        # If no requested recording exists, return all, so that the error can list their names.
        return [self._recording(path, names[path]) for path in wanted or files]

    def _recording(self, path: Path, name: str) -> UtdRecording:
        length = array_shape(path, "d_depth")[2]
        return UtdRecording(
            name=name,
            fps=30.0,
            length=min(length, self.frames or length),
            subject=subject_of(name, r"^a\d+_(s\d+)_t\d+$"),
            depth_file=path,
            skeleton_file=self.root / "Skeleton" / f"{name}_skeleton.mat",
            skeleton_lead=self.skeleton_lead,
        )


@dataclass(frozen=True)
class UtdRecording(Recording):
    """One action of one person.

    Attributes:
        depth_file: Depth images (240, 320, T) [mm].
        skeleton_file: Joints (20, 3, T) [m], x to the right of the mirrored image and y up.
        skeleton_lead: Number of frames by which the joints are ahead of the images.
    """

    depth_file: Path
    skeleton_file: Path
    skeleton_lead: float

    def frames(self) -> Iterator[Frame]:
        """Yields the back-projected depth images."""
        images = read_frames(self.depth_file, "d_depth")
        for index, image in zip(range(self.length), images, strict=False):
            depth = image[:, ::-1] / 1000.0
            place = f"{self.depth_file}: frame {index}"
            yield Frame(CAMERA.back_projected(depth, place=place), CAMERA, depth, place)

    def input_files(self) -> list[Path]:
        """Returns both files, the second one if it exists."""
        return [self.depth_file, *([self.skeleton_file] if self.skeleton_file.is_file() else [])]

    def truth(self) -> Truth | None:
        """Returns the Kinect's joints in the camera's frame, with x flipped like the images.

        They are interpolated to the times of the images; the first one stands for earlier times.
        """
        if not self.skeleton_file.exists():
            return None
        joints = np.moveaxis(read_array(self.skeleton_file, "d_skel"), 2, 0)
        if joints.shape[1:] != (len(JOINTS), 3) or len(joints) < self.length:
            raise DataError(
                f"d_skel has the shape {joints.shape}, frames first; it must be "
                f"({self.length}, 20, 3)",
                place=str(self.skeleton_file),
            )
        joints = _delayed(joints * np.array([-1.0, -1.0, 1.0]), self.skeleton_lead)
        return Truth(JOINTS, joints[: self.length])


def _delayed(joints: Array, frames: float) -> Array:
    """Returns joints (T, J, 3) delayed by ``frames``, linearly interpolated; at rest at first."""
    times = np.maximum(np.arange(len(joints)) - frames, 0.0)
    before = times.astype(np.intp)
    share = (times - before)[:, None, None]
    after = np.minimum(before + 1, len(joints) - 1)
    return np.asarray((1.0 - share) * joints[before] + share * joints[after])


def _by_numbers(path: Path) -> list[int]:
    """Returns a sort key that puts a9 before a19."""
    digits = "".join(letter if letter.isdigit() else " " for letter in path.stem)
    return [int(number) for number in digits.split()]
