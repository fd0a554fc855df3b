"""Landmarks: measured positions of named points of the body in one frame."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from regkit.geometry.rigid import transformed
from regkit.system.arrays import Array
from regkit.system.brief import Brief
from regkit.system.errors import ConfigError, DataError


@dataclass(frozen=True)
class Landmarks(Brief):
    """L named points of the body, as a detector or a motion-capture system measures them.

    A landmark has a position in space, in the picture, or both; the one in space counts then. Its
    name is that of a template's marker; a template without such a marker ignores it.

    Attributes:
        names: Names of the template's markers, (L,).
        positions: Positions in the camera frame, (L, 3) [m]; NaN where unknown.
        pixels: Columns and rows in the rectified depth image, (L, 2) [pixels]; NaN where unknown.
        confidences: Confidences from 0 (ignored) to 1, (L,).
        alone: Whether nothing else is measured, as by a motion-capture system: the points of the
            frame are these landmarks, and no surface.

    Raises:
        DataError: If the arrays differ in length, a name is repeated, or a confidence is not from
            0 to 1.
    """

    names: tuple[str, ...]
    positions: Array
    pixels: Array
    confidences: Array
    alone: bool = False

    def __post_init__(self) -> None:
        """Validates names and arrays."""
        count = len(self.names)
        for name, shape in (("positions", (count, 3)), ("pixels", (count, 2)),
                            ("confidences", (count,))):  # fmt: skip
            found = np.shape(getattr(self, name))
            if found != shape:
                raise DataError(
                    f"there are {count} landmarks, but {name} of the shape {found}; it must be "
                    f"{shape}"
                )
        if len(set(self.names)) < count:
            twice = next(name for name in self.names if self.names.count(name) > 1)
            raise DataError(f"two landmarks are called '{twice}'")
        outside = ~((self.confidences >= 0.0) & (self.confidences <= 1.0))
        if outside.any():
            at = int(np.flatnonzero(outside)[0])
            raise DataError(
                f"the confidence of landmark '{self.names[at]}' is {self.confidences[at]:g}; it "
                "must be from 0 to 1"
            )

    @classmethod
    def in_space(
        cls, names: tuple[str, ...], positions: Array, confidences: Array | None = None
    ) -> Landmarks:
        """Returns landmarks of known positions (L, 3) [m]; their confidence is 1 by default."""
        sure = np.ones(len(names)) if confidences is None else confidences
        return cls(names, positions, np.full((len(names), 2), np.nan), sure)

    @classmethod
    def in_picture(
        cls, names: tuple[str, ...], pixels: Array, confidences: Array | None = None
    ) -> Landmarks:
        """Returns landmarks of known pixels (L, 2); their confidence is 1 by default."""
        sure = np.ones(len(names)) if confidences is None else confidences
        return cls(names, np.full((len(names), 3), np.nan), pixels, sure)

    def moved(self, T_new_old: Array) -> Landmarks:
        """Returns the landmarks in another frame, in which no camera is at the origin.

        Args:
            T_new_old: Pose of this frame in the other one, (4, 4) [m].

        Raises:
            ConfigError: If a landmark is known in the picture alone, which says little without its
                camera.
        """
        unknown = np.isnan(self.positions).any(axis=1) & (self.confidences > 0.0)
        if unknown.any():
            raise ConfigError(
                f"the landmark '{self.names[int(np.flatnonzero(unknown)[0])]}' is known in the "
                "picture alone; with several cameras, landmarks need positions in space"
            )
        return Landmarks.in_space(
            self.names, transformed(T_new_old, self.positions), self.confidences
        )

    @cached_property
    def rows(self) -> dict[str, int]:
        """Row of each name."""
        return {name: row for row, name in enumerate(self.names)}

    def renamed(self, name: Callable[[str], str]) -> Landmarks:
        """Returns the landmarks by other names."""
        return replace(self, names=tuple(map(name, self.names)))


def surest(several: Sequence[Landmarks]) -> Landmarks:
    """Returns each landmark where it is known with the greatest confidence.

    Args:
        several: Landmarks of one frame and one body, in the same frame of reference.
    """
    best: dict[str, tuple[Landmarks, int]] = {}
    for found in several:
        for row, name in enumerate(found.names):
            if name not in best or found.confidences[row] > _confidence(*best[name]):
                best[name] = found, row
    return Landmarks.in_space(
        tuple(best),
        np.array([found.positions[row] for found, row in best.values()]).reshape(-1, 3),
        np.array([_confidence(*one) for one in best.values()]),
    )


def _confidence(found: Landmarks, row: int) -> float:
    return float(found.confidences[row])
