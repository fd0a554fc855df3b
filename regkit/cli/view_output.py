"""The live viewer as an output of ``regkit track``."""

from __future__ import annotations

import numpy as np

from regkit.api.live_pose import LivePose
from regkit.api.live_track import LiveTrack
from regkit.cli.console import errors
from regkit.cli.view import open_browser
from regkit.observation import PlacedCamera
from regkit.viewer.live import LiveViewer

NO_POINTS = np.zeros((0, 3))


class ViewOutput:
    """Shows the poses of a track in browsers as they come.

    Args:
        track: The track, whose body is found.
        method: Name of the method.
        host: Address to listen on.
        port: Port; 0 for a free one.

    Raises:
        ConfigError: If the address cannot be listened on.
    """

    def __init__(self, track: LiveTrack, method: str, host: str, port: int) -> None:
        stream = track.stream
        self._viewer = LiveViewer(
            track.name, stream.fps, track.registrar, method=method, host=host, port=port
        )
        errors.print(f"viewer: {self._viewer.url}")
        open_browser(self._viewer.url)

    def add(self, pose: LivePose, status: str) -> None:
        """Shows a pose."""
        seen = pose.observation
        points = NO_POINTS if seen is None else seen.points
        self._viewer.add(
            pose.number,
            pose.time,
            points,
            pose.segments,
            pose.markers,
            pose.verdict,
            supports=pose.supports,
            curves={"inlier share": 100.0 * pose.inlier_share},
            status=status,
            cameras=() if seen is None else PlacedCamera.of_views(seen.views),
        )

    def close(self) -> None:
        """Tells the browsers that the track has ended."""
        self._viewer.close()
