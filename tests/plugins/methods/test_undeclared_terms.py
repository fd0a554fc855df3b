"""A term says by its class whether it weighs primitives; one that does otherwise is refused."""

from typing import ClassVar

import numpy as np
import pytest

from regkit.config.plugin import register
from regkit.observation import Observation
from regkit.system.errors import PluginError
from regkit_plugins.methods.direct import Direct
from regkit_plugins.terms.visibility import Visibility


def test_a_term_that_weighs_without_saying_so_is_refused(linkage):
    @register
    class Silent(Visibility):
        kind: str = "silent"
        weighs: ClassVar[bool] = False

    method = Direct(
        shape="gsog", kernel="likelihood", solver="gauss_newton", terms=({"kind": "silent"},)
    )
    rest = linkage.skeleton.rest()
    points = linkage.capsules.axis_points(0.05).points
    data = Observation(points, np.ones(len(points)), np.full(len(points), 1e-3))
    with pytest.raises(PluginError, match=r"'silent' .* weighs"):
        method.bind(linkage).register(data, [rest])
