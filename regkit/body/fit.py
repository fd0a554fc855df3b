"""How well a posed body fits a cloud, judged on both sides and without a method's own energy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from regkit.body.body import Body
from regkit.body.gaps import surface_gaps
from regkit.clouds.compiled_nearest import nearest_distances
from regkit.observation.sight import Sight
from regkit.skeleton import Pose
from regkit.system.arrays import Array, loop_input

NEAR = 0.03
"""Distance within which data fit a body without capsules, as a fraction of its size."""

FARTHEST = 2.0
"""A distance counts up to this many radii of a typical limb."""


@dataclass(frozen=True)
class BodyFit:
    """Agreement of a posed body with a cloud; NaN where the body has no surface.

    Data fit if they lie within the radius of a typical limb of the surface. It is about as far as
    a limb can be off and still be the one that the data show, for a person, a hand and a robot.

    Attributes:
        distance: Median distance of the points to the body's surface [m].
        inlier_share: Fraction of the points that fit the surface, from 0 to 1.
        coverage: Fraction of the visible body that has data nearby, from 0 to 1; parts that are out
            of the picture or hidden do not count. NaN for a body without capsules.
        misfit: Mean distance of the points to the surface, and of the visible body to the points,
            each up to twice the radius of a typical limb and in units of it: 0 to 4. NaN for a body
            without capsules.
        relief: Standard deviation of the points along their thinnest direction, in radii of a
            typical limb; that of a wall is near 0, that of a body seen from one side about 1. A
            rigid body with a flatter side has a smaller unit.
    """

    distance: float
    inlier_share: float
    coverage: float
    misfit: float
    relief: float

    @classmethod
    def unknown(cls) -> BodyFit:
        """Returns the fit to no data, or of a body without a surface."""
        return cls(*(5 * [float("nan")]))

    @classmethod
    def of(cls, body: Body, pose: Pose, points: Array, sight: Sight | None = None) -> BodyFit:
        """Returns the fit of a body.

        Args:
            body: The body.
            pose: Its pose.
            points: The data, (N, 3) [m].
            sight: What the cameras show; None if everything is seen.
        """
        gaps = surface_gaps(body, pose, points)
        if gaps is None:
            return cls.unknown()
        near = tolerance(body)
        if len(body.capsules):
            points, transforms = loop_input(points), body.place(pose).transforms
            axes = body.required_axes
            spheres = axes.place(transforms)
            bare = np.maximum(nearest_distances(spheres, points, np.inf) - axes.radii, 0.0)
            if sight is not None:
                bare = bare[sight.observable(spheres, axes.radii + near)]
            # A body of which nothing is visible is not in sight.
            bare = bare if len(bare) else np.array([np.inf])
            coverage = float((bare <= near).mean())
            sides = [np.minimum(side / near, FARTHEST).mean() for side in (gaps, bare)]
            misfit = float(sum(sides))
            relief = _least_deviation(points) / _relief_of(body, pose, points)
        else:
            # The far side of an object is never seen, and an object may be flat.
            coverage = misfit = relief = float("nan")
        return cls(
            distance=float(np.median(gaps)),
            inlier_share=float((gaps <= near).mean()),
            coverage=coverage,
            misfit=misfit,
            relief=relief,
        )


def tolerance(body: Body) -> float:
    """Returns the distance within which data fit a body's surface [m]."""
    return body.limb_radius if len(body.capsules) else NEAR * body.size


def _relief_of(body: Body, pose: Pose, points: Array) -> float:
    """Returns the unit of the relief of data (N, 3) [m]: the radius of a typical limb.

    A rigid body may show a side that is flatter, such as a ball, or a box from the front: then it
    is twice the deviation of its surface beside the data.
    """
    if len(body.skeleton.names) > 1:
        return body.limb_radius
    placed = body.capsules.place(body.place(pose).transforms)
    _, distances, directions = placed.nearest(points)
    beside = _least_deviation(points - distances[:, None] * directions)
    return max(min(body.limb_radius, 2.0 * beside), 1e-9)


def _least_deviation(points: Array) -> float:
    """Returns the standard deviation [m] of points (N, 3) along their thinnest direction."""
    centred = points - points.mean(axis=0)
    return float(np.sqrt(max(np.linalg.eigvalsh(centred.T @ centred / len(points))[0], 0.0)))
