"""The parts of a depth camera's noise model, with formulas and sources."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from regkit.config.model import Model
from regkit.config.quantities import Length
from regkit.sensors.noise.edges import displaced, step_across
from regkit.sensors.raycast import View
from regkit.system.arrays import Array

NotNegative = Annotated[float, Field(ge=0.0, le=1e4)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]

STEEPEST = np.radians(85.0)
"""Angle of incidence beyond which the noise is constant, for lack of measurements [rad]."""


class AxialNoise(Model):
    """Gaussian noise of the depth z of a surface at the angle of incidence theta.

    sigma = (constant + quadratic (z - nearest)^2) / cos(theta)^shading
    + oblique / sqrt(z) (theta / (pi/2 - theta))^2

    For triangulation, the noise grows with the square of the depth (Khoshelham and Elberink,
    Accuracy and Resolution of Kinect Depth Data, Sensors 2012). It also does for time of flight,
    where it is inversely proportional to the amplitude of the returned light, which decreases with
    the square of the distance and, for a matte surface, with the cosine (Lange and Seitz,
    Solid-State Time-of-Flight Range Camera, IEEE J. Quantum Electronics 2001). Without ``shading``,
    this is the model that Nguyen, Izadi and Lovell measured for a Kinect (Modeling Kinect Sensor
    Noise for Improved 3D Reconstruction and Tracking, 3DIMPVT 2012); they omit the last term below
    60 degrees, where it is less than 0.4 mm at depths over a metre.
    """

    constant: NotNegative = 0.0
    """Standard deviation at the depth ``nearest`` [m]."""
    quadratic: NotNegative = 0.0
    """Growth with the square of the depth [1/m]."""
    nearest: NotNegative = 0.0
    """Depth from which the noise grows [m]."""
    shading: NotNegative = 0.0
    """Exponent of the cosine: 0 for no dependence on the angle, 1 for matte surfaces."""
    oblique: NotNegative = 0.0
    """Strength at grazing incidence [m^1.5]."""

    def sigma(self, depth: Array, cosines: Array) -> Array:
        """Returns standard deviations (...) [m] for depths (...) [m] and cosines (...)."""
        angle = np.minimum(np.arccos(np.clip(cosines, 0.0, 1.0)), STEEPEST)
        facing = self.constant + self.quadratic * (depth - self.nearest) ** 2
        grazing = self.oblique * (angle / (np.pi / 2.0 - angle)) ** 2
        return np.asarray(facing / np.cos(angle) ** self.shading + grazing / np.sqrt(depth))

    def applied(self, view: View, random: np.random.Generator) -> Array:
        """Returns the depth (H, W) [m] with noise."""
        normal = random.standard_normal(view.depth.shape)
        seen = view.depth > 0.0
        noisy = view.depth.copy()
        noisy[seen] += self.sigma(view.depth[seen], view.cosines[seen]) * normal[seen]
        return np.maximum(noisy, 0.0)


class LateralNoise(Model):
    """Lateral noise: a pixel measures the depth of a nearby one, which frays outlines.

    sigma = constant_px + oblique_px theta / (pi/2 - theta), Gaussian in rows and columns, rounded
    to whole pixels. Source: Nguyen, Izadi and Lovell, 3DIMPVT 2012, who measure 0.8 px and
    0.035 px.
    """

    constant_px: NotNegative = 0.0
    """Standard deviation on a surface that faces the camera [px]."""
    oblique_px: NotNegative = 0.0
    """Growth with the angle of incidence [px]."""

    def sigma(self, cosines: Array) -> Array:
        """Returns standard deviations (...) [px] for cosines (...)."""
        angle = np.minimum(np.arccos(np.clip(cosines, 0.0, 1.0)), STEEPEST)
        return np.asarray(self.constant_px + self.oblique_px * angle / (np.pi / 2.0 - angle))

    def applied(self, view: View, random: np.random.Generator) -> View:
        """Returns the view with every pixel displaced."""
        shifts = random.standard_normal((2, *view.depth.shape)) * self.sigma(view.cosines)
        return displaced(view, np.rint(shifts).astype(np.intp))


class FlyingPixels(Model):
    """Flying pixels: pixels at edges with a depth between the near and the far surface.

    A fraction of the pixels next to a depth step receives light from both surfaces and measures
    z + u step, with u uniform in [0, 1]. At an outline without background the step is ``reach``.
    Source: May, Droeschel, Holz et al., Three-dimensional Mapping with Time-of-flight Cameras,
    J. Field Robotics 2009 ("jump edges"); the fraction is our choice.
    """

    share: Share
    """Fraction of the pixels next to a depth step."""
    jump: Length = 0.1
    """Minimum difference between neighbours that counts as a depth step [m]."""
    reach: Length = 0.3
    """Maximum displacement of a flying pixel [m]."""

    def applied(self, depth: Array, random: np.random.Generator) -> Array:
        """Returns the depth (H, W) [m] with flying pixels."""
        chosen, share = random.random((2, *depth.shape))
        step = step_across(depth)
        flying = (np.abs(step) >= self.jump) & (chosen < self.share)
        way = share * np.clip(step, -self.reach, self.reach)
        return np.asarray(np.where(flying, depth + way, depth))


class MissingPixels(Model):
    """Invalid pixels: at random, next to depth steps, and at grazing incidence.

    Mallick, Das and Majumdar, Characterizations of Noise in Kinect Depth Images: A Review, IEEE
    Sensors J. 2014, describe these causes; the fractions are our choice.
    """

    share: Share = 0.0
    """Fraction of all pixels."""
    edge_share: Share = 0.0
    """Fraction of the pixels next to a depth step."""
    jump: Length = 0.1
    """Minimum difference between neighbours that counts as a depth step [m]."""
    grazing_deg: Annotated[float, Field(gt=0.0, le=90.0)] = 90.0
    """Angle between ray and normal beyond which pixels are invalid [deg]."""

    def missing(self, view: View, random: np.random.Generator) -> Array:
        """Returns a mask (H, W) of the invalid pixels of a view."""
        anywhere, at_edges = random.random((2, *view.depth.shape))
        edge = np.abs(step_across(view.depth)) >= self.jump
        grazing = view.cosines < np.cos(np.radians(self.grazing_deg))
        return np.asarray((anywhere < self.share) | (edge & (at_edges < self.edge_share)) | grazing)
