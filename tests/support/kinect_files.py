"""Recordings of an Azure Kinect as ``k4arecorder`` lays them out, with few images."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

PARAMETERS = [
    0.5122697949409485, 0.49451231956481934, 0.4921168386936188, 0.4921667277812958,
    3.1305770874023438, 2.324939012527466, 0.1304156482219696,
    3.458651542663574, 3.350114583969116, 0.6629416346549988,
    0.0, 0.0, -0.0000511557373101823, 0.00008132171933539212,
]  # fmt: skip
"""Parameters of a depth camera: cx cy fx fy k1 to k6, the centre of distortion, p2 p1."""

MODEL = "CALIBRATION_LensDistortionModelBrownConrady"


def calibration(parameters: Sequence[float] = PARAMETERS, model: str = MODEL) -> dict[str, Any]:
    """Returns the content of ``calibration.json``."""
    intrinsics = {"ModelParameters": parameters, "ModelType": model, "ModelParameterCount": 14}
    cameras = [
        {"Location": "CALIBRATION_CameraLocationPV0", "Intrinsics": {}},
        {"Location": "CALIBRATION_CameraLocationD0", "Intrinsics": intrinsics},
    ]
    return {"CalibrationInformation": {"Cameras": cameras}}


def element(kind: int, *content: bytes, size: int | None = None) -> bytes:
    """Returns an element; its size may be stated wrongly."""
    inside = b"".join(content)
    stated = len(inside) if size is None else size
    identifier = kind.to_bytes((kind.bit_length() + 7) // 8, "big")
    return identifier + (stated | 1 << 56).to_bytes(8, "big") + inside


def number(kind: int, value: int) -> bytes:
    return element(kind, value.to_bytes(8, "big"))


def track(index: int, name: str, width: int, height: int, code: bytes = b"b16g") -> bytes:
    header = bytes(16) + code + bytes(20)
    return element(
        0xAE, number(0xD7, index), element(0x536E, name.encode()),
        element(0x86, b"V_MS/VFW/FOURCC"), element(0x63A2, header), number(0x23E383, 33_333_333),
        element(0xE0, number(0xB0, width), number(0xBA, height)),
    )  # fmt: skip


def block(index: int, offset: int, data: bytes, *, group: bool = False) -> bytes:
    content = bytes([0x80 | index]) + offset.to_bytes(2, "big", signed=True) + b"\x80" + data
    return element(0xA0, element(0xA1, content)) if group else element(0xA3, content)


def kinect_bytes(
    images: Sequence[np.ndarray],
    *,
    attached: dict[str, Any] | None = None,
    name: str = "DEPTH",
    code: bytes = b"b16g",
    group: bool = False,
) -> bytes:
    """Returns a recording of images (H, W) [mm], two in a cluster, beside a track of colours.

    Args:
        images: The images.
        attached: The calibration; the usual one by default, and none if it is empty.
        name: Name of the depth track.
        code: Code of its pixels.
        group: Whether its blocks are in groups.
    """
    height, width = images[0].shape
    content = json.dumps(calibration() if attached is None else attached).encode()
    file = element(0x61A7, element(0x466E, b"calibration.json"), element(0x465C, content))
    clusters = []
    for first in range(0, len(images), 2):
        blocks = []
        for index in range(first, min(first + 2, len(images))):
            data = images[index].astype(">u2").tobytes()
            offset = 33_333 * (index - first) - 2000
            blocks += [block(1, offset, b"colours"), block(2, offset, data, group=group)]
        clusters.append(element(0x1F43B675, number(0xE7, 1_002_000 + 33_333 * first), *blocks))
    segment = element(
        0x18538067,
        element(0x1549A966, number(0x2AD7B1, 1000), element(0x7BA9, b"Azure Kinect")),
        element(0x1654AE6B, track(1, "COLOR", 8, 8, b"MJPG"), track(2, name, width, height, code)),
        *([element(0x1941A469, file)] if attached != {} else []),
        *clusters,
    )
    return element(0x1A45DFA3, element(0x4282, b"matroska")) + segment


def write_kinect(path: Path, images: Sequence[np.ndarray], **options: Any) -> Path:
    """Writes a recording, and returns its file."""
    path.write_bytes(kinect_bytes(images, **options))
    return path
