"""Kernels and shapes go together: what goes with nothing would be tried with nothing."""

from __future__ import annotations

from regkit.interfaces import Kernel, ShapeModel
from regkit.testing.cases import Pair
from regkit.testing.laws import Laws
from regkit.testing.verdict import require


class KernelPartnerLaws(Laws):
    """What a kernel compares."""

    def test_kernel_has_a_shape_to_compare(self, kernel: Kernel) -> None:
        """At least one of those that are installed."""
        require(
            any(pair.plugin is kernel for pair in self.parameters["pair"]), kernel,
            f"takes the primitives of no installed shape: it accepts {kernel.accepts.__name__}",
            look_at=type(kernel),
        )  # fmt: skip


class ShapePartnerLaws(Laws):
    """What compares a shape."""

    def test_shape_has_a_kernel_that_compares_it(self, shape: ShapeModel) -> None:
        """At least one of those that are installed."""
        pairs = [pair for pair in self.parameters["pair"] if isinstance(pair, Pair)]
        require(
            any(pair.shape is shape for pair in pairs), shape, f"makes {shape.makes.__name__}, "
            "which no installed kernel takes; derive them from the primitives of one, or bring a "
            "kernel", look_at=type(shape),
        )  # fmt: skip
