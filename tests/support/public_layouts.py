"""Small files in the layouts of published data sets, made from one scene.

The scene in the camera's frame: a wall at 3 m, before it a square at 2 m that moves to the right
by ``STEP`` columns in each frame, with a head above its centre, a left hand to the right of it (as
of a person who faces the camera) and a right hand to the left.
"""

from pathlib import Path

import h5py
import numpy as np
from scipy.io import savemat

from regkit.geometry.camera import Camera
from regkit_plugins.datasets.formats.organized_clouds.records import RecordLayout
from regkit_plugins.datasets.itop.recording import JOINTS

FRAMES = 4
STEP = 6
WALL, SQUARE = 3.0, 2.0
SMALL = Camera(width=40, height=30, fx=36.0, fy=35.0, cx=19.0, cy=15.5)
BODY = {"head": (0.0, -0.2), "left_hand": (0.3, 0.1), "right_hand": (-0.3, 0.1)}


def depth_image(frame: int, camera: Camera = SMALL) -> np.ndarray:
    """(H, W) [m]; one pixel in the corner has no measurement."""
    depth = np.full((camera.height, camera.width), WALL)
    depth[square(frame, camera)] = SQUARE
    depth[0, 0] = 0.0
    return depth


def square(frame: int, camera: Camera = SMALL) -> tuple[slice, slice]:
    """Rows and columns of the square."""
    rows = slice(camera.height // 3, 2 * camera.height // 3)
    left = camera.width // 8 + STEP * frame
    return rows, slice(left, left + camera.width // 8)


def body(frame: int, camera: Camera = SMALL) -> dict[str, np.ndarray]:
    """Positions [m] by name."""
    rows, columns = square(frame, camera)
    middle = np.array([columns.start + columns.stop - 1, rows.start + rows.stop - 1]) / 2.0
    x, y = (middle - [camera.cx, camera.cy]) * SQUARE / [camera.fx, camera.fy]
    return {name: np.array([x + dx, y + dy, SQUARE]) for name, (dx, dy) in BODY.items()}


def write_records(
    path: Path, record: RecordLayout, signs: tuple[int, int, int] = (1, -1, -1)
) -> None:
    """A file of frame records; the points are the camera's times ``signs``."""
    records = np.zeros(FRAMES, dtype=record.dtype)
    for frame, entry in enumerate(records):
        depth = depth_image(frame)
        entry["magic"], entry["frame"] = 0x5EED, frame
        entry["points"] = SMALL.rays() * depth[..., None] * signs
        entry["marker_count"], entry["joint_count"] = 2, 1
        positions = body(frame)
        for slot, name in enumerate(("left_hand", "right_hand")):
            entry["markers"][slot] = (name.encode() + b"\0rest", positions[name] * signs)
        entry["joints"][0] = (7, positions["head"] * signs)
    # The right hand is not seen in the second frame, in the way of motion capture: all zero.
    records[1]["markers"][1]["position"] = 0.0
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(records.tobytes())


def write_itop(root: Path, view: str = "side", split: str = "test") -> None:
    """Three people's frames in one file: 0 to 2 of one, 5 and 6 of another, 8 of it, 0 of a third.

    The second frame of all is not valid.
    """
    identifiers = [
        "00_00000",
        "00_00001",
        "00_00002",
        "03_00005",
        "03_00006",
        "03_00008",
        "11_00000",
    ]
    count = len(identifiers)
    camera = Camera(320, 240, 1 / 0.0035, 1 / 0.0035, 160.0, 120.0)
    joints = np.zeros((count, len(JOINTS), 3), dtype=np.float32)
    depth = np.zeros((count, 240, 320), dtype=np.float16)
    parts = np.full((count, 240, 320), -1, dtype=np.int16)
    for index in range(count):
        depth[index] = depth_image(index, camera)
        parts[index][square(index, camera)] = 8
        for name, position in body(index, camera).items():
            joints[index, JOINTS.index(name)] = position * [1.0, -1.0, 1.0]
    valid = np.array([1, 0, 1, 1, 1, 1, 1], dtype=np.int16)
    root.mkdir(parents=True, exist_ok=True)
    names = np.array(identifiers, dtype="S8")
    with h5py.File(root / f"ITOP_{view}_{split}_depth_map.h5", "w") as file:
        file["id"], file["data"] = names, depth
    with h5py.File(root / f"ITOP_{view}_{split}_labels.h5", "w") as file:
        file["id"], file["is_valid"] = names, valid
        file["segmentation"], file["real_world_coordinates"] = parts, joints
        file["visible_joints"] = np.ones((count, len(JOINTS)), dtype=np.int16)


def write_pdt13(root: Path, name: str = "M2_D1", *, hdf5: bool = False) -> None:
    """Depth images and positions in millimetres, as MATLAB writes them by default or in 7.3."""
    images = [np.rint(1000.0 * depth_image(frame)) for frame in range(FRAMES)]
    depth = np.stack(images, axis=2).astype(np.uint16)
    joints = 1000.0 * np.stack([list(body(frame).values()) for frame in range(FRAMES)], axis=2)
    joints[0, :, 1] = np.nan
    for part, values in (("depth", depth), ("joints", joints)):
        path = root / f"{name}_{part}.mat"
        path.parent.mkdir(parents=True, exist_ok=True)
        if hdf5:
            with h5py.File(path, "w", userblock_size=512) as file:
                file[part] = values.T
            with path.open("r+b") as stream:
                stream.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124))
        else:
            savemat(path, {part: values}, do_compression=True)
