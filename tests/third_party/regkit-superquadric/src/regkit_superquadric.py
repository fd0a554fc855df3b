"""Superquadrics for regkit: a shape model, its primitives, and a kernel that compares them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import Field
from scipy.special import beta, gamma

from regkit.body import Body, EllipsoidParameters, ListedShape, ShapeParameters, ellipsoids
from regkit.interfaces import Kernel, ListedShapeModel
from regkit.observation import Observation
from regkit.primitives import SPHERE, Placed, Primitives, Volumes
from regkit.registration import Residuals, ResidualSimilarity, Robust
from regkit.system.arrays import Array


@dataclass(frozen=True)
class Superellipsoids(Volumes):
    """Solids about their second axis: the points whose gauge is at most one.

    With the semi-axes a = 2 scales the gauge is ``((x_1^2 / a_1^2 + x_3^2 / a_3^2)^(q / 2) +
    |x_2 / a_2|^q)^(1 / q)``: Barr, Superquadrics and angle-preserving transformations, 1981.

    Attributes:
        exponents: q of each, (K,): 2 for an ellipsoid; the larger, the more a cylinder.
    """

    exponents: Array

    def surface_points(self) -> Array:
        """Where the rays in all directions leave each solid, (K, P, 3) [m]."""
        gauges, _ = gauge(SPHERE[None], self.scales[:, None], self.exponents[:, None])
        return np.asarray(SPHERE / gauges[..., None])


def gauge(points: Array, scales: Array, exponents: Array) -> tuple[Array, Array]:
    """The gauge (...) of points (..., 3) in the solids' own axes, and its gradient (..., 3)."""
    ratios = points / (2.0 * scales)
    across = np.maximum(np.hypot(ratios[..., 0], ratios[..., 2]), 1e-12)
    along = np.abs(ratios[..., 1])
    largest = np.maximum(across, along)
    powers = (across / largest) ** exponents + (along / largest) ** exponents
    value = largest * powers ** (1.0 / exponents)
    gradients = ratios / across[..., None] * ((across / value) ** (exponents - 1.0))[..., None]
    gradients[..., 1] = np.sign(ratios[..., 1]) * (along / value) ** (exponents - 1.0)
    return value, gradients / (2.0 * scales)


class SuperellipsoidParameters(EllipsoidParameters):
    """A superellipsoid that a template lists, by its mean and standard deviations."""

    exponent: Annotated[float, Field(ge=2.0, le=20.0)] = 2.0
    """Two for an ellipsoid; the larger, the more it is a cylinder about its second axis."""


class Superquadric(ListedShapeModel):
    """The template's superellipsoids, or one for each capsule, of the same length and volume."""

    kind: Literal["superquadric"] = "superquadric"
    makes: ClassVar[type[Primitives]] = Superellipsoids
    parameters: ClassVar[type[ShapeParameters] | None] = SuperellipsoidParameters

    girth: Annotated[float, Field(gt=0.0)] = 1.0
    """Radius as a part of the template's."""

    def bind(self, body: Body) -> Superellipsoids:
        """The superellipsoids that the template lists, or one about each capsule's axis."""
        listed = self.listed(body)
        solids = self._of_capsules(body) if listed is None else _of_moments(listed)
        return replace(solids, scales=solids.scales * [self.girth, 1.0, self.girth])

    def _of_capsules(self, body: Body) -> Superellipsoids:
        capsules = self.capsules_of(body)
        lengths = np.linalg.norm(capsules.ends[:, 1] - capsules.ends[:, 0], axis=1)
        radii = capsules.radii.mean(axis=1)
        reach = 0.5 * lengths + radii
        # The part that a solid fills of the cylinder around it grows with its exponent.
        exponents = np.linspace(2.0, 20.0, 500)
        parts = gamma(1 + 2 / exponents) * gamma(1 + 1 / exponents) / gamma(1 + 3 / exponents)
        filled = (0.5 * lengths + 2.0 / 3.0 * radii) / reach
        return Superellipsoids(
            segments=capsules.segments,
            centres=capsules.ends.mean(axis=1),
            axes=capsules.frames(),
            scales=0.5 * np.column_stack([radii, reach, radii]),
            weights=np.ones(len(radii)),
            exponents=np.interp(filled, parts, exponents),
        )


def _of_moments(listed: ListedShape[SuperellipsoidParameters]) -> Superellipsoids:
    """The superellipsoids that a template lists; their variances are ratios of beta functions."""
    segments, centres, axes, sigmas, weights = ellipsoids(listed)
    exponents = np.array([one.exponent for one in listed.parameters])
    part, whole = 1.0 / exponents, beta(1.0 / exponents, 2.0 / exponents + 1.0)
    across = beta(part, 4.0 * part + 1.0) / (4.0 * whole)
    along = beta(3.0 * part, 2.0 * part + 1.0) / whole
    scales = sigmas / np.sqrt(4.0 * np.column_stack([across, along, across]))
    return Superellipsoids(segments, centres, axes, scales, weights, exponents)


class RadialDistance(Kernel):
    """Distance of each point to the nearest superellipsoid, along the ray from its centre."""

    kind: Literal["radial_distance"] = "radial_distance"
    accepts: ClassVar[type[Primitives]] = Superellipsoids

    robust: Robust = Robust(scale=0.03)
    """What a distance costs."""

    def bind(
        self, observation: Observation, start: Placed[Any], *, smoothing: float = 0.0
    ) -> BoundRadialDistance:
        """Bind the kernel to a frame's data."""
        return BoundRadialDistance(observation, self.robust.bound(smoothing=smoothing))


class BoundRadialDistance(ResidualSimilarity):
    """``r = |x| (1 - 1 / g)`` for the gauge g of a point's place x in a solid's axes.

    Source: Gross, Boult, Error of fit measures for recovering parametric solids, ICCV 1988.
    """

    def residuals(self, placed: Placed[Superellipsoids]) -> Residuals:
        """The distance of each point to its nearest solid."""
        solids, local = placed.primitives, placed.local(self.points)
        # No ray leads from a centre to itself; there the one along the first axis is taken.
        local[~local.any(axis=2), 0] = 1e-9
        gauges, gradients = gauge(local, solids.scales, solids.exponents)
        lengths, part = np.linalg.norm(local, axis=2), 1.0 - 1.0 / gauges
        gradients = (part / lengths)[..., None] * local + (lengths / gauges**2)[
            ..., None
        ] * gradients
        return self.nearest(placed, local, lengths * part, gradients)
