"""Gaussians: whole ones, and those of which a camera sees the front."""

from __future__ import annotations

from dataclasses import dataclass

from regkit.primitives.volumes import Volumes


@dataclass(frozen=True)
class Gaussians(Volumes):
    """Un-normalised Gaussians, eqs. 1 and 3; the scales are standard deviations.

    ``G(x) = weight * exp(-1/2 (x - m)^T C^-1 (x - m))`` with the covariance C = R diag(scales^2)
    R^T. (The paper writes C for the matrix in the exponent and calls it a covariance; there it is a
    precision.)
    """


@dataclass(frozen=True)
class SurfaceGaussians(Gaussians):
    """Gaussians of which a camera, where there is one, sees only the front."""
