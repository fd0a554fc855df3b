"""How well a posed body fits a cloud, judged on both sides and without a method's own energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

from regkit.body.body import Body
from regkit.body.distance import model_to_data
from regkit.geometry.capsules import Capsules
from regkit.skeleton import Pose
from regkit.system.arrays import Array

NEAR = 0.03
"""Distance within which data fit a body without capsules, as a fraction of its size."""

SPACING = 0.05
"""Distance of the points on a body's axes, as a fraction of its size."""


@dataclass(frozen=True)
class BodyFit:
    """Agreement of a posed body with a cloud; NaN where the body has no surface.

    Data fit if they lie within the radius of a typical limb of the surface. It is about as far as
    a limb can be off and still be the one that the data show, for a person, a hand and a robot.

    Attributes:
        distance: Median distance of the points to the body's surface [m].
        inlier_share: Fraction of the points that fit the surface, from 0 to 1.
        coverage: Fraction of the body that has data nearby, from 0 to 1; parts that are out of the
            picture or occluded have none. NaN for a body without capsules.
        relief: Standard deviation of the points along their thinnest direction, in radii of a
            typical limb; that of a wall is near 0, that of a body seen from one side about 1.
    """

    distance: float
    inlier_share: float
    coverage: float
    relief: float

    @classmethod
    def unknown(cls) -> BodyFit:
        """Returns the fit to no data, or of a body without a surface."""
        return cls(float("nan"), float("nan"), float("nan"), float("nan"))

    @classmethod
    def of(cls, body: Body, pose: Pose, points: Array) -> BodyFit:
        """Returns the fit of a body to points (N, 3) [m]."""
        transforms = body.place(pose).transforms
        if len(body.capsules):
            capsules = body.capsules.place(transforms)
            gaps = np.abs(capsules.surface_distance(points))
            required = body.required.place(transforms)
            bare = model_to_data(required.axis_points(SPACING * body.size), KDTree(points)).lengths
            near = _limb_radius(body.required)
            coverage = float((bare <= near).mean())
            relief = _least_deviation(points) / near
        elif body.surface is not None:
            placed = body.surface.place(transforms)
            gaps = np.asarray(KDTree(placed).query(points)[0])
            near = NEAR * body.size
            # The far side of an object is never seen, and an object may be flat.
            coverage = relief = float("nan")
        else:
            return cls.unknown()
        return cls(
            distance=float(np.median(gaps)),
            inlier_share=float((gaps <= near).mean()),
            coverage=coverage,
            relief=relief,
        )


def _least_deviation(points: Array) -> float:
    """Returns the standard deviation [m] of points (N, 3) along their thinnest direction."""
    centred = points - points.mean(axis=0)
    return float(np.sqrt(max(np.linalg.eigvalsh(centred.T @ centred / len(points))[0], 0.0)))


def _limb_radius(capsules: Capsules) -> float:
    """Returns the radius [m] of a typical limb: the median over the capsules' length."""
    radii = capsules.radii.mean(axis=1)
    lengths = np.linalg.norm(capsules.ends[:, 1] - capsules.ends[:, 0], axis=1) + 2.0 * radii
    order = np.argsort(radii)
    half = np.searchsorted(np.cumsum(lengths[order]), 0.5 * lengths.sum())
    return float(radii[order][half])
