"""Depth cameras: known models, files, or given intrinsics."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from regkit.config.model import InputPath, Model
from regkit.geometry.camera import Camera

Positive = Annotated[float, Field(ge=1e-3, le=1e6)]
Pixel = Annotated[float, Field(ge=-1e6, le=1e6)]
Pixels = Annotated[int, Field(gt=0, le=4096)]


class CameraNumbers(Model):
    """The intrinsics of a pinhole camera without distortion."""

    width: Pixels
    """Image width [px]."""
    height: Pixels
    """Image height [px]."""
    fx: Positive
    """Horizontal focal length [px]."""
    fy: Positive | None = None
    """Vertical focal length [px]; by default equal to ``fx``."""
    cx: Pixel | None = None
    """Column of the principal point [px]; by default the image centre."""
    cy: Pixel | None = None
    """Row of the principal point [px]; by default the image centre."""
    depth_scale: Positive = 1000.0
    """Depth image units per metre: 1000 for millimetres."""

    def camera(self) -> Camera:
        """The camera."""
        middle = ((self.width - 1) / 2.0, (self.height - 1) / 2.0)
        return Camera(
            self.width,
            self.height,
            self.fx,
            self.fx if self.fy is None else self.fy,
            middle[0] if self.cx is None else self.cx,
            middle[1] if self.cy is None else self.cy,
        )


class CameraFile(Model):
    """A file with intrinsics, such as ``camera.json`` of a recording."""

    file: InputPath
    """Open3D's ``PinholeCameraIntrinsic`` JSON."""
    depth_scale: Positive = 1000.0
    """Depth image units per metre: 1000 for millimetres."""

    def camera(self) -> Camera:
        """The camera.

        Raises:
            DataError: If the file is missing or is not such a JSON file.
        """
        return Camera.read(self.file)


CameraName = Literal["sr4000", "kinect_v1", "kinect_v1_320x240", "realsense_d435", "sr305"]

CAMERAS: Mapping[CameraName, CameraNumbers] = {
    "sr4000": CameraNumbers(width=176, height=144, fx=231.0),
    "kinect_v1": CameraNumbers(width=640, height=480, fx=585.0),
    "kinect_v1_320x240": CameraNumbers(width=320, height=240, fx=292.5),
    "realsense_d435": CameraNumbers(width=848, height=480, fx=424.0),
    "sr305": CameraNumbers(width=320, height=240, fx=238.0, depth_scale=10000.0),
}
"""Known cameras, with the principal point at the image centre.

- ``sr4000``: MESA SR4000, time of flight, 176 x 144 pixels, field of view 42 by 35 degrees;
  nominal values, not verified with the data sheet.
- ``kinect_v1``: Microsoft's first Kinect, structured light. Calibrations of individual devices give
  focal lengths of 571 to 594 px; 585 px is the rounded value of Nguyen, Izadi and Lovell.
- ``realsense_d435``: Intel RealSense D435, active stereo, 848 x 480 pixels, the mode that Intel
  recommends for depth, with the horizontal field of view of 90 degrees of Intel's formulas.
- ``sr305``: Intel RealSense SR305, coded light, at half its resolution.
"""


def _form(value: Any) -> str:
    """Returns the tag of a camera's form: name, file or numbers."""
    if isinstance(value, str):
        return "name"
    named = isinstance(value, CameraFile) or (isinstance(value, dict) and "file" in value)
    return "file" if named else "numbers"


CameraChoice = Annotated[
    Annotated[CameraName, Tag("name")]
    | Annotated[CameraFile, Tag("file")]
    | Annotated[CameraNumbers, Tag("numbers")],
    Discriminator(_form),
]
"""A known camera by its name, ``{file: camera.json}``, or its numbers."""


def camera_of(choice: CameraName | CameraFile | CameraNumbers) -> CameraFile | CameraNumbers:
    """Returns a camera by its name, or the given one."""
    return CAMERAS[choice] if isinstance(choice, str) else choice
