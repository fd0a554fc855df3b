"""Laws of a kernel's compiled functions, for every shape that it accepts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from regkit.registration import TangentCoordinates
from regkit.testing.bound import Bound
from regkit.testing.compiled_laws import (
    alike,
    function_of,
    planned,
    require_same,
    require_same_equations,
)
from regkit.testing.laws import Laws, checked_on_every


class CompiledKernelLaws(Laws):
    """Laws of compiled functions, which are optional in a kernel."""

    @checked_on_every("option")
    @pytest.mark.parametrize("smoothing", [0.0, 0.02])
    def test_compiled_kernel_is_the_readable_one(
        self, bound: Bound, random: np.random.Generator, smoothing: float
    ) -> None:
        """Energy, gradient, matrix and inlier probabilities agree to single precision."""
        uniform = replace(bound, data=alike(bound.data))
        part = bound.kernel.compiled(bound.primitives)
        fast = planned(
            bound.body, bound.primitives, part, uniform.data, bound.start, smoothing=smoothing
        )
        look_at, chart = function_of(part), TangentCoordinates(bound.body.skeleton, bound.start)
        x, problem = bound.near_start(random), uniform.problem(smoothing)
        require_same_equations(bound.kernel, problem, fast.problem(chart, None), x, look_at)
        pose = chart.pose(x)
        placed, similarity = uniform.placed(pose), uniform.similarity(smoothing)
        alone = np.asarray(fast.total(pose))
        require_same(
            bound.kernel, "energy alone", alone, np.asarray(similarity.energy(placed)), look_at
        )
        probability = similarity.inlier_probability(placed)
        if probability is not None:
            own = fast.inlier_probability(pose)
            require_same(bound.kernel, "inlier probability", own, probability, look_at)
