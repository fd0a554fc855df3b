"""The folder of a recording of several cameras, each with a folder of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from regkit.geometry.lens import Lens
from regkit.observation import Frame, View
from regkit.recording.cameras import FILE, CameraDescription, Cameras
from regkit.recording.cloud_folder import CloudFolder
from regkit.recording.depth_folder import DepthFolder
from regkit.recording.description import FILE as DESCRIPTION
from regkit.recording.description import RecordingDescription
from regkit.recording.folder import RecordingFolder
from regkit.recording.instants import matched, runs
from regkit.recording.times import FILE as TIMES
from regkit.recording.times import read_times
from regkit.system.arrays import Array, Indices
from regkit.system.errors import DataError

CONTENTS: tuple[type[RecordingFolder], ...] = (CloudFolder, DepthFolder)
"""What a camera's folder may hold."""

MOST_RUNS = 3
"""Maximum number of gaps in a message."""


@dataclass(frozen=True)
class CameraFolder:
    """One camera of a recording.

    Attributes:
        name: Name of the camera.
        content: Its frames.
        description: What ``cameras.json`` says of it.
        lens: Its intrinsics, if they are not in its folder.
    """

    name: str
    content: RecordingFolder
    description: CameraDescription
    lens: Lens | None

    @cached_property
    def times(self) -> Array:
        """Times of its frames, (T,) [s], with its offset.

        Raises:
            DataError: If they go back.
        """
        count = len(self.content.files)
        path = self.content.folder / TIMES
        times = read_times(path, count)
        if times is None:
            times = np.arange(count) / self.content.description.fps
        back = np.flatnonzero(np.diff(times) <= 0.0)
        if len(back):
            raise DataError(
                f"the time of frame {back[0] + 1} is not after that of frame {back[0]}; frames of "
                "several cameras are matched by their times",
                place=str(path),
            )
        return times + self.description.time_offset_s


@dataclass(frozen=True)
class CamerasFolder:
    """The folder of a recording of several cameras.

    Attributes:
        folder: The folder.
        name: Name of the recording.
        fps: Frames per second of the fastest camera [1/s].
        tolerance: Largest difference of the times of an instant [s].
        cameras: The cameras.
        instants: The frame of each camera in each instant, (N, V); -1 for none.
    """

    folder: Path
    name: str
    fps: float
    tolerance: float
    cameras: tuple[CameraFolder, ...]
    instants: Indices

    @classmethod
    def read(cls, folder: Path, frames: int | None = None) -> CamerasFolder:
        """Reads the description of the cameras and matches their frames.

        Args:
            folder: The recording's folder.
            frames: Maximum number of instants, from the first; all by default.

        Raises:
            RegkitError: If the description is invalid, or a camera's folder is damaged.
        """
        return cls.of(folder, Cameras.read(folder), frames)

    @classmethod
    def of(cls, folder: Path, described: Cameras, frames: int | None = None) -> CamerasFolder:
        """Matches the frames of described cameras; the arguments are those of ``read``."""
        shared = None
        if (folder / DESCRIPTION).is_file():
            shared = RecordingDescription.read(folder)
        cameras = tuple(
            CameraFolder(name, _content(folder, name, one, shared), one, one.lens(folder))
            for name, one in described.cameras.items()
        )
        fps = max(camera.content.description.fps for camera in cameras)
        tolerance = described.tolerance_s or 0.5 / fps
        instants = matched([camera.times for camera in cameras], tolerance)[:frames]
        name = shared.name if shared is not None and shared.name else folder.resolve().name
        return cls(folder, name, fps, tolerance, cameras, instants)

    def check_placed(self) -> None:
        """Checks that all cameras have a pose.

        Raises:
            DataError: If one has none.
        """
        for camera in self.cameras:
            if camera.description.T_world_camera is None:
                raise DataError(
                    "the camera has no T_world_camera; `regkit calibrate --extrinsics` finds it, "
                    "or track its folder alone",
                    place=f"{self.folder / FILE}: cameras.{camera.name}",
                )

    def reader(self) -> Callable[[int], Frame]:
        """Returns the function that reads the frame of an instant, from 0.

        Raises:
            DataError: If what all frames share is damaged; the function raises it for a frame.
        """
        readers = [camera.content.reader(camera.lens) for camera in self.cameras]
        poses = [camera.description.pose for camera in self.cameras]

        def read(index: int) -> Frame:
            views = []
            for camera, reader, pose, at in zip(
                self.cameras, readers, poses, self.instants[index], strict=True
            ):
                if at >= 0 and pose is not None:
                    views.append(View(camera.name, pose, reader(int(at))))
            return Frame.of_views(views, place=f"{self.folder}: instant {index}")

        return read

    def absences(self) -> list[str]:
        """Returns in words in which instants each camera has no frame."""
        told = []
        for column, camera in enumerate(self.cameras):
            missing = np.flatnonzero(self.instants[:, column] < 0)
            if not len(missing):
                continue
            gaps = [
                f"{first}" if first == last else f"{first} to {last}"
                for first, last in runs(missing)
            ]
            more = f" and {len(gaps) - MOST_RUNS} more gaps" if len(gaps) > MOST_RUNS else ""
            told.append(
                f"camera '{camera.name}' has no frame in {len(missing)} of {len(self.instants)} "
                f"instants, {', '.join(gaps[:MOST_RUNS])}{more}; there the others alone are used"
            )
        return told

    def input_files(self) -> list[Path]:
        """Returns the files of all cameras, and those that they share."""
        beside = [self.folder / name for name in (FILE, DESCRIPTION, "truth.csv")]
        named = [
            self.folder / camera.description.intrinsics
            for camera in self.cameras
            if isinstance(camera.description.intrinsics, str)
        ]
        own = [path for camera in self.cameras for path in camera.content.input_files()]
        return [*(path for path in (*beside, *named) if path.is_file()), *own]


def _content(
    folder: Path, name: str, camera: CameraDescription, shared: RecordingDescription | None
) -> RecordingFolder:
    """Returns the frames of a camera.

    Raises:
        RegkitError: If there are none, or they are damaged.
    """
    own = folder / (camera.folder or name)
    for content in CONTENTS:
        if (own / content.content).is_dir():
            described = None if (own / DESCRIPTION).is_file() else shared
            return content.read(own, description=described)
    raise DataError(
        f"the folder of the camera '{name}' has neither depth/ nor clouds/", place=str(own)
    )
