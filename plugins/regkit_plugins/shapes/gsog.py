"""G-SoG: the shape model of a generalized sum of Gaussians with full covariances."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from regkit.body import Body, EllipsoidParameters, ShapeParameters, ellipsoids
from regkit.gaussians.surface import Surface, shown
from regkit.interfaces import ListedShapeModel
from regkit.primitives import Gaussians, Primitives
from regkit.system.arrays import Array
from regkit.system.errors import ConfigError


class GeneralizedSumOfGaussians(ListedShapeModel):
    """Generalized sum of Gaussians, eqs. 2 and 3.

    The Gaussians are those that the template lists. If it lists none, each of its capsules becomes
    the Gaussian with the mean and covariance of the solid capsule.
    """

    kind: Literal["gsog"] = "gsog"
    makes: ClassVar[type[Primitives]] = Gaussians
    parameters: ClassVar[type[ShapeParameters] | None] = EllipsoidParameters

    surface: Surface = "volume"
    """Whether kernels compare data with the whole Gaussian, or with its visible surface."""

    def bind(self, body: Body) -> Gaussians:
        """Returns the template's Gaussians, or those with the moments of its capsules.

        Raises:
            ConfigError: If the template has neither Gaussians nor capsules, or lacks a named list.
        """
        listed = self.listed(body)
        gaussians = _moments_of(body) if listed is None else Gaussians(*ellipsoids(listed))
        return shown(gaussians, self.surface)


def _moments_of(body: Body) -> Gaussians:
    capsules = body.capsules
    if not len(capsules):
        raise ConfigError(
            f"the template '{body.name}' has neither shapes.gsog nor capsules, which shape 'gsog' "
            "needs"
        )
    moments = [
        _moments(ends, radii) for ends, radii in zip(capsules.ends, capsules.radii, strict=True)
    ]
    return Gaussians(
        segments=capsules.segments,
        centres=np.array([centre for centre, _, _ in moments]),
        axes=np.array([axes for _, axes, _ in moments]),
        scales=np.array([scales for _, _, scales in moments]),
        weights=np.ones(len(moments)),
    )


def _moments(ends: Array, radii: Array) -> tuple[Array, Array, Array]:
    """Returns centre (3,) [m], axes (3, 3) and standard deviations (3,) [m] of a solid capsule.

    The moments are integrated over thin discs perpendicular to the axis; a disc of radius r has the
    variance r^2/4 in each direction of its plane.
    """
    length = float(np.linalg.norm(ends[1] - ends[0]))
    unit = (ends[1] - ends[0]) / length if length > 0.0 else np.array([0.0, 1.0, 0.0])
    heights = np.linspace(-radii[0], length + radii[1], 400)
    centres = np.linspace(0.0, length, 50)
    spheres = np.linspace(radii[0], radii[1], 50)
    squares = spheres**2 - (heights[:, None] - centres) ** 2
    discs = np.maximum(squares.max(axis=1), 0.0)  # Squared radius of the solid at each height.
    mass = discs / discs.sum()
    middle = float(mass @ heights)
    along = float(mass @ (heights - middle) ** 2)
    across = float(mass @ discs) / 4.0
    helper = np.eye(3)[np.argmin(np.abs(unit))]
    side = np.cross(unit, helper)
    side /= np.linalg.norm(side)
    axes = np.column_stack([side, unit, np.cross(side, unit)])
    return ends[0] + middle * unit, axes, np.sqrt([across, along, across])
