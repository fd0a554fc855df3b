"""Bags of ROS 1 and ROS 2, and MCAP files.

- ``rosbag``: the plug-in.
- ``topics``: which topics are depth images and their cameras.
- ``images``, ``cameras``: their messages.
- ``stream``: the frames of a topic.
"""

from regkit_plugins.sources.rosbag.rosbag import Rosbag

__all__ = ["Rosbag"]
