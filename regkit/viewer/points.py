"""The points of some frames, in steps of a fraction of a millimetre."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from regkit.system.arrays import Array, Indices, real_numbers, whole_numbers
from regkit.viewer.packed import packed

STEPS = 2000
"""Number of steps into which the longest side of all points is divided: a person's are of a
millimetre. Fewer digits take less space in a file."""


@dataclass(frozen=True)
class FramePoints:
    """The points of F frames.

    Attributes:
        frames: Numbers of the frames, (F,), ascending.
        origin: Centre of all points, (3,) [m].
        step: Length of a step [m].
        offsets: Where each frame's points begin and the last one's end, (F + 1,).
        positions: Steps from the origin, (P, 3).
    """

    frames: Indices
    origin: Array
    step: float
    offsets: Indices
    positions: NDArray[np.int16]

    @classmethod
    def of(cls, points: Mapping[int, NDArray[Any]]) -> Self:
        """Returns the points (N, 3) [m] of frames by their numbers."""
        frames = sorted(points)
        clouds = [np.asarray(points[frame], dtype=np.float64) for frame in frames]
        every = np.concatenate([*clouds, np.zeros((0, 3))])
        low, high = (every.min(axis=0), every.max(axis=0)) if len(every) else np.zeros((2, 3))
        origin = 0.5 * (low + high)
        step = max(float((high - low).max()) / STEPS, 1e-9)
        return cls(
            frames=np.array(frames, dtype=np.intp),
            origin=origin,
            step=step,
            offsets=np.cumsum([0, *map(len, clouds)]),
            positions=np.rint((every - origin) / step).astype(np.int16),
        )

    def __len__(self) -> int:
        """Number F of frames."""
        return len(self.frames)

    def at(self, index: int) -> Array:
        """Returns the points of the frame at an index, (N, 3) [m]."""
        part = slice(self.offsets[index], self.offsets[index + 1])
        return np.asarray(self.origin + self.step * self.positions[part])

    def by_frame(self) -> dict[int, Array]:
        """Returns the points (N, 3) [m] of each frame by its number."""
        return {int(frame): self.at(index) for index, frame in enumerate(self.frames)}

    def thinned(self, share: float) -> Self:
        """Returns about a share of each frame's points, from 0 to 1, evenly chosen."""
        clouds = {
            frame: points[np.linspace(0.0, len(points), int(share * len(points)), endpoint=False)
                          .astype(np.intp)]
            for frame, points in self.by_frame().items()
        }  # fmt: skip
        return type(self).of(clouds)

    def json(self) -> dict[str, Any]:
        """Returns the points as JSON."""
        return {
            "origin": self.origin.tolist(),
            "step": self.step,
            "offsets": packed(self.offsets, "u4"),
            "positions": packed(self.positions, "i2"),
        }

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Returns the points as named arrays."""
        return {
            "frames": self.frames.astype(np.uint32),
            "origin": self.origin,
            "step": np.array(self.step),
            "offsets": self.offsets.astype(np.uint32),
            # Neighbours are near each other, so that differences take less space.
            "differences": np.diff(self.positions, axis=0, prepend=np.int16(0)),
        }

    @classmethod
    def from_arrays(cls, named: Mapping[str, NDArray[Any]]) -> Self:
        """Returns the points of named arrays from ``arrays``.

        Raises:
            KeyError: If an array is missing.
            DataError: If an array does not hold the right kind of numbers.
            ValueError: If the arrays contradict each other.
        """
        frames = whole_numbers(named["frames"], "frames")
        offsets = whole_numbers(named["offsets"], "offsets")
        origin = real_numbers(named["origin"], "origin")
        differences = whole_numbers(named["differences"], "differences")
        positions = np.cumsum(differences, axis=0, dtype=np.int16)
        step = float(named["step"])
        sound = (
            positions.shape == (len(positions), 3)
            and frames.shape == (len(frames),)
            and offsets.shape == (len(frames) + 1,)
            and origin.shape == (3,)
            and np.isfinite([step, *origin]).all()
        )
        if not sound or (np.diff(offsets) < 0).any() or (np.diff(frames) <= 0).any():
            raise ValueError("the points of the frames contradict each other")
        if offsets[0] != 0 or offsets[-1] != len(positions):
            raise ValueError(f"the frames have {offsets[-1]} points; {len(positions)} are there")
        return cls(frames, origin, step, offsets, positions)


def packed_frame(points: Array, most: int) -> dict[str, Any]:
    """Returns at most ``most`` points (N, 3) [m] of one frame as JSON with steps of their own."""
    alone = FramePoints.of({0: points[:: max(1, -(-len(points) // most))]})
    return {
        "origin": alone.origin.tolist(),
        "step": alone.step,
        "positions": packed(alone.positions, "i2"),
    }


def frame_bytes(points: Array) -> bytes:
    """Returns points (N, 3) [m] as 4 float32, origin and step, followed by int16 steps (N, 3)."""
    alone = FramePoints.of({0: points})
    head = np.array([*alone.origin, alone.step], dtype="<f4")
    return head.tobytes() + alone.positions.astype("<i2").tobytes()


def evenly(frames: Sequence[int], most: int, marked: Sequence[int]) -> list[int]:
    """Returns at most ``most`` of the frames: those marked, and others spread evenly."""
    kept = [frame for frame in frames if frame in set(marked)][:most]
    others = [frame for frame in frames if frame not in set(kept)]
    room = min(most - len(kept), len(others))
    chosen = np.linspace(0, len(others) - 1, room).round().astype(int)
    return sorted({*kept, *(others[at] for at in chosen)})
