"""Measured frames with exact joints, rendered once and kept in the user's cache folder."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.geometry.camera import Camera
from regkit.observation import Frame
from regkit.system.arrays import Array
from regkit.system.cache import cache_folder

VERSION = 1
"""Version of all generators, incremented with every change that changes frames."""


@dataclass(frozen=True)
class Shots:
    """Some frames of a moving body.

    Attributes:
        joints: Names of the J joints.
        truth: Their exact positions in the frames' axes, (T, J, 3) [m].
        camera: Intrinsics; None for clouds.
        depth: Depth images, (T, H, W) in units of ``1 / scale`` [m]; 0 for invalid pixels.
        scale: Stored units per metre.
        clouds: Clouds without a camera, (T, N, 3) [m], instead of depth images.
    """

    joints: tuple[str, ...]
    truth: Array
    camera: Camera | None = None
    depth: NDArray[np.uint16] | None = None
    scale: float = 1000.0
    clouds: NDArray[np.float32] | None = None

    def __len__(self) -> int:
        """Returns the number of frames."""
        return len(self.truth)

    def frames(self) -> Iterator[Frame]:
        """Yields the frames, as a dataset yields them."""
        for index in range(len(self)):
            if self.clouds is not None:
                yield Frame(self.clouds[index].astype(np.float64))
                continue
            assert self.camera is not None
            assert self.depth is not None
            depth = self.depth[index] / self.scale
            yield Frame(self.camera.back_projected(depth), self.camera, depth)


def kept(name: str, make: Callable[[], Shots]) -> Shots:
    """Returns the frames of a name, made on first use.

    Args:
        name: Everything that the frames depend on, in words.
        make: Function that makes them.
    """
    key = hashlib.sha256(f"{VERSION} {name}".encode()).hexdigest()[:24]
    file = cache_folder() / "benchmarks" / "starts" / f"{key}.npz"
    if not file.is_file():
        file.parent.mkdir(parents=True, exist_ok=True)
        # Other processes may make the same frames: a file appears only when it is complete.
        own = file.with_suffix(f".{os.getpid()}.npz")
        _write(make(), own)
        own.replace(file)
    return _read(file)


def _write(shots: Shots, file: Path) -> None:
    arrays: dict[str, Any] = {
        "joints": np.array(shots.joints),
        "truth": shots.truth,
        "scale": shots.scale,
    }
    if (camera := shots.camera) is not None:
        arrays["size"] = np.array([camera.width, camera.height])
        arrays["lens"] = np.array([camera.fx, camera.fy, camera.cx, camera.cy])
    if shots.depth is not None:
        arrays["depth"] = shots.depth
    if shots.clouds is not None:
        arrays["clouds"] = shots.clouds
    np.savez_compressed(file, **arrays)


def _read(file: Path) -> Shots:
    with np.load(file) as arrays:
        camera = None
        if "lens" in arrays:
            camera = Camera(*map(int, arrays["size"]), *map(float, arrays["lens"]))
        return Shots(
            tuple(map(str, arrays["joints"])),
            arrays["truth"],
            camera,
            arrays.get("depth"),
            float(arrays["scale"]),
            arrays.get("clouds"),
        )
