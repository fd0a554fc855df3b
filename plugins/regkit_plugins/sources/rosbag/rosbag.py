"""The source of bags."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field

from regkit.config.model import InputPath
from regkit.interfaces import Source, Stream
from regkit.recording.description import Positive
from regkit.system.errors import DataError
from regkit.system.guard import reading
from regkit.system.optional import load_library
from regkit_plugins.sources.formats.realsense_topics import is_realsense
from regkit_plugins.sources.rosbag.stream import RosbagStream
from regkit_plugins.sources.rosbag.topics import chosen_topics

INSTALL = 'pip install "regkit[ros]"'

METADATA = "metadata.yaml"
"""File in the folder of a ROS 2 bag."""

Topic = Annotated[str, Field(min_length=1, max_length=1000)]


class Rosbag(Source):
    """A bag of ROS 1 (``.bag``) or ROS 2 (its folder, or a ``.db3`` or ``.mcap`` file).

    Depth images are messages ``sensor_msgs/Image`` of the encodings 16UC1 and 32FC1 [m], or
    ``compressedDepth``; a ``CameraInfo`` gives their camera and its distortion. Times are those of
    the messages' headers.
    """

    kind: Literal["rosbag"] = "rosbag"

    suffixes: ClassVar[tuple[str, ...]] = (".bag", ".db3", ".mcap")

    path: InputPath
    """The file, or the folder with ``metadata.yaml``."""
    topic: Topic | None = None
    """Topic of the depth images; by default the only one that has a camera."""
    camera_info: Topic | None = None
    """Topic of their camera; by default the ``camera_info`` beside them."""
    depth_scale: Positive = 1000.0
    """Units per metre of 16-bit images; ROS has millimetres."""
    rectified: bool | None = None
    """Whether the images are rectified, so that the camera's matrix P holds and its distortion does
    not; by default if the topic's last part begins with ``image_rect``."""

    @classmethod
    def accepts(cls, path: Path) -> bool:
        """Returns whether it is a bag, and none of a RealSense camera without ROS."""
        if path.is_dir():
            return (path / METADATA).is_file()
        return super().accepts(path) and not is_realsense(path)

    def open(self) -> Stream:
        """Opens the bag at its first depth image.

        Raises:
            DataError: If it is damaged or cut short, or has no depth image with a camera.
            ConfigError: If it has several, or not the topic.
            DependencyError: If rosbags is not installed.
        """
        if not self.path.exists():
            raise DataError("there is no such file or folder", place=str(self.path))
        highlevel = load_library("rosbags.highlevel", install=INSTALL)
        typesys = load_library("rosbags.typesys", install=INSTALL)
        # Bags of early ROS 2 versions do not define their messages; these are the same in all.
        types = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
        with reading(self.path, "a bag, or cut short" + _mending(self.path)):
            bag = highlevel.AnyReader([self.path], default_typestore=types)
            bag.open()
        try:
            return self._stream(bag)
        except BaseException:
            bag.close()
            raise

    def _stream(self, bag: Any) -> Stream:
        with reading(self.path, "a bag with depth images"):
            topics = chosen_topics(bag, self.topic, self.camera_info)
            return RosbagStream(
                bag, topics, self.path, depth_scale=self.depth_scale, rectified=self.rectified
            )


def _mending(path: Path) -> str:
    """Returns how a bag is mended whose recorder was killed before it wrote the index."""
    commands = {".mcap": "mcap recover FILE -o MENDED", ".bag": "rosbag reindex FILE"}
    command = commands.get(path.suffix.lower())
    return f" ('{command}' mends one whose recorder was killed)" if command else ""
