"""The file of a track's scene, ``scene.npz``, in the folder of the track."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body import Markers
from regkit.system.archives import read_arrays
from regkit.system.arrays import real_numbers, whole_numbers
from regkit.system.files import write_arrays
from regkit.system.guard import reading
from regkit.tracking import check_verdicts
from regkit.viewer.camera_arrays import camera_arrays, cameras_of, lens_of
from regkit.viewer.points import FramePoints
from regkit.viewer.shapes import Shape, shape_of
from regkit.viewer.track_scene import Curve, TrackScene

FILE = "scene.npz"
"""Name of the file in the folder of a track."""

WHOLE = ("bones", "marker_segments", "marked_frames")
"""Arrays that hold indices."""


def write_scene(scene: TrackScene, folder: Path) -> None:
    """Writes ``FILE`` into the folder of a track.

    Raises:
        DataError: If the file cannot be written.
    """
    write_arrays(folder / FILE, scene_arrays(scene))


def read_scene(folder: Path) -> TrackScene:
    """Returns the scene in the folder of a track.

    Raises:
        DataError: If the file is missing or damaged.
    """
    what = "a scene of regkit"
    with reading(folder / FILE, what):
        return scene_of(read_arrays(folder / FILE, what=what))


def scene_arrays(scene: TrackScene) -> dict[str, NDArray[Any]]:
    """Returns the scene as named arrays, in single precision."""
    named: dict[str, NDArray[Any]] = {
        "fps": np.array(scene.fps),
        "segments": np.array(scene.segments, dtype=np.str_),
        "bones": scene.bones.astype(np.uint16),
        "marker_names": np.array(scene.markers.names, dtype=np.str_),
        "marker_segments": scene.markers.segments.astype(np.uint16),
        "marker_points": scene.markers.points,
        "transforms": scene.transforms,
        "supports": scene.supports.astype(np.float32),
        "verdicts": scene.verdicts,
        "joints": np.array(scene.joints, dtype=np.str_),
        "reference": scene.reference.astype(np.float32),
        "marked_frames": np.array(list(scene.marked), dtype=np.uint32),
        "marked_why": np.array(list(scene.marked.values()), dtype=np.str_),
        "curve_names": np.array([one.name for one in scene.curves], dtype=np.str_),
        "curve_units": np.array([one.unit for one in scene.curves], dtype=np.str_),
        "curves": np.array([one.values for one in scene.curves], dtype=np.float32),
    }
    if scene.camera is not None:
        named["camera"] = np.array([float(value) for value in vars(scene.camera).values()])
    if scene.cameras:
        named |= camera_arrays(scene.cameras)
    if scene.ellipsoids is not None:
        named["ellipsoids"] = scene.ellipsoids
    named |= {f"points_{name}": one for name, one in scene.points.arrays().items()}
    for number, shape in enumerate(scene.shapes):
        named |= {f"shape{number}_{name}": one for name, one in shape.arrays().items()}
    return named


def scene_of(named: Mapping[str, NDArray[Any]]) -> TrackScene:
    """Returns the scene of named arrays from ``scene_arrays``.

    Raises:
        KeyError: If an array is missing.
        DataError: If an array holds no numbers, or verdicts no words of ``Verdict``.
        ValueError: If the arrays contradict each other.
    """
    segments = _texts(named["segments"])
    transforms = real_numbers(named["transforms"], "transforms")
    frames, count = len(transforms), len(segments)
    check_verdicts(named["verdicts"], frames)
    points = FramePoints.from_arrays(_part(named, "points_"))
    joints, names = _texts(named["joints"]), _texts(named["marker_names"])
    numbers = {
        "transforms": (frames, count, 7),
        "supports": (frames, count),
        "reference": (len(points), len(joints), 3),
        "marker_segments": (len(names),),
        "marker_points": (len(names), 3),
        "bones": (len(named["bones"]), 2),
        "curves": (len(named["curve_names"]), frames),
        "marked_frames": (len(named["marked_why"]),),
    }
    if "ellipsoids" in named:
        numbers["ellipsoids"] = (frames, len(names), 7)
    values: dict[str, NDArray[Any]] = {
        name: (whole_numbers if name in WHOLE else real_numbers)(named[name], name)
        for name in numbers
    }
    for name, shape in numbers.items():
        if values[name].shape != shape:
            raise ValueError(f"'{name}' has the shape {values[name].shape}, not {shape}")
    _check_range(values["bones"], count + len(names), "bones")
    _check_range(values["marker_segments"], count, "marker_segments")
    _check_range(points.frames, frames, "frames")
    marked = values["marked_frames"]
    _check_range(marked, frames, "marked_frames")
    if not np.isfinite(transforms).all():
        raise ValueError("'transforms' has numbers that are not finite")
    fps = float(named["fps"])
    if not 0.0 < fps < np.inf:
        raise ValueError(f"{fps} frames per second")
    units = _texts(named["curve_units"])
    camera = None
    if "camera" in named:
        camera = lens_of(real_numbers(named["camera"], "camera"))
    shapes: list[Shape] = []
    while own := _part(named, f"shape{len(shapes)}_"):
        shapes.append(shape_of(own, count))
    return TrackScene(
        fps=fps,
        segments=segments,
        bones=values["bones"],
        markers=Markers(names, values["marker_segments"], values["marker_points"]),
        transforms=transforms.astype(np.float32),
        supports=values["supports"],
        verdicts=named["verdicts"],
        curves=tuple(
            Curve(*one)
            for one in zip(_texts(named["curve_names"]), units, values["curves"], strict=True)
        ),
        shapes=tuple(shapes),
        points=points,
        joints=joints,
        reference=values["reference"],
        marked=dict(zip(marked.tolist(), _texts(named["marked_why"]), strict=True)),
        camera=camera,
        ellipsoids=values["ellipsoids"].astype(np.float32) if "ellipsoids" in values else None,
        cameras=cameras_of(named) if "camera_names" in named else (),
    )


def _part(named: Mapping[str, NDArray[Any]], prefix: str) -> dict[str, NDArray[Any]]:
    return {
        name.removeprefix(prefix): array for name, array in named.items() if name.startswith(prefix)
    }


def _texts(array: NDArray[Any]) -> tuple[str, ...]:
    return tuple(map(str, array))


def _check_range(indices: NDArray[Any], end: int, name: str) -> None:
    if indices.size and not (indices.min() >= 0 and indices.max() < end):
        raise ValueError(f"'{name}' is out of range")
