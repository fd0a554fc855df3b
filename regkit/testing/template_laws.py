"""Laws of templates."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from regkit.body import Body, ListedShape
from regkit.geometry.rigid import rigid
from regkit.interfaces import Template
from regkit.testing.laws import Laws
from regkit.testing.verdict import require, same


class TemplateLaws(Laws):
    """Laws of templates."""

    @pytest.fixture
    def grown(self, template: Template) -> Body:
        """Returns the body at its smallest size."""
        return template.body(template.candidate_sizes()[0])

    def test_template_gives_a_body_of_each_size(self, template: Template) -> None:
        """The sizes are positive and ascending, and each body has the requested size."""
        sizes, at = template.candidate_sizes(), type(template).body
        require(
            len(sizes) > 0 and all(size > 0.0 for size in sizes) and list(sizes) == sorted(sizes),
            template, f"has the sizes {sizes}; they must be positive and ascending",
            look_at=type(template).candidate_sizes,
        )  # fmt: skip
        for size in (sizes[0], sizes[-1]):
            body = template.body(size)
            require(
                body.size == size, template, f"returns a body of size {body.size} for {size}",
                look_at=at,
            )  # fmt: skip
            lengths = [body.capsules.ends, body.capsules.radii, body.markers.points]
            require(
                all(np.isfinite(each).all() for each in lengths)
                and bool((body.capsules.radii > 0.0).all()), template,
                "returns a body with lengths that are not finite, or radii that are not positive",
                look_at=at,
            )  # fmt: skip

    def test_extended_template_has_optional_parts_and_the_same_sizes(
        self, template: Template
    ) -> None:
        """What the data may show is optional, and nothing that was decided is extended again."""
        longer, at = template.extended(), type(template).extended
        if longer is None:
            return
        sizes, others = template.candidate_sizes(), longer.candidate_sizes()
        require(sizes == others, template, f"has the sizes {sizes}, extended {others}", look_at=at)
        require(
            len(longer.body(sizes[0]).optional) > 0, template,
            "extended has no optional segment, on which data could lie", look_at=at,
        )  # fmt: skip
        require(
            longer.extended() is None and template.plain().extended() is None, template,
            "is extended again after it was decided", look_at=at,
        )  # fmt: skip

    def test_template_has_something_to_register(self, template: Template, grown: Body) -> None:
        """It has capsules, primitives or a surface, each on an existing segment."""
        flesh = [grown.capsules.segments, *(own.segments for own in grown.shapes.values())]
        flesh += [] if grown.surface is None else [grown.surface.segments.ravel()]
        at = type(template).body
        require(
            sum(map(len, flesh)) > 0, template, "has neither capsules nor shapes nor a surface",
            look_at=at,
        )  # fmt: skip
        carried = np.concatenate([*flesh, grown.markers.segments])
        require(
            carried.min() >= 0 and carried.max() < len(grown.skeleton.names), template,
            f"has geometry on segment {carried.max()} of {len(grown.skeleton.names)}", look_at=at,
        )  # fmt: skip

    def test_template_stances_are_within_the_limits(self, template: Template, grown: Body) -> None:
        """The first stance is the rest pose."""
        at = type(template).description
        require(
            bool(grown.stances) and grown.stances[0].name == "rest", template,
            "does not have the rest pose as its first stance", look_at=at,
        )  # fmt: skip
        for stance in grown.stances:
            by = float(np.degrees(grown.skeleton.limits.violation(stance.pose).max(initial=0.0)))
            require(
                by < 1e-6, template, f"has a stance '{stance.name}' {by:.3g} degrees beyond a "
                "joint limit", look_at=at,
            )  # fmt: skip

    def test_template_size_scales_all_lengths(self, template: Template) -> None:
        """Joints, capsules, markers and surfaces scale together."""
        sizes = template.candidate_sizes()
        if len(sizes) == 1:
            pytest.skip("it has only one size")
        small, large = template.body(sizes[0]), template.body(sizes[-1])
        factor, at = sizes[-1] / sizes[0], type(template).body
        for index, stance in enumerate(small.stances):
            first, second = (
                _lengths(body, body.stances[index].pose.root) for body in (small, large)
            )
            by = max(
                float(np.abs(factor * a - b).max(initial=0.0))
                for a, b in zip(first, second, strict=True)
            )
            require(
                by < 1e-9, template, f"does not scale evenly: in the stance '{stance.name}' a "
                f"position is off by {by:.2g} m", look_at=at,
            )  # fmt: skip

    def test_template_markers_have_names_of_their_own(
        self, template: Template, grown: Body
    ) -> None:
        """Names are unique, as columns of tables must be."""
        names = grown.markers.names
        twice = sorted({name for name in names if names.count(name) > 1})
        require(
            not twice, template, f"has several markers named {', '.join(twice)}",
            look_at=type(template).description,
        )  # fmt: skip

    def test_template_is_deterministic(self, template: Template) -> None:
        """Repeated calls return the same body."""
        size = template.candidate_sizes()[0]
        first, second = template.body(size), template.body(size)
        require(
            same((first.capsules, first.markers), (second.capsules, second.markers))
            and same(first.surface, second.surface), template,
            "returns another body when called again", look_at=type(template).body,
        )  # fmt: skip


def _lengths(body: Body, root: np.ndarray) -> list[np.ndarray]:
    """Returns positions that scale with a body, in its rest pose about the origin."""
    turned = rigid(root[:3, :3], np.zeros(3))
    transforms = body.place(body.skeleton.rest(turned)).transforms
    capsules = body.capsules.place(transforms)
    surface = [] if body.surface is None else [body.surface.place(transforms)]
    return [
        transforms[:, :3, 3], capsules.ends, capsules.radii, body.markers.place(transforms),
        *surface, *(_means(own, transforms) for own in body.shapes.values()),
    ]  # fmt: skip


def _means(listed: ListedShape[Any], transforms: np.ndarray) -> np.ndarray:
    """Returns the centres of primitives in the world (K, 3) [m]."""
    means = np.array([one.moments()[0] for one in listed.parameters]).reshape(-1, 3, 1)
    carriers = transforms[listed.segments]
    return np.asarray((carriers[:, :3, :3] @ means)[:, :, 0] + carriers[:, :3, 3])
