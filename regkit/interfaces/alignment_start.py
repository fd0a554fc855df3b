"""Starts of alignments: candidates for the motion between two rigid clouds."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from regkit.config.plugin import Plugin
from regkit.interfaces.method import Method
from regkit.system.arrays import Array
from regkit.system.brief import Brief


@dataclass(frozen=True)
class AlignmentCandidate(Brief):
    """A motion from which a method begins.

    Attributes:
        transform: T_target_source, (4, 4).
        accuracy: Root mean square distance [m] of the source's points from where they belong, if
            the candidate is right; infinite if it is only a guess. A method need not search
            farther.
        description: How it was found, for the user.
        overlap: Estimate of the fraction of both clouds that lies on the other one, less what
            contradicts it; NaN if there is none.
    """

    transform: Array
    accuracy: float
    description: str
    overlap: float = float("nan")


class AlignmentStart(Plugin, ABC):
    """A way to candidates for the motion between two clouds in any orientation."""

    group = "regkit.alignment_starts"

    @abstractmethod
    def candidates(self, source: Array, target: Array, method: Method) -> list[AlignmentCandidate]:
        """Returns candidates for T_target_source, the best first.

        Args:
            source: Points to align, (N, 3) [m].
            target: Fixed points, (M, 3) [m].
            method: The registration method, which a search may use.

        Raises:
            DataError: If no candidate is found.
            DependencyError: If a library is missing.
        """
