"""Small scenes for the viewer's page: a figure of three segments that walks past a camera."""

import base64
import json
from typing import Any

import numpy as np

CAMERA = {"width": 160, "height": 120, "fx": 150.0, "fy": 150.0, "cx": 79.5, "cy": 59.5}
SEGMENTS = ["trunk", "left arm", "right arm"]
DTYPES = {"f4": "<f4", "i2": "<i2", "u2": "<u2", "u4": "<u4"}


def entry(dtype: str, values: Any) -> dict[str, Any]:
    """An array as scenes hold it."""
    array = np.asarray(values, DTYPES[dtype])
    data = base64.b64encode(array.tobytes()).decode("ascii")
    return {"dtype": dtype, "shape": list(array.shape), "data": data}


def transforms(frames: int) -> np.ndarray:
    """T_camera_segment of the figure, (F, 3, 7): arms that swing about a trunk that moves on."""
    found = np.zeros((frames, 3, 7))
    phase = np.linspace(0.0, 2.0 * np.pi, frames)[:, None]
    found[:, :, 4:] = [[0.0, 0.0, 2.5], [0.2, -0.3, 2.5], [-0.2, -0.3, 2.5]]
    found[:, :, 4] += 0.01 * np.arange(frames)[:, None]
    angles = 0.5 * np.sin(phase) * np.array([0.0, 1.0, -1.0])
    found[:, :, 0], found[:, :, 3] = np.sin(angles / 2), np.cos(angles / 2)
    return found


def shapes() -> list[dict[str, Any]]:
    """The figure as ellipsoids, capsules and a mesh."""
    centres = [[0.0, 0.0, 0.0], [0.0, 0.25, 0.0], [0.0, 0.25, 0.0]]
    radii = [[0.16, 0.35, 0.1], [0.05, 0.25, 0.05], [0.05, 0.25, 0.05]]
    ends = [[[0, -0.25, 0], [0, 0.3, 0]], [[0, 0, 0], [0, 0.5, 0]], [[0, 0, 0], [0, 0.5, 0]]]
    rest = transforms(1)[0]
    corners = rest[:, None, 4:] + 0.08 * np.array(
        [[-1, -3, 0], [1, -3, 0], [0, 4, 1], [0, 4, -1]], float
    )
    return [
        {
            "kind": "ellipsoids",
            "segments": entry("u2", [0, 1, 2]),
            "centres": entry("f4", centres),
            "rotations": entry("f4", [[0, 0, 0, 1]] * 3),
            "radii": entry("f4", radii),
        },
        {
            "kind": "capsules",
            "segments": entry("u2", [0, 1, 2]),
            "ends": entry("f4", ends),
            "radii": entry("f4", [[0.16, 0.1], [0.05, 0.03], [0.05, 0.03]]),
        },
        {
            "kind": "mesh",
            "vertices": entry("f4", corners.reshape(-1, 3)),
            "triangles": entry(
                "u4", [[4 * s + i for i in t] for s in range(3) for t in tetrahedron()]
            ),
            "carriers": entry("u2", np.repeat([[0, 0], [1, 0], [2, 0]], 4, axis=0)),
            "weights": entry("f4", np.tile([0.8, 0.2], (12, 1))),
            "rest": entry("f4", rest),
        },
    ]


def tetrahedron() -> list[list[int]]:
    return [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]


def method(name: str, colour: str, numbers: list[int], length: int, **more: Any) -> dict[str, Any]:
    """A method that found the figure in the given frames of a recording."""
    frames = len(numbers)
    placed = transforms(frames)
    curve = 90.0 + 10.0 * np.sin(np.arange(length) / 5.0)
    return {
        "name": name,
        "colour": colour,
        "segments": SEGMENTS,
        "bones": entry("u2", [[0, 1], [0, 2], [1, 3], [2, 4]]),
        "markers": {
            "names": ["left hand", "right hand"],
            "positions": entry("f4", placed[:, 1:, 4:] + [0.0, 0.5, 0.0]),
        },
        "transforms": entry("f4", placed),
        "shapes": shapes(),
        "verdicts": [["found", length]],
        "confidence": None,
        "curves": [
            {
                "name": "inlier share",
                "unit": "%",
                "frames": entry("u4", np.arange(length)),
                "values": entry("f4", curve),
            }
        ],
    } | more


def recording(
    name: str = "walk", frames: int = 6, every: int = 10, **more: Any
) -> tuple[dict[str, Any], list[int], int]:
    """A recording without methods, the numbers of its frames in the scene, and its length."""
    numbers = [every * index for index in range(frames)]
    length = every * frames
    random = np.random.default_rng(5)
    cloud = random.normal(0.0, [0.1, 0.25, 0.05], (200, 3))
    points = [cloud + placed[0, 4:] - [0, 0, 2.5] for placed in transforms(frames)]
    made = {
        "name": name,
        "fps": 30.0,
        "length": length,
        "frames": numbers,
        "marked": [],
        "points": {
            "origin": [0.0, 0.0, 2.5],
            "step": 0.0005,
            "offsets": entry("u4", 200 * np.arange(frames + 1)),
            "positions": entry("i2", np.reshape(points, (-1, 3)) / 0.0005),
        },
        "clouds": [],
        "joints": {
            "names": ["left hand"],
            "positions": entry("f4", transforms(frames)[:, 1:2, 4:] + [0.02, 0.5, 0.0]),
        },
        "up": [0.0, -1.0, 0.0],
        "camera": CAMERA,
        "methods": [],
    } | more
    return made, numbers, length


def scene(*recordings: dict[str, Any], title: str = "demo", **more: Any) -> bytes:
    """A scene's document."""
    document = {"format": 1, "title": title, "note": "", "live": False} | more
    return json.dumps(document | {"recordings": list(recordings)}).encode("utf-8")


def walk(**more: Any) -> bytes:
    """Two methods on a walk: one loses the figure in the middle, where a mark is.

    A second recording is a cloud without methods, which two cameras see.
    """
    made, numbers, length = recording(marked=[{"frame": 30, "why": "worst of icp"}])
    confidence = entry("f4", np.tile([1.0, 0.6, 0.1], (len(numbers), 1)))
    made["methods"] = [
        method("best", "#0072b2", numbers, length, confidence=confidence),
        method(
            "icp",
            "#d55e00",
            numbers,
            length,
            verdicts=[["found", 25], ["doubtful", 5], ["lost", 10], ["no data", 10], ["found", 10]],
        ),
    ]
    corners = [[-0.5, -0.4, 1.0], [0.5, -0.4, 1.0], [0.5, 0.4, 1.0], [-0.5, 0.4, 1.0]]
    cameras = [
        {"name": name, "place": [x, 0.0, 0.0], "corners": [[x + a, b, c] for a, b, c in corners]}
        for name, x in (("left", -1.0), ("right", 1.0))
    ]
    single = {"name": "cloud", "joints": None, "camera": None, "cameras": cameras}
    return scene(made, recording(frames=1, every=1)[0] | single, **more)
