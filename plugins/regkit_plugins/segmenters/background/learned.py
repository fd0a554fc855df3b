"""The depth of the static background, learned per pixel."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from regkit.system.arrays import Array

NEAR = 0.1
"""Samples within this fraction of the background's depth show the background and its noise."""

DEVIATIONS = 5.0
"""Number of standard deviations of the noise within which points are background's."""

USUAL = 0.5
"""A pixel that is measured in this share of the frames may have a background with dropouts."""


@dataclass(frozen=True)
class StaticDepth:
    """The static background of a camera.

    Attributes:
        depth: Depth of each pixel, (H, W) [m]; infinite where the background is out of range.
        noise: Bound of its noise, (H, W) [m].
    """

    depth: Array
    noise: Array

    @classmethod
    def learned(cls, images: Array, visible: float) -> Self:
        """Returns the background of images, the far quantile of each pixel.

        A pixel without a measurement sees farther than the camera measures, unless it comes and
        goes as dropouts do: a person comes and goes seldom.

        Args:
            images: Depth images, (T, H, W) [m]; zero marks a pixel without a measurement.
            visible: Least share of the images in which the background is visible.
        """
        # The order of the depths tells all; they are sorted in place to spare memory.
        depths = np.where(images > 0.0, images, np.inf)
        depths.sort(axis=0)
        count = len(depths)
        far = depths[count - max(1, int(np.ceil(visible * count)))].astype(np.float64)
        measured = np.isfinite(depths).sum(axis=0)
        middle = np.take_along_axis(depths, np.maximum(measured - 1, 0)[None] // 2, axis=0)[0]
        scale = _noise_scale(depths, far)
        share = measured / count
        changes = np.count_nonzero(np.diff(images > 0.0, axis=0), axis=0)
        # Of dropouts at random, half of this is expected at least in nearly every pixel.
        flickers = changes >= share * (1.0 - share) * (count - 1)
        filled = np.isinf(far) & (share >= USUAL) & flickers
        far[filled] = middle[filled]
        known = np.where(np.isfinite(far), far, 0.0)
        return cls(far, DEVIATIONS * scale * known**2)


def _noise_scale(depths: Array, far: Array) -> float:
    """Returns the standard deviation of the background's noise at 1 m; it grows with depth squared.

    Args:
        depths: Sorted depths of each pixel, (T, H, W) [m].
        far: Depth of the background, (H, W) [m].
    """
    step = max(1, far.size // 5000)
    at = far.reshape(-1)[::step]
    some = depths.reshape(len(depths), -1)[:, ::step][:, np.isfinite(at)]
    at = at[np.isfinite(at)]
    some = some[:, at > 0.0]
    gaps = np.abs(some - at)
    close = gaps < NEAR * at
    ratios = (gaps / at**2)[close]
    return float(1.4826 * np.median(ratios)) if len(ratios) else 0.0
