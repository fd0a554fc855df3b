"""Every kernel needs a shape and every shape a kernel; otherwise they remain untested."""

from __future__ import annotations

from regkit.interfaces import Kernel, ShapeModel
from regkit.testing.cases import Pair
from regkit.testing.laws import Laws
from regkit.testing.verdict import require


class KernelPartnerLaws(Laws):
    """Shapes that a kernel accepts."""

    def test_kernel_has_a_shape_to_compare(self, kernel: Kernel) -> None:
        """At least one installed shape fits."""
        require(
            any(pair.plugin is kernel for pair in self.parameters["pair"]), kernel,
            f"accepts the primitives of no installed shape: it accepts {kernel.accepts.__name__}",
            look_at=type(kernel),
        )  # fmt: skip


class ShapePartnerLaws(Laws):
    """Kernels that accept a shape."""

    def test_shape_has_a_kernel_that_compares_it(self, shape: ShapeModel) -> None:
        """At least one installed kernel fits."""
        pairs = [pair for pair in self.parameters["pair"] if isinstance(pair, Pair)]
        require(
            any(pair.shape is shape for pair in pairs), shape, f"makes {shape.makes.__name__}, "
            "which no installed kernel accepts; derive them from a kernel's primitives, or provide "
            "a kernel", look_at=type(shape),
        )  # fmt: skip
