"""Records: the data of a tracked recording from which its figures and overlays can be redrawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from regkit.interfaces import Registrar
from regkit.metrics import PCK_FRACTION, JointErrors, Losses
from regkit.observation import Truth
from regkit.report.frame_drawing import FrameDrawing
from regkit.system.arrays import Array, real_numbers
from regkit.tracking import Snapshot, Track, Verdict, check_verdicts

Arrays = dict[str, np.ndarray[Any, Any]]

PER_FRAME = (
    "surface_distances",
    "inlier_shares",
    "seconds",
    "preprocessing",
    "evaluations",
)
"""Arrays with a number for each frame."""


@dataclass(frozen=True)
class Record:
    """The data of a tracked recording of T frames that figures and overlays show.

    Attributes:
        fps: Frames per second of the recording.
        size: Size of the body [m].
        errors: Joint errors, if there are reference joints.
        surface_distances: Median distance of each frame's points to the body's surface, (T,) [m];
            NaN for a body without a surface.
        inlier_shares: Fraction of each frame's points that lie on the body, (T,); NaN without data.
        verdicts: Whether the body was found in each frame, (T,), as text.
        seconds: Time to preprocess and register each frame, (T,) [s].
        preprocessing: Time to preprocess each frame, (T,) [s].
        evaluations: Number of energy evaluations of each frame, (T,).
        drawings: Snapshots of the first, the worst and the last frame, without duplicates.
    """

    fps: float
    size: float
    errors: JointErrors | None
    surface_distances: Array
    inlier_shares: Array
    verdicts: NDArray[np.str_]
    seconds: Array
    preprocessing: Array
    evaluations: Array
    drawings: tuple[FrameDrawing, ...]

    @classmethod
    def of(
        cls,
        track: Track,
        snapshot: Callable[[int], Snapshot],
        registrar: Registrar,
        errors: JointErrors | None,
        truth: Truth | None,
        fps: float,
    ) -> Self:
        """Returns the record of a tracked recording.

        Args:
            track: The tracked recording.
            snapshot: Returns the snapshot of a frame by its number.
            registrar: The registrar that registered the frames.
            errors: Joint errors, if there are reference joints.
            truth: Reference joints, which overlays show.
            fps: Frames per second of the recording.
        """
        positions = None if truth is None else truth.positions
        drawings = [
            FrameDrawing.at(
                name,
                snapshot(index),
                registrar,
                None if positions is None or index >= len(positions) else positions[index],
            )
            for index, name in sorted(_chosen(track, errors).items())
        ]
        return cls(
            fps=fps,
            size=registrar.body.size,
            errors=errors,
            surface_distances=track.surface_distances,
            inlier_shares=track.inlier_shares,
            verdicts=np.array(track.verdicts, dtype=np.str_),
            seconds=track.seconds,
            preprocessing=track.preprocessing,
            evaluations=track.evaluations,
            drawings=tuple(drawings),
        )

    @property
    def pck_threshold(self) -> float:
        """The PCK threshold [m] of the body."""
        return PCK_FRACTION * self.size

    @property
    def losses(self) -> Losses:
        """The frames in which the body was lost by its joint errors, or else by its verdicts."""
        if self.errors is None or not np.isfinite(self.errors.raw).any():
            return Losses(np.asarray(self.verdicts == Verdict.LOST))
        return Losses.of(self.errors.raw, self.pck_threshold)

    def arrays(self) -> Arrays:
        """Returns the record as named arrays; those of drawings have single precision."""
        named: Arrays = {
            "fps": np.array(self.fps),
            "size": np.array(self.size),
            "surface_distances": self.surface_distances,
            "inlier_shares": self.inlier_shares,
            "verdicts": self.verdicts,
            "seconds": self.seconds,
            "preprocessing": self.preprocessing,
            "evaluations": self.evaluations,
        }
        if self.errors is not None:
            named["joints"] = np.array(self.errors.joints, dtype=np.str_)
            named["raw"] = self.errors.raw
            named["adjusted"] = self.errors.adjusted
            if self.errors.parts:
                named["parts"] = np.array(self.errors.parts, dtype=np.str_)
            if self.errors.deviations is not None and self.errors.covered is not None:
                named["deviations"] = self.errors.deviations
                named["covered"] = self.errors.covered
        for number, drawing in enumerate(self.drawings):
            named |= {f"drawing{number}_{name}": array for name, array in drawing.arrays().items()}
        return named

    @classmethod
    def from_arrays(cls, named: Mapping[str, np.ndarray[Any, Any]]) -> Self:
        """Returns the record of named arrays from ``arrays``.

        Raises:
            KeyError: If an array is missing.
            DataError: If an array holds no numbers, or verdicts no words of ``Verdict``.
            ValueError: If an array has another shape than the others.
        """
        frames = len(named["seconds"])
        check_verdicts(named["verdicts"], frames)
        values = {name: real_numbers(named[name], name) for name in PER_FRAME}
        for name, array in values.items():
            if array.shape != (frames,):
                raise ValueError(f"'{name}' has the shape {array.shape} of {frames} frames")
        errors = None
        if "joints" in named:
            joints = tuple(str(joint) for joint in named["joints"])
            parts = tuple(str(part) for part in named.get("parts", ()))
            if len(parts) not in (0, len(joints)):
                raise ValueError(f"there are {len(parts)} parts of {len(joints)} joints")
            known = [name for name in ("raw", "adjusted", "deviations", "covered") if name in named]
            errors = JointErrors(joints, **{
                name: real_numbers(named[name], name).reshape(frames, len(joints)) for name in known
            }, parts=parts)  # fmt: skip
        drawings: list[FrameDrawing] = []
        while any(name.startswith(prefix := f"drawing{len(drawings)}_") for name in named):
            own = {
                name.removeprefix(prefix): array
                for name, array in named.items()
                if name.startswith(prefix)
            }
            drawings.append(FrameDrawing.from_arrays(own))
        return cls(
            fps=float(named["fps"]),
            size=float(named["size"]),
            errors=errors,
            verdicts=named["verdicts"],
            drawings=tuple(drawings),
            **values,
        )


def _chosen(track: Track, errors: JointErrors | None) -> dict[int, str]:
    """Returns frames with data to draw, and why; the worst is by joint error, if known."""
    seen = np.flatnonzero(track.seen)
    if len(track) == 1:
        return dict.fromkeys(map(int, seen), "the only frame")
    if not len(seen):
        return {}
    chosen = {int(seen[0]): "first", int(seen[-1]): "last"}
    badness = track.surface_distances
    if errors is not None and np.isfinite(errors.raw).any():
        badness = errors.of_frames()
        badness = np.where(track.seen[: len(badness)], badness, np.nan)
    if np.isfinite(badness).any():
        worst = int(np.nanargmax(badness))
        chosen[worst] = f"{chosen[worst]}, worst" if worst in chosen else "worst"
    return chosen
