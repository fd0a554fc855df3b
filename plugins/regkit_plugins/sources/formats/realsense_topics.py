"""Recordings of RealSense cameras, which have the containers of ROS bags, and topics of their own.

Their topics begin with ``/device_0/``: https://github.com/realsenseai/librealsense, in
``src/media/ros/file_types.h`` and ``readme.md``. The bag format is described at
https://wiki.ros.org/Bags/Format/2.0.
"""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

TOPIC = "/device_0/"
"""Begin of the topics of the first camera."""

MAGIC = b"#ROSBAG V2.0\n"
"""Begin of a ROS 1 bag."""

HEADER, INDEX = 4096, 1 << 20
"""Number of bytes of a bag's header record, and of the records of connections that are read."""


def is_realsense(path: Path) -> bool:
    """Returns whether a ``.bag`` or ``.db3`` file is the recording of a RealSense camera.

    A file that cannot be read is none.
    """
    try:
        if path.suffix.lower() == ".db3":
            return _of_database(path)
        return _of_bag(path)
    except (OSError, sqlite3.Error):
        return False


def _of_database(path: Path) -> bool:
    query = "SELECT count(*) FROM topics WHERE name LIKE ?"
    with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as database:
        (count,) = database.execute(query, (f"{TOPIC}%",)).fetchone()
    return bool(count)


def _of_bag(path: Path) -> bool:
    """Looks for topics among the connections, which the index at the end lists."""
    with path.open("rb") as file:
        head = file.read(HEADER)
        if not head.startswith(MAGIC):
            return False
        field = head.find(b"index_pos=")
        start = int.from_bytes(head[field + 10 : field + 18], "little") if field >= 0 else 0
        # A recording that was cut short has no index: its connections are in its first chunk.
        file.seek(start)
        return b"topic=" + TOPIC.encode() in file.read(INDEX)
