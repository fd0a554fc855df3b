"""Laws of sources."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from regkit.interfaces import Source, Stream, TimedFrame
from regkit.system.errors import RegkitError
from regkit.testing.laws import Laws
from regkit.testing.verdict import require, same

FRAMES = 5
"""Maximum number of frames to read, other than to the end of a short recording."""

SHORT = 100
"""Number of frames up to which a recording is read to its end."""


class SourceLaws(Laws):
    """Laws of sources that end; of a live one, the laws of its frames."""

    @pytest.fixture
    def first_frames(self, source: Source) -> list[TimedFrame]:
        """Returns the first frames."""
        return frames_at_start(source)

    def test_source_frames_are_in_metres_and_fit_their_camera(
        self, source: Source, first_frames: list[TimedFrame]
    ) -> None:
        """Points are (N, 3) and finite; a depth image has the size of its camera's."""
        at = type(source).open
        require(bool(first_frames), source, "yields no frame", look_at=at)
        for frame in (timed.frame for timed in first_frames):
            points = np.asarray(frame.points)
            require(
                points.ndim == 2 and points.shape[1:] == (3,) and np.isfinite(points).all(),
                source, f"yields points of shape {points.shape}, or not finite", look_at=at,
            )  # fmt: skip
            far = float(np.abs(points).max(initial=0.0))
            require(
                far < 1000.0, source, f"yields a point {far:.3g} m away; points must be in metres",
                look_at=at,
            )  # fmt: skip
            if frame.depth is None:
                continue
            camera = frame.camera
            require(
                camera is not None and frame.depth.shape == (camera.height, camera.width), source,
                f"yields a depth image of shape {frame.depth.shape}, unlike its camera's",
                look_at=at,
            )  # fmt: skip
            require(
                camera is not None and same(camera.back_projected(frame.depth), points), source,
                "yields points that are not those of its depth image; use Frame.of_image",
                look_at=at,
            )  # fmt: skip

    def test_source_times_are_finite_and_do_not_decrease(
        self, source: Source, first_frames: list[TimedFrame]
    ) -> None:
        """Times are those of one clock, in seconds."""
        times = [timed.time for timed in first_frames]
        require(
            all(math.isfinite(time) for time in times)
            and all(before <= after for before, after in pairwise(times)),
            source, f"yields frames at the times {times}", look_at=type(source).open,
        )  # fmt: skip

    def test_source_reads_the_same_when_it_is_opened_twice(
        self, source: Source, first_frames: list[TimedFrame]
    ) -> None:
        """A recording begins anew each time; a camera goes on."""
        with _opened(source) as stream:
            if stream.live:
                pytest.skip("a camera shows something else each time")
        require(
            same(frames_at_start(source), first_frames), source,
            "yields other frames when it is opened again", look_at=type(source).open,
        )  # fmt: skip

    def test_source_has_ended_once_it_ends(self, source: Source) -> None:
        """Reading after the end returns None again, and the length is that of the frames."""
        with _opened(source) as stream:
            if stream.live or (stream.length or 0) > SHORT:
                pytest.skip("it does not end, or not soon")
            count = 0
            while stream.read() is not None:
                count += 1
            at = type(stream).read
            require(stream.read() is None, source, "yields frames after its end", look_at=at)
            require(
                stream.length in (None, count), source,
                f"states {stream.length} frames but yields {count}", look_at=at,
            )  # fmt: skip

    def test_source_can_be_closed_twice(self, source: Source) -> None:
        """Closing again does nothing; a stream has a name, a frame rate and a scale."""
        stream = _opened(source)
        at = type(stream)
        try:
            require(bool(stream.name), source, "opens a stream without a name", look_at=at)
            require(
                0.0 < stream.fps < math.inf and 0.0 < stream.depth_scale < math.inf, source,
                f"opens a stream of {stream.fps} frames per second, with {stream.depth_scale} "
                "units per metre", look_at=at,
            )  # fmt: skip
        finally:
            stream.close()
            stream.close()


def frames_at_start(source: Source) -> list[TimedFrame]:
    """Returns the first frames, at most ``FRAMES``."""
    found: list[TimedFrame] = []
    with _opened(source) as stream:
        while len(found) < FRAMES:
            timed = stream.read()
            if timed is None:
                break
            found.append(timed)
    return found


def _opened(source: Source) -> Stream:
    """Opens a source; skips the law of a camera that is not connected."""
    try:
        return source.open()
    except RegkitError as error:
        if source.scheme:
            pytest.skip(f"the camera cannot be opened: {error}")
        raise
