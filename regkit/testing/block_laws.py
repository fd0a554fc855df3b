"""Laws of a kernel's Gauss-Newton blocks, for every shape that it accepts."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.body import Body
from regkit.testing.bound import Bound
from regkit.testing.cases import Pair
from regkit.testing.differences import best_length
from regkit.testing.laws import Laws, checked_on_every
from regkit.testing.verdict import require

TOO_FAR = 32.0
"""Maximum factor between a Gauss-Newton step and the best step of the same direction."""


class BlockLaws(Laws):
    """Laws of Gauss-Newton blocks, which are optional in a kernel."""

    @pytest.fixture
    def bound(self, pair: Pair, body: Body, random: np.random.Generator) -> Bound:
        """Returns a kernel bound to a shape and data."""
        return Bound.near(pair, body, random)

    def test_kernel_blocks_are_symmetric_and_semidefinite(self, bound: Bound) -> None:
        """A Gauss-Newton block is J^T W J of some residuals."""
        blocks = bound.similarity()(bound.placed(), curvature=True).stiffness
        if blocks is None:
            pytest.skip("it has no Gauss-Newton blocks")
        at, size = bound.answer, np.abs(blocks).max()
        require(
            blocks.shape == (len(bound.primitives), 6, 6) and np.isfinite(blocks).all(),
            bound.kernel, f"has blocks of the shape {blocks.shape}, or not finite", look_at=at,
        )  # fmt: skip
        uneven = np.abs(blocks - np.swapaxes(blocks, 1, 2)).max() / size
        require(
            uneven < 1e-9, bound.kernel, f"has blocks that are not symmetric: {uneven:.2g} of "
            "the largest entry", look_at=at,
        )  # fmt: skip
        least = np.linalg.eigvalsh(blocks).min() / size
        require(
            least > -1e-9, bound.kernel, f"has a block with the eigenvalue {least:.2g} of the "
            "largest entry; clip the weights of residuals at zero", look_at=at,
        )  # fmt: skip

    @checked_on_every("option")
    def test_kernel_blocks_fit_its_forces(self, bound: Bound, random: np.random.Generator) -> None:
        """Forces act only along stiff directions, and the step has about the right length."""
        x, problem = bound.near_start(random), bound.problem()
        equations = problem.normal_equations(x)
        if equations is None:
            pytest.skip("it has no Gauss-Newton blocks")
        _, gradient, matrix = equations
        step, *_ = np.linalg.lstsq(matrix, -gradient, rcond=1e-10)
        left = np.linalg.norm(matrix @ step + gradient) / np.linalg.norm(gradient)
        require(
            left < 1e-3, bound.kernel, f"has blocks without stiffness along its forces: no step "
            f"reduces {100 * left:.2g} % of the gradient", look_at=bound.answer,
        )  # fmt: skip
        length = best_length(problem, x, np.asarray(step))
        require(
            length > 1.0 / TOO_FAR, bound.kernel, "has blocks that are too soft: the minimum is at "
            f"{length:.2g} of the Gauss-Newton step", look_at=bound.answer,
        )  # fmt: skip
        require(
            length < TOO_FAR, bound.kernel, "has blocks that are too stiff: the minimum is at "
            f"{length:.3g} Gauss-Newton steps", look_at=bound.answer,
        )  # fmt: skip
