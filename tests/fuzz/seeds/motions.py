"""Motions of synthetic recordings, and recorded hand poses."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from regkit_synthesis import assets
from regkit_synthesis.figure.figure import FIGURE
from regkit_synthesis.hands.handywork import read_handywork
from regkit_synthesis.hands.iwer import read_iwer
from regkit_synthesis.hands.pose import HandPose
from regkit_synthesis.motion.config import BvhConfig, ClipConfig, GltfConfig
from regkit_synthesis.motion.motion import Motion
from tests.fuzz import oracles
from tests.fuzz.kind import Damaged, Files, Kind
from tests.fuzz.seeds.meshes import glb

SHIPPED = Path(assets.__file__).parent


def _human_glb() -> list[Files]:
    lines = "".join(f"  {joint}: {joint}\n" for joint in FIGURE)
    return [{**glb(tuple(FIGURE))[0], "map.yaml": f"joints:\n{lines}".encode()}]


def _shipped(folder: str, *names: str, file: str, lines: int | None = None) -> list[Files]:
    texts = [(SHIPPED / folder / name).read_bytes().splitlines(keepends=True) for name in names]
    return [{file: b"".join(text[:lines])} for text in texts]


def _short_bvh() -> list[Files]:
    """A shipped motion of three frames."""
    (seed,) = _shipped("bvhtoolbox", "kneel.bvh", file="motion.bvh")
    lines = seed["motion.bvh"].splitlines(keepends=True)
    (frames,) = (n for n, line in enumerate(lines) if line.startswith(b"Frames:"))
    kept = [*lines[:frames], b"Frames: 3\n", *lines[frames + 1 : frames + 5]]
    return [{"motion.bvh": b"".join(kept)}]


def motion_nonsense(value: Motion, file: Damaged) -> Iterator[str]:
    if not 0.0 < value.duration < 1e6:
        yield f"duration: {value.duration}"
    for share in (0.0, 0.37, 1.0):
        pose = value.at(share * value.duration)
        yield from oracles.numbers(pose.root, "root", most=oracles.FARTHEST)
        for joint, turn in pose.rotations.items():
            if not np.allclose(turn @ turn.T, np.eye(3), atol=1e-3):
                yield f"{joint}: not a rotation"
                break


def _hand(value: HandPose, file: Damaged) -> Iterator[str]:
    yield from oracles.every_number(value, "pose")


MOTIONS = (
    Kind(
        "motions/bvh",
        _short_bvh,
        {"motion.bvh": "text"},
        lambda path: BvhConfig(path=path).motion(),
        motion_nonsense,
        weight=1.0,
    ),
    Kind(
        "motions/clip",
        lambda: _shipped("humanoid_pybullet", "humanoid3d_jump.txt", file="clip.txt"),
        {"clip.txt": "json"},
        lambda path: ClipConfig(path=path).motion(),
        motion_nonsense,
        weight=1.0,
    ),
    Kind(
        "motions/gltf",
        _human_glb,
        {"mesh.glb": "glb", "map.yaml": "yaml"},
        lambda folder: GltfConfig(path=folder / "mesh.glb", map=str(folder / "map.yaml")).motion(),
        motion_nonsense,
        whole=True,
        weight=1.0,
    ),
    Kind(
        "motions/handywork",
        lambda: _shipped("handywork", "fist.handpose", "point.handpose", file="pose.handpose"),
        {"pose.handpose": "text"},
        read_handywork,
        _hand,
        weight=0.5,
    ),
    Kind(
        "motions/iwer",
        lambda: _shipped("iwer", "pinch.js", file="pose.js"),
        {"pose.js": "text"},
        read_iwer,
        _hand,
        weight=0.5,
    ),
)
