"""Poses as they are stored in files, checked, and placed with their body."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from regkit.body import Body
from regkit.body.verdict import check_verdicts
from regkit.skeleton import Pose
from regkit.system.arrays import Array, real_numbers
from regkit.system.errors import DataError
from regkit.system.guard import reading

MOVING = ("root", "balls", "hinges", "markers")
NEEDED = (*MOVING, "size")
"""Arrays that define a motion."""

SAME = 1e-6
"""Tolerance [m] between stored markers and those of the body."""


def checked_poses(
    arrays: Mapping[str, NDArray[Any]], file: Path, what: str
) -> dict[str, NDArray[Any]]:
    """Returns the arrays of a track, with those that define its motion as numbers.

    Args:
        arrays: The arrays by name.
        file: Their file, for messages.
        what: What the file should be, for messages.

    Raises:
        DataError: If an array is missing, or the poses are not finite and of one length.
    """
    missing = [name for name in NEEDED if name not in arrays]
    if missing:
        raise DataError(f"lacks the arrays {', '.join(missing)}", place=str(file))
    with reading(file, what):
        numbers = {name: real_numbers(arrays[name], name) for name in NEEDED}
        frames = len(numbers["root"])
        whole = numbers["size"].shape == () and numbers["root"].shape == (frames, 4, 4)
        if not whole or not all(
            len(numbers[name]) == frames and np.isfinite(numbers[name]).all() for name in MOVING
        ):
            raise DataError(f"damaged: not {frames} finite poses and a size")
        if "verdicts" in arrays:
            check_verdicts(arrays["verdicts"], frames)
    return {**arrays, **numbers}


def placed(body: Body, arrays: Mapping[str, NDArray[Any]]) -> Array | None:
    """Returns T_world_segment (T, S, 4, 4), or None if the body's markers are not the stored."""
    skeleton = body.skeleton
    shapes = {
        "balls": (len(skeleton.ball_links), 4),
        "hinges": (len(skeleton.hinge_links),),
        "markers": (len(body.markers.names), 3),
    }
    if any(arrays[name].shape[1:] != shape for name, shape in shapes.items()):
        return None
    poses = zip(arrays["root"], arrays["balls"], arrays["hinges"], strict=True)
    transforms = np.array([body.place(Pose(*pose)).transforms for pose in poses])
    markers = np.array([body.markers.place(one) for one in transforms])
    same = np.abs(markers - arrays["markers"]).max(initial=0.0) <= SAME
    return transforms if same else None
