"""Bags of depth images, written as the drivers of cameras write them."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image
from places import DATA
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore

from regkit.geometry import Camera

WALK = DATA / "human_walk"
CAMERA = Camera(176, 144, 231.0, 231.0, 87.5, 71.5)
"""The camera of the shipped walk."""

TOPIC = "/camera/depth/image_raw"
INFO = "/camera/depth/camera_info"
START = 1_700_000_000
"""Time of the first image [s]."""

FORMATS = ("mcap", "db3", "bag", "mcap file", "db3 file")
"""A folder of MCAP or SQLite, a ROS 1 bag, and the files in those folders."""

ROS1, ROS2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_HUMBLE)

Row = tuple[str, int, dict[str, Any]]
"""Topic, time [ns], and the fields of a message."""


def walk_images(count: int) -> list[np.ndarray]:
    """Returns the first images (H, W) of the shipped walk [mm]."""
    return [
        np.asarray(Image.open(WALK / "depth" / f"{n:06d}.png")).astype("u2") for n in range(count)
    ]


def nanoseconds(index: int) -> int:
    """Returns the time of an image at 30 frames per second [ns]."""
    return START * 10**9 + round(index * 1e9 / 30.0)


def image_row(
    image: np.ndarray, index: int, *, topic: str = TOPIC, padding: int = 0, **changed: Any
) -> Row:
    """Returns the message of an image of ``u2`` [mm], ``f4`` [m] or other bytes of any order.

    Args:
        image: The image (H, W).
        index: Its number.
        topic: Its topic.
        padding: Number of bytes behind each row.
        changed: Fields of the message that are changed.
    """
    height, width = image.shape
    step = width * image.itemsize + padding
    rows = np.full((height, step), 0xAB, dtype=np.uint8)
    rows[:, : width * image.itemsize] = np.ascontiguousarray(image).view(np.uint8)
    encoding = {"u": "16UC1", "f": "32FC1"}[image.dtype.kind]
    fields = {
        "height": height, "width": width, "encoding": encoding, "step": step,
        "is_bigendian": int(image.dtype.byteorder == ">"), "data": rows.ravel(),
    }  # fmt: skip
    return topic, nanoseconds(index), {"type": "Image", **fields, **changed}


def compressed_row(image: np.ndarray, index: int, **changed: Any) -> Row:
    """Returns the message of a compressed image of ``u2`` [mm]."""
    file = io.BytesIO()
    Image.fromarray(image).save(file, "PNG")
    data = np.frombuffer(struct.pack("<i2f", 0, 0.0, 0.0) + file.getvalue(), dtype=np.uint8)
    fields = {"type": "CompressedImage", "format": "16UC1; compressedDepth png", "data": data}
    return f"{TOPIC}/compressedDepth", nanoseconds(index), {**fields, **changed}


def camera_row(
    camera: Camera = CAMERA,
    *,
    topic: str = INFO,
    model: str = "plumb_bob",
    coefficients: Sequence[float] = (0.0,) * 5,
    **changed: Any,
) -> Row:
    """Returns the message of a camera."""
    k = [camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0]
    fields = {
        "type": "CameraInfo", "width": camera.width, "height": camera.height,
        "distortion_model": model, "d": coefficients, "k": k,
        "p": [*k[:3], 0.0, *k[3:6], 0.0, *k[6:], 0.0], "roi": {}, "binning": 0,
    }  # fmt: skip
    return topic, nanoseconds(0), {**fields, **changed}


def walk_rows(count: int) -> list[Row]:
    """Returns the messages of the shipped walk."""
    return [camera_row(), *(image_row(image, n) for n, image in enumerate(walk_images(count)))]


def write_bag(path: Path, kind: str, rows: Iterable[Row]) -> Path:
    """Writes messages as a bag of one of the ``FORMATS``, and returns its file or folder."""
    storage = kind.split()[0]
    ros1 = storage == "bag"
    types = ROS1 if ros1 else ROS2
    path = path.with_suffix(".bag") if ros1 else path
    plugin = StoragePlugin.MCAP if storage == "mcap" else StoragePlugin.SQLITE3
    writer = Writer1(path) if ros1 else Writer2(path, version=9, storage_plugin=plugin)
    connections: dict[str, Any] = {}
    with writer as bag:
        for topic, time, fields in rows:
            message = _message(types, fields, time, ros1=ros1)
            if topic not in connections:
                connections[topic] = bag.add_connection(topic, message.__msgtype__, typestore=types)
            write = types.serialize_ros1 if ros1 else types.serialize_cdr
            bag.write(connections[topic], time, write(message, message.__msgtype__))
    return next(path.glob(f"*.{storage}")) if kind.endswith("file") else path


def _message(types: Any, fields: dict[str, Any], time: int, *, ros1: bool) -> Any:
    stamp_type = types.types["builtin_interfaces/msg/Time"]
    header_type = types.types["std_msgs/msg/Header"]
    fields = dict(fields)
    kind = fields.pop("type")
    stamp = fields.pop("stamp", time)
    header = {"stamp": stamp_type(stamp // 10**9, stamp % 10**9), "frame_id": "camera"}
    fields["header"] = header_type(**({"seq": 0} if ros1 else {}), **header)
    message = types.types[f"sensor_msgs/msg/{kind}"]
    if kind == "CameraInfo":
        numbers = {name: np.array(fields.pop(name), dtype=float) for name in ("d", "k", "p")}
        numbers["r"] = np.eye(3).ravel()
        fields |= {name.upper() if ros1 else name: one for name, one in numbers.items()}
        fields["binning_x"] = fields["binning_y"] = fields.pop("binning")
        region = {"x_offset": 0, "y_offset": 0, "height": 0, "width": 0, "do_rectify": False}
        fields["roi"] = types.types["sensor_msgs/msg/RegionOfInterest"](**(region | fields["roi"]))
    return message(**fields)
