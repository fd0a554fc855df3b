"""ITOP: depth of one person at a time, from the side or from above, in HDF5 files."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from regkit.config.model import InputPath
from regkit.config.quantities import FrameCount, Rate
from regkit.geometry.camera import Camera
from regkit.interfaces import Dataset, Recording
from regkit_plugins.datasets.itop.recording import ItopFiles, ItopRecording

CAMERA = Camera(width=320, height=240, fx=1 / 0.0035, fy=1 / 0.0035, cx=160.0, cy=120.0)
"""The nominal camera, which relates joints in metres to joints in pixels."""


class Itop(Dataset):
    """ITOP (Haque, Peng, Luo, Alahi, Yeung and Fei-Fei, ECCV 2016).

    ``ITOP_side_test_depth_map.h5`` holds ``data`` (N, 240, 320) [m] and ``id`` (N,), where
    ``02_00143`` is frame 143 of person 2; ``ITOP_side_test_labels.h5`` holds for the same frames
    ``real_world_coordinates`` (N, 15, 3) [m], ``is_valid`` (N,) and ``segmentation``
    (N, 240, 320), -1 for the background. According to several public loaders, a joint (x, y, z)
    appears at the pixel (160 + x / 0.0035 z, 120 - y / 0.0035 z) in both views: x points right,
    y *up*, z forward. Right and left are the person's own. Not verified are: images that are not
    mirrored (``mirrored``), and the frame rate (``fps``).

    One file contains the frames of all people; a recording is a run of one person's consecutive
    frames, named after the person and the first frame: ``02_00143``.
    """

    kind: Literal["itop"] = "itop"

    root: InputPath
    """Folder of the unpacked files."""
    view: Literal["side", "top"] = "side"
    """View of the camera."""
    split: Literal["train", "test"] = "test"
    """Part of the data set."""
    background: Literal["dropped", "kept"] = "dropped"
    """Whether to use only the pixels that the labels assign to the person. The labels are valid
    only in manually approved frames (``is_valid``), and all other frames are then left out; with
    the background kept they are included, but their joints are not evaluated."""
    gap: FrameCount = 1
    """Maximum increment of the frame number within a recording."""
    mirrored: bool = False
    """Whether images and joints are stored mirrored, and must be flipped."""
    fps: Rate = 30.0
    """Frames per second."""

    def found(self) -> list[Recording]:
        """Returns a recording for each run of frames of one person."""
        stem = f"ITOP_{self.view}_{self.split}"
        files = ItopFiles(self._file(f"{stem}_depth_map.h5"), self._file(f"{stem}_labels.h5"))
        runs = files.runs(valid_only=self.background == "dropped", gap=self.gap)
        return [
            ItopRecording(
                name=f"{run.person}_{run.number:05d}",
                fps=self.fps,
                length=min(len(run.indices), self.frames or len(run.indices)),
                subject=run.person,
                files=files,
                indices=run.indices,
                segmented=self.background == "dropped",
                mirrored=self.mirrored,
                camera=CAMERA,
            )
            for run in runs
        ]

    def _file(self, name: str) -> Path:
        return self.root / name
