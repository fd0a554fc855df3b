"""Laws of a kernel's form for rigid bodies, for every shape that it accepts."""

from __future__ import annotations

import numpy as np
import pytest

from regkit.body import Body
from regkit.system.errors import RegkitError
from regkit.testing.bound import Bound
from regkit.testing.cases import Pair
from regkit.testing.laws import Laws, checked_on_every
from regkit.testing.verdict import require


class RigidLaws(Laws):
    """Laws of ``Kernel.bind_rigid``, which is optional."""

    @checked_on_every("option")
    def test_kernel_of_a_rigid_body_sums_over_its_primitives(
        self, pair: Pair, rigid_body: Body, random: np.random.Generator
    ) -> None:
        """Bound for a rigid body, it has the same energy, the sums of wrenches and of blocks."""
        try:
            pair.shape.bind(rigid_body)
        except RegkitError as error:
            pytest.skip(str(error))
        bound = Bound.near(pair, rigid_body, random)
        comparison = bound.kernel.bind_rigid(bound.data, bound.primitives)
        if comparison is None:
            pytest.skip("it has no form for rigid bodies")
        root, placed = bound.start.root, bound.placed()
        general = bound.similarity()(placed, curvature=True)
        answer = comparison.paired(root)(root)
        # The body's origin and axes are the reference of the sums.
        turn = np.kron(np.eye(2), root[:3, :3].T)
        wrench = turn @ placed.accumulate(general.wrenches, 1)[0]
        at = type(comparison.paired(root)).__call__
        require(
            bool(np.isclose(answer.energy, general.energy, rtol=1e-6, atol=1e-6)), bound.kernel,
            f"has the energy {answer.energy:.6g} for a rigid body but {general.energy:.6g} for its "
            "primitives", look_at=at,
        )  # fmt: skip
        by = np.abs(answer.wrenches[0] - wrench).max() / max(np.abs(wrench).max(), 1e-300)
        require(
            by < 1e-4, bound.kernel, f"has a wrench of a rigid body that differs by {by:.2g} from "
            "that of its primitives, in the body's axes about its origin", look_at=at,
        )  # fmt: skip
        if general.stiffness is None or answer.stiffness is None:
            require(
                general.stiffness is answer.stiffness, bound.kernel,
                "has blocks either for a rigid body or for its primitives alone", look_at=at,
            )  # fmt: skip
            return
        block = turn @ placed.accumulate_stiffness(general.stiffness, 1)[0] @ turn.T
        by = np.abs(answer.stiffness[0] - block).max() / max(np.abs(block).max(), 1e-300)
        require(
            by < 1e-4, bound.kernel, f"has a block of a rigid body that differs by {by:.2g} from "
            "that of its primitives", look_at=at,
        )  # fmt: skip
