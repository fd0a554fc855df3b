"""Keypoints: files of any detector; and markers."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from regkit import Keypoints, load_keypoints
from regkit.recording.markers import Trajectories, read_trajectories
from tests.fuzz import oracles
from tests.fuzz.kind import Damaged, Files, Kind


def flat() -> bytes:
    rows = [f"{f},{side}_knee,{40 + f}.5,80,0.9" for f in range(3) for side in ("left", "right")]
    return ("\n".join(["frame,name,x,y,confidence", *rows]) + "\n").encode()


def space() -> bytes:
    rows = [f"{f},{joint},0.1,{0.1 * f:.3f},2.0,1" for f in range(3) for joint in ("neck", "head")]
    return ("\n".join(["frame,name,x,y,z,confidence", *rows]) + "\n").encode()


def openpose() -> Files:
    numbers = [round(0.5 * n, 3) % 1.0 for n in range(75)]
    content = json.dumps({"version": 1.3, "people": [{"pose_keypoints_2d": numbers}]}).encode()
    return {f"walk_{n:012d}_keypoints.json": content for n in range(2)}


def mediapipe() -> bytes:
    marks = [{"x": 0.02 * n, "y": 0.5, "z": 0.1, "visibility": 0.9} for n in range(33)]
    return json.dumps({"frames": [{"landmarks": marks}, {"frame": 4, "landmarks": []}]}).encode()


def nonsense(found: Keypoints, file: Damaged) -> Iterator[str]:
    for name in found.names:
        yield from oracles.name(name, "keypoint")
    shape = len(found.numbers), len(found.names)
    if found.confidences.shape != shape or found.positions.shape != (*shape, 3):
        yield f"shapes: {found.confidences.shape}, {found.positions.shape}, {shape}"
    if not ((found.confidences >= 0.0) & (found.confidences <= 1.0)).all():
        yield "confidences: not from 0 to 1"
    if not (np.diff(found.numbers) > 0).all():
        yield "numbers: not ascending"
    yield from oracles.numbers(found.positions, "positions", most=1e4, gaps=True)
    yield from oracles.numbers(found.pixels, "pixels", most=1e6, gaps=True)


def _read(path: Path) -> Keypoints:
    return load_keypoints(path)


def trc() -> bytes:
    rows = [f"{n + 1}\t{0.01 * n:.2f}\t0.1\t0.2\t{0.3 + 0.1 * n:.3f}\t\t\t" for n in range(3)]
    head = [
        "PathFileType\t4\t(X/Y/Z)\ta.trc",
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits",
        "100\t100\t3\t2\tm",
        "Frame#\tTime\tA\t\t\tB\t\t",
        "\t\tX1\tY1\tZ1\tX2\tY2\tZ2",
        "",
    ]
    return ("\n".join([*head, *rows]) + "\n").encode()


def odd_trajectories(found: Trajectories, file: Damaged) -> Iterator[str]:
    for name in found.names:
        yield from oracles.name(name, "marker")
    if not 1e-3 < found.fps < 1e5:
        yield f"fps: {found.fps}"
    if found.positions.shape[1:] != (len(found.names), 3):
        yield f"shape: {found.positions.shape}"
    yield from oracles.numbers(found.positions, "positions", most=1e4, gaps=True)


KEYPOINTS = (
    Kind(
        "recordings/trc",
        lambda: [{"walk.trc": trc()}],
        {"walk.trc": "text"},
        read_trajectories,
        odd_trajectories,
    ),
    Kind(
        "recordings/keypoints.csv",
        lambda: [{"keypoints.csv": flat()}, {"keypoints.csv": space()}],
        {"keypoints.csv": "text"},
        _read,
        nonsense,
    ),
    Kind(
        "recordings/openpose",
        lambda: [openpose()],
        dict.fromkeys(openpose(), "json"),
        _read,
        nonsense,
        whole=True,
    ),
    Kind(
        "recordings/mediapipe.json",
        lambda: [{"pose.json": mediapipe()}],
        {"pose.json": "json"},
        _read,
        nonsense,
    ),
)
