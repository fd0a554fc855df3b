"""Faults that are put into a right shape and a right kernel, each with the law that it breaks.

A fault is a text, what stands instead of it, the name of the law, and what the law then says.
"""

from pathlib import Path

SUPERQUADRIC = (
    Path(__file__).parents[1]
    / "third_party" / "regkit-superquadric" / "src" / "regkit_superquadric.py"
)  # fmt: skip

SHAPE = '''
from collections.abc import Callable
from typing import ClassVar, Literal

import numpy as np

from regkit.interfaces import ShapeModel
from regkit.config.plugin import register
from regkit.primitives import Gaussians, Primitives
from regkit.geometry.rotation import rotation_between


@register
class Faulty(ShapeModel):
    """A ball about each capsule."""

    kind: Literal["faulty"] = "faulty"
    makes: ClassVar[type[Primitives]] = Gaussians

    width: float = 0.5
    """A part of the radius."""

    def bind(self, body):
        capsules = body.capsules
        radii = capsules.radii.mean(axis=1)
        return Gaussians(
            segments=capsules.segments,
            centres=capsules.ends.mean(axis=1),
            axes=np.tile(np.eye(3), (len(radii), 1, 1)),
            scales=np.tile(self.width * radii[:, None], (1, 3)),
            weights=np.ones(len(radii)),
        )
'''

SHAPE_FAULTS = {
    "covers": (
        "capsules = body.capsules\n",
        "capsules = body.capsules.selected(body.capsules.segments != 1)\n",
        "test_shape_covers_every_segment",
        "shape 'faulty' has segments without a primitive: arm; look at",
    ),
    "place": (
        "centres=capsules.ends.mean(axis=1)",
        "centres=capsules.ends.mean(axis=1)[::-1]",
        "test_shape_lies_where_its_segments_are",
        "m outside its segment 'base'",
    ),
    "random": (
        "centres=capsules.ends.mean(axis=1)",
        "centres=capsules.ends.mean(axis=1) + 0.01 * np.random.default_rng().normal(size=(1, 3))",
        "test_shape_is_deterministic_and_leaves_the_body_alone",
        "shape 'faulty' makes other primitives when called again",
    ),
    "writes": (
        "radii = capsules.radii.mean(axis=1)",
        "capsules.radii[:] *= 1.01; radii = capsules.radii.mean(axis=1)",
        "test_shape_is_deterministic_and_leaves_the_body_alone",
        "shape 'faulty' ",
    ),
    "axes": (
        "np.tile(np.eye(3),",
        "np.tile(np.diag([1.0, 1.0, -1.0]),",
        "test_shape_makes_what_it_says",
        "shape 'faulty' makes axes that are not rotations",
    ),
    "transposed": (
        "axes=np.tile(np.eye(3), (len(radii), 1, 1)),\n"
        "            scales=np.tile(self.width * radii[:, None], (1, 3)),",
        "axes=np.array([rotation_between(np.eye(3)[1], b - a).T for a, b in capsules.ends]),\n"
        "            scales=[0.5, 1.5, 0.5] * radii[:, None],",
        "test_shape_has_its_axes_as_columns",
        "with transposed axes",
    ),
    "scaled": (
        "@register\nclass Faulty",
        '''class Gaussians(Gaussians):
    """Gaussians that do not grow."""

    def scaled(self, factor):
        from dataclasses import replace

        return replace(self, centres=factor * self.centres)


@register
class Faulty''',
        "test_shape_stays_in_its_place_when_scaled",
        "shape 'faulty' has primitives whose scaled() does not scale scales",
    ),
    "not written": (
        "width: float = 0.5",
        "width: float = 0.5\n    how: Callable[[int], int] = abs",
        "test_plugin_round_trips_through_yaml",
        "shape 'faulty' has a field without a YAML form (Unable to serialize",
    ),
    "other type": (
        "return Gaussians(",
        "return dict(",
        "test_shape_covers_every_segment",
        "shape 'faulty' declares makes = Gaussians, but makes dict; look at",
    ),
    "class docstring": (
        '    """A ball about each capsule."""\n',
        "",
        "test_plugin_is_documented",
        "shape 'faulty' has no docstring",
    ),
    "field docstring": (
        '    """A part of the radius."""\n',
        "",
        "test_plugin_is_documented",
        "shape 'faulty' has fields without a docstring below them: width",
    ),
    "world": (
        "@register\nclass Faulty",
        '''class Gaussians(Gaussians):
    """Gaussians that forget to turn."""

    def place(self, transforms):
        from dataclasses import replace

        return replace(super().place(transforms), axes=self.axes)


@register
class Faulty''',
        "test_shape_moves_with_the_body",
        "shape 'faulty' does not rotate with the body: place(G T) differs",
    ),
}  # fmt: skip

