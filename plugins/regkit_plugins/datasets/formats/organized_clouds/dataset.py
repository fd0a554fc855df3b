"""Datasets in binary files: each record is a frame's organized cloud, markers and joints.

An organized cloud has a point for each pixel of the image. This is how EVAL is stored, as read by
the public loader of pyKinectTools (https://github.com/colincsl/pyKinectTools,
``dataset_readers/EVALPlayer.py``):

    int32 magic, int32 frame, float32 points[height][width][3] [m],
    int32 marker count, markers[slots] of {char name[256], float32 position[3]},
    int32 joint count, joints[slots] of {int32 number, float32 position[3]}

all little-endian and without gaps.
"""

from __future__ import annotations

from abc import ABC
from pathlib import Path
from typing import Annotated

from pydantic import Field

from regkit.config.model import InputPath
from regkit.interfaces import Dataset, Recording
from regkit.system.errors import DataError
from regkit_plugins.datasets.formats.axes import Axes
from regkit_plugins.datasets.formats.organized_clouds.recording import OrganizedRecording
from regkit_plugins.datasets.formats.organized_clouds.records import RecordFile, RecordLayout
from regkit_plugins.datasets.formats.subjects import SubjectPattern, subject_of


class OrganizedClouds(Dataset, ABC):
    """Files of organized clouds, each a recording."""

    root: InputPath
    """The folder that holds the files."""
    files: str
    """Which files of the folder are recordings, as a pattern with ``*``."""
    subjects: SubjectPattern | None
    """A regular expression whose one group finds the subject in a file's name."""
    record: RecordLayout
    """How large the parts of a record are."""
    axes: Axes = ("x", "-y", "-z")
    """The data's axes that point right, down and forward from the camera."""
    fps: Annotated[float, Field(gt=0.0)]
    """Frames per second."""
    camera: bool = True
    """Fit a pinhole camera to the grid of points; without it the frames are clouds alone."""
    foreground: Annotated[float, Field(gt=0.0)] | None = None
    """Keep only what is so much nearer [m] than the farthest that its pixel saw in the recording.
    It needs people who leave every place where they stood; everything is kept without it."""

    def found(self) -> list[Recording]:
        """A recording for each file."""
        files = sorted(path for path in self.root.glob(self.files) if path.is_file())
        if not files:
            raise DataError(
                f"no recording here: no file is called like '{self.files}' (dataset.files)",
                place=str(self.root),
            )
        wanted = [path for path in files if self.wanted(path.stem)]
        # If none is wanted, all are returned: the answer to a misspelt name lists them.
        return [self._recording(path) for path in wanted or files]

    def _recording(self, path: Path) -> Recording:
        file = RecordFile.of(path, self.record)
        return OrganizedRecording(
            name=path.stem,
            fps=self.fps,
            length=min(file.length, self.frames or file.length),
            subject=subject_of(path.stem, self.subjects),
            file=file,
            axes=self.axes,
            with_camera=self.camera,
            foreground=self.foreground,
        )
