"""The curvature of an energy at a registered pose, from which its covariance follows."""

from __future__ import annotations

from abc import ABC, abstractmethod

from regkit.system.arrays import Array


class Curvature(ABC):
    """The Gauss-Newton matrix of an energy at its minimum, with the prior and the active limits."""

    @abstractmethod
    def covariance(self, points: float) -> Array:
        """Returns the covariance of the pose, (n, n), on the tangent space at the pose.

        Args:
            points: Effective number N of independent points, by which the energy is multiplied.
        """

    @abstractmethod
    def carried(self, points: float) -> Array:
        """Returns the covariance (n, n) by which a filter holds the pose in the next frame.

        It also counts what points tell of hidden parts, which is too little to be believed, and
        enough to keep a limb where it may be.

        Args:
            points: As for ``covariance``.
        """

    @abstractmethod
    def information(self, points: float) -> Array:
        """Returns what the data alone tell of the m independent degrees of freedom, (m, m).

        A coupled hinge is none of them.

        Args:
            points: As for ``covariance``.
        """

    @abstractmethod
    def pull(self, points: float) -> Array:
        """Returns how the data alone pull at the pose, (m,): the gradient of their log-likelihood.

        Args:
            points: As for ``covariance``.
        """
