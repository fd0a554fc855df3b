"""Laws of starts of alignments."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.geometry.rigid import rigid, transformed
from regkit.geometry.rotation import vector_to_matrix
from regkit.interfaces import AlignmentCandidate, AlignmentStart, Method
from regkit.system.arrays import Array
from regkit.system.errors import DependencyError
from regkit.testing.laws import Laws
from regkit.testing.verdict import copied, require, same

WITHIN = 0.1
"""Greatest distance of the best candidate from the truth, relative to the size of the cloud."""


class AlignmentStartLaws(Laws):
    """Laws of starts of alignments."""

    @pytest.fixture
    def bumpy(self) -> Array:
        """Returns points on a closed surface without symmetries, (N, 3) [m]."""
        random = np.random.default_rng(4)
        unit = random.normal(size=(2500, 3))
        unit /= np.linalg.norm(unit, axis=1, keepdims=True)
        x, y, z = unit.T
        radius = 1.0 + 0.3 * np.sin(3.0 * x + 1.0) * np.cos(4.0 * y) + 0.2 * z * x
        return np.asarray(radius[:, None] * unit * [1.0, 0.8, 0.6])

    def test_alignment_start_finds_any_orientation(
        self, alignment_start: AlignmentStart, bumpy: Array
    ) -> None:
        """Of the same cloud, turned, the first candidate is near the truth; the data stay."""
        turn = vector_to_matrix(np.array([0.5, 2.4, -1.0]))
        truth = rigid(turn, np.array([1.0, 2.0, 3.0]))
        target = transformed(truth, bumpy)
        before, at = copied((bumpy, target)), type(alignment_start).candidates
        found = self._candidates(alignment_start, bumpy, target)
        moved = transformed(found[0].transform, bumpy) - target
        by = float(np.sqrt((moved**2).sum(axis=1).mean())) / float(np.ptp(bumpy, axis=0).max())
        require(
            by < WITHIN, alignment_start,
            f"the first candidate is off by {100 * by:.2g} % of the cloud's size", look_at=at,
        )  # fmt: skip
        require(same(before, (bumpy, target)), alignment_start, "modifies the data", look_at=at)
        again = self._candidates(alignment_start, bumpy, target)
        equal = [one.transform.tolist() for one in again] == [
            one.transform.tolist() for one in found
        ]
        require(
            equal, alignment_start, "returns other candidates when called again", look_at=at,
        )  # fmt: skip

    def _candidates(
        self, start: AlignmentStart, source: Array, target: Array
    ) -> list[AlignmentCandidate]:
        method = Method.parse(Method.default("rigid"), place="the laws", field="method")
        try:
            return start.candidates(source, target, method)
        except DependencyError as error:
            # The library of a start may be an extra that is not installed.
            pytest.skip(str(error))
