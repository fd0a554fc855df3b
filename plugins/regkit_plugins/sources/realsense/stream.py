"""The depth images of a device, which is connected or played back."""

from __future__ import annotations

import time
from typing import Any

import numpy as np

from regkit.interfaces import Stream, TimedFrame
from regkit.observation import Frame
from regkit.system.errors import DataError, SourceLostError
from regkit.system.guard import foreign
from regkit_plugins.sources.formats.clock import checked_time
from regkit_plugins.sources.realsense.devices import name_of
from regkit_plugins.sources.realsense.library import realsense
from regkit_plugins.sources.realsense.profiles import depth_profiles, lens_of, scale_of

WAIT = 50
"""Time [ms] of one wait for a frame, after which the device is asked whether it is still there."""

PATIENCE = 5.0
"""Time [s] without a frame after which a connected camera counts as lost."""

BEHIND = 4
"""Number of measured frames that wait to be read; a later one takes the place of the first."""


class DeviceStream(Stream):
    """The depth images of one profile of a device's sensor."""

    def __init__(self, device: Any, sensor: Any, profile: Any, *, place: str, behind: int) -> None:
        """Opens the sensor.

        Args:
            device: A ``device`` of pyrealsense2.
            sensor: Its sensor.
            profile: The sensor's profile of 16-bit depth images.
            place: The camera or the file, for messages.
            behind: Number of frames that wait to be read.

        Raises:
            DataError: If the sensor cannot be opened, or its images not be used.
        """
        self.fps = float(profile.fps())
        self._device, self._sensor, self._place = device, sensor, place
        self._queue = realsense().frame_queue(behind, keep_frames=True)
        self._number: int | None = None
        try:
            self._lens = lens_of(profile)
            self.depth_scale = scale_of(sensor)
            sensor.open(profile)
            sensor.start(self._queue)
        except DataError as error:
            raise error.at(place) from None
        except RuntimeError as error:  # What the library raises for everything.
            raise DataError(
                f"the camera cannot be started: {foreign(error)}", place=place
            ) from None
        self._open = True

    def close(self) -> None:
        """Stops the sensor."""
        if self._open:
            self._open = False
            try:
                self._sensor.stop()
                self._sensor.close()
            except RuntimeError:
                # An unplugged camera has stopped.
                pass

    def _wait(self) -> Any:
        """Returns the next frame within ``WAIT``, or None."""
        ready, frame = self._queue.try_wait_for_frame(WAIT)
        return frame.as_depth_frame() if ready else None

    def _timed(self, frame: Any) -> TimedFrame:
        """Returns a frame of the device in metres."""
        number = int(frame.get_frame_number())
        place = f"{self._place}: frame {number}"
        if self._number is not None and number > self._number + 1:
            self.dropped += number - self._number - 1
        self._number = number
        at = checked_time(1e-3 * float(frame.get_timestamp()), place=place)
        depth = np.asanyarray(frame.get_data()).astype(np.float64) / self.depth_scale
        return TimedFrame(Frame.of_image(depth, self._lens, place=place), at)


class CameraStream(DeviceStream):
    """The depth images of a connected camera."""

    live = True

    def __init__(
        self,
        device: Any,
        *,
        width: int | None = None,
        height: int | None = None,
        fps: int | None = None,
        patience: float = PATIENCE,
    ) -> None:
        """Starts the camera.

        Args:
            device: A ``device`` of pyrealsense2.
            width: Width of the images [px]; by default the camera's own choice.
            height: Height of the images [px].
            fps: Frames per second [1/s].
            patience: Time without a frame [s] after which the camera counts as lost.

        Raises:
            DataError: If it does not measure such images.
        """
        self.name = place = name_of(device)
        sensor, profile = _chosen(depth_profiles(device), (width, height, fps), place)
        self._patience = patience
        super().__init__(device, sensor, profile, place=place, behind=BEHIND)

    def read(self) -> TimedFrame | None:
        """Returns the next frame, waiting for it; None once the stream is closed.

        Raises:
            DataError: If the frame is damaged.
            SourceLostError: If the camera is unplugged, or silent for long.
        """
        end = time.monotonic() + self._patience
        while self._open:
            frame = self._wait()
            if frame is not None:
                return self._timed(frame)
            if not self._device.is_connected():
                raise SourceLostError("the camera is no longer connected", place=self._place)
            if time.monotonic() > end:
                raise SourceLostError(
                    f"no frame came within {self._patience:g} s; is the camera still plugged in, "
                    "and its cable fit for this size and frame rate?",
                    place=self._place,
                )
        return None


def _chosen(
    offered: list[tuple[Any, Any]], wanted: tuple[int | None, ...], place: str
) -> tuple[Any, Any]:
    """Returns the sensor and the profile of the wanted width, height and frame rate.

    Of several, it is the camera's default one, or else the largest.
    """
    fit = [
        one
        for one in offered
        if all(want in (None, has) for want, has in zip(wanted, _format(one), strict=True))
    ]
    if not fit:
        known = sorted({_format(one) for one in offered})
        listed = ", ".join(f"{width}x{height} at {fps}" for width, height, fps in known)
        raise DataError(
            f"the camera has no such depth images (there are, by width, height and fps: "
            f"{listed or 'none'})",
            place=place,
        )
    return max(fit, key=lambda one: (one[1].is_default(), _format(one)))


def _format(offered: tuple[Any, Any]) -> tuple[int, int, int]:
    """Returns width [px], height [px] and frame rate [1/s] of a profile."""
    _, profile = offered
    return int(profile.width()), int(profile.height()), int(profile.fps())
