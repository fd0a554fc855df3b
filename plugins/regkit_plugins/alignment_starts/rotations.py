"""Many rotations, each registered with few points."""

from __future__ import annotations

from typing import Literal

from regkit.clouds import spacing
from regkit.interfaces import Method
from regkit.interfaces.alignment_start import AlignmentCandidate, AlignmentStart
from regkit.search.rotations import by_rotations
from regkit.system.arrays import Array


class Rotations(AlignmentStart):
    """The best of the 60 rotations of the icosahedron, each registered by the method itself.

    It needs no features, but clouds that overlap for the most part, and much more time.
    """

    kind: Literal["rotations"] = "rotations"

    def candidates(self, source: Array, target: Array, method: Method) -> list[AlignmentCandidate]:
        """Returns the result with the greatest fitness and overlap."""
        transform, description = by_rotations(source, target, method)
        return [AlignmentCandidate(transform, 4.0 * spacing(source), description)]
