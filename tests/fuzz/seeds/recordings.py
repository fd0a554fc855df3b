"""Recordings: depth images or clouds in a folder, with their camera, description and truth."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from regkit import load_frame, load_recording
from regkit.geometry.camera import Camera
from regkit.interfaces import Recording
from regkit.observation import Frame
from tests.fuzz import oracles
from tests.fuzz.kind import Damaged, Files, Kind
from tests.fuzz.seeds.cloud_files import archive, pcd, ply

CAMERA = Camera(width=40, height=30, fx=36.0, fy=35.0, cx=19.0, cy=15.5)
SEQUENCE = b'name: take\nfps: 30\ndepth_scale: 1000\nsource: "made"\nlicence: "CC0"\n'
FARTHEST = 1e4
"""No depth camera sees farther [m]."""


def image(frame: int) -> bytes:
    depth = np.zeros((CAMERA.height, CAMERA.width), dtype=np.uint16)
    depth[5:25, 8 + frame : 28 + frame] = 2000 + np.arange(20)
    stream = io.BytesIO()
    Image.fromarray(depth).save(stream, "PNG")
    return stream.getvalue()


def truth() -> bytes:
    lines = ["frame,joint,x,y,z"]
    for frame in range(2):
        lines += [f"{frame},{joint},0.1,{0.1 * n:.6f},2.0" for n, joint in enumerate("abc")]
    return ("\n".join(lines) + "\n").encode()


def depth_folder() -> list[Files]:
    return [
        {
            "depth/000000.png": image(0),
            "depth/000001.png": image(1),
            "camera.json": CAMERA.to_json().encode(),
            "sequence.yaml": SEQUENCE,
            "truth.csv": truth(),
            "keypoints.csv": b"frame,name,x,y,z,confidence\n1,a,0.1,0.1,2.0,0.5\n",
        }
    ]


def cloud_folder() -> list[Files]:
    rest = {"sequence.yaml": SEQUENCE, "truth.csv": truth()}
    return [
        {"clouds/000000.npz": archive(), **rest},
        {"clouds/000000.ply": ply("binary_little_endian"), **rest},
    ]


def everything(recording: Recording) -> tuple[Recording, list[Frame], Any]:
    """All that a run reads of a recording."""
    return recording, list(recording.frames()), recording.truth()


def nonsense(value: Any, file: Damaged) -> Iterator[str]:
    recording, frames, positions = value
    yield from oracles.name(recording.name, "recording")
    if not 1e-3 < recording.fps < 1e5:
        yield f"fps: {recording.fps}"
    if len(frames) != recording.length:
        yield f"frames: {len(frames)} of {recording.length}"
    for frame in frames:
        yield from of_frame(frame)
    if positions is not None:
        for joint in positions.joints:
            yield from oracles.name(joint, "joint")
        yield from oracles.numbers(positions.positions, "truth", most=FARTHEST, gaps=True)
        if len(positions.positions) != recording.length:
            yield f"truth: {len(positions.positions)} frames of {recording.length}"


def of_frame(frame: Frame) -> Iterator[str]:
    # A cloud may be in another unit; an image has its scale.
    most = oracles.LARGEST if frame.depth is None else FARTHEST
    yield from oracles.numbers(frame.points, "points", most=most)
    if frame.depth is not None and (frame.points[:, 2] <= 0.0).any():
        yield "points: behind the camera"


def _in_folder(path: Path) -> Any:
    return everything(load_recording(path))


def _one_frame(path: Path) -> Frame:
    return load_frame(path)


RECORDINGS = (
    Kind(
        "recordings/depth",
        depth_folder,
        {
            "depth/000000.png": "png",
            "camera.json": "json",
            "sequence.yaml": "yaml",
            "truth.csv": "text",
            "keypoints.csv": "text",
        },
        _in_folder,
        nonsense,
        whole=True,
        weight=5.0,
    ),
    Kind(
        "recordings/clouds",
        cloud_folder,
        {
            "clouds/000000.npz": "npz",
            "clouds/000000.ply": "binary",
            "sequence.yaml": "yaml",
            "truth.csv": "text",
        },
        _in_folder,
        nonsense,
        whole=True,
    ),
    Kind(
        "recordings/frame",
        lambda: [{"000000.png": image(0), "camera.json": CAMERA.to_json().encode()}],
        {"000000.png": "png", "camera.json": "json"},
        lambda folder: _one_frame(folder / "000000.png"),
        lambda frame, file: of_frame(frame),
        whole=True,
    ),
    Kind(
        "recordings/seen",
        lambda: [{"cloud.pcd": pcd("binary"), "camera.json": CAMERA.to_json().encode()}],
        {"camera.json": "json", "cloud.pcd": "binary"},
        lambda folder: _one_frame(folder / "cloud.pcd"),
        lambda frame, file: of_frame(frame),
        whole=True,
        weight=0.5,
    ),
)
