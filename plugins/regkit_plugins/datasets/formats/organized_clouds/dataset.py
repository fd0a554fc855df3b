"""Datasets in binary files of records: a frame's organized cloud, markers and joints.

An organized cloud has a point for each pixel of the image. EVAL is stored like this, as read by
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

from regkit.config.model import InputPath
from regkit.config.quantities import Length, Rate
from regkit.interfaces import Dataset, Recording
from regkit.system.errors import DataError
from regkit_plugins.datasets.formats.axes import Axes
from regkit_plugins.datasets.formats.organized_clouds.recording import OrganizedRecording
from regkit_plugins.datasets.formats.organized_clouds.records import RecordFile, RecordLayout
from regkit_plugins.datasets.formats.subjects import SubjectPattern, subject_of


class OrganizedClouds(Dataset, ABC):
    """Files of organized clouds, one for each recording."""

    root: InputPath
    """Folder of the files."""
    files: str
    """Pattern of the recordings' file names, with ``*`` as wildcard."""
    subjects: SubjectPattern | None
    """Regular expression whose only group is the subject in a file's name."""
    record: RecordLayout
    """Sizes of the parts of a record."""
    axes: Axes = ("x", "-y", "-z")
    """Axes of the data that point right, down and forward from the camera."""
    fps: Rate
    """Frames per second."""
    camera: bool = True
    """Fit a pinhole camera to the grid of points; otherwise frames are clouds only."""
    foreground: Length | None = None
    """Keep only points that are closer than the largest depth of their pixel by at least this [m].
    People must leave every place where they stood; by default everything is kept."""

    def found(self) -> list[Recording]:
        """Returns a recording for each file."""
        files = sorted(path for path in self.root.glob(self.files) if path.is_file())
        if not files:
            raise DataError(
                f"no recording here: no file matches '{self.files}' (dataset.files)",
                place=str(self.root),
            )
        wanted = [path for path in files if self.wanted(path.stem)]
        # If no requested recording exists, return all, so that the error can list their names.
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
