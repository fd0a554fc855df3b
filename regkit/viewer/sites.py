"""What a server answers for a scene, and for a recording whose frames are read on request."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from threading import Lock

import numpy as np

from regkit.interfaces import Recording
from regkit.observation import PlacedCamera
from regkit.viewer.frame_cursor import FrameCursor
from regkit.viewer.page import page
from regkit.viewer.points import frame_bytes
from regkit.viewer.reference import reference_of
from regkit.viewer.scene import RecordingScene, Scene
from regkit.viewer.server import BYTES, HTML, JSON, Answer

MOST_POINTS = 30_000
"""Maximum number of points of a frame."""

FRAME = re.compile(r"points/0/(\d{1,9})")
"""The address of a frame's points."""


@dataclass(frozen=True)
class SceneSite:
    """The page of a scene, and the scene."""

    scene: Scene

    def __call__(self, path: str) -> Answer | None:
        """Returns the answer to a path."""
        if path == "":
            return HTML, self._page
        return (JSON, self._json) if path == "scene.json" else None

    @cached_property
    def _page(self) -> bytes:
        return page(self.scene.title).encode()

    @cached_property
    def _json(self) -> bytes:
        return self.scene.json()


@dataclass(frozen=True)
class RecordingSite:
    """The page of a recording, whose frames are read when the page shows them."""

    recording: Recording

    def __call__(self, path: str) -> Answer | None:
        """Returns the answer to a path.

        Raises:
            RegkitError: If a frame cannot be read.
        """
        asked = FRAME.fullmatch(path)
        if asked is None:
            return self._site(path)
        index = int(asked[1])
        if index >= self.recording.length:
            return None
        # A dataset need not bear two readers.
        with self._reading:
            frame = self._cursor.at(index)
        if frame is None:
            return None
        return BYTES, frame_bytes(frame.points[:: max(1, -(-len(frame.points) // MOST_POINTS))])

    @cached_property
    def _reading(self) -> Lock:
        return Lock()

    @cached_property
    def _cursor(self) -> FrameCursor:
        return FrameCursor(self.recording)

    @cached_property
    def _site(self) -> SceneSite:
        recording = self.recording
        first = next((frame for _, frame in recording.some([0])), None)
        frames = np.arange(recording.length)
        joints, reference = reference_of(recording.truth(), frames)
        shown = RecordingScene(
            name=recording.name,
            fps=recording.fps,
            length=recording.length,
            frames=frames,
            joints=joints,
            reference=reference,
            points="points/0/{index}",
            camera=None if first is None else first.camera,
            cameras=() if first is None else PlacedCamera.of_views(first.views),
        )
        return SceneSite(Scene(recording.name, (shown,)))