KERNEL = (
    SUPERQUADRIC.read_text()
    .replace('"superquadric"', '"faulty"')
    .replace('"radial_distance"', '"radial_faulty"')
    .replace("class RadialDistance(", "@register\nclass RadialDistance(")
    .replace(
        "from regkit.primitives",
        "from regkit.config.plugin import register\nfrom regkit.primitives",
    )
)

ANSWERS = """    def __call__(self, placed, *, curvature=False):
        from dataclasses import replace

        answer = super().__call__(placed, curvature=curvature)
        blocks = answer.stiffness
        return replace(answer, CHANGE)

    def residuals("""
"""A kernel whose answer is changed in one way."""


def answering(change: str) -> tuple[str, str]:
    return "    def residuals(", ANSWERS.replace("CHANGE", change)


REMEMBERS = """    seen = None

    def __call__(self, placed, *, curvature=False):
        if self.seen is not placed.primitives:
            self.seen, self.answer = placed.primitives, super().__call__(placed)
        return self.answer

    def residuals("""
"""A kernel that takes an array which it has seen for a point which it has seen."""


RESIDUALS = """    def residuals(self, placed):
        from dataclasses import replace

        right = self.right(placed)
        return replace(right, CHANGE)

    def right("""
"""A kernel whose residuals are changed in one way."""


def leaving(change: str) -> tuple[str, str]:
    return "    def residuals(", RESIDUALS.replace("CHANGE", change)


KERNEL_FAULTS = {
    "remembers": (
        "    def residuals(",
        REMEMBERS,
        "test_kernel_answers_for_the_point_after_a_step_in_place",
        "do not cache by the identity of an array",
    ),
    "torque": (
        *leaving("rows=right.rows * [1, 1, 1, -1, -1, -1]"),
        "test_kernel_gradient_is_the_derivative_of_its_energy",
        "(the forces are right, so the torques are wrong)",
    ),
    "sign": (
        *leaving("rows=-right.rows"),
        "test_kernel_gradient_is_the_derivative_of_its_energy",
        "(all signs are wrong: it must point uphill)",
    ),
    "blocks": (
        *answering("stiffness=None if blocks is None else 1e-3 * blocks"),
        "test_kernel_blocks_fit_its_forces",
        "has blocks that are too soft",
    ),
    "stiff": (
        *answering("stiffness=None if blocks is None else 1e3 * blocks"),
        "test_kernel_blocks_fit_its_forces",
        "has blocks that are too stiff",
    ),
    "negative": (
        *answering("stiffness=None if blocks is None else -blocks"),
        "test_kernel_blocks_are_symmetric_and_semidefinite",
        "clip the weights of residuals at zero",
    ),
    "where": (
        *answering("energy=answer.energy + placed.centres[0, 0]"),
        "test_kernel_is_left_alone_by_a_common_motion",
        "if body and data move together",
    ),
    "unweighted": (
        *leaving("weights=np.full(len(right.weights), 1.0 / len(right.weights))"),
        "test_kernel_takes_a_point_of_twice_the_weight_for_two",
        "ignores the weights of the data",
    ),
    "maximum": (
        *answering("energy=-answer.energy, wrenches=-answer.wrenches"),
        "test_kernel_prefers_the_body_where_the_data_are",
        "prefers a body 0.1 m away from its data",
    ),
}
