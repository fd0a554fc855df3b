"""The topics of depth images and of their cameras."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from regkit.config.model import did_you_mean
from regkit.system.errors import ConfigError, DataError
from regkit_plugins.sources.rosbag.images import ENCODINGS, encoding_of

IMAGE, COMPRESSED = "sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"
CAMERA = "sensor_msgs/msg/CameraInfo"

COMPRESSED_DEPTH = "/compressedDepth"
"""End of the topics of compressed depth images."""


@dataclass(frozen=True)
class DepthTopics:
    """A topic of depth images, with that of their camera.

    Attributes:
        images: Connections of the images.
        cameras: Connections of the camera.
        first: The first image's message.
        camera: The first message of the camera.
    """

    images: tuple[Any, ...]
    cameras: tuple[Any, ...]
    first: Any
    camera: Any

    @property
    def name(self) -> str:
        """Topic of the images."""
        return str(self.images[0].topic)


def chosen_topics(bag: Any, topic: str | None, camera_info: str | None) -> DepthTopics:
    """Returns the topics to read.

    Args:
        bag: The open bag.
        topic: Topic of the images; None for the only one that has a camera.
        camera_info: Topic of the camera; None for the one beside the images.

    Raises:
        ConfigError: If there are several, or not the ones that are named.
        DataError: If there is no depth image, or it has no camera.
    """
    cameras = _of_type(bag, CAMERA)
    images = {**_of_type(bag, IMAGE), **_of_type(bag, COMPRESSED)}
    if topic is None:
        topic = _only_topic(_depth_topics(bag, images), list(cameras), camera_info)
    first = _first(bag, images, topic, "topic")
    encoding = encoding_of(first)
    if encoding not in ENCODINGS:
        raise DataError(
            f"{topic} has images of the encoding {encoding or 'unknown'}; depth images have "
            f"{' or '.join(ENCODINGS)}"
        )
    info = camera_info or camera_topic(topic)
    if camera_info is None and info not in cameras:
        raise DataError(
            f"{topic} has no camera: there is no CameraInfo {info}; name one by the field "
            f"'camera_info' ({_listed(cameras)})"
        )
    camera = _first(bag, cameras, info, "camera_info")
    return DepthTopics(tuple(images[topic]), tuple(cameras[info]), first, camera)


def camera_topic(topic: str) -> str:
    """Returns the topic of the camera beside that of images, as image_transport names it."""
    return topic.removesuffix(COMPRESSED_DEPTH).rpartition("/")[0] + "/camera_info"


def _only_topic(found: list[str], cameras: list[str], camera_info: str | None) -> str:
    """Returns the only topic of depth images that has a camera."""
    if not found:
        raise DataError(
            f"there is no depth image: no Image of the encoding {' or '.join(ENCODINGS)}, and no "
            "compressedDepth"
        )
    # The same images may be there as they are and compressed.
    whole = [
        one
        for one in found
        if not (one.endswith(COMPRESSED_DEPTH) and one.removesuffix(COMPRESSED_DEPTH) in found)
    ]
    seen = [one for one in whole if camera_info is not None or camera_topic(one) in cameras]
    choice = seen or whole
    if len(choice) > 1:
        raise ConfigError(
            f"there are several topics of depth images: {', '.join(choice)}; name one by the field "
            "'topic'"
        )
    return choice[0]


def _depth_topics(bag: Any, images: dict[str, list[Any]]) -> list[str]:
    """Returns the topics whose first message is a depth image."""
    found = []
    for topic, connections in images.items():
        message = next(_messages(bag, connections), None)
        if message is not None and encoding_of(message) in ENCODINGS:
            found.append(topic)
    return sorted(found)


def _of_type(bag: Any, kind: str) -> dict[str, list[Any]]:
    """Returns the connections of a type of messages by topic."""
    found: dict[str, list[Any]] = {}
    for connection in bag.connections:
        if connection.msgtype == kind:
            found.setdefault(str(connection.topic), []).append(connection)
    return found


def _first(bag: Any, topics: dict[str, list[Any]], name: str, field: str) -> Any:
    """Returns the first message of a topic."""
    if name not in topics:
        raise ConfigError(
            f"no topic {name} for the field '{field}' ({_listed(topics)})"
            + did_you_mean(name, list(topics))
        )
    message = next(_messages(bag, topics[name]), None)
    if message is None:
        raise DataError(f"the topic {name} has no message")
    return message


def _messages(bag: Any, connections: list[Any]) -> Iterator[Any]:
    for connection, _, data in bag.messages(connections=connections):
        yield bag.deserialize(data, connection.msgtype)


def _listed(topics: dict[str, list[Any]]) -> str:
    return f"there are: {', '.join(sorted(topics)) or 'none'}"
