"""The law of compiled functions notices a compiled form that computes something else."""

from dataclasses import replace

import numpy as np
import pytest

from regkit.testing.bound import Bound
from regkit.testing.cases import Pair
from regkit.testing.compiled_kernel_laws import CompiledKernelLaws
from regkit.testing.samples import linkage
from regkit_plugins.kernels.likelihood import Likelihood
from regkit_plugins.shapes.gsog import GeneralizedSumOfGaussians


class OtherOutliers(Likelihood):
    def compiled(self, primitives):
        part = super().compiled(primitives)
        surface, frozen, outliers = part.numbers
        return replace(part, numbers=(surface, frozen, 1.1 * outliers))


def checked(kernel):
    random = np.random.default_rng(7)
    bound = Bound.near(Pair(kernel, GeneralizedSumOfGaussians(), "pair"), linkage(), random)
    law = CompiledKernelLaws().test_compiled_kernel_is_the_readable_one
    law(bound, random, smoothing=0.0)


def test_right_compiled_form_keeps_the_law():
    checked(Likelihood())


def test_other_compiled_form_breaks_the_law():
    with pytest.raises(pytest.fail.Exception, match="differs from the readable one"):
        checked(OtherOutliers())
