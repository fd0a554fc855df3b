"""RealSense cameras that are connected."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from regkit.geometry.camera import MAX_SIZE
from regkit.interfaces import Source, Stream
from regkit_plugins.sources.realsense.devices import connected
from regkit_plugins.sources.realsense.library import realsense
from regkit_plugins.sources.realsense.stream import CameraStream

Size = Annotated[int, Field(ge=1, le=MAX_SIZE)]


class RealSense(Source):
    """A connected RealSense camera: ``realsense:``, or ``realsense:SERIAL`` of several.

    Frames are measured while they are read; what is not read in time is lost, and counted.
    """

    kind: Literal["realsense"] = "realsense"

    scheme: ClassVar[str] = "realsense"

    serial: Annotated[str, Field(max_length=100)] = ""
    """Serial number of the camera; needed only if several are connected."""
    width: Size | None = None
    """Width of the depth images [px]; by default the camera's own choice."""
    height: Size | None = None
    """Height of the depth images [px]; by default the camera's own choice."""
    fps: Annotated[int, Field(ge=1, le=1000)] | None = None
    """Frames per second; by default the camera's own choice."""

    @classmethod
    def fields_of(cls, address: str) -> dict[str, Any]:
        """Returns the serial number, if the address has one."""
        return {"serial": address} if address else {}

    def open(self) -> Stream:
        """Starts the camera.

        Raises:
            DataError: If it is not connected or cannot measure such images.
            ConfigError: If several are connected, and none is named.
            DependencyError: If pyrealsense2 is not installed.
        """
        device = connected(realsense().context(), self.serial)
        return CameraStream(device, width=self.width, height=self.height, fps=self.fps)
