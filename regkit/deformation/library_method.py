"""Base class of methods that call another library to deform a cloud."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from regkit.body import Body
from regkit.clouds import spacing
from regkit.deformation.deforming_method import Deformed, DeformingMethod
from regkit.deformation.moving import MovesOthers, Scaled
from regkit.deformation.posed_first import PosedFirst
from regkit.system.arrays import Array
from regkit.system.errors import DataError, RegkitError


@dataclass(frozen=True)
class Displaced:
    """The result of a library, in units of the body's extent.

    Attributes:
        moving: What moves points.
        converged: Whether it converged; true if the library does not report it.
        iterations: Number of iterations; 0 if the library does not report it.
        message: Reason of termination.
    """

    moving: MovesOthers
    converged: bool
    iterations: int
    message: str


class LibraryDeformation(DeformingMethod):
    """A method of another library that deforms a source onto a target.

    The library sees both clouds with the source's centroid as origin, in units of the source's
    extent, the root mean square distance of its points from their centroid.
    """

    @abstractmethod
    def library(self) -> Any:
        """Imports the library.

        Raises:
            DependencyError: If it is missing.
        """

    @abstractmethod
    def displaced(self, source: Array, target: Array) -> Displaced:
        """Returns what moves a source (M, 3) onto a target (N, 3), in units of the extent."""

    def bind(self, body: Body) -> PosedFirst:
        """Binds the first method to a body, and the deformation to its surface.

        Raises:
            DependencyError: If the library is missing.
            RegkitError: If the first method does not support the body, or it has no surface.
        """
        self.library()
        return super().bind(body)

    def deformed(self, source: Array, target: Array) -> Deformed:
        """Calls the library, and measures the distances of the data in units of their spacing.

        Raises:
            DataError: If the library fails, or its result is not finite.
        """
        centre = source.mean(axis=0)
        scale = float(np.sqrt(((source - centre) ** 2).sum(axis=1).mean()))
        try:
            found = self.displaced((source - centre) / scale, (target - centre) / scale)
        except RegkitError:
            raise
        except Exception as error:
            raise DataError(
                f"method '{self.kind}' failed: {type(error).__name__}: {error}"
            ) from error
        deformation = Scaled(centre, scale, found.moving)
        moved = deformation.moved(source)
        if not np.isfinite(moved).all():
            raise DataError(f"method '{self.kind}' returned points that are not finite")
        distances = scipy.spatial.KDTree(moved).query(target)[0] / spacing(source)
        inliers = np.exp(-0.5 * distances**2)
        energy = float(1.0 - inliers.mean())
        return Deformed(
            deformation, inliers, energy, found.converged, found.iterations, found.message
        )
