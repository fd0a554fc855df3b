"""The parts of a depth camera's noise, each with its formula and where that comes from."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from regkit.config.model import Model
from regkit.system.arrays import Array
from regkit_synthesis.cameras.raycast import View
from regkit_synthesis.noise.edges import displaced, step_across

NotNegative = Annotated[float, Field(ge=0.0)]
Share = Annotated[float, Field(ge=0.0, le=1.0)]

STEEPEST = np.radians(85.0)
"""Angle of incidence beyond which noise grows no more; nobody measured it there [rad]."""


class AxialNoise(Model):
    """Gaussian noise of the depth z of a surface that is seen at the angle theta to its normal.

    sigma = (constant + quadratic (z - nearest)^2) / cos(theta)^shading
    + oblique / sqrt(z) (theta / (pi/2 - theta))^2

    Triangulation makes the noise grow with the square of the depth (Khoshelham and Elberink,
    Accuracy and Resolution of Kinect Depth Data, Sensors 2012). So does a time of flight, whose
    noise is inverse to the amplitude of the light that comes back, and this falls with the square
    of the distance and, on a matte surface, with the cosine (Lange and Seitz, Solid-State
    Time-of-Flight Range Camera, IEEE J. Quantum Electronics 2001). The whole of it, without
    ``shading``, is what Nguyen, Izadi and Lovell measured of a Kinect (Modeling Kinect Sensor Noise
    for Improved 3D Reconstruction and Tracking, 3DIMPVT 2012); they leave the last part out below
    60 degrees, where it is less than 0.4 mm from a metre on.
    """

    constant: NotNegative = 0.0
    """Noise at the nearest depth [m]."""
    quadratic: NotNegative = 0.0
    """How it grows with the square of the depth [1/m]."""
    nearest: NotNegative = 0.0
    """The depth from which it grows [m]."""
    shading: NotNegative = 0.0
    """0: as strong on a slanted surface; 1: inverse to the cosine, as the light that comes back."""
    oblique: NotNegative = 0.0
    """How strong it becomes at grazing incidence [m^1.5]."""

    def sigma(self, depth: Array, cosines: Array) -> Array:
        """The standard deviation (...) [m] at depths (...) [m] under cosines (...)."""
        angle = np.minimum(np.arccos(np.clip(cosines, 0.0, 1.0)), STEEPEST)
        facing = self.constant + self.quadratic * (depth - self.nearest) ** 2
        grazing = self.oblique * (angle / (np.pi / 2.0 - angle)) ** 2
        return np.asarray(facing / np.cos(angle) ** self.shading + grazing / np.sqrt(depth))

    def applied(self, view: View, random: np.random.Generator) -> Array:
        """The depth (H, W) [m] with noise."""
        normal = random.standard_normal(view.depth.shape)
        seen = view.depth > 0.0
        noisy = view.depth.copy()
        noisy[seen] += self.sigma(view.depth[seen], view.cosines[seen]) * normal[seen]
        return np.maximum(noisy, 0.0)


class LateralNoise(Model):
    """A pixel measures what is seen a little to its side; outlines fray, slopes become rough.

    sigma = constant_px + oblique_px theta / (pi/2 - theta), Gaussian in rows and in columns and
    rounded to whole pixels. Source: Nguyen, Izadi and Lovell, 3DIMPVT 2012, who find 0.8 px and
    0.035 px.
    """

    constant_px: NotNegative = 0.0
    """Standard deviation on a surface that faces the camera [px]."""
    oblique_px: NotNegative = 0.0
    """How it grows with the angle of incidence [px]."""

    def sigma(self, cosines: Array) -> Array:
        """The standard deviation (...) [px] under cosines (...)."""
        angle = np.minimum(np.arccos(np.clip(cosines, 0.0, 1.0)), STEEPEST)
        return np.asarray(self.constant_px + self.oblique_px * angle / (np.pi / 2.0 - angle))

    def applied(self, view: View, random: np.random.Generator) -> View:
        """The view with every pixel displaced."""
        shifts = random.standard_normal((2, *view.depth.shape)) * self.sigma(view.cosines)
        return displaced(view, np.rint(shifts).astype(np.intp))


class FlyingPixels(Model):
    """Pixels at edges that measure something between the near and the far surface.

    A share of the pixels beside a step of the depth measures z + u step, u uniform in 0 to 1: light
    of both surfaces falls on it. Beyond an outline there is nothing; the step is then ``reach``.
    Source: May, Droeschel, Holz et al., Three-dimensional Mapping with Time-of-flight Cameras,
    J. Field Robotics 2009, for such "jump edges"; which share, is a choice.
    """

    share: Share
    """How many of the pixels beside a step are such."""
    jump: Annotated[float, Field(gt=0.0)] = 0.1
    """How large a difference of neighbours is a step [m]."""
    reach: Annotated[float, Field(gt=0.0)] = 0.3
    """How far they fly at most [m]."""

    def applied(self, depth: Array, random: np.random.Generator) -> Array:
        """The depth (H, W) [m] with flying pixels."""
        chosen, share = random.random((2, *depth.shape))
        step = step_across(depth)
        flying = (np.abs(step) >= self.jump) & (chosen < self.share)
        way = share * np.clip(step, -self.reach, self.reach)
        return np.asarray(np.where(flying, depth + way, depth))


class MissingPixels(Model):
    """Pixels that measure nothing: at random, beside steps of the depth, at grazing incidence.

    Mallick, Das and Majumdar, Characterizations of Noise in Kinect Depth Images: A Review, IEEE
    Sensors J. 2014, name these causes; how many, is a choice.
    """

    share: Share = 0.0
    """How many of all pixels."""
    edge_share: Share = 0.0
    """How many of those beside a step."""
    jump: Annotated[float, Field(gt=0.0)] = 0.1
    """How large a difference of neighbours is a step [m]."""
    grazing_deg: Annotated[float, Field(gt=0.0, le=90.0)] = 90.0
    """Angle between ray and normal beyond which nothing is measured [deg]."""

    def missing(self, view: View, random: np.random.Generator) -> Array:
        """Which pixels (H, W) measure nothing of a view."""
        anywhere, at_edges = random.random((2, *view.depth.shape))
        edge = np.abs(step_across(view.depth)) >= self.jump
        grazing = view.cosines < np.cos(np.radians(self.grazing_deg))
        return np.asarray((anywhere < self.share) | (edge & (at_edges < self.edge_share)) | grazing)
