"""The live viewer: browsers follow a track while it is computed, and never hold it up."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from threading import Condition, Thread

import numpy as np

from regkit.geometry.camera import Camera
from regkit.interfaces import Registrar
from regkit.observation import PlacedCamera
from regkit.system.arrays import Array
from regkit.viewer.live_frame import LiveFrame
from regkit.viewer.page import page
from regkit.viewer.points import FramePoints
from regkit.viewer.scene import MethodScene, RecordingScene, Scene
from regkit.viewer.server import HOST, HTML, JSON, Answer, Server
from regkit.viewer.track_scene import TrackScene

KEPT = 600
"""Number of frames that are kept for browsers that come later, or go back."""

BEHIND = 60
"""Number of frames by which a slow browser may lag; it then skips to the newest."""

FAREWELL = 0.5
"""Time [s] in which browsers are told that no frame follows."""

POLLED = 0.05
"""Time [s] after which the server notices that it is to end."""

SILENCE = 5.0
"""Time [s] without a frame after which a sign of life is sent, which finds browsers that left."""


class LiveViewer:
    """Serves a track to any number of browsers while it is computed.

    ``add`` returns at once: it neither packs a frame nor waits for a browser. A browser that comes
    later gets the last ``KEPT`` frames; one that is too slow misses some.

    Args:
        title: Title of the page.
        fps: Frames per second of the source; at which rate the page replays them.
        registrar: The registrar, whose body and shape model are shown.
        method: Name of the method.
        colour: Its colour, #rrggbb.
        curves: Units of the curves by their names.
        camera: The camera, if it is known.
        host: Address to bind to; others than this machine's are told.
        port: Port; 0 for any that is free.

    Raises:
        ConfigError: If the server cannot be bound to the address.
    """

    def __init__(
        self,
        title: str,
        fps: float,
        registrar: Registrar,
        *,
        method: str = "track",
        colour: str = "#0072B2",
        curves: Mapping[str, str] | None = None,
        camera: Camera | None = None,
        host: str = HOST,
        port: int = 0,
    ) -> None:
        self._method = method
        units = {"inlier share": "%"} if curves is None else dict(curves)
        track = TrackScene.empty(registrar, fps, units)
        recording = RecordingScene(
            name=title,
            fps=fps,
            length=0,
            frames=np.zeros(0, dtype=np.intp),
            points=FramePoints.of({}),
            methods=(MethodScene(method, colour, track),),
            camera=camera,
        )
        self._scene = Scene(title, (recording,), live=True).json()
        self._page = page(title).encode()
        self._frames: deque[LiveFrame] = deque(maxlen=KEPT)
        self._added = 0
        self._watching = 0
        self._closed: str | None = None
        self._news = Condition()
        self._server = Server(self._answer, host, port)
        self._thread = Thread(target=self._server.serve_forever, args=(POLLED,), daemon=True)
        self._thread.start()

    @property
    def url(self) -> str:
        """The address of the page."""
        return self._server.url

    def add(
        self,
        number: int,
        time: float,
        points: Array,
        transforms: Array,
        markers: Array,
        verdict: str,
        *,
        supports: Array | None = None,
        curves: Mapping[str, float] | None = None,
        status: str = "",
        cameras: Iterable[PlacedCamera] = (),
    ) -> None:
        """Shows a frame; none of the arrays may be changed afterwards.

        Args:
            number: Number of the frame, ascending.
            time: Its time [s].
            points: Its data, (N, 3) [m]; (0, 3) if it has none.
            transforms: T_camera_segment, (S, 4, 4) [m].
            markers: The markers, (M, 3) [m].
            verdict: Whether the body was found: found, doubtful, lost or no data.
            supports: How well data support each segment, (S,), from 0 to 1.
            curves: Numbers of the frame by the names of their curves; NaN where unknown.
            status: A few words on the state, such as the speed.
            cameras: Several cameras in the world.
        """
        frame = LiveFrame(
            number, time, points, self._method, transforms, markers, supports, str(verdict),
            dict(curves or {}), status, tuple(cameras),
        )  # fmt: skip
        with self._news:
            self._frames.append(frame)
            self._added += 1
            self._news.notify_all()

    def close(self, message: str = "the track has ended") -> None:
        """Tells the browsers that no frame follows, and ends the server.

        Args:
            message: What the pages show.
        """
        with self._news:
            self._closed = message
            self._news.notify_all()
            self._news.wait_for(lambda: not self._watching, FAREWELL)
        self._server.shutdown()
        self._server.server_close()
        self._thread.join(timeout=1.0)

    def _answer(self, path: str) -> Answer | None:
        if path == "frames":
            return self._events()
        return {"": (HTML, self._page), "scene.json": (JSON, self._scene)}.get(path)

    def _events(self) -> Iterator[bytes]:
        """Yields the frames that are kept, then those that come, until the end."""
        with self._news:
            self._watching += 1
            begun, seen = self._added, self._added - len(self._frames)
        try:
            yield b"retry: 1000\n\n"
            while True:
                with self._news:
                    if self._added == seen and self._closed is None:
                        self._news.wait(SILENCE)
                    # The kept frames of the past are sent whole; of new ones some may be missed.
                    slow = seen >= begun and self._added - seen > BEHIND
                    seen = self._added - 1 if slow else max(seen, self._added - len(self._frames))
                    frame = self._frames[seen - self._added] if seen < self._added else None
                if frame is not None:
                    seen += 1
                    yield frame.event
                elif self._closed is not None:
                    yield b"event: end\ndata: " + " ".join(self._closed.split()).encode() + b"\n\n"
                    return
                else:
                    yield b": waiting\n\n"
        finally:
            with self._news:
                self._watching -= 1
                self._news.notify_all()
