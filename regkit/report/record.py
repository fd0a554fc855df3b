"""What is kept of a tracked recording for figures and pictures, so that they can be made anew."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from regkit.interfaces import Registrar
from regkit.metrics import PCK_PART, JointErrors, Losses
from regkit.observation import Truth
from regkit.report.look import Look
from regkit.system.arrays import Array
from regkit.tracking import Snapshot, Track

Arrays = dict[str, np.ndarray[Any, Any]]


@dataclass(frozen=True)
class Record:
    """A tracked recording of T frames as its figures need it.

    Attributes:
        fps: Frames per second at which it was recorded.
        size: Of the body [m].
        errors: Of the joints, if they have references.
        surface_distances: Median distance of a frame's points to the body's surface, (T,) [m]; NaN
            for a body without one.
        seconds: To observe and register, (T,).
        preprocessing: To observe, (T,) [s].
        evaluations: Of the energy, (T,).
        looks: The first, the worst and the last frame; one that is two of these is there once.
    """

    fps: float
    size: float
    errors: JointErrors | None
    surface_distances: Array
    seconds: Array
    preprocessing: Array
    evaluations: Array
    looks: tuple[Look, ...]

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
        """The record of what was tracked.

        Args:
            track: What was tracked.
            snapshot: Gives a frame of it by its number.
            registrar: What registered them.
            errors: Of the joints, if they have references.
            truth: The references themselves, which the pictures show.
            fps: Frames per second at which the recording was recorded.
        """
        positions = None if truth is None else truth.positions
        looks = [
            Look.at(
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
            seconds=track.seconds,
            preprocessing=track.preprocessing,
            evaluations=track.evaluations,
            looks=tuple(looks),
        )

    @property
    def near(self) -> float:
        """Within which distance [m] a joint is near its reference."""
        return PCK_PART * self.size

    @property
    def losses(self) -> Losses | None:
        """In which frames the body was lost, if that is known."""
        return None if self.errors is None else Losses.of(self.errors.raw, self.near)

    def arrays(self) -> Arrays:
        """The record as named arrays, of single precision where they are many."""
        named: Arrays = {
            "fps": np.array(self.fps),
            "size": np.array(self.size),
            "surface_distances": self.surface_distances,
            "seconds": self.seconds,
            "preprocessing": self.preprocessing,
            "evaluations": self.evaluations,
        }
        if self.errors is not None:
            named["joints"] = np.array(self.errors.joints, dtype=np.str_)
            named["raw"] = self.errors.raw
            named["adjusted"] = self.errors.adjusted
        for number, look in enumerate(self.looks):
            named |= {f"look{number}_{name}": array for name, array in look.arrays().items()}
        return named

    @classmethod
    def from_arrays(cls, named: Mapping[str, np.ndarray[Any, Any]]) -> Self:
        """The record that was written as ``arrays``.

        Raises:
            KeyError: If one is missing.
        """
        errors = None
        if "joints" in named:
            joints = tuple(str(joint) for joint in named["joints"])
            errors = JointErrors(joints, named["raw"], named["adjusted"])
        looks: list[Look] = []
        while any(name.startswith(prefix := f"look{len(looks)}_") for name in named):
            own = {
                name.removeprefix(prefix): array
                for name, array in named.items()
                if name.startswith(prefix)
            }
            looks.append(Look.from_arrays(own))
        return cls(
            fps=float(named["fps"]),
            size=float(named["size"]),
            errors=errors,
            surface_distances=named["surface_distances"],
            seconds=named["seconds"],
            preprocessing=named["preprocessing"],
            evaluations=named["evaluations"],
            looks=tuple(looks),
        )


def _chosen(track: Track, errors: JointErrors | None) -> dict[int, str]:
    """The frames to be looked at, and why; the worst by joint error, or by surface distance."""
    last = len(track.seconds) - 1
    if last == 0:
        return {0: "the only one"}
    chosen = {0: "first", last: "last"}
    badness = track.surface_distances
    if errors is not None and np.isfinite(errors.raw).any():
        known = np.isfinite(errors.raw)
        sums = np.where(known, errors.raw, 0.0).sum(axis=1)
        badness = np.where(known.any(axis=1), sums / np.maximum(known.sum(axis=1), 1), np.nan)
    if np.isfinite(badness).any():
        worst = int(np.nanargmax(badness))
        chosen[worst] = f"{chosen[worst]}, worst" if worst in chosen else "worst"
    return chosen
