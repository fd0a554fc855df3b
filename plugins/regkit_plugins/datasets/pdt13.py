"""PDT-13: Kinect depth of people with motion-capture markers, in MATLAB files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from regkit.config.model import InputPath, Model
from regkit.config.quantities import Rate
from regkit.geometry.camera import Camera
from regkit.interfaces import Dataset, Recording
from regkit.observation import Frame, Truth
from regkit.system.errors import DataError
from regkit_plugins.datasets.formats.axes import Axes, in_camera
from regkit_plugins.datasets.formats.matlab import array_shape, read_array, read_frames
from regkit_plugins.datasets.formats.subjects import SubjectPattern, subject_of

Positive = Annotated[float, Field(ge=1e-3, le=1e6)]
Pixel = Annotated[float, Field(ge=-1e6, le=1e6)]


class Intrinsics(Model):
    """A pinhole camera; the defaults are the nominal values of a Kinect."""

    focal_px: Positive = 571.4
    """Focal length [px]."""
    centre_px: tuple[Pixel, Pixel] = (319.5, 239.5)
    """Principal point [px], column and row; the first pixel has its centre at 0."""


class Pdt13(Dataset):
    """PDT-13 (Helten, Baak, Bharaj, Müller, Seidel and Theobalt, 3DV 2013).

    According to the data set's page
    (https://gvvperfcapeva.mpi-inf.mpg.de/public/PersonalizedDepthTracker) a Kinect recorded people
    named M1 to M3 and F1 to F3, and according to the paper a marker-based system did too. The
    layout of the tracking files is not documented publicly. This plug-in *assumes* two MATLAB files
    for each recording: depth images (rows, columns, T) and reference positions (J, 3, T). Their
    names, arrays, units and axes are configurable; convert other layouts to this one, or to the
    folder format (``depth``). The images are used as they are: remove the background with the
    preprocessor's ``crop``.
    """

    kind: Literal["pdt13"] = "pdt13"

    root: InputPath
    """Folder of the files."""
    depth_suffix: str = "_depth.mat"
    """Suffix of the depth images' files; the rest of the name is the recording's name."""
    depth_array: str = "depth"
    """Name of the array of depth images in them."""
    depth_scale: Positive = 1000.0
    """Depth image units per metre."""
    intrinsics: Intrinsics = Intrinsics()
    """Intrinsics of the depth camera."""
    mirrored: bool = False
    """Whether the images are stored mirrored, and must be flipped."""
    joint_suffix: str = "_joints.mat"
    """Suffix of the reference positions' files."""
    joint_array: str = "joints"
    """Name of the array of reference positions in them."""
    joint_names: tuple[str, ...] | None = None
    """Names of the reference positions in order; ``joint_0``, ``joint_1``, ... by default."""
    joint_scale: Positive = 1000.0
    """Units of the reference positions per metre."""
    joint_axes: Axes = ("x", "y", "z")
    """Axes of the reference positions that point right, down and forward from the camera."""
    subjects: SubjectPattern | None = "([MF][1-3])"
    """Regular expression whose only group is the subject in a recording's name."""
    fps: Rate = 30.0
    """Frames per second."""

    def found(self) -> list[Recording]:
        """Returns a recording for each file of depth images."""
        files = {
            path.name.removesuffix(self.depth_suffix): path
            for path in sorted(self.root.glob(f"*{self.depth_suffix}"))
        }
        if not files:
            raise DataError(
                f"no recording here: no file ends with '{self.depth_suffix}' "
                "(dataset.depth_suffix)",
                place=str(self.root),
            )
        wanted = [name for name in files if self.wanted(name)]
        # If no requested recording exists, return all, so that the error can list their names.
        return [self._recording(name, files[name]) for name in wanted or files]

    def _recording(self, name: str, path: Path) -> Recording:
        height, width, length = array_shape(path, self.depth_array)
        focal, (cx, cy) = self.intrinsics.focal_px, self.intrinsics.centre_px
        try:
            camera = Camera(width, height, focal, focal, cx, cy)
        except DataError as error:
            raise error.at(f"{path}: dataset.intrinsics") from None
        return Pdt13Recording(
            name=name,
            fps=self.fps,
            length=min(length, self.frames or length),
            subject=subject_of(name, self.subjects),
            layout=self,
            depth_file=path,
            joint_file=self.root / f"{name}{self.joint_suffix}",
            camera=camera,
        )


@dataclass(frozen=True)
class Pdt13Recording(Recording):
    """A recording of PDT-13.

    Attributes:
        layout: Layout of the files.
        depth_file: Depth images (H, W, T).
        joint_file: Reference positions (J, 3, T); it may be missing.
        camera: Camera of the stored images.
    """

    layout: Pdt13
    depth_file: Path
    joint_file: Path
    camera: Camera

    def frames(self) -> Iterator[Frame]:
        """Yields the back-projected depth images."""
        camera = self.camera
        if self.layout.mirrored:
            cx = camera.width - 1.0 - camera.cx
            camera = Camera(camera.width, camera.height, camera.fx, camera.fy, cx, camera.cy)
        images = read_frames(self.depth_file, self.layout.depth_array)
        for index, image in zip(range(self.length), images, strict=False):
            depth = image / self.layout.depth_scale
            depth = np.where(np.isfinite(depth), depth, 0.0)
            if self.layout.mirrored:
                depth = depth[:, ::-1]
            place = f"{self.depth_file}: frame {index}"
            yield Frame(camera.back_projected(depth, place=place), camera, depth, place)

    def input_files(self) -> list[Path]:
        """Returns both files, the second one if it exists."""
        return [self.depth_file, *([self.joint_file] if self.joint_file.is_file() else [])]

    def truth(self) -> Truth | None:
        """Returns the reference positions; non-finite or all-zero ones count as unseen."""
        if not self.joint_file.exists():
            return None
        stored = np.moveaxis(read_array(self.joint_file, self.layout.joint_array), 2, 0)
        names = self.layout.joint_names or tuple(f"joint_{j}" for j in range(stored.shape[1]))
        if stored.shape[1:] != (len(names), 3) or len(stored) < self.length:
            raise DataError(
                f"{self.layout.joint_array} has the shape {(*stored.shape[1:], len(stored))}; it "
                f"must be ({len(names)}, 3, {self.length}): positions, axes, frames",
                place=str(self.joint_file),
            )
        stored = stored[: self.length]
        unseen = ~np.isfinite(stored).all(axis=2) | (stored == 0.0).all(axis=2)
        positions = in_camera(stored / self.layout.joint_scale, self.layout.joint_axes)
        return Truth(names, np.where(unseen[..., None], np.nan, positions))
